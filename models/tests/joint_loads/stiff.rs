//! An implicit solver takes the dependence of a joint load on the state into its Jacobian.

use linchpin_proto::joint_load::{End, JointLaw, Law};
use nalgebra::Vector3;

use crate::bodies::PENDULUM;
use crate::common::RADAU5;
use crate::joint::{Joint, Partner, Space};
use crate::run::Run;

const MULTIPLIER: f64 = 1e6;
const DAMPING: f64 = 3e3;
const RATE: f64 = 0.5;

/// A link in a viscous hinge follows a turning axis that holds it as a spring of 1e6 N m/rad: its fast motions decay within
/// 0.2 and 3 ms, and then it lags by the angle `asin(d w / lambda)`.
#[test]
fn a_stiff_load_does_not_shorten_the_internal_steps() {
    let joint = Joint {
        marker: "tip",
        law: JointLaw {
            law: Law::Perpendicular {
                axes: [Vector3::x(); 2],
            },
            points: [Vector3::zeros(); 2],
        },
        end: End::A,
    };
    let partner = Partner {
        space: Space::Planar,
        position: |_| Vector3::zeros(),
        turn: |t| Vector3::new(0.0, 0.0, 0.3 + RATE * t),
        reference: [1.0, 0.0, 0.0, 0.0],
    };
    let parameters = [
        ("gravity", 0.0),
        ("spring", 0.0),
        ("damping", DAMPING),
        ("angle0", 0.2),
        ("rate0", 0.0),
    ];
    let lag = (DAMPING * RATE / MULTIPLIER).asin();
    let mut run = Run::new(
        PENDULUM.case,
        &parameters,
        RADAU5,
        partner.request(&[joint]),
    );
    let mut steps = [0; 10];
    for steps in &mut steps {
        partner.signals(|_| MULTIPLIER, |signals| run.step(0.1, signals));
        *steps = run.internal_steps;
    }
    let [angle] = partner.signals(|_| MULTIPLIER, |signals| run.read_all(signals, ["angle"]));
    let error = (angle - (0.3 + RATE * run.t - lag)).abs();
    println!("error {error:.1e}, internal steps {steps:?}");
    assert!(error < 1e-8, "{error:e}");
    assert!(steps[9] - steps[0] < 30, "{steps:?}");
}
