//! A run that is written at a macro point and read back goes on bit by bit, with every method: all memory of master and workers is new.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin_master::run::checkpoint::Checkpoint;
use linchpin_master::scene::Scene;
use linchpin_master::{CoSimulation, RunError};
use linchpin_tests::runs::start;
use linchpin_tests::scenes::with_settings;

const OSCILLATOR: &str = include_str!("../../scenes/oscillator.toml");
const DOUBLE_PENDULUM: &str = include_str!("../../scenes/double-pendulum.toml");
const GIMBAL: &str = include_str!("../../scenes/spatial/gimbal.toml");
const LOAD_STEP: &str = include_str!("../../scenes/hard/load-step.toml");
const STOP: &str = include_str!("../../scenes/s2/double-pendulum-stop.toml");
const SPLIT: &str = include_str!("../../scenes/s2/split-slider-crank.toml");
const MOTOR: &str = include_str!("../../scenes/motor/slider-crank.toml");

fn scene(text: &str, settings: &[&str]) -> Scene {
    with_settings(text, "", settings)
}

/// The bits of the present row, and of the samples before it.
fn bits(simulation: &mut CoSimulation) -> Vec<u64> {
    let mut bits = Vec::new();
    for place in 0..simulation.samples() {
        let (number, row) = simulation.sample(place).unwrap();
        bits.push(number);
        bits.extend(row.values().iter().map(|value| value.to_bits()));
    }
    bits.extend(
        simulation
            .row()
            .values()
            .iter()
            .map(|value| value.to_bits()),
    );
    bits
}

/// The rows of a run to its end.
fn finish(mut simulation: CoSimulation) -> Vec<Vec<u64>> {
    let mut rows = Vec::new();
    while simulation.macro_step().unwrap() {
        rows.push(bits(&mut simulation));
    }
    rows
}

fn through_bytes(state: &Checkpoint) -> Checkpoint {
    let bytes = postcard::to_stdvec(state).unwrap();
    let read: Checkpoint = postcard::from_bytes(&bytes).unwrap();
    assert_eq!(&read, state);
    read
}

/// Stops a run after `steps` macro steps, and lets another one with memory of its own go on from what was written.
fn stopped_and_resumed(scene: &Scene, steps: usize) -> Vec<Vec<u64>> {
    let mut stopped = start(scene);
    for _ in 0..steps {
        assert!(stopped.macro_step().unwrap());
    }
    let checkpoint = through_bytes(&stopped.checkpoint().unwrap());
    drop(stopped);
    let mut resumed = start(scene);
    resumed.resume(checkpoint).unwrap();
    assert_eq!(resumed.steps_done(), steps);
    finish(resumed)
}

/// Asserts that a run that is stopped once, at several places, has the rows of one that is not.
fn assert_resumes(name: &str, scene: &Scene) {
    let whole = finish(start(scene));
    let steps = whole.len();
    assert!(steps > 12, "{name}: {steps} steps");
    for stop in [1, 2, 3, steps / 3, steps / 2, 2 * steps / 3, steps - 1] {
        let rest = stopped_and_resumed(scene, stop);
        assert!(
            rest[..] == whole[stop..],
            "{name}, stopped after {stop} of {steps} steps"
        );
    }
}

