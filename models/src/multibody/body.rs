//! Rigid bodies.

use linchpin_proto::joint_load::{Pose, Wrench};
use linchpin_worker::setup::SetupError;
use nalgebra::{Matrix3, Vector3};

use super::dimension::Dimension;
use super::entries::{Entries, Entry};
use super::error::CompositionError;
use super::kinematics::{BodyMotion, Twist};

/// Name of the ground among the bodies.
pub const GROUND_NAME: &str = "ground";

/// Place of the ground among the bodies.
pub const GROUND: usize = 0;

/// A moment of inertia may exceed the sum of the other two by this part: the rounding of a flat body's.
const ROUNDING: f64 = 1e-12;

/// One body. The ground has no mass: nothing moves it.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// Mass (kg).
    pub mass: f64,
    /// Inertia about the centre of mass in the body's axes (kg m^2).
    inertia: Matrix3<f64>,
    inverse_inertia: Matrix3<f64>,
    /// Motion at the start.
    pub start: BodyMotion,
}

/// The ground, then all bodies of a composition in the order of their names.
///
/// # Errors
/// [`SetupError`]: no body, a value that is missing or out of its range.
pub fn read(entries: &Entries<'_>, dimension: Dimension) -> Result<Vec<Body>, SetupError> {
    let mut bodies = vec![Body {
        name: GROUND_NAME.to_owned(),
        mass: 0.0,
        inertia: Matrix3::zeros(),
        inverse_inertia: Matrix3::zeros(),
        start: dimension.ground(),
    }];
    for entry in entries.of("body") {
        bodies.push(Body::read(&entry, dimension)?);
    }
    if bodies.len() == 1 {
        return Err(SetupError::Missing {
            field: "parameters.body".to_owned(),
        });
    }
    Ok(bodies)
}

/// Place of the body that a key names.
pub fn place(entry: &Entry<'_>, key: &str, bodies: &[Body]) -> Result<usize, SetupError> {
    entry.place_of(key, "body", bodies.iter().map(|body| body.name.as_str()))
}

/// Places of the two bodies that the keys `a` and `b` name.
pub fn pair(entry: &Entry<'_>, bodies: &[Body]) -> Result<[usize; 2], SetupError> {
    let pair = [place(entry, "a", bodies)?, place(entry, "b", bodies)?];
    if pair[0] == pair[1] {
        let error = CompositionError::OneBody {
            field: entry.field("b"),
            body: bodies[pair[0]].name.clone(),
        };
        return Err(error.into());
    }
    Ok(pair)
}

impl Body {
    fn read(entry: &Entry<'_>, dimension: Dimension) -> Result<Self, SetupError> {
        if entry.name == GROUND_NAME {
            let field = entry.place();
            return Err(CompositionError::Ground { field }.into());
        }
        let inertia = dimension.inertia(&moments(entry, dimension)?);
        let orientation = entry.orientation()?;
        let rotation = orientation.rotation();
        let angular = match dimension {
            Dimension::Plane => Vector3::z() * entry.number_or("rate", 0.0)?,
            Dimension::Space => rotation * entry.vector_or_zeros("omega")?,
        };
        Ok(Self {
            name: entry.name.to_owned(),
            mass: entry.positive("m")?,
            inertia,
            inverse_inertia: inertia.map(|moment| if moment > 0.0 { 1.0 / moment } else { 0.0 }),
            start: BodyMotion {
                orientation,
                pose: Pose {
                    position: entry.vector_or_zeros("position")?,
                    rotation,
                },
                twist: Twist {
                    linear: entry.vector_or_zeros("velocity")?,
                    angular,
                },
            },
        })
    }

    /// Angular momentum about the centre of mass, and momentum, of a twist.
    pub fn momentum(&self, motion: &BodyMotion, twist: &Twist) -> Wrench {
        let rotation = &motion.pose.rotation;
        Wrench {
            force: self.mass * twist.linear,
            moment: rotation * (self.inertia * (rotation.transpose() * twist.angular)),
        }
    }

    /// The twist that has this momentum: the acceleration under a load at the centre of mass, if nothing turns.
    pub fn response(&self, motion: &BodyMotion, load: &Wrench) -> Twist {
        if self.mass == 0.0 {
            return Twist::ZERO;
        }
        let rotation = &motion.pose.rotation;
        Twist {
            linear: load.force / self.mass,
            angular: rotation * (self.inverse_inertia * (rotation.transpose() * load.moment)),
        }
    }

    /// The moment `-omega x J omega` that a turning body needs to go on turning.
    pub fn gyroscopic(&self, motion: &BodyMotion) -> Vector3<f64> {
        let omega = motion.twist.angular;
        -omega.cross(&self.momentum(motion, &motion.twist).moment)
    }

    /// Kinetic energy (J).
    pub fn kinetic_energy(&self, motion: &BodyMotion) -> f64 {
        0.5 * motion.twist.power(&self.momentum(motion, &motion.twist))
    }
}

/// One moment of inertia in the plane, three in space.
fn moments(entry: &Entry<'_>, dimension: Dimension) -> Result<Vec<f64>, SetupError> {
    if dimension == Dimension::Plane {
        return Ok(vec![entry.positive("inertia")?]);
    }
    let moments: [f64; 3] = entry.list("inertia")?;
    for (axis, &value) in moments.iter().enumerate() {
        let field = entry.field(&format!("inertia[{axis}]"));
        if value <= 0.0 {
            return Err(SetupError::OutOfRange {
                field,
                value,
                allowed: "it must be greater than 0",
            });
        }
        let rest = moments.iter().sum::<f64>() - value;
        if value * (1.0 - ROUNDING) > rest {
            return Err(CompositionError::Inertia { field, value, rest }.into());
        }
    }
    Ok(moments.to_vec())
}
