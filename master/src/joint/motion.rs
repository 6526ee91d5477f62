//! Motion of a joint's markers, and vectors that they carry, with their time derivatives.

use linchpin_proto::joint_load::{Marker, Pose};
use nalgebra::Vector3;

use super::level::Level;

/// Motion of a marker. Vectors are in inertial axes; a marker in the plane moves in the first two of them and turns about
/// the third, a scalar marker moves along the first. What was not read is zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MarkerMotion {
    /// Position (m) and orientation.
    pub pose: Pose,
    /// m/s
    pub velocity: Vector3<f64>,
    /// Angular velocity, rad/s.
    pub omega: Vector3<f64>,
    /// m/s^2
    pub acceleration: Vector3<f64>,
    /// Angular acceleration, rad/s^2.
    pub alpha: Vector3<f64>,
}

/// The derivatives of a number with respect to the motion of a marker: what it changes by under a small change is the sum of
/// the products.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MarkerGradient {
    /// By the position.
    pub position: Vector3<f64>,
    /// By the rotation vector of the change of orientation, in inertial axes.
    pub rotation: Vector3<f64>,
    /// By the velocity.
    pub velocity: Vector3<f64>,
    /// By the angular velocity.
    pub omega: Vector3<f64>,
    /// By the acceleration.
    pub acceleration: Vector3<f64>,
    /// By the angular acceleration.
    pub alpha: Vector3<f64>,
}

/// Motion of the markers at ends a and b.
pub type Motion = [MarkerMotion; 2];

/// A vector with its first and second time derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet(pub [Vector3<f64>; 3]);

impl Default for MarkerMotion {
    /// At rest in the origin, parallel to the inertial axes.
    fn default() -> Self {
        let zero = Vector3::zeros();
        Self {
            pose: Pose::default(),
            velocity: zero,
            omega: zero,
            acceleration: zero,
            alpha: zero,
        }
    }
}

impl Marker for MarkerMotion {
    type Vector = Jet;

    fn constant(vector: Vector3<f64>) -> Jet {
        Jet::constant(vector)
    }

    /// `T s`, `omega x T s`, `alpha x T s + omega x (omega x T s)`.
    fn carried(&self, s: &Vector3<f64>) -> Jet {
        let carried = self.pose.carried(s);
        let rate = self.omega.cross(&carried);
        let second = self.alpha.cross(&carried) + self.omega.cross(&rate);
        Jet([carried, rate, second])
    }

    /// `r + T s` and its derivatives.
    fn point(&self, s: &Vector3<f64>) -> Jet {
        let Jet([carried, rate, second]) = self.carried(s);
        Jet([
            self.pose.position + carried,
            self.velocity + rate,
            self.acceleration + second,
        ])
    }
}

impl MarkerMotion {
    /// The derivatives of `by_0 . T s + by_1 . (T s)' + by_2 . (T s)''` with respect to the motion.
    ///
    /// With `c = T s`, a small rotation `theta` changes `c` by `theta x c`, `c' = omega x c` by `omega x (theta x c)`, and so on:
    /// what multiplies a change of `c''` is carried on to `c'` and to `c`.
    pub fn carried_gradient(
        &self,
        s: &Vector3<f64>,
        Jet([by, by_rate, by_second]): &Jet,
    ) -> MarkerGradient {
        let Jet([carried, rate, _]) = self.carried(s);
        let on_rate = by_rate + by_second.cross(&self.omega);
        let on_carried = by + by_second.cross(&self.alpha) + on_rate.cross(&self.omega);
        MarkerGradient {
            rotation: carried.cross(&on_carried),
            omega: carried.cross(&on_rate) + rate.cross(by_second),
            alpha: carried.cross(by_second),
            ..MarkerGradient::default()
        }
    }

    /// The same of the point `r + T s`.
    pub fn point_gradient(&self, s: &Vector3<f64>, by: &Jet) -> MarkerGradient {
        let Jet([position, velocity, acceleration]) = *by;
        MarkerGradient {
            position,
            velocity,
            acceleration,
            ..self.carried_gradient(s, by)
        }
    }
}

impl Default for MarkerGradient {
    /// Of a number that does not depend on the motion.
    fn default() -> Self {
        let zero = Vector3::zeros();
        Self {
            position: zero,
            rotation: zero,
            velocity: zero,
            omega: zero,
            acceleration: zero,
            alpha: zero,
        }
    }
}

impl std::ops::Add for MarkerGradient {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            position: self.position + other.position,
            rotation: self.rotation + other.rotation,
            velocity: self.velocity + other.velocity,
            omega: self.omega + other.omega,
            acceleration: self.acceleration + other.acceleration,
            alpha: self.alpha + other.alpha,
        }
    }
}

impl Jet {
    /// A vector that does not change in time.
    pub fn constant(vector: Vector3<f64>) -> Self {
        Self([vector, Vector3::zeros(), Vector3::zeros()])
    }

    /// What multiplies a vector and its derivatives in the scalar product with this one on a level ([`Jet::dot`]).
    pub fn multipliers(&self, level: Level) -> Self {
        let Self([w, w1, w2]) = *self;
        let zero = Vector3::zeros();
        Self(match level {
            Level::Position => [w, zero, zero],
            Level::Velocity => [w1, w, zero],
            Level::Acceleration => [w2, 2.0 * w1, w],
        })
    }

    /// The scalar product `u . w`, its rate `u' . w + u . w'`, or `u'' . w + 2 u' . w' + u . w''`.
    pub fn dot(&self, other: &Self, level: Level) -> f64 {
        let (Self([u, u1, u2]), Self([w, w1, w2])) = (self, other);
        match level {
            Level::Position => u.dot(w),
            Level::Velocity => u1.dot(w) + u.dot(w1),
            Level::Acceleration => u2.dot(w) + 2.0 * u1.dot(w1) + u.dot(w2),
        }
    }
}

impl std::ops::Sub for Jet {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(std::array::from_fn(|level| self.0[level] - other.0[level]))
    }
}

impl std::ops::Neg for Jet {
    type Output = Self;

    fn neg(self) -> Self {
        Self(self.0.map(|vector| -vector))
    }
}
