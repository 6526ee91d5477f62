//! Motions of the bodies in a run, and how far they are from those of a reference.

use linchpin_master::joint::{End, Joint};
use linchpin_models::reference::{BodyMotion, JointReaction};
use linchpin_proto::joint_load::{Pose, Wrench};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::runs::Trajectory;

/// The outputs of a `spatial-body` that tell its motion: centre, attitude (at a marker with the axes of the body),
/// velocity of the centre, angular velocity in the axes of the body.
pub const BODY_OUTPUTS: [&str; 13] = [
    "x", "y", "z", "start_qw", "start_qx", "start_qy", "start_qz", "vx", "vy", "vz", "omega1",
    "omega2", "omega3",
];

/// The motion of a `spatial-body` at every recorded macro point.
pub fn motions(trajectory: &Trajectory, body: &str) -> Vec<BodyMotion> {
    let columns = BODY_OUTPUTS.map(|output| trajectory.column(&format!("{body}.{output}")));
    let at = |row: usize| {
        let value = |column: usize| columns[column][row];
        let vector = |first: usize| Vector3::from_fn(|axis, _| value(first + axis));
        BodyMotion {
            position: vector(0),
            attitude: Quaternion::new(value(3), value(4), value(5), value(6)),
            velocity: vector(7),
            omega: vector(10),
        }
    };
    (0..trajectory.rows.len()).map(at).collect()
}

/// Largest distance between centres of mass (m) and largest angle between attitudes (rad) at equal times.
pub fn pose_errors<'a>(
    found: &[BodyMotion],
    exact: impl Iterator<Item = &'a BodyMotion>,
) -> [f64; 2] {
    let mut largest = [0.0_f64; 2];
    let mut count = 0;
    for (found, exact) in found.iter().zip(exact) {
        let [own, other] =
            [found, exact].map(|motion| UnitQuaternion::from_quaternion(motion.attitude));
        largest[0] = largest[0].max((found.position - exact.position).norm());
        largest[1] = largest[1].max(own.angle_to(&other));
        count += 1;
    }
    assert_eq!(count, found.len());
    largest
}

/// What the joint does to the body at end a by its multipliers: force, and moment about the marker; `markers` are the
/// poses of the markers at ends a and b.
pub fn wrench(joint: &Joint, multipliers: &[f64], markers: &[Pose; 2]) -> Wrench {
    let mut sum = Wrench {
        force: Vector3::zeros(),
        moment: Vector3::zeros(),
    };
    for (condition, lambda) in joint.conditions().zip(multipliers) {
        let law = condition.law().unwrap();
        let unit = law.unit_wrench(End::A, markers);
        sum.force += *lambda * unit.force;
        sum.moment += *lambda * unit.moment;
    }
    sum
}

/// Distance of a load, force and moment about `at`, from that of the reference on the same body (N, and N m about the
/// joint's point).
pub fn load_error(found: &Wrench, at: &Vector3<f64>, exact: &JointReaction) -> f64 {
    let moment = found.moment + (at - exact.point).cross(&found.force);
    (found.force - exact.force).norm() + (moment - exact.moment).norm()
}
