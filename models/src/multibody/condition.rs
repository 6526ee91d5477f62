//! Conditions that joints and motions put on bodies: `g(q, t) = 0`, one number each.
//!
//! The laws and their derivatives are those of joint loads ([`linchpin_proto::joint_load`]): with the twists `V` of the
//! two bodies, `g' = J V + g_t` and `g'' = J V' + c`, where the row `J` is the load of a unit multiplier.

use linchpin_proto::joint_load::{End, JointLaw, Law, Pose, Wrench};
use nalgebra::{Rotation3, Unit, Vector3};

use super::kinematics::{BodyMotion, Twist};
use super::motion::{Coordinate, Course};

/// One condition between two bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Condition {
    /// Place of its joint or motion among the parameters.
    pub place: String,
    /// Places of bodies a and b.
    pub bodies: [usize; 2],
    /// What it says of their centres of mass and axes.
    pub law: JointLaw,
    /// How it depends on time.
    pub drive: Drive,
}

/// How a condition depends on time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drive {
    /// Not.
    None,
    /// `sign` times the course is added to it.
    Shift {
        /// Of the displacement (m).
        course: Course,
        /// 1 or -1.
        sign: f64,
    },
    /// Body a is taken as turned about an axis.
    Turn {
        /// Of the angle (rad).
        course: Course,
        /// Angle at which nothing is turned (rad).
        start: f64,
        /// Unit vector in the axes of body a.
        axis: Vector3<f64>,
    },
}

/// A condition at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Places of bodies a and b.
    pub bodies: [usize; 2],
    /// `J`: loads of a unit multiplier at the centres of mass of a and b.
    pub loads: [Wrench; 2],
    /// `g` (m or rad).
    pub residual: f64,
    /// `g_t` (m/s or rad/s).
    pub drift: f64,
    /// `c` (m/s^2 or rad/s^2).
    pub bias: f64,
}

/// What the law is applied to.
struct Ends {
    poses: [Pose; 2],
    twists: [Twist; 2],
    shift: Coordinate,
    /// Prescribed angular velocity that is added to that of body a, and its rate.
    spin: Vector3<f64>,
    spin_rate: Vector3<f64>,
}

impl Condition {
    /// The condition at time `t` (s).
    pub fn row(&self, t: f64, motions: &[BodyMotion]) -> Row {
        let Ends {
            poses,
            twists,
            shift,
            spin,
            spin_rate,
        } = self.ends(t, motions);
        let loads = End::BOTH.map(|end| self.law.unit_wrench(end, &poses));
        let moved = [twists[0].displacement(), twists[1].displacement()];
        let changes = End::BOTH.map(|end| self.law.unit_wrench_change(end, &poses, &moved));
        let curvature = twists[0].power(&changes[0]) + twists[1].power(&changes[1]);
        Row {
            bodies: self.bodies,
            loads,
            residual: self.law.residual(&poses) + shift.value,
            drift: shift.rate + spin.dot(&loads[0].moment),
            bias: curvature + shift.acceleration + spin_rate.dot(&loads[0].moment),
        }
    }

    fn ends(&self, t: f64, motions: &[BodyMotion]) -> Ends {
        let [a, b] = self.bodies.map(|place| &motions[place]);
        let mut ends = Ends {
            poses: [a.pose, b.pose],
            twists: [a.twist, b.twist],
            shift: Coordinate::default(),
            spin: Vector3::zeros(),
            spin_rate: Vector3::zeros(),
        };
        match self.drive {
            Drive::None => {}
            Drive::Shift { course, sign } => ends.shift = course.at(t).times(sign),
            Drive::Turn {
                course,
                start,
                axis,
            } => {
                let angle = course.at(t);
                let unit = Unit::new_unchecked(axis);
                let turn = Rotation3::from_axis_angle(&unit, angle.value - start);
                let axis = a.arm(&axis);
                ends.poses[0].rotation *= turn.into_inner();
                ends.spin = angle.rate * axis;
                ends.spin_rate = angle.acceleration * axis + a.twist.angular.cross(&ends.spin);
                ends.twists[0].angular += ends.spin;
            }
        }
        ends
    }

    /// Units of the condition and of its rate.
    pub fn units(&self) -> [&'static str; 2] {
        match self.law.law {
            Law::AtPoint { .. } | Law::InPlane { .. } => ["m", "m/s"],
            Law::Perpendicular { .. } => ["rad", "rad/s"],
        }
    }
}

impl Row {
    /// `J V` for the twists of all bodies, or `J V'` for their rates.
    pub fn along(&self, twists: impl Fn(usize) -> Twist) -> f64 {
        let [a, b] = self.bodies;
        twists(a).power(&self.loads[0]) + twists(b).power(&self.loads[1])
    }
}
