//! Hermite coupling with moments from integrals of outputs: orders, errors at long macro steps, stability for every step, and which conditions
//! have them.

#![allow(clippy::unwrap_used, missing_docs)]

use std::sync::Arc;

use linchpin::connect::Place;
use linchpin_master::connection::Direct;
use linchpin_master::results::MomentsOf;
use linchpin_master::run::CoSimulation;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_models::oscillator::{Oscillator, OscillatorParameters};
use linchpin_models::reference::DoublePendulum;
use linchpin_proto::contract::Contract;
use linchpin_proto::v1;
use linchpin_tests::convergence::assert_all_orders;
use linchpin_tests::errors::{closed_form, of_hermite_oscillator};
use linchpin_tests::random_pairs::{Pair, Tally, Verdict};
use linchpin_tests::runs::run;
use linchpin_tests::scenes::{hermite_oscillator as scene, oscillator_with, with_settings};
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Host, Model, Setup, Subsystem};

fn errors(coupling: &str, h: f64) -> [f64; 3] {
    of_hermite_oscillator(&format!("moments=integrals {coupling}"), h)
}

/// Positions, velocities and multipliers have the order 2p + 1.
#[test]
fn orders() {
    assert_all_orders(
        &[("degree=3", [7.0; 3])],
        &[2.5e-2, 1.25e-2, 6.25e-3],
        errors,
    );
    assert_all_orders(&[("degree=4", [9.0; 3])], &[4e-2, 2.5e-2, 1.6e-2], errors);
    assert_all_orders(&[("degree=5", [11.0; 3])], &[6.25e-2, 5e-2, 4e-2], errors);
}

/// The largest error of a position over the macro points, of the amplitude, with exact subsystems and with those of a solver, as far as its
/// tolerance goes.
#[test]
fn errors_at_a_long_macro_step() {
    let adaptive = "subsystem.*.solver={ kind = \"radau5\", rtol = 1e-12, atol = 1e-12 }";
    let exact = "subsystem.*.solver={ kind = \"exact\" }";
    for (solver, floor) in [(exact, 0.0), (adaptive, 1e-9)] {
        for (degree, most) in [(3, 1.2e-6), (4, 7e-9), (5, 3e-11)] {
            let coupling =
                format!("method=hermite degree={degree} moments=integrals macro_step=5e-2");
            let scene = oscillator_with(&coupling, &["scene.t_end=1", solver]);
            let trajectory = run(&scene, Place::InProcess);
            // Both masses as one of 3 kg on 2000 N/m and 20 N s/m, with 100 m/s at the start.
            let decay = 20.0 / 6.0;
            let omega = (2000.0_f64 / 3.0 - decay * decay).sqrt();
            let position = |t: f64| 100.0 / omega * (-decay * t).exp() * (omega * t).sin();
            let amplitude = position((omega / decay).atan() / omega);
            let points = trajectory
                .column("t")
                .into_iter()
                .zip(trajectory.column("mass1.x"));
            let error = points
                .map(|(t, x)| (x - position(t)).abs())
                .fold(0.0, f64::max)
                / amplitude;
            println!("degree {degree}, {solver}: {error:e}");
            assert!(error < most + floor, "degree {degree}, {solver}: {error:e}");
        }
    }
}

/// None is unstable, whatever `omega H` is.
fn assert_stable(degree: usize, pairs: usize) {
    let coupling = format!("method=hermite degree={degree} moments=integrals limiter=off");
    let tally = Tally::of(&coupling, 7, pairs);
    println!(
        "degree {degree}: {} of {pairs} out of reach",
        tally.out_of_reach.len()
    );
    assert!(tally.unstable.is_empty(), "{degree}: {:?}", tally.unstable);
    // The equations of degree 5 are conditioned so badly that double precision cannot tell for some.
    let most = if degree < 5 { pairs / 100 } else { pairs / 10 };
    assert!(
        tally.out_of_reach.len() <= most,
        "{degree}: {:?}",
        tally.out_of_reach
    );
}

#[test]
fn it_is_stable_for_random_pairs() {
    for (degree, pairs) in [(3, 600), (4, 400), (5, 200)] {
        assert_stable(degree, pairs);
    }
}

#[test]
#[ignore = "the same with 10,000 pairs, which takes minutes"]
fn it_is_stable_for_all_random_pairs() {
    for degree in [3, 4, 5] {
        assert_stable(degree, 10_000);
    }
}

