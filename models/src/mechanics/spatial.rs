//! Kinematics of a rigid body in space.
//!
//! The attitude is a unit quaternion `q` from the body's axes to those of space: unlike three angles it has no
//! attitude at which its rate becomes infinite, and unlike a rotation vector relative to the start of a macro step it
//! sets no limit to the turn within one. `q' = q (0, omega) / 2` keeps its length; an integrator keeps it to its own
//! error, so the length is brought back to 1 at every macro point.

use linchpin_proto::joint_load::Wrench;
use nalgebra::{Matrix3, Matrix3x4, Matrix4, Matrix4x3, Quaternion, Vector3, Vector4};

/// `q v q*`: components in space of a vector given in the body's axes.
pub fn to_space(q: &Quaternion<f64>, v: &Vector3<f64>) -> Vector3<f64> {
    (q * Quaternion::from_imag(*v) * q.conjugate()).imag()
}

/// `q* v q`: components in the body's axes of a vector given in space.
pub fn to_body(q: &Quaternion<f64>, v: &Vector3<f64>) -> Vector3<f64> {
    to_space(&q.conjugate(), v)
}

/// Derivative of [`to_body`] with respect to `(w, x, y, z)` of `q = (w, u)`, from
/// `q* v q = (w^2 - u u) v + 2 (u v) u - 2 w u x v`.
pub fn to_body_by_attitude(q: &Quaternion<f64>, v: &Vector3<f64>) -> Matrix3x4<f64> {
    let (w, u) = (q.scalar(), q.imag());
    let by_real = 2.0 * (w * v - u.cross(v));
    let by_imaginary = 2.0
        * (u * v.transpose() - v * u.transpose()
            + Matrix3::identity() * u.dot(v)
            + w * v.cross_matrix());
    let mut derivative = Matrix3x4::zeros();
    derivative.set_column(0, &by_real);
    derivative
        .fixed_columns_mut::<3>(1)
        .copy_from(&by_imaginary);
    derivative
}

/// `(w, x, y, z)` of `q' = q (0, omega) / 2`; `omega` in the body's axes.
pub fn attitude_rate(q: &Quaternion<f64>, omega: &Vector3<f64>) -> Vector4<f64> {
    real_first(&(q * Quaternion::from_imag(omega * 0.5)))
}

/// Derivative of [`attitude_rate`] with respect to `(w, x, y, z)`.
pub fn attitude_rate_by_attitude(omega: &Vector3<f64>) -> Matrix4<f64> {
    let units = [
        Quaternion::new(1.0, 0.0, 0.0, 0.0),
        Quaternion::new(0.0, 1.0, 0.0, 0.0),
        Quaternion::new(0.0, 0.0, 1.0, 0.0),
        Quaternion::new(0.0, 0.0, 0.0, 1.0),
    ];
    Matrix4::from_columns(&units.map(|unit| attitude_rate(&unit, omega)))
}

/// Derivative of [`attitude_rate`] with respect to `omega`.
pub fn attitude_rate_by_omega(q: &Quaternion<f64>) -> Matrix4x3<f64> {
    let units = [Vector3::x(), Vector3::y(), Vector3::z()];
    Matrix4x3::from_columns(&units.map(|unit| attitude_rate(q, &unit)))
}

/// `(w, x, y, z)`: the order of states and outputs.
pub fn real_first(q: &Quaternion<f64>) -> Vector4<f64> {
    Vector4::new(q.w, q.i, q.j, q.k)
}

/// Motion of a rigid body, told by its centre of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMotion {
    /// Position of the centre (m), in space.
    pub position: Vector3<f64>,
    /// Attitude.
    pub attitude: Quaternion<f64>,
    /// Velocity of the centre (m/s), in space.
    pub velocity: Vector3<f64>,
    /// Angular velocity (rad/s), in the body's axes.
    pub omega: Vector3<f64>,
}

/// Rates of [`BodyMotion::velocity`] and [`BodyMotion::omega`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyAcceleration {
    /// Acceleration of the centre (m/s^2), in space.
    pub centre: Vector3<f64>,
    /// Angular acceleration (rad/s^2), in the body's axes.
    pub alpha: Vector3<f64>,
}

/// A point fixed in a body, by its place in the body's axes relative to the centre of mass (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyPoint(pub Vector3<f64>);

impl BodyPoint {
    fn position(&self, body: &BodyMotion) -> Vector3<f64> {
        body.position + to_space(&body.attitude, &self.0)
    }

    fn velocity(&self, body: &BodyMotion) -> Vector3<f64> {
        body.velocity + to_space(&body.attitude, &body.omega.cross(&self.0))
    }

    /// `a + alpha x r + omega x (omega x r)`.
    fn acceleration(&self, body: &BodyMotion, rates: &BodyAcceleration) -> Vector3<f64> {
        let centripetal = body.omega.cross(&body.omega.cross(&self.0));
        let relative = rates.alpha.cross(&self.0) + centripetal;
        rates.centre + to_space(&body.attitude, &relative)
    }

    /// Moment about the centre of mass of a load at this point, in the body's axes.
    pub fn moment(&self, attitude: &Quaternion<f64>, load: &Wrench) -> Vector3<f64> {
        self.0.cross(&to_body(attitude, &load.force)) + to_body(attitude, &load.moment)
    }

    /// Derivative of [`BodyPoint::moment`] with respect to `(w, x, y, z)` of the attitude.
    pub fn moment_by_attitude(&self, attitude: &Quaternion<f64>, load: &Wrench) -> Matrix3x4<f64> {
        self.0.cross_matrix() * to_body_by_attitude(attitude, &load.force)
            + to_body_by_attitude(attitude, &load.moment)
    }

    /// Output number `component` of a spatial marker at this point. Angular velocity and acceleration are those in
    /// space: the rate of `q omega q*` is `q omega' q*`, because `omega x omega` vanishes.
    pub fn output(
        &self,
        component: usize,
        body: &BodyMotion,
        rates: impl FnOnce() -> BodyAcceleration,
    ) -> f64 {
        match component {
            0..3 => self.position(body)[component],
            3..7 => real_first(&body.attitude)[component - 3],
            7..10 => self.velocity(body)[component - 7],
            10..13 => to_space(&body.attitude, &body.omega)[component - 10],
            13..16 => self.acceleration(body, &rates())[component - 13],
            _ => to_space(&body.attitude, &rates().alpha)[component - 16],
        }
    }
}
