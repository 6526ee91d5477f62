//! Torsional springs and dampers.

use linchpin_proto::joint_load::Wrench;
use linchpin_worker::setup::SetupError;
use nalgebra::Vector3;

use super::body::{self, Body};
use super::dimension::Dimension;
use super::entries::{Entries, Entry};
use super::joint::{Joint, JointKind};
use super::kinematics::{Kinematics, NO_LOAD, Orientation, add_load};

/// A torsional spring and damper: with the angle `phi` of b from a, the moment on b about the axis is
/// `-stiffness (phi - rest_angle) - damping phi'`, and a gets the opposite.
#[derive(Debug, Clone, PartialEq)]
pub struct TorsionSpring {
    bodies: [usize; 2],
    /// In the axes of a.
    axis: Vector3<f64>,
    /// The joint whose angle it feels; in the plane it feels the angles of the bodies.
    joint: Option<usize>,
    stiffness: f64,
    damping: f64,
    rest_angle: f64,
}

/// All torsional springs of a composition.
///
/// # Errors
/// [`SetupError`]: a body or joint that is not there, a value out of its range.
pub fn read(
    entries: &Entries<'_>,
    bodies: &[Body],
    joints: &[Joint],
    dimension: Dimension,
) -> Result<Vec<TorsionSpring>, SetupError> {
    let springs = entries.of("torsion-spring");
    springs
        .map(|entry| TorsionSpring::read(&entry, bodies, joints, dimension))
        .collect()
}

impl TorsionSpring {
    fn read(
        entry: &Entry<'_>,
        bodies: &[Body],
        joints: &[Joint],
        dimension: Dimension,
    ) -> Result<Self, SetupError> {
        let (pair, axis, joint) = match dimension {
            Dimension::Plane => (body::pair(entry, bodies)?, Vector3::z(), None),
            Dimension::Space => {
                let names = joints.iter().map(|joint| joint.name.as_str());
                let place = entry.place_of("joint", "joint", names)?;
                let joint = &joints[place];
                joint.require(entry, &[JointKind::Revolute], "revolute")?;
                (joint.bodies, joint.axes[0], Some(place))
            }
        };
        Ok(Self {
            bodies: pair,
            axis,
            joint,
            stiffness: entry.non_negative_or("stiffness", 0.0)?,
            damping: entry.non_negative_or("damping", 0.0)?,
            rest_angle: entry.number_or("rest_angle", 0.0)?,
        })
    }

    /// Adds its moments on the bodies.
    pub fn add_loads(&self, kinematics: &Kinematics, loads: &mut [Wrench]) {
        let [a, b] = self.bodies.map(|place| &kinematics.bodies[place]);
        let axis = a.arm(&self.axis);
        let rate = (b.twist.angular - a.twist.angular).dot(&axis);
        let moment = -self.stiffness * self.turn(kinematics) - self.damping * rate;
        let load = Wrench {
            moment: moment * axis,
            ..NO_LOAD
        };
        for (place, sign) in self.bodies.into_iter().zip([-1.0, 1.0]) {
            add_load(&mut loads[place], sign, &load);
        }
    }

    /// Energy of the spring (J).
    pub fn energy(&self, kinematics: &Kinematics) -> f64 {
        0.5 * self.stiffness * self.turn(kinematics).powi(2)
    }

    /// Angle beyond that of rest.
    fn turn(&self, kinematics: &Kinematics) -> f64 {
        let [a, b] = self
            .bodies
            .map(|place| kinematics.bodies[place].orientation);
        let angle = match (self.joint, a.to(&b)) {
            (Some(joint), _) => kinematics.angles[joint],
            (None, Orientation::Angle(angle)) => angle,
            (None, Orientation::Attitude(_)) => 0.0,
        };
        angle - self.rest_angle
    }
}
