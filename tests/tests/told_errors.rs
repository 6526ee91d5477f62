//! What a run tells of its own error: random pairs of masses in a rigid link, of any stiffness and damping, under all methods that correct
//! their prediction, over macro steps from fine to far too long. A run that is wrong by a tenth of its motion ends with an error or a warning,
//! and a sound one without.

#![allow(clippy::unwrap_used, missing_docs)]

use std::f64::consts::TAU;

use linchpin::connect::Place;
use linchpin_master::setup::Options;
use linchpin_models::oscillator::OscillatorParameters;
use linchpin_tests::masses::scene_text;
use linchpin_tests::runs::try_run;
use linchpin_tests::scenes::{oscillator_with, with_settings};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

const METHODS: [&str; 7] = [
    "method=hermite",
    "method=hermite degree=3",
    "method=hermite degree=4",
    "method=hermite degree=5",
    "method=weighted index=2 degree=0",
    "method=weighted index=1 degree=1",
    "method=baumgarte index=2 degree=0 beta=2H",
];

/// Percentage of the runs that may be warned of although they are sound: a word too many costs less than one too few.
const MOST_ALARMS: usize = 10;

/// Two masses in a rigid link that start with the same speed; the macro step as a share of their common period.
#[derive(Debug, Clone)]
struct Swing {
    masses: [OscillatorParameters; 2],
    share: f64,
}

fn swing() -> impl Strategy<Value = Swing> {
    let power = |from: f64, to: f64| (from..to).prop_map(|exponent: f64| 10f64.powf(exponent));
    (
        power(-2.0, 2.0),
        power(-1.0, 1.0),
        power(0.0, 5.0),
        power(-2.0, 2.0),
        0.0..0.2f64,
        power(-2.5, 0.3),
    )
        .prop_map(|(m, mass_ratio, c, stiffness_ratio, damping, share)| {
            let damping = |m: f64, c: f64| 2.0 * damping * (m * c).sqrt();
            let mass = |m: f64, c: f64| OscillatorParameters {
                m,
                c,
                d: damping(m, c),
                x0: 0.0,
                v0: 1.3,
            };
            Swing {
                masses: [mass(m, c), mass(m * mass_ratio, c * stiffness_ratio)],
                share,
            }
        })
}

impl Swing {
    /// Frequency without damping, decay rate.
    fn common(&self) -> [f64; 2] {
        let [a, b] = self.masses;
        let m = a.m + b.m;
        [((a.c + b.c) / m).sqrt(), (a.d + b.d) / (2.0 * m)]
    }

    fn position(&self, t: f64) -> f64 {
        let [omega, decay] = self.common();
        let damped = (omega * omega - decay * decay).sqrt();
        1.3 / damped * (-decay * t).exp() * (damped * t).sin()
    }

    /// The largest error over the macro points, of the largest displacement; and whether the run says a word against itself.
    fn run(&self, coupling: &str) -> (f64, bool) {
        let period = TAU / self.common()[0];
        let settings = format!("{coupling} macro_step={:e}", self.share * period);
        let t_end = format!("scene.t_end={:e}", 4.0 * period);
        let text = scene_text(&self.masses, &[(0, 1)], &[0, 1]);
        let scene = with_settings(&text, &settings, &[&t_end]);
        let Ok(found) = try_run(&scene, Place::InProcess, &Options::default()) else {
            return (f64::INFINITY, true);
        };
        let times = found.column("t");
        let motion = (0..4000).map(|k| self.position(f64::from(k) * 1e-3 * period).abs());
        let motion = motion.fold(0.0, f64::max);
        let both = ["mass1.x", "mass2.x"].map(|name| found.column(name));
        let errors = both
            .iter()
            .flat_map(|x| x.iter().zip(&times))
            .map(|(x, t)| (x - self.position(*t)).abs() / motion);
        let error = errors.fold(0.0, f64::max);
        (error, !found.statistics.warnings().is_empty())
    }
}

