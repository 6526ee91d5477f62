//! Results at fixed times, with macro steps that do not meet them.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::scene::{Scene, parse};
use linchpin_tests::errors::closed_form;
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::oscillator_with;

const INTERVAL: f64 = 0.013;

fn scene(coupling: &str, others: &[&str]) -> Scene {
    oscillator_with(coupling, &[others, &["scene.t_end=0.2"]].concat())
}

fn sampled(coupling: &str, place: Place) -> Trajectory {
    let interval = format!("output.interval={INTERVAL}");
    run(&scene(coupling, &[&interval]), place)
}

/// The couplings of the tests: fixed and variable steps, some shorter and some longer than the interval.
const COUPLINGS: [&str; 8] = [
    "method=hermite macro_step=5e-3",
    "method=hermite macro_step=3.1e-2",
    "method=hermite tolerance=1e-9",
    "method=weighted index=1 a=2 b=2.6 degree=2 tolerance=1e-7",
    "method=explicit mu=10H macro_step=2.3e-3",
    "method=penalty stiffness=2.7e4 damping=31 degree=1 macro_step=3.1e-3",
    "method=penalty stiffness=2.7e4 damping=31 degree=2 macro_step=1.1e-3",
    "method=penalty order=gauss-seidel stiffness=2.7e4 damping=31 degree=1 macro_step=1.7e-3",
];

#[test]
fn rows_stand_at_their_times_and_at_the_end() {
    for coupling in COUPLINGS {
        let trajectory = sampled(coupling, Place::InProcess);
        let times = trajectory.column("t");
        assert_eq!(times.len(), 17, "{coupling}: {times:?}");
        for (number, t) in times[..16].iter().enumerate() {
            assert!(
                (t - number as f64 * INTERVAL).abs() < 1e-15,
                "{coupling}: {t}"
            );
        }
        assert_eq!(times[16], 0.2, "{coupling}");
    }
}

/// Samples are as accurate as macro points, also multipliers, which come from the curves.
#[test]
fn samples_are_accurate() {
    for (coupling, motion, multiplier) in [(COUPLINGS[0], 1e-7, 1e-3), (COUPLINGS[2], 1e-7, 1e-3)] {
        let scene = scene(coupling, &[]);
        let exact = closed_form(&scene);
        let trajectory = sampled(coupling, Place::InProcess);
        for (column, allowed) in [("mass1.x", motion), ("link.lambda", multiplier)] {
            let values = trajectory.column(column);
            let size = values
                .iter()
                .fold(0.0f64, |most, value| most.max(value.abs()));
            let times = trajectory.column("t");
            for (t, value) in times.iter().zip(&values).skip(1) {
                let error = (value - exact(column, *t).unwrap()).abs() / size;
                assert!(error < allowed, "{coupling}: {column} at {t}: {error:e}");
            }
        }
    }
}

/// The macro steps do not know of the samples: what is at the end has the same bits.
#[test]
fn samples_disturb_nothing() {
    for coupling in COUPLINGS {
        let with = sampled(coupling, Place::InProcess);
        let without = run(&scene(coupling, &[]), Place::InProcess);
        let last = |trajectory: &Trajectory| -> Vec<u64> {
            let row = trajectory.rows.last().unwrap();
            row.iter().map(|value| value.to_bits()).collect()
        };
        assert_eq!(last(&with), last(&without), "{coupling}");
        let causes = with.statistics.integrations_by_cause;
        assert_eq!(causes.sum(), with.integrations, "{coupling}: {causes:?}");
        assert!(causes.samples >= 20, "{coupling}: {causes:?}");
        assert_eq!(
            with.bits(),
            sampled(coupling, Place::Threads).bits(),
            "{coupling}"
        );
    }
}

/// The springs of the methods without a corrector are read from the outputs at the samples: with the same macro steps, multiplier and
/// residual belong to each other there as they do at macro points.
#[test]
fn spring_loads_belong_to_the_openings_at_the_samples() {
    for coupling in &COUPLINGS[5..] {
        let trajectory = sampled(coupling, Place::InProcess);
        let column = |name: &str| trajectory.column(name).into_iter();
        let rates = column("link.residual.velocity");
        let openings = column("link.residual.position").zip(rates);
        let loads: Vec<f64> = column("link.lambda").collect();
        let size = loads.iter().fold(0.0f64, |most, load| most.max(load.abs()));
        for ((opening, rate), load) in openings.zip(&loads) {
            let expected = 2.7e4 * opening + 31.0 * rate;
            assert!((load - expected).abs() < 1e-9 * size, "{coupling}");
        }
        assert!(size > 100.0, "{coupling}");
    }
}

/// The explicit method holds its multipliers: a sample shows those of the macro point before it.
#[test]
fn held_multipliers_are_those_of_the_last_macro_point() {
    let coupling = "method=explicit mu=1e-2 macro_step=1e-2";
    let points = run(&scene(coupling, &[]), Place::InProcess);
    let (times, loads) = (points.column("t"), points.column("link.lambda"));
    let trajectory = sampled(coupling, Place::InProcess);
    let samples = trajectory.column("t").into_iter();
    for (t, load) in samples.zip(trajectory.column("link.lambda")) {
        let before = times.iter().rposition(|&point| point <= t + 1e-12).unwrap();
        assert_eq!(load, loads[before], "{t}");
    }
}

#[test]
fn an_interval_is_positive_and_not_longer_than_the_run() {
    let text = include_str!("../../scenes/oscillator.toml");
    for (value, told) in [("0.0", "greater than 0"), ("7.0", "7")] {
        let interval = format!("output.interval={value}").parse().unwrap();
        let shown = parse(text, "scene.toml", &[interval])
            .unwrap_err()
            .to_string();
        assert!(
            shown.contains("output.interval") && shown.contains(told),
            "{shown}"
        );
    }
}
