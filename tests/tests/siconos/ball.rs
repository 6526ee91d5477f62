//! A ball that bounces to rest.

use linchpin_models::nonsmooth::systems::point_mass::BouncingBall;

use crate::compare::{Expected, assert_agreement};
use crate::other::Problem;
use crate::own;

/// Impacts faster than 0.01 m/s are 13: 3.81 m/s, each 0.63 of the one before, down to 0.0149 m/s. The ball rests from
/// 1.745 s on.
#[test]
fn a_ball_that_bounces_to_rest() {
    let (mass, gravity, height, speed, restitution) = (0.37, 9.81, 0.737, 0.31, 0.63);
    let problem = Problem {
        name: "ball",
        settings: &[
            ("m", mass),
            ("g", gravity),
            ("h0", height),
            ("v0", speed),
            ("eps", restitution),
        ],
        t_end: 1.8,
        samples: 60,
    };
    let system = BouncingBall::new(mass, gravity, restitution);
    let own_dt = 1e-6;
    let own = own::run(
        system,
        [&[height], &[speed]],
        own_dt,
        problem.t_end,
        problem.samples,
    );
    assert_eq!(own.impacts, 13);
    let expected = Expected {
        steps: [8e-5, 1e-5],
        constant: 5.0,
        ratio: [4.0, 16.0],
        loss: None,
    };
    assert_agreement(problem, &own, own_dt, expected);
}
