//! The conditions themselves, at one instant or with their time derivatives.

use std::ops::Sub;

use nalgebra::Vector3;

use super::{JointLaw, Law, Pose};

/// What a condition is written in terms of: the pose of a marker, or its motion.
pub trait Marker {
    /// A vector; of a motion one with its time derivatives.
    type Vector: Sub<Output = Self::Vector>;

    /// A vector that is the same at all times.
    fn constant(vector: Vector3<f64>) -> Self::Vector;

    /// A vector `s` fixed in the marker's axes: `T s`.
    fn carried(&self, s: &Vector3<f64>) -> Self::Vector;

    /// The point `s` of the marker's axes: `r + T s`.
    fn point(&self, s: &Vector3<f64>) -> Self::Vector;
}

impl Marker for Pose {
    type Vector = Vector3<f64>;

    fn constant(vector: Vector3<f64>) -> Vector3<f64> {
        vector
    }

    fn carried(&self, s: &Vector3<f64>) -> Vector3<f64> {
        self.rotation * s
    }

    fn point(&self, s: &Vector3<f64>) -> Vector3<f64> {
        self.position + self.rotation * s
    }
}

impl JointLaw {
    /// The two vectors `u` and `w` of the condition `g = u . w`.
    pub fn factors<M: Marker>(&self, [a, b]: &[M; 2]) -> [M::Vector; 2] {
        let apart = || a.point(&self.points[0]) - b.point(&self.points[1]);
        match self.law {
            Law::AtPoint { direction } => [apart(), M::constant(direction)],
            Law::InPlane { normal } => [apart(), b.carried(&normal)],
            Law::Perpendicular { axes } => [a.carried(&axes[0]), b.carried(&axes[1])],
        }
    }

    /// The residual `g` in m; that of the perpendicular law is a number.
    pub fn residual(&self, poses: &[Pose; 2]) -> f64 {
        let [u, w] = self.factors(poses);
        u.dot(&w)
    }
}
