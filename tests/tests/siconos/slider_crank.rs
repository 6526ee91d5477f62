//! The slider-crank with clearance of S2.

use linchpin_models::nonsmooth::systems::notch::CornerLaw;
use linchpin_models::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism, RigidSliderCrank};

use crate::compare::{Expected, assert_agreement};
use crate::other::Problem;
use crate::own;

fn compare(name: &str, mechanism: Mechanism, law: CornerLaw, start: [f64; 3], constant: f64) {
    let problem = Problem {
        name,
        settings: &[],
        t_end: 0.05,
        samples: 50,
    };
    let system = RigidSliderCrank::new(mechanism, Guide::Clearance(law));
    let own_dt = 1e-6;
    let own = own::run(
        system,
        [&[0.0; 3], &start],
        own_dt,
        problem.t_end,
        problem.samples,
    );
    let expected = Expected {
        steps: [1e-5, 5e-6],
        constant,
        ratio: [1.8, 2.2],
        // Siconos counts the torque as a potential.
        loss: Some(own.loss + mechanism.torque * own.samples[49][0]),
    };
    assert_agreement(problem, &own, own_dt, expected);
}

#[test]
fn slider_crank_of_table_1() {
    let law = CornerLaw {
        normal_restitution: 0.4,
        tangential_restitution: 0.0,
        friction: 0.01,
    };
    let start = [150.0, -75.0, 0.0];
    compare("slider-crank-1", Mechanism::table_1(), law, start, 650.0);
}

#[test]
fn slider_crank_of_table_2() {
    let law = CornerLaw {
        normal_restitution: 0.1,
        tangential_restitution: 0.0,
        friction: 0.1,
    };
    compare("slider-crank-2", Mechanism::table_2(), law, [0.0; 3], 2.5);
}
