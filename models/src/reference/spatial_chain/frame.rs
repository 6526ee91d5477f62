//! A frame that one freedom after the other carries outwards.

use nalgebra::{UnitQuaternion, Vector3};

use crate::reference::spatial_joint::Freedom;

/// A frame in motion. Its accelerations are those at constant coordinate rates; everything is told in space.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    pub attitude: UnitQuaternion<f64>,
    pub omega: Vector3<f64>,
    pub alpha: Vector3<f64>,
    pub origin: Vector3<f64>,
    pub velocity: Vector3<f64>,
    pub acceleration: Vector3<f64>,
}

/// Partial velocities of everything outside of a freedom: the motion per unit of its rate.
#[derive(Debug, Clone, Copy)]
pub struct Screw {
    /// Angular velocity.
    pub angular: Vector3<f64>,
    /// Velocity of the point that passes the origin.
    at_origin: Vector3<f64>,
}

impl Screw {
    /// Velocity at a point in space.
    pub fn at(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.at_origin + self.angular.cross(point)
    }
}

impl Frame {
    /// At the origin, at rest.
    pub fn ground() -> Self {
        let zero = Vector3::zeros();
        Self {
            attitude: UnitQuaternion::identity(),
            omega: zero,
            alpha: zero,
            origin: zero,
            velocity: zero,
            acceleration: zero,
        }
    }

    /// The origin goes to a point that is fixed in the frame, given in its axes:
    /// `v + omega x r`, `a + alpha x r + omega x (omega x r)`.
    pub fn carry(&mut self, point: &Vector3<f64>) {
        let arm = self.attitude * point;
        let relative = self.omega.cross(&arm);
        self.origin += arm;
        self.velocity += relative;
        self.acceleration += self.alpha.cross(&arm) + self.omega.cross(&relative);
    }

    /// Moves the frame by a freedom. A turn adds `e q'` to `omega` and `omega x e q'` to `alpha`, a slide `e q'` to the
    /// velocity and Coriolis' `2 omega x e q'` to the acceleration.
    pub fn free(&mut self, freedom: &Freedom, coordinate: f64, rate: f64) -> Screw {
        match freedom {
            Freedom::Turn(axis) => {
                let direction = self.attitude * axis.into_inner();
                self.alpha += self.omega.cross(&(direction * rate));
                self.omega += direction * rate;
                self.attitude *= UnitQuaternion::from_axis_angle(axis, coordinate);
                Screw {
                    angular: direction,
                    at_origin: self.origin.cross(&direction),
                }
            }
            Freedom::Slide(axis) => {
                let direction = self.attitude * axis.into_inner();
                self.carry(&(axis.into_inner() * coordinate));
                self.velocity += direction * rate;
                self.acceleration += 2.0 * self.omega.cross(&(direction * rate));
                Screw {
                    angular: Vector3::zeros(),
                    at_origin: direction,
                }
            }
        }
    }
}
