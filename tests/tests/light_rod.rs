//! A light rod that carries a heavy bob on its end, with fixed steps: what corrections leave grows from step to step.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::with_settings;

fn rod(mass: f64, coupling: &str) -> Trajectory {
    let text = format!(
        "[scene]\nname = \"light-rod\"\nt_end = 1.0\n\
         [[subsystem]]\nname = \"rod\"\nmodel = \"pendulum\"\n\
         parameters = {{ m = {mass:e}, inertia = {:e}, length = 1.0, angle0 = -0.3 }}\n\
         [[subsystem]]\nname = \"bob\"\nmodel = \"planar-body\"\n\
         parameters = {{ m = 1.0, inertia = 0.01, length = 0.2, x0 = {:e}, y0 = {:e}, angle0 = -0.3 }}\n\
         [[joint]]\nname = \"w\"\nkind = \"weld\"\na = \"rod.tip\"\nb = \"bob.start\"\npoint_b = [0.1, 0.0]\n\
         [output]\nvariables = [\"bob.angle\"]\n",
        mass / 12.0,
        0.9 * 0.3_f64.cos(),
        -0.9 * 0.3_f64.sin(),
    );
    run(&with_settings(&text, coupling, &[]), Place::InProcess)
}

/// The frequency of the rod under the pull of the bob is 870 rad/s at 0.1 g, and goes with the root of its mass.
#[test]
fn steps_that_resolve_the_rod_are_enough() {
    for (mass, h, degrees) in [
        (1e-2, 3e-3, 2..=3),
        (1e-3, 9e-4, 2..=3),
        (1e-4, 3e-4, 2..=2),
    ] {
        for degree in degrees {
            let own = rod(
                mass,
                &format!("method=hermite degree={degree} macro_step={h:e}"),
            );
            let converged = format!(
                "method=hermite degree={degree} macro_step={:e} iterations={{most=10,tolerance=1e-10}}",
                0.5 * h
            );
            let exact = rod(mass, &converged);
            let end = |run: &Trajectory| *run.column("bob.angle").last().unwrap();
            let off = (end(&own) - end(&exact)).abs();
            println!("{mass:e} kg, degree {degree}, H = {h:e}: {off:.1e}");
            assert!(
                off < 1e-6,
                "{mass:e} kg, degree {degree}, H = {h:e}: {off:e}"
            );
        }
    }
}
