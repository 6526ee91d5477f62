//! Motions of the bodies in a run, and how far they are from those of a reference.

use linchpin_master::joint::{End, Joint};
use linchpin_models::reference::{BodyMotion, SpatialChainMotion};
use linchpin_proto::joint_load::Pose;
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

/// A joint between two bodies of a reference, and its multipliers in a run.
pub struct Loaded<'a> {
    /// Name in the scene.
    pub name: &'a str,
    /// Its conditions.
    pub joint: &'a Joint,
    /// Markers at ends a and b: number of the body in the reference, place in the body (m).
    pub markers: [(usize, Vector3<f64>); 2],
}

impl Loaded<'_> {
    /// Largest distance between the joint's load on the body at end a and that of the reference (N, N m), after the first
    /// tenth of the time, in which the degree of the multipliers grows.
    pub fn load_error(&self, trajectory: &Trajectory, exact: &[SpatialChainMotion]) -> f64 {
        let names = (0..self.joint.len()).map(|row| match self.joint.name(row) {
            "" => format!("{}.lambda", self.name),
            end => format!("{}.lambda.{end}", self.name),
        });
        let multipliers: Vec<_> = names.map(|name| trajectory.column(&name)).collect();
        let late = exact.len() / 10..exact.len();
        let errors = late.map(|row| {
            let lambda = multipliers.iter().map(|column| column[row]);
            self.error_at(lambda, &exact[row])
        });
        errors.fold(0.0, f64::max)
    }

    fn error_at(&self, lambda: impl Iterator<Item = f64>, exact: &SpatialChainMotion) -> f64 {
        let markers = self
            .markers
            .map(|(body, marker)| pose(&exact.bodies[body], &marker));
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for (condition, lambda) in self.joint.conditions().zip(lambda) {
            let law = condition.law().unwrap();
            let unit = law.unit_wrench(End::A, &markers);
            force += lambda * unit.force;
            moment += lambda * unit.moment;
        }
        let exact = &exact.reactions[self.markers[0].0];
        let moment = moment + (markers[0].position - exact.point).cross(&force);
        (force - exact.force).norm() + (moment - exact.moment).norm()
    }
}

fn pose(body: &BodyMotion, marker: &Vector3<f64>) -> Pose {
    let attitude = UnitQuaternion::from_quaternion(body.attitude);
    Pose {
        position: body.position + attitude * marker,
        rotation: attitude.to_rotation_matrix().into_inner(),
    }
}
