//! Macro steps that were rejected leave no trace in a run.

use linchpin::connect::Place;
use linchpin_master::results::StepDegrees;
use linchpin_master::scene::{Calls, Scene};
use linchpin_master::setup::Options;

use crate::runs::{Trajectory, run, try_run};

/// The accepted steps of a run with the degrees of their polynomials.
pub fn with_steps_of(run: &Trajectory) -> Options {
    let has = |name: &str| run.columns.iter().any(|column| column == name);
    let degrees = |name: &str| -> Vec<Option<usize>> {
        match has(name) {
            true => run.column(name)[1..]
                .iter()
                .map(|degree| Some(*degree as usize))
                .collect(),
            false => vec![None; run.rows.len() - 1],
        }
    };
    let both = degrees("degree")
        .into_iter()
        .zip(degrees("exchanged_degree"));
    let both = both.map(|(multipliers, exchanged)| StepDegrees {
        multipliers,
        exchanged,
    });
    Options {
        step_lengths: Some(run.column("step")[1..].to_vec()),
        degrees: has("degree").then(|| both.collect()),
        ..Options::default()
    }
}

/// Asserts that a run of the scene rejects steps, and that one that is given the accepted steps from the beginning has equal bits at less cost.
pub fn assert_no_trace(name: &str, scene: &Scene) {
    let found = run(scene, Place::InProcess);
    assert!(found.rejected > 0, "{name} rejects no step");
    let expected = try_run(scene, Place::InProcess, &with_steps_of(&found)).unwrap();
    assert!(found.bits() == expected.bits(), "{name}");
    assert!(found.integrations > expected.integrations, "{name}");
}

/// Asserts that threads and either way to call a worker change no bit.
pub fn assert_equal_bits_everywhere(name: &str, scene: &Scene) {
    let expected = run(scene, Place::InProcess).bits();
    assert!(run(scene, Place::Threads).bits() == expected, "{name}");
    for calls in [Calls::Unary, Calls::Automatic] {
        let mut scene = scene.clone();
        for subsystem in &mut scene.subsystems {
            subsystem.calls = calls;
        }
        assert!(run(&scene, Place::InProcess).bits() == expected, "{name}");
    }
}
