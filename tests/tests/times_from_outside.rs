//! A run whose times somebody else chooses (`CoSimulation::advance_to`): the bits of the run itself at its macro points, the same accuracy anywhere.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin_master::scene::Scene;
use linchpin_master::{CoSimulation, RunError};
use linchpin_tests::runs::start;
use linchpin_tests::scenes::with_settings;

const OSCILLATOR: &str = include_str!("../../scenes/oscillator.toml");
const DOUBLE_PENDULUM: &str = include_str!("../../scenes/double-pendulum.toml");
const MOTOR: &str = include_str!("../../scenes/motor/slider-crank.toml");

fn scene(text: &str, settings: &[&str]) -> Scene {
    with_settings(text, "", settings)
}

fn bits(simulation: &CoSimulation) -> Vec<u64> {
    let values = simulation.row().values().iter();
    values.map(|value| value.to_bits()).collect()
}

/// Every method, with steps that are given, and with a tolerance.
const COUPLINGS: [&[&str]; 8] = [
    &["coupling.method=hermite", "coupling.degree=2"],
    &["coupling.method=hermite", "coupling.degree=4"],
    &[
        "coupling.method=baumgarte",
        "coupling.index=1",
        "coupling.beta=2H",
        "coupling.gamma=H^2",
    ],
    &[
        "coupling.method=weighted",
        "coupling.index=1",
        "coupling.a=1",
        "coupling.b=1",
    ],
    &[
        "coupling.method=weighted",
        "coupling.index=3",
        "coupling.a=0",
        "coupling.b=0",
        "coupling.degree=0",
    ],
    &["coupling.method=explicit", "coupling.mu=10H"],
    &[
        "coupling.method=penalty",
        "coupling.stiffness=2/H^2",
        "coupling.damping=1/H",
    ],
    &[
        "coupling.method=hermite",
        "coupling.degree=automatic",
        "coupling.tolerance=1e-7",
    ],
];

#[test]
fn at_its_macro_points_a_run_has_its_own_bits() {
    for coupling in COUPLINGS {
        let more = ["scene.t_end=0.1", "coupling.macro_step=2e-3"];
        let scene = scene(OSCILLATOR, &[coupling, &more].concat());
        let mut whole = start(&scene);
        let mut points = Vec::new();
        while whole.macro_step().unwrap() {
            points.push((whole.t(), bits(&whole)));
        }
        assert!(points.len() > 4, "{coupling:?}");
        let mut driven = start(&scene);
        for (t, expected) in points.iter().skip(2).step_by(3) {
            driven.advance_to(*t).unwrap();
            assert!(bits(&driven) == *expected, "{coupling:?} at {t}");
        }
    }
}

/// The state at the end of a run over times that have nothing to do with its macro step, and of one that nobody interferes with.
fn ends(text: &str, settings: &[&str], times: usize) -> [Vec<f64>; 2] {
    let scene = scene(text, settings);
    let mut driven = start(&scene);
    let span = scene.t_end - scene.t_start;
    for number in 1..=times {
        let t = scene.t_start + span * number as f64 / times as f64;
        driven.advance_to(t).unwrap();
        assert!(
            (driven.t() - t).abs() < 1e-12 * span,
            "{} is not {t}",
            driven.t()
        );
    }
    let mut whole = start(&scene);
    while whole.macro_step().unwrap() {}
    assert!(driven.steps_done() > whole.steps_done());
    [driven, whole].map(|own| {
        let columns = own.row().columns().iter().zip(own.row().values());
        let told_of_steps = ["lambda", "residual", "step", "error"];
        let shown = columns.filter(|(name, _)| !told_of_steps.iter().any(|own| name.contains(own)));
        shown.map(|(_, value)| *value).collect()
    })
}

#[test]
fn times_between_macro_points_cost_no_accuracy() {
    for (text, coupling, times, close) in [
        (
            OSCILLATOR,
            &[
                "coupling.method=hermite",
                "coupling.degree=3",
                "coupling.macro_step=5e-3",
                "scene.t_end=0.5",
            ][..],
            37,
            1e-6,
        ),
        (
            OSCILLATOR,
            &[
                "coupling.method=hermite",
                "coupling.tolerance=1e-7",
                "scene.t_end=0.5",
            ],
            37,
            1e-5,
        ),
        (
            DOUBLE_PENDULUM,
            &[
                "coupling.method=hermite",
                "coupling.degree=3",
                "coupling.macro_step=5e-3",
                "scene.t_end=0.2",
            ],
            23,
            1e-6,
        ),
        (
            DOUBLE_PENDULUM,
            &[
                "coupling.method=weighted",
                "coupling.degree=1",
                "coupling.macro_step=1e-3",
                "scene.t_end=0.2",
            ],
            23,
            1e-4,
        ),
        (MOTOR, &["scene.t_end=0.1"], 17, 1e-3),
    ] {
        let [driven, whole] = ends(text, coupling, times);
        for (place, (a, b)) in driven.iter().zip(&whole).enumerate() {
            let size = b.abs().max(1.0);
            assert!(
                (a - b).abs() < close * size,
                "{coupling:?}, column {place}: {a} and {b}"
            );
        }
    }
}

#[test]
fn a_time_that_is_reached_takes_no_step_and_one_behind_the_end_is_refused() {
    let scene = scene(
        OSCILLATOR,
        &["scene.t_end=0.01", "coupling.macro_step=1e-3"],
    );
    let mut run = start(&scene);
    run.advance_to(4e-3).unwrap();
    let before = (run.steps_done(), bits(&run));
    run.advance_to(4e-3).unwrap();
    run.advance_to(2e-3).unwrap();
    assert_eq!((run.steps_done(), bits(&run)), before);
    run.advance_to(0.01).unwrap();
    assert!(run.is_finished());
    run.advance_to(0.01).unwrap();
    let error = run.advance_to(0.011).unwrap_err();
    assert!(matches!(error, RunError::BehindTheEnd { .. }), "{error}");
    assert!(
        error.to_string().contains("0.011 s lies behind the end"),
        "{error}"
    );
}