/// Undamped pairs, over mass ratios and `omega H` up to 50, on a grid of this many values each.
fn assert_undamped_are_stable(values: usize) {
    let h = 1e-2;
    let mass = |m: f64, turns: f64| OscillatorParameters {
        m,
        c: m * (turns / h) * (turns / h),
        d: 0.0,
        x0: 0.0,
        v0: 0.0,
    };
    let turns: Vec<f64> = (0..values)
        .map(|place| 0.3 + 49.7 * (place as f64 + 0.37) / values as f64)
        .collect();
    let mut unstable = Vec::new();
    let mut out_of_reach = 0;
    for degree in [3, 4, 5] {
        let coupling = format!("method=hermite degree={degree} moments=integrals limiter=off");
        for ratio in [1e-4, 1e-2, 1.0, 1e2, 1e4] {
            for &own in &turns {
                for &other in &turns {
                    let masses = [mass(1.0, own), mass(ratio, other)];
                    match (Pair {
                        masses,
                        macro_step: h,
                    })
                    .judge(&coupling)
                    {
                        Verdict::Stable => {}
                        Verdict::Unstable(radius) => {
                            unstable.push((degree, ratio, own, other, radius))
                        }
                        Verdict::OutOfReach(_) => out_of_reach += 1,
                    }
                }
            }
        }
    }
    println!("{out_of_reach} of {} out of reach", 15 * values * values);
    assert!(unstable.is_empty(), "{unstable:?}");
}

#[test]
fn undamped_pairs_are_stable() {
    assert_undamped_are_stable(7);
}

#[test]
#[ignore = "the same over a finer grid, which takes minutes"]
fn undamped_pairs_are_stable_over_a_fine_grid() {
    assert_undamped_are_stable(40);
}

fn moments(scene: &Scene) -> MomentsOf {
    run(scene, Place::InProcess).statistics.moments.unwrap()
}

fn names(all: &[&str]) -> Vec<String> {
    all.iter().map(|name| (*name).to_owned()).collect()
}

const DOUBLE_PENDULUM: &str = include_str!("../../scenes/double-pendulum.toml");
const GIMBAL: &str = include_str!("../../scenes/spatial/gimbal.toml");

/// A condition has integrals if it is linear in outputs: where the points of a hinge are markers, not where they turn with a body.
#[test]
fn conditions_that_are_linear_in_outputs_have_integrals() {
    let short = "scene.t_end=0.1";
    let of = |moments: &str| {
        let coupling = format!("method=hermite degree=3 moments={moments} macro_step=1e-2");
        let scene = oscillator_with(&coupling, &[short]);
        self::moments(&scene)
    };
    assert_eq!(of("integrals").integrals, names(&["link"]));
    assert_eq!(of("instants").instants, names(&["link"]));
    assert_eq!(of("instants").integrals, names(&[]));
    let coupling = "method=hermite degree=3 moments=integrals macro_step=1e-2";
    let found = moments(&with_settings(DOUBLE_PENDULUM, coupling, &[short]));
    assert_eq!(
        (found.integrals, found.instants),
        (names(&["hinge"]), names(&[]))
    );
    // The point of a revolute joint is served by integrals, its axis is not: one joint has both.
    let found = moments(&with_settings(GIMBAL, coupling, &[short]));
    let of_bearing = |all: &[String]| {
        all.iter()
            .filter(|name| name.starts_with("bearing."))
            .count()
    };
    assert_eq!(
        (of_bearing(&found.integrals), of_bearing(&found.instants)),
        (3, 2),
        "{found:?}"
    );
}

/// A joint with conditions of both kinds, in space, moves as with instants alone.
#[test]
fn a_joint_with_both_kinds_has_the_same_motion() {
    let of = |moments: &str| {
        let coupling = format!("method=hermite degree=3 moments={moments} macro_step=1e-2");
        run(
            &with_settings(GIMBAL, &coupling, &["scene.t_end=0.5"]),
            Place::InProcess,
        )
    };
    let [one, other] = ["integrals", "instants"].map(of);
    let mut compared = 0;
    for (column, name) in one.columns.iter().enumerate() {
        let values = |run: &linchpin_tests::runs::Trajectory| -> Vec<f64> {
            run.rows.iter().map(|row| row[column]).collect()
        };
        // Positions of markers; what depends on the multipliers misses their error of order p + 1.
        if !["_x", "_y", "_z"].iter().any(|end| name.ends_with(end))
            || name.matches('_').count() > 1
        {
            continue;
        }
        compared += 1;
        let (one, other) = (values(&one), values(&other));
        let size = other
            .iter()
            .fold(0.0f64, |most, value| most.max(value.abs()));
        let off = one
            .iter()
            .zip(&other)
            .map(|(one, other)| (one - other).abs())
            .fold(0.0, f64::max);
        println!("{name}: {off:e} of {size:e}");
        assert!(off <= 1e-6 * size.max(1.0), "{name}: {off:e} of {size:e}");
    }
    assert!(compared >= 6, "{:?}", one.columns);
}

