//! Prescribed motion: a coordinate as a function of time.

use std::f64::consts::TAU;

use linchpin_proto::joint_load::{JointLaw, Law};
use linchpin_worker::setup::SetupError;
use nalgebra::Vector3;

use super::body::{self, Body, GROUND};
use super::condition::{Condition, Drive};
use super::entries::{Entries, Entry};
use super::error::CompositionError;
use super::joint::{Joint, JointKind};

/// `offset + speed t + amplitude sin(2 pi frequency t + phase)`, with the time `t` of the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Course {
    offset: f64,
    speed: f64,
    amplitude: f64,
    /// 2 pi frequency (rad/s).
    omega: f64,
    phase: f64,
}

/// A coordinate with its first and second rate.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Coordinate {
    /// m or rad.
    pub value: f64,
    /// Per s.
    pub rate: f64,
    /// Per s^2.
    pub acceleration: f64,
}

/// What moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target {
    /// Angle or displacement of this joint.
    Joint(usize),
    /// Component of the position of a point of a body.
    Point {
        /// Place of the body.
        body: usize,
        /// In the body's axes (m).
        point: Vector3<f64>,
        /// Unit vector in inertial axes.
        direction: Vector3<f64>,
    },
}

/// One prescribed motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Its place among the parameters.
    pub place: String,
    /// What moves.
    pub target: Target,
    /// How.
    pub course: Course,
}

impl Coordinate {
    /// All of it times `factor`.
    pub fn times(&self, factor: f64) -> Self {
        Self {
            value: factor * self.value,
            rate: factor * self.rate,
            acceleration: factor * self.acceleration,
        }
    }
}

impl Course {
    /// The coordinate at `t` (s).
    pub fn at(&self, t: f64) -> Coordinate {
        let (sin, cos) = (self.omega * t + self.phase).sin_cos();
        Coordinate {
            value: self.offset + self.speed * t + self.amplitude * sin,
            rate: self.speed + self.amplitude * self.omega * cos,
            acceleration: -self.amplitude * self.omega * self.omega * sin,
        }
    }

    /// With the offset that gives `start` at `t` unless one is given.
    fn read(entry: &Entry<'_>, t: f64, start: f64) -> Result<Self, SetupError> {
        let mut course = Self {
            offset: 0.0,
            speed: entry.number_or("speed", 0.0)?,
            amplitude: entry.number_or("amplitude", 0.0)?,
            omega: TAU * entry.non_negative_or("frequency", 0.0)?,
            phase: entry.number_or("phase", 0.0)?,
        };
        course.offset = entry.number_or("offset", start - course.at(t).value)?;
        Ok(course)
    }
}

impl Motion {
    /// The condition that the motion puts on its target.
    pub fn condition(&self, bodies: &[Body], joints: &[Joint]) -> Condition {
        let mut condition = match self.target {
            Target::Joint(joint) => joints[joint].driven(self.course, bodies),
            Target::Point {
                body,
                point,
                direction,
            } => Condition {
                place: String::new(),
                bodies: [body, GROUND],
                law: JointLaw {
                    law: Law::AtPoint { direction },
                    points: [point, Vector3::zeros()],
                },
                drive: Drive::Shift {
                    course: self.course,
                    sign: -1.0,
                },
            },
        };
        condition.place.clone_from(&self.place);
        condition
    }

    /// The joint that it drives.
    pub fn joint(&self) -> Option<usize> {
        match self.target {
            Target::Joint(joint) => Some(joint),
            Target::Point { .. } => None,
        }
    }

    fn read(
        entry: &Entry<'_>,
        bodies: &[Body],
        joints: &[Joint],
        t: f64,
    ) -> Result<Self, SetupError> {
        const COURSE: [&str; 5] = ["offset", "speed", "amplitude", "frequency", "phase"];
        let (target, start) = match (entry.has("joint"), entry.has("body")) {
            (true, false) => {
                entry.allow_only(&[&["joint"][..], &COURSE].concat())?;
                let names = joints.iter().map(|joint| joint.name.as_str());
                let place = entry.place_of("joint", "joint", names)?;
                joints[place].require(
                    entry,
                    &[JointKind::Revolute, JointKind::Prismatic],
                    "revolute, prismatic",
                )?;
                let start = joints[place].start_coordinate(bodies);
                (Target::Joint(place), start)
            }
            (false, true) => {
                entry.allow_only(&[&["body", "point", "direction"][..], &COURSE].concat())?;
                let body = body::place(entry, "body", bodies)?;
                let point = entry.vector_or_zeros("point")?;
                let direction = entry.direction("direction")?;
                let start = bodies[body].start.point(&point).dot(&direction);
                let target = Target::Point {
                    body,
                    point,
                    direction,
                };
                (target, start)
            }
            _ => {
                let field = entry.place();
                return Err(CompositionError::Target { field }.into());
            }
        };
        Ok(Self {
            place: entry.place(),
            target,
            course: Course::read(entry, t, start)?,
        })
    }
}

/// All prescribed motions of a composition, in the order of their names; `t` is the time of the start (s).
///
/// # Errors
/// [`SetupError`]: a target that is not there, a value that is missing or out of its range.
pub fn read(
    entries: &Entries<'_>,
    bodies: &[Body],
    joints: &[Joint],
    t: f64,
) -> Result<Vec<Motion>, SetupError> {
    let motions = entries.of("motion");
    let motions: Result<Vec<Motion>, SetupError> = motions
        .map(|entry| Motion::read(&entry, bodies, joints, t))
        .collect();
    let motions = motions?;
    for (number, motion) in motions.iter().enumerate() {
        let Target::Joint(joint) = motion.target else {
            continue;
        };
        let mut before = motions[..number].iter();
        if let Some(other) = before.find(|other| other.target == motion.target) {
            let error = CompositionError::DrivenTwice {
                field: format!("{}.joint", motion.place),
                joint: joints[joint].name.clone(),
                other: other.place.clone(),
            };
            return Err(error.into());
        }
    }
    Ok(motions)
}
