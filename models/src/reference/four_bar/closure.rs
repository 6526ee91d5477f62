//! The closed loop of a four-bar linkage at a crank angle and rate.

use nalgebra::{Rotation2, Vector2};

use super::{FourBar, Side};
use crate::reference::tip_line::TipLine;

/// Angles (rad) of crank, coupler and rocker, and what follows from them.
#[derive(Debug, Clone, Copy)]
pub struct Closure {
    pub angles: [f64; 3],
    pub rates: [f64; 3],
    /// Rates per rate of the crank.
    pub ratios: [f64; 3],
    /// Angular accelerations at a constant rate of the crank.
    pub bias: [f64; 3],
}

impl Closure {
    /// Not a number where the loop cannot be closed, infinite where coupler and rocker lie in one line.
    ///
    /// The loop is `a e(p1) + b e(p2) - c e(p3) = const`. Derived, its component along the rocker gives the coupler's
    /// rate, that along the coupler the rocker's; derived twice, their angular accelerations.
    pub fn new(linkage: &FourBar, angle: f64, rate: f64) -> Self {
        let angles = angles(linkage, angle);
        let [first, second, third] = angles;
        let [a, b, c] = linkage.bars.map(|bar| bar.length);
        let (across, along) = (third - second).sin_cos();
        let ratios = [
            1.0,
            -a * (third - first).sin() / (b * across),
            -a * (second - first).sin() / (c * across),
        ];
        let rates = ratios.map(|ratio| ratio * rate);
        let [inward_a, inward_b, inward_c] =
            [0, 1, 2].map(|bar| linkage.bars[bar].length * rates[bar].powi(2));
        let on_rocker = inward_a * (third - first).cos() + inward_b * along - inward_c;
        let on_coupler = inward_a * (second - first).cos() + inward_b - inward_c * along;
        Self {
            angles,
            rates,
            ratios,
            bias: [0.0, on_rocker / (b * across), on_coupler / (c * across)],
        }
    }

    /// A point of a bar, given from its first hinge along and across it, relative to that hinge.
    pub fn arm(&self, bar: usize, point: [f64; 2]) -> Arm {
        let arm = Rotation2::new(self.angles[bar]) * Vector2::from(point);
        let across = turned(&arm);
        Arm {
            arm,
            partial: self.ratios[bar] * across,
            bias: self.bias[bar] * across - self.rates[bar].powi(2) * arm,
        }
    }
}

/// A point of a bar relative to another point of the same bar, or the sum of such steps.
#[derive(Debug, Clone, Copy)]
pub struct Arm {
    /// Position.
    pub arm: Vector2<f64>,
    /// Velocity per rate of the crank.
    pub partial: Vector2<f64>,
    /// Acceleration at a constant rate of the crank.
    pub bias: Vector2<f64>,
}

impl std::ops::Add for Arm {
    type Output = Self;

    fn add(self, further: Self) -> Self {
        Self {
            arm: self.arm + further.arm,
            partial: self.partial + further.partial,
            bias: self.bias + further.bias,
        }
    }
}

/// By +90 degrees.
fn turned(v: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-v.y, v.x)
}

/// Angles by the law of cosines in the triangle of rocker hinge, crank tip and the hinge between coupler and rocker.
/// Those of coupler and rocker are continuous, but may be whole turns away from the nearest to 0.
fn angles(linkage: &FourBar, angle: f64) -> [f64; 3] {
    let [a, b, c] = linkage.bars.map(|bar| bar.length);
    let line = TipLine::new(linkage.between_frame_hinges(), a, angle);
    let side = match linkage.side {
        Side::Left => 1.0,
        Side::Right => -1.0,
    };
    let at_rocker = corner(c, line.distance, b);
    let at_crank = corner(b, line.distance, c);
    [
        angle,
        line.angle + std::f64::consts::PI - side * at_crank,
        line.angle + side * at_rocker,
    ]
}

/// Angle between the sides `p` and `q` of a triangle, `r` opposite.
fn corner(p: f64, q: f64, r: f64) -> f64 {
    ((p * p + q * q - r * r) / (2.0 * p * q)).acos()
}