/// Errors of integrals beside those of instants with a solver of default tolerance, what decided that instants are the default.
#[test]
#[ignore = "prints a comparison"]
fn integrals_beside_instants() {
    let adaptive = "subsystem.*.solver={ kind = \"radau5\" }";
    for degree in [3, 4, 5] {
        for h in [1e-1, 5e-2, 2.5e-2] {
            for moments in ["instants", "integrals"] {
                let coupling =
                    format!("method=hermite degree={degree} moments={moments} macro_step={h:e}");
                let angles = "output.variables=[\"link1.angle\", \"link2.angle\"]";
                let pendulum = with_settings(
                    DOUBLE_PENDULUM,
                    &coupling,
                    &["scene.t_end=1", adaptive, angles],
                );
                let pendulum = run(&pendulum, Place::InProcess);
                let motions = DoublePendulum::schweizer_lu()
                    .motions(&pendulum.column("t"))
                    .unwrap();
                let angles = pendulum.column("link2.angle").into_iter().zip(&motions);
                let off = angles.map(|(angle, motion)| (angle - motion.angles[1]).abs());
                let off = off.fold(0.0, f64::max);
                let steps = pendulum.statistics.solver_steps;
                let oscillator = oscillator_with(&coupling, &["scene.t_end=1", adaptive]);
                let exact = closed_form(&oscillator);
                let found = run(&oscillator, Place::InProcess);
                let points = found.column("t").into_iter().zip(found.column("mass1.x"));
                let error = points.map(|(t, x)| (x - exact("mass1.x", t).unwrap()).abs());
                println!(
                    "degree {degree}, H {h:e}, {moments}: pendulum {off:.2e} rad in {steps} internal steps, oscillator {:.2e} m in {}",
                    error.fold(0.0, f64::max),
                    found.statistics.solver_steps
                );
            }
        }
    }
}

/// An oscillator that does not say that it integrates outputs.
struct Silent;

impl Model for Silent {
    fn describe(&self) -> v1::Model {
        let mut model = Oscillator.describe();
        if let Some(capabilities) = &mut model.capabilities {
            capabilities.output_integrals = false;
        }
        v1::Model {
            name: "silent".into(),
            ..model
        }
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        Oscillator.initialize(setup)
    }
}

fn started(scene: &Scene) -> Result<CoSimulation, String> {
    let models: Vec<Box<dyn Model>> = vec![Box::new(Oscillator), Box::new(Silent)];
    let host = Arc::new(Host::new(models));
    let run = CoSimulation::start(
        scene,
        &mut |_, _| {
            let calls = Arc::clone(&host) as Arc<dyn Contract>;
            Ok(Box::new(Direct::new(calls)))
        },
        &Options::default(),
    );
    run.map_err(|error| error.to_string())
}

#[test]
fn a_worker_without_integrals_is_looked_at_at_instants_or_refused() {
    let silent = "subsystem.mass2.model=\"silent\"";
    let of = |moments: &str| {
        let coupling = format!("method=hermite degree=3 moments={moments} macro_step=1e-2");
        started(&oscillator_with(&coupling, &["scene.t_end=0.1", silent]))
    };
    let automatic = of("automatic").unwrap();
    let served = automatic.statistics().moments.unwrap();
    assert_eq!(
        (served.integrals, served.instants),
        (names(&[]), names(&["link"]))
    );
    let error = of("integrals").err().unwrap();
    for words in [
        "\"silent\"",
        "\"mass2\"",
        "offers no integrals",
        "coupling.moments = \"automatic\"",
    ] {
        assert!(error.contains(words), "{error}");
    }
}

/// The same error bounds hold beside a scene with a mistake: what is no choice is named with all that are.
#[test]
fn another_word_is_refused() {
    let error = std::panic::catch_unwind(|| scene("degree=3 moments=samples", 1e-2))
        .err()
        .unwrap();
    let message = error.downcast_ref::<String>().unwrap();
    for words in [
        "coupling.moments",
        "automatic",
        "integrals",
        "instants",
        "samples",
    ] {
        assert!(message.contains(words), "{message}");
    }
}
