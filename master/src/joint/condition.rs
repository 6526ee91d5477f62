//! One scalar condition of a joint.

use linchpin_proto::joint_load::{End, JointLaw, Law, Reads};

use super::level::Level;
use super::motion::{Jet, MarkerGradient, Motion};

/// Residuals below this share of the terms that cancel in them ([`Condition::extent`]) are rounding.
pub const ROUNDING: f64 = 1e-11;

/// Motion below this (m, rad, and per s) is no measure of an opening: a joint may rest in the origin, and then its
/// positions and velocities are nothing but rounding.
const LEAST_MOTION: f64 = 1e-3;

/// `u . w` and its derivatives up to a level, 0 above it.
pub fn product(highest: Level, [u, w]: &[Jet; 2]) -> [f64; 3] {
    highest.each_up_to(|level| u.dot(w, level))
}

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

    /// Derivatives of the sum of `by` times [`Condition::factors`], each vector times its own, with respect to the motion at one end.
    fn factor_gradient(&self, motion: &Motion, end: End, by: [&Jet; 2]) -> MarkerGradient;

    /// `g`, `g'` or `g''`.
    fn value(&self, level: Level, motion: &Motion) -> f64 {
        self.values(level, motion)[level as usize]
    }

    /// `g`, `g'`, `g''` up to `highest`, 0 above it.
    fn values(&self, highest: Level, motion: &Motion) -> [f64; 3] {
        product(highest, &self.factors(motion))
    }

    /// Derivatives of [`Condition::value`] with respect to the motion at one end; `factors` are those at this motion.
    fn gradient(
        &self,
        level: Level,
        (motion, [u, w]): (&Motion, &[Jet; 2]),
        end: End,
    ) -> MarkerGradient {
        let by = [w.multipliers(level), u.multipliers(level)];
        self.factor_gradient(motion, end, by.each_ref())
    }

    /// Size of the terms that cancel in [`Condition::value`] while the condition holds, for judging what is rounding:
    /// lengths and rates of positions; of axes 1 and rates of turning. At least 1e-3.
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