/// Every method, fixed and variable steps, degrees and columns.
const COUPLINGS: [&[&str]; 17] = [
    &[
        "coupling.method=hermite",
        "coupling.degree=4",
        "coupling.moments=integrals",
        "coupling.macro_step=1.1e-2",
    ],
    &[
        "coupling.method=hermite",
        "coupling.degree=automatic",
        "coupling.moments=integrals",
        "coupling.tolerance=1e-9",
        "coupling.greatest_step=8e-3",
    ],
    &[
        "coupling.method=hermite",
        "coupling.degree=4",
        "coupling.macro_step=1.1e-2",
    ],
    &[
        "coupling.method=hermite",
        "coupling.degree=automatic",
        "coupling.tolerance=1e-9",
        "coupling.greatest_step=8e-3",
    ],
    &[
        "coupling.method=baumgarte",
        "coupling.index=1",
        "coupling.beta=2H",
        "coupling.gamma=H^2",
        "coupling.degree=2",
        "coupling.macro_step=3e-3",
    ],
    &[
        "coupling.method=baumgarte",
        "coupling.index=2",
        "coupling.gamma=0",
        "coupling.degree=0",
        "coupling.jacobian=every-step",
        "coupling.macro_step=3e-3",
    ],
    &[
        "coupling.method=weighted",
        "coupling.index=1",
        "coupling.degree=3",
        "coupling.macro_step=3e-3",
    ],
    &[
        "coupling.method=weighted",
        "coupling.index=1",
        "coupling.degree=3",
        "coupling.tolerance=1e-5",
        "output.interval=7e-3",
    ],
    &[
        "coupling.method=weighted",
        "coupling.index=1",
        "coupling.degree=automatic",
        "coupling.tolerance=1e-5",
    ],
    &[
        "coupling.method=weighted",
        "coupling.index=1",
        "coupling.degree=automatic",
        "coupling.macro_step=3e-3",
    ],
    &[
        "coupling.method=weighted",
        "coupling.index=1",
        "coupling.iterations.most=4",
        "coupling.iterations.tolerance=1e-6",
        "coupling.macro_step=3e-3",
    ],
    &[
        "coupling.method=hermite",
        "coupling.macro_step=7e-3",
        "output.interval=3e-3",
    ],
    &[
        "coupling.method=hermite",
        "coupling.variant=c0pv",
        "coupling.macro_step=7e-3",
    ],
    &["coupling.method=hermite", "coupling.tolerance=1e-6"],
    &[
        "coupling.method=explicit",
        "coupling.mu=10H",
        "coupling.degree=0",
        "coupling.exchanged_degree=0",
        "coupling.macro_step=2e-3",
        "output.interval=3e-3",
    ],
    &[
        "coupling.method=penalty",
        "coupling.stiffness=2.7e4",
        "coupling.damping=31",
        "coupling.degree=2",
        "coupling.macro_step=1e-3",
    ],
    &[
        "coupling.method=penalty",
        "coupling.order=gauss-seidel",
        "coupling.stiffness=2.7e4",
        "coupling.damping=31",
        "coupling.degree=1",
        "coupling.macro_step=1e-3",
    ],
];

#[test]
fn every_method_goes_on_bit_by_bit_from_what_was_written() {
    for settings in COUPLINGS {
        let all = [settings, &["scene.t_end=0.2"]].concat();
        assert_resumes(
            &format!("oscillator {settings:?}"),
            &scene(OSCILLATOR, &all),
        );
    }
}

#[test]
fn mechanisms_with_turning_loads_go_on_bit_by_bit() {
    for settings in COUPLINGS.iter().filter(|all| !all[0].contains("penalty")) {
        for (name, text) in [("double pendulum", DOUBLE_PENDULUM), ("gimbal", GIMBAL)] {
            let settings = [settings, &["scene.t_end=0.15"][..]].concat();
            assert_resumes(&format!("{name} {settings:?}"), &scene(text, &settings));
        }
    }
}

/// Jumps of loads: rejected steps, histories that start anew, degrees that fall.
#[test]
fn a_run_with_jumps_and_one_with_signals_go_on_bit_by_bit() {
    for degree in ["2", "automatic"] {
        let degree = format!("coupling.degree={degree}");
        assert_resumes("load step", &scene(LOAD_STEP, &[&degree]));
    }
    assert_resumes("motor", &scene(MOTOR, &["scene.t_end=0.05"]));
}

/// Impacts that partners take part in, with steps that are equal and steps that vary.
#[test]
fn impacts_across_joints_go_on() {
    assert_resumes("stop", &scene(STOP, &[]));
    assert_resumes("split slider-crank", &scene(SPLIT, &["scene.t_end=0.006"]));
}

#[test]
fn the_state_of_another_method_is_refused() {
    let hermite = scene(
        OSCILLATOR,
        &["coupling.method=hermite", "coupling.macro_step=1e-2"],
    );
    let explicit = scene(OSCILLATOR, &["coupling.method=explicit", "coupling.mu=10H"]);
    let checkpoint = start(&hermite).checkpoint().unwrap();
    let error = start(&explicit).resume(checkpoint).unwrap_err();
    assert!(matches!(error, RunError::Resume(_)), "{error}");
    assert!(
        error
            .to_string()
            .contains("coupling method hermite, this run has explicit"),
        "{error}"
    );
}

/// Of equal columns or not: other subsystems, joints, recorded outputs, steps that vary.
#[test]
fn the_state_of_another_scene_is_refused() {
    let checkpoint = start(&scene(OSCILLATOR, &[])).checkpoint().unwrap();
    let error = start(&scene(DOUBLE_PENDULUM, &[])).resume(checkpoint);
    let told = error.unwrap_err().to_string();
    assert!(
        told.contains("\"link.lambda\"") && told.contains("\"hinge.lambda.x\""),
        "{told}"
    );
    let variable = scene(OSCILLATOR, &["coupling.tolerance=1e-5"]);
    let checkpoint = start(&variable).checkpoint().unwrap();
    let error = start(&scene(OSCILLATOR, &[])).resume(checkpoint);
    let told = error.unwrap_err().to_string();
    assert!(
        told.contains("\"step\"") && told.contains("\"error_estimate\""),
        "{told}"
    );
}
