//! The translational clearance joint: a rectangular slider in a notch (S2 Sect. C.7, Figs. 40, 41).
//!
//! Corners 1 and 2 touch the upper wall (behind and in front), 3 and 4 the lower one. With the centre of the slider at
//! `(x, y)` and its angle `theta` (S2 eqs. 171 to 178):
//!
//! ```text
//! g_N1,2 = d/2 - y +- a sin(theta) - b cos(theta),   g_N3,4 = d/2 + y -+ a sin(theta) - b cos(theta)
//! g_T1,2 = x -+ a cos(theta) - b sin(theta),         g_T3,4 = x -+ a cos(theta) + b sin(theta)
//! ```

use crate::nonsmooth::system::{Contact, Side};

/// Corners of the slider.
pub const CORNERS: usize = 4;
/// Rows of all corners: a normal and a tangent each.
pub const ROWS: usize = 2 * CORNERS;

/// Signs of `a` in the gaps of the corners: those behind the centre have -1 in `g_T`.
const ALONG: [f64; CORNERS] = [-1.0, 1.0, -1.0, 1.0];
/// 1 for the upper corners, -1 for the lower ones.
const UPPER: [f64; CORNERS] = [1.0, 1.0, -1.0, -1.0];

/// Slider and notch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Notch {
    /// Half the length of the slider, `a` (m).
    pub half_length: f64,
    /// Half its height, `b` (m).
    pub half_height: f64,
    /// Clearance on each side, `c` (m); the notch is `d = 2 (b + c)` wide.
    pub clearance: f64,
}

/// Laws of the corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CornerLaw {
    /// Newton's coefficient in normal direction.
    pub normal_restitution: f64,
    /// Newton's coefficient in tangential direction.
    pub tangential_restitution: f64,
    /// Coulomb's coefficient.
    pub friction: f64,
}

impl CornerLaw {
    /// As a contact in the plane; without friction it has no tangent.
    pub fn contact(&self) -> Contact {
        Contact {
            side: Side::Unilateral,
            normal_restitution: self.normal_restitution,
            tangential_restitution: self.tangential_restitution,
            friction: self.friction,
            tangents: 1,
        }
    }
}

impl Notch {
    /// Gaps of the corners.
    pub fn gaps(&self, y: f64, theta: f64) -> [f64; CORNERS] {
        let (sin, cos) = theta.sin_cos();
        let height = self.half_height + self.clearance - self.half_height * cos;
        std::array::from_fn(|k| height - UPPER[k] * (y + ALONG[k] * self.half_length * sin))
    }

    /// A corner in the axes of the slider, from its centre (m).
    pub fn corner(&self, corner: usize) -> [f64; 2] {
        [
            ALONG[corner] * self.half_length,
            UPPER[corner] * self.half_height,
        ]
    }

    /// `dg_N/dtheta`; `dg_N/dy` is [`Notch::by_height`].
    pub fn normal_by_angle(&self, theta: f64) -> [f64; CORNERS] {
        let (sin, cos) = theta.sin_cos();
        std::array::from_fn(|k| {
            self.half_height * sin - UPPER[k] * ALONG[k] * self.half_length * cos
        })
    }

    /// `dg_T/dtheta`; `dg_T/dx` is 1.
    pub fn tangent_by_angle(&self, theta: f64) -> [f64; CORNERS] {
        let (sin, cos) = theta.sin_cos();
        std::array::from_fn(|k| {
            -ALONG[k] * self.half_length * sin - UPPER[k] * self.half_height * cos
        })
    }

    /// `d^2 g_N/dtheta^2`.
    pub fn normal_by_angle_twice(&self, theta: f64) -> [f64; CORNERS] {
        let (sin, cos) = theta.sin_cos();
        std::array::from_fn(|k| {
            self.half_height * cos + UPPER[k] * ALONG[k] * self.half_length * sin
        })
    }

    /// `d^2 g_T/dtheta^2`.
    pub fn tangent_by_angle_twice(&self, theta: f64) -> [f64; CORNERS] {
        let (sin, cos) = theta.sin_cos();
        std::array::from_fn(|k| {
            -ALONG[k] * self.half_length * cos + UPPER[k] * self.half_height * sin
        })
    }

    /// `dg_N/dy`.
    pub fn by_height() -> [f64; CORNERS] {
        UPPER.map(|upper| -upper)
    }
}
