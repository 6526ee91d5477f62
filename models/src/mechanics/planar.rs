//! Kinematics of a rigid body in the plane.

/// A point on the axis of a rigid body, `along` (m) from the body's reference point.
///
/// The body is told by the motion of its reference point: positions `(x, y, angle)`, velocities and accelerations
/// are their rates. The axis points in the direction `e = (cos angle, sin angle)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisPoint {
    pub along: f64,
}

/// Position and angle, or their rates, or force and moment about the point.
pub type Triple = [f64; 3];

impl AxisPoint {
    /// `r + along e`.
    pub fn position(&self, [x, y, angle]: Triple) -> Triple {
        let (sin, cos) = angle.sin_cos();
        [x + self.along * cos, y + self.along * sin, angle]
    }

    /// `v + along rate e'`.
    pub fn velocity(&self, angle: f64, [vx, vy, rate]: Triple) -> Triple {
        let (sin, cos) = angle.sin_cos();
        let speed = self.along * rate;
        [vx - speed * sin, vy + speed * cos, rate]
    }

    /// `a + along (alpha e' - rate^2 e)`.
    pub fn acceleration(&self, angle: f64, rate: f64, [ax, ay, alpha]: Triple) -> Triple {
        let (sin, cos) = angle.sin_cos();
        let (across, inward) = (self.along * alpha, self.along * rate * rate);
        [
            ax - across * sin - inward * cos,
            ay + across * cos - inward * sin,
            alpha,
        ]
    }

    /// Moment about the reference point of a load at this point.
    pub fn moment(&self, angle: f64, [fx, fy, moment]: Triple) -> f64 {
        let (sin, cos) = angle.sin_cos();
        moment + self.along * (cos * fy - sin * fx)
    }

    /// Derivative of [`AxisPoint::moment`] with respect to the angle.
    pub fn moment_by_angle(&self, angle: f64, [fx, fy, _]: Triple) -> f64 {
        let (sin, cos) = angle.sin_cos();
        -self.along * (sin * fy + cos * fx)
    }

    /// Output number `component` of a planar marker at this point.
    pub fn output(
        &self,
        component: usize,
        position: Triple,
        velocity: Triple,
        acceleration: impl FnOnce() -> Triple,
    ) -> f64 {
        let [.., angle] = position;
        let [.., rate] = velocity;
        match component {
            0..3 => self.position(position)[component],
            3..6 => self.velocity(angle, velocity)[component - 3],
            _ => self.acceleration(angle, rate, acceleration())[component - 6],
        }
    }
}
