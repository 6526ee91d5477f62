//! Markers: points of bodies with axes of their own.

use linchpin_proto::joint_load::{Pose, Wrench};
use linchpin_worker::setup::SetupError;
use nalgebra::Vector3;

use super::body::{self, Body};
use super::entries::Entries;
use super::kinematics::{BodyMotion, Orientation, Twist, moved_load};
use crate::mechanics::spatial::real_first;

/// One marker.
#[derive(Debug, Clone, PartialEq)]
pub struct Marker {
    /// Its name.
    pub name: String,
    /// Place of its body.
    pub body: usize,
    /// In the body's axes, from the centre of mass (m).
    point: Vector3<f64>,
    /// From the axes of the marker to those of the body.
    orientation: Orientation,
}

/// All markers of a composition, in the order of their names.
///
/// # Errors
/// [`SetupError`]: a body that is not there, a value that is missing or out of its range.
pub fn read(entries: &Entries<'_>, bodies: &[Body]) -> Result<Vec<Marker>, SetupError> {
    let markers = entries.of("marker").map(|entry| {
        Ok(Marker {
            name: entry.name.to_owned(),
            body: body::place(&entry, "body", bodies)?,
            point: entry.vector_or_zeros("point")?,
            orientation: entry.orientation()?,
        })
    });
    markers.collect()
}

impl Marker {
    /// Position and axes.
    pub fn pose(&self, body: &BodyMotion) -> Pose {
        Pose {
            position: body.point(&self.point),
            rotation: body.pose.rotation * self.orientation.rotation(),
        }
    }

    /// A load at this point as one at the centre of mass.
    pub fn at_centre(&self, body: &BodyMotion, load: &Wrench) -> Wrench {
        moved_load(load, &body.arm(&self.point))
    }

    /// Position in the order of the outputs of a marker: in the plane two components and an angle, in space three and a
    /// unit quaternion.
    pub fn position(&self, body: &BodyMotion) -> Vec<f64> {
        let position = body.point(&self.point);
        match body.orientation.then(&self.orientation) {
            Orientation::Angle(angle) => vec![position.x, position.y, angle],
            Orientation::Attitude(attitude) => {
                let settled = attitude.normalize();
                [position.as_slice(), real_first(&settled).as_slice()].concat()
            }
        }
    }

    /// Velocity and angular velocity.
    pub fn velocity(&self, body: &BodyMotion) -> Twist {
        body.twist.shifted(&body.arm(&self.point))
    }

    /// Acceleration and angular acceleration; `acceleration` is that of the body.
    pub fn acceleration(&self, body: &BodyMotion, acceleration: &Twist) -> Twist {
        acceleration.accelerated(&body.arm(&self.point), &body.twist.angular)
    }
}
