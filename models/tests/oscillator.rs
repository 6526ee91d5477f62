//! The oscillator: its acceleration, and the error and observed order of each solver.

#![allow(clippy::unwrap_used)]

mod common;

use common::{
    A, ALL, EXACT, RADAU5, RK4, Solver, V, X, force, interval, oscillator, snapshot, state,
};
use linchpin_worker::{Inputs, StepFailure};
use proptest::prelude::*;

const OWN: [(&str, f64); 5] = [
    ("m", 1.3),
    ("c", 1e3),
    ("d", 10.0),
    ("x0", 0.02),
    ("v0", 100.0),
];

#[test]
fn the_acceleration_is_that_of_the_inputs_given() {
    for solver in ALL {
        let parameters = [
            OWN.as_slice(),
            &[("partner_stiffness", 70.0), ("partner_damping", 0.3)],
        ]
        .concat();
        let mut subsystem = oscillator(&parameters, solver);
        let mut values = [0.0; 3];
        subsystem
            .outputs(0.0, &[333.0, 0.9, -5.0], &[A, X, V], &mut values)
            .unwrap();
        let expected =
            (333.0 - 1e3 * 0.02 - 10.0 * 100.0 + 70.0 * (0.9 - 0.02) + 0.3 * (-5.0 - 100.0)) / 1.3;
        assert!(
            (values[0] / expected - 1.0).abs() < 1e-14,
            "{solver:?}: {values:?} {expected}"
        );
        assert_eq!(values[1..], [0.02, 100.0]);
        let unknown = subsystem.outputs(0.0, &[0.0; 3], &[3], &mut values);
        assert!(
            matches!(unknown, Err(StepFailure::Fatal { .. })),
            "{solver:?}"
        );
    }
}

/// Error of x after one macro step of 0.3 s with a force of degree 3, against the exact solver.
fn error_of(solver: Solver) -> f64 {
    let inputs = force(&[333.0, -5e3, 2e4, 9e4], 0.3);
    let end = |solver| {
        let mut subsystem = oscillator(&OWN, solver);
        subsystem.step(interval(0.0, 0.3), &inputs).unwrap();
        state(&mut subsystem)[X]
    };
    (end(solver) - end(EXACT)).abs()
}

#[test]
fn rk4_is_of_order_four() {
    let errors = [
        error_of(Solver("rk4", &[("step", 4e-3)])),
        error_of(Solver("rk4", &[("step", 2e-3)])),
        error_of(Solver("rk4", &[("step", 1e-3)])),
    ];
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 4.0).abs() < 0.1, "{errors:?}: order {order}");
    }
}

#[test]
fn rk4_cuts_a_macro_step_into_parts_not_longer_than_its_step() {
    for (length, parts) in [
        (7e-4, 1),
        (7.1e-4, 2),
        (1.4e-3, 2),
        (3e-4, 1),
        (0.3 - 0.2, 143),
        (7e-2, 100),
    ] {
        let mut subsystem = oscillator(&OWN, RK4);
        subsystem
            .step(interval(0.0, length), &force(&[1.0], length))
            .unwrap();
        assert_eq!(subsystem.internal_steps(), parts, "{length}");
    }
}

#[test]
fn radau5_follows_a_forced_motion_within_its_tolerance() {
    let loose = error_of(Solver("radau5", &[("rtol", 1e-6), ("atol", 1e-6)]));
    let normal = error_of(RADAU5);
    let tight = error_of(Solver("radau5", &[("rtol", 1e-11), ("atol", 1e-11)]));
    assert!(
        loose < 1e-5 && normal < 1e-7 && tight < 1e-10,
        "{loose:e} {normal:e} {tight:e}"
    );
    assert!(
        loose > 10.0 * normal && normal > 100.0 * tight,
        "{loose:e} {normal:e} {tight:e}"
    );
}

#[test]
fn only_radau5_has_a_tolerance() {
    let tolerances = ALL.map(|solver| oscillator(&OWN, solver).tolerance());
    assert_eq!(tolerances, [None, Some(1e-8 + 1e-8 * 100.0), None]);
}

proptest! {
    /// The oscillator is linear: the response to a change of an input is proportional to the change.
    #[test]
    fn perturbed_steps_are_linear_in_the_perturbation(
        m in 0.2f64..3.0,
        log_c in 0f64..5.0,
        d in 0f64..50.0,
        length in 1e-3f64..2e-2,
        change in 1f64..100.0,
    ) {
        let own = [("m", m), ("c", 10f64.powf(log_c)), ("d", d), ("v0", 1.0)];
        for solver in ALL {
            let mut subsystem = oscillator(&own, solver);
            let start = snapshot(&*subsystem);
            let level = |f: f64| Inputs::constant(&[f, 0.0, 0.0]);
            subsystem.step(interval(0.0, length), &level(20.0)).unwrap();
            let base = state(&mut subsystem);
            let mut response = |change: f64| {
                subsystem.restore(&start).unwrap();
                subsystem.perturbed_step(interval(0.0, length), &level(20.0 + change)).unwrap();
                let raised = state(&mut subsystem);
                [0, 1].map(|i| (raised[i] - base[i]) / change)
            };
            let (once, thrice) = (response(change), response(-3.0 * change));
            let scale = [length * length / m, length / m];
            for i in 0..2 {
                prop_assert!((once[i] - thrice[i]).abs() < 1e-9 * scale[i], "{:?} {:?} {:?}", solver, once, thrice);
            }
        }
    }
}
