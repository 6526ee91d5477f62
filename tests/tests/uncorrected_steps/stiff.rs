//! Springs that are too stiff for the macro step.

use linchpin::connect::Place;
use linchpin_master::RunError;
use linchpin_master::cosimulation::Options;
use linchpin_tests::masses::{FOUR, scene_text};
use linchpin_tests::runs::{run, try_run};
use linchpin_tests::scenes::with_settings;
use linchpin_tests::spring_pair::SpringPair;

/// The estimate sees loads grow before positions do.
#[test]
fn a_stiff_spring_that_diverges_with_a_fixed_step_stays_stable_with_a_tolerance() {
    let (stiffness, damping, tolerance) = (1.3e7, 2.1e3, 1e-3);
    let text = scene_text(&FOUR[..2], &[(0, 1)], &[0, 1]);
    let exact = SpringPair::new(&FOUR[0], &FOUR[1], stiffness, damping);
    for method in [
        "method=penalty degree=0",
        "method=penalty degree=1",
        "method=penalty degree=2",
        "method=penalty order=gauss-seidel degree=1",
        "method=jacobi degree=1",
        "method=gauss-seidel degree=1",
    ] {
        let with_steps = |steps: &str| {
            let springs = format!("stiffness={stiffness:e} damping={damping:e}");
            with_settings(&text, &format!("{method} {springs} {steps}"), &[])
        };
        let fixed = with_steps("macro_step=1e-3");
        let error = try_run(&fixed, Place::InProcess, &Options::default()).unwrap_err();
        assert!(matches!(error, RunError::Grown { .. }), "{method}: {error}");

        let scene = with_steps(&format!("tolerance={tolerance:e}"));
        let trajectory = run(&scene, Place::InProcess);
        let found = trajectory.column("mass1.x");
        let times = trajectory.column("t").into_iter();
        let (mut error, mut size) = (0.0f64, 0.0f64);
        for (t, x) in times.zip(found) {
            let exact = exact.state(t)[0];
            error = error.max((x - exact).abs());
            size = size.max(exact.abs());
        }
        let context = format!("{method}: {error:e} of {size:e}");
        assert!(error < 10.0 * tolerance * size, "{context}");
        let steps = trajectory.statistics.macro_steps;
        let rejected = trajectory.rejected;
        assert!(10 * rejected < steps, "{context}: {rejected} of {steps}");
    }
}
