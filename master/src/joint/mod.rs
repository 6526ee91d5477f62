//! Joints: rows of scalar conditions between two markers; the rest of the master sees rows only.
//!
//! * [`rigid_link`], [`atpoint`], [`inplane`], [`perpendicular`]: one fundamental joint each;
//! * [`composite`]: what users name in a scene;
//! * [`motion`]: what the conditions are evaluated on;
//! * the loads: [`linchpin_proto::joint_load`], shared with the workers.

pub mod atpoint;
pub mod composite;
pub mod inplane;
pub mod motion;
pub mod perpendicular;
pub mod rigid_link;

pub use atpoint::AtPoint;
pub use composite::Kind;
pub use inplane::InPlane;
pub use linchpin_proto::joint_load::End;
pub use motion::{MarkerChange, MarkerMotion, Motion};
pub use perpendicular::Perpendicular;
pub use rigid_link::RigidLink;

use linchpin_proto::joint_load::{JointLaw, Law, Reads};
use motion::Jet;
use nalgebra::Vector3;

/// Time derivative of a coupling condition: `g`, `g'` or `g''`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// `g`
    Position,
    /// `dg/dt`
    Velocity,
    /// `d^2 g/dt^2`
    Acceleration,
}

impl Level {
    /// All levels, lowest first.
    pub const ALL: [Self; 3] = [Self::Position, Self::Velocity, Self::Acceleration];

    /// This level and those below it.
    pub fn up_to(self) -> &'static [Self] {
        &Self::ALL[..=self as usize]
    }

    /// `value` of this level and those below it, 0 above.
    fn each_up_to(self, value: impl Fn(Self) -> f64) -> [f64; 3] {
        Self::ALL.map(|level| if level <= self { value(level) } else { 0.0 })
    }

    /// As it stands in the names of result columns.
    pub fn name(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
        }
    }
}

/// Residuals below this share of the terms that cancel in them ([`Condition::extent`]) are rounding.
pub const ROUNDING: f64 = 1e-11;

/// Motion below this (m, rad, and per s) is no measure of an opening: a joint may rest in the origin, and then its
/// positions and velocities are nothing but rounding.
pub const LEAST_MOTION: f64 = 1e-3;

/// One scalar condition `g = u . w` of two vectors that the markers determine, on every level.
pub trait Condition: Send + Sync {
    /// The law of the load; `None` for the link between scalar markers, whose load is `+lambda` on a, `-lambda` on b.
    fn law(&self) -> Option<&JointLaw>;

    /// What the condition reads of the marker at `end`.
    fn reads(&self, end: End) -> Reads {
        let of_link = Reads {
            position: true,
            rotation: false,
        };
        self.law().map_or(of_link, |law| law.condition_reads(end))
    }

    /// `u` and `w` with their time derivatives.
    fn factors(&self, motion: &Motion) -> [Jet; 2];

    /// Change of [`Condition::factors`] under a small change of the motion at one end.
    fn factor_changes(&self, motion: &Motion, end: End, change: &MarkerChange) -> [Jet; 2];

    /// `g`, `g'` or `g''`.
    fn value(&self, level: Level, motion: &Motion) -> f64 {
        self.values(level, motion)[level as usize]
    }

    /// `g`, `g'`, `g''` up to `highest`, 0 above it.
    fn values(&self, highest: Level, motion: &Motion) -> [f64; 3] {
        let [u, w] = self.factors(motion);
        highest.each_up_to(|level| u.dot(&w, level))
    }

    /// Changes of [`Condition::values`] under a small change of the motion at one end.
    fn changes(
        &self,
        highest: Level,
        motion: &Motion,
        end: End,
        change: &MarkerChange,
    ) -> [f64; 3] {
        let [u, w] = self.factors(motion);
        let [du, dw] = self.factor_changes(motion, end, change);
        highest.each_up_to(|level| du.dot(&w, level) + u.dot(&dw, level))
    }

    /// Size of the terms that cancel in [`Condition::value`] while the condition holds, for judging what is rounding:
    /// lengths and rates of positions; of axes 1 and rates of turning. At least [`LEAST_MOTION`].
    fn extent(&self, level: Level, motion: &Motion) -> f64 {
        let arms = self
            .law()
            .map_or([0.0; 2], |law| law.points.map(|s| s.norm()));
        let sizes = motion.iter().zip(arms).map(|(marker, arm)| {
            let turning = match level {
                Level::Position => 1.0,
                Level::Velocity => marker.omega.norm(),
                Level::Acceleration => marker.alpha.norm() + marker.omega.norm_squared(),
            };
            let moving = match level {
                Level::Position => marker.pose.position,
                Level::Velocity => marker.velocity,
                Level::Acceleration => marker.acceleration,
            };
            if self.is_length() {
                moving.norm() + arm * turning
            } else {
                turning
            }
        });
        sizes.fold(LEAST_MOTION, f64::max)
    }

    /// Power of the load of a multiplier 1 on both ends per unit of `g'`: 1 for the laws, -1 for the link between scalar
    /// markers. A spring of stiffness K in place of the multiplier, `-(this) K g`, therefore stores the energy `K g^2 / 2`.
    fn load_power(&self) -> f64 {
        match self.law() {
            Some(_) => 1.0,
            None => -1.0,
        }
    }

    /// Whether `g` is a length (m); otherwise it is a number.
    fn is_length(&self) -> bool {
        let law = self.law().map(|law| law.law);
        !matches!(law, Some(Law::Perpendicular { .. }))
    }
}

/// A joint: its conditions, each with the end of its name in result columns.
pub struct Joint {
    rows: Vec<(&'static str, Box<dyn Condition>)>,
    aligned: Vec<[Vector3<f64>; 2]>,
}

impl Joint {
    fn new(rows: Vec<(&'static str, Box<dyn Condition>)>, aligned: Vec<[Vector3<f64>; 2]>) -> Self {
        Self { rows, aligned }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether it demands nothing: no joint of [`composite`] does.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// End of the name of a row in result columns; empty if it is the only one.
    pub fn name(&self, row: usize) -> &'static str {
        self.rows[row].0
    }

    /// The condition of a row.
    pub fn condition(&self, row: usize) -> &dyn Condition {
        &*self.rows[row].1
    }

    /// All conditions.
    pub fn conditions(&self) -> impl Iterator<Item = &dyn Condition> {
        self.rows.iter().map(|(_, condition)| &**condition)
    }

    /// What the joint reads of the marker at `end`.
    pub fn reads(&self, end: End) -> Reads {
        let reads = self.conditions().map(|condition| condition.reads(end));
        reads.fold(Reads::default(), |all, one| Reads {
            position: all.position || one.position,
            rotation: all.rotation || one.rotation,
        })
    }

    /// Axes of markers a and b that have to point to the same side: the conditions also hold where they point to opposite
    /// sides, and those that keep an attitude also a third of a turn away from it, where they are at right angles.
    pub fn aligned(&self) -> &[[Vector3<f64>; 2]] {
        &self.aligned
    }
}

#[cfg(test)]
mod tests;
