//! Runs that ask for too much.

use linchpin::connect::Place;
use linchpin_master::cosimulation::Options;
use linchpin_tests::runs::try_run;
use linchpin_tests::scenes::oscillator_with;

#[test]
fn a_least_step_that_is_too_long_is_told_with_place_and_variable() {
    for (method, variable) in [
        ("method=explicit mu=10H", "link.residual.position"),
        ("method=penalty stiffness=1e6", "link.residual.position"),
        ("method=jacobi stiffness=1e6", "link.residual.position"),
        (
            "method=gauss-seidel stiffness=1e6",
            "link.residual.position",
        ),
    ] {
        let coupling = format!("{method} tolerance=1e-9 least_step=3e-3 macro_step=5e-3");
        let scene = oscillator_with(&coupling, &[]);
        let error = try_run(&scene, Place::InProcess, &Options::default()).unwrap_err();
        let error = error.to_string();
        for part in [
            "t = 0 s",
            "H = 0.003 s",
            "coupling.least_step",
            variable,
            "coupling.tolerance = 1e-9",
        ] {
            assert!(error.contains(part), "{method}: no {part:?} in {error}");
        }
    }
}