/// Runs so many of the family; those that are wrong without a word, and those that are sound with one.
fn count(cases: usize, coupling: &str) -> [Vec<String>; 2] {
    let seed = *b"what a run tells of its own erro";
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &seed);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let mut found = [Vec::new(), Vec::new()];
    for _ in 0..cases {
        let own = swing().new_tree(&mut runner).unwrap().current();
        let (error, is_told) = own.run(coupling);
        if error > 0.1 && !is_told {
            found[0].push(format!("{error:.1e} {own:?}"));
        }
        if error < 1e-3 && is_told {
            found[1].push(format!("{error:.1e} {own:?}"));
        }
    }
    found
}

fn check(cases: usize) {
    for coupling in METHODS {
        let [silent, alarms] = count(cases, coupling);
        println!(
            "{coupling}: {} of {cases} silently wrong, {} false alarms",
            silent.len(),
            alarms.len()
        );
        assert!(silent.is_empty(), "{coupling}: {silent:#?}");
        assert!(
            alarms.len() * 100 <= MOST_ALARMS * cases,
            "{coupling}: {alarms:#?}"
        );
    }
}

#[test]
fn no_run_is_silently_wrong() {
    check(300);
}

/// The same at full size: `cargo test --release -p linchpin-tests --test told_errors -- --ignored --nocapture`.
#[test]
#[ignore = "takes minutes"]
fn no_run_of_many_is_silently_wrong() {
    check(10_000);
}

/// The estimated error of the oscillator falls with the order of the method, and lies within a factor of 200 above and 20 below the true one.
#[test]
fn estimates_follow_the_error() {
    for degree in [2, 3, 4] {
        for share in [0.02, 0.04, 0.08] {
            let own = Swing {
                masses: [1.0, 2.0].map(|m| OscillatorParameters {
                    m,
                    c: 1000.0,
                    d: 10.0,
                    x0: 0.0,
                    v0: 1.3,
                }),
                share,
            };
            let coupling = format!("method=hermite degree={degree}");
            let (error, _) = own.run(&coupling);
            let period = TAU / own.common()[0];
            let scene = oscillator_with(
                &format!("{coupling} macro_step={:e}", share * period),
                &[&format!("scene.t_end={:e}", 4.0 * period)],
            );
            let found = try_run(&scene, Place::InProcess, &Options::default()).unwrap();
            let told = found.statistics.estimated_errors.unwrap();
            println!(
                "degree {degree}, H/T {share}: {error:.1e}, told {:.1e}",
                told.accumulated
            );
            if error > 1e-12 {
                let ratio = told.accumulated / error;
                assert!((0.05..200.0).contains(&ratio), "{degree} {share}: {ratio}");
            }
        }
    }
}

/// Loads that turn with a body follow its attitude, which is exchanged: what its curve misses is told as an error of angles, against the same
/// scene with degree 3 and a quarter of the step.
#[test]
fn the_errors_of_exchanged_attitudes_are_told() {
    let gimbal = include_str!("../../scenes/spatial/gimbal.toml");
    let run = |coupling: &str| {
        let scene = with_settings(gimbal, coupling, &[]);
        try_run(&scene, Place::InProcess, &Options::default()).unwrap()
    };
    let coarse = run("method=hermite degree=2 macro_step=4e-3");
    let fine = run("method=hermite degree=3 macro_step=1e-3");
    let mut wrong: f64 = 0.0;
    for part in ["w", "x", "y", "z"] {
        let name = format!("top.start_q{part}");
        let (coarse, fine) = (coarse.column(&name), fine.column(&name));
        let pairs = coarse.iter().zip(fine.iter().step_by(4));
        wrong = pairs.fold(wrong, |wrong, (own, exact)| wrong.max((own - exact).abs()));
    }
    let told = coarse.statistics.estimated_errors.unwrap();
    assert!(wrong > 1e-10, "{wrong:e}");
    assert!(
        wrong < told.accumulated && told.largest < 1e-4,
        "{wrong:e}, {told:?}"
    );
    assert_eq!(told.of, "top.start.rotation");
}
