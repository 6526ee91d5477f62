//! A rigid body in the plane whose corners touch planes: a block on an incline, a rocking block, a rod on the floor.
//!
//! Coordinates: centre of mass and angle, `q = (x, y, theta)` (m, m, rad). A corner `p` of the body is at
//! `r = (x, y) + R(theta) p`; a plane has the unit normal `n`, and its tangent is `t = (n_y, -n_x)`. With
//! `R' = dR/dtheta`
//!
//! ```text
//! g_N = n . r - d,   W_N^T = (n_x, n_y, n . R' p),   W_T^T = (t_x, t_y, t . R' p)
//! ```

use super::notch::CornerLaw;
use crate::nonsmooth::matrix::{BorderedBand, Shape};
use crate::nonsmooth::system::{Contact, Instant, MechanicalSystem};

/// A body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Mass (kg).
    pub mass: f64,
    /// Moment of inertia about the centre of mass (kg m^2).
    pub inertia: f64,
    /// Acceleration of gravity along -y (m/s^2).
    pub gravity: f64,
}

/// A half-plane that the body must not enter: `n . r < d`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Unit normal `n`, out of the half-plane.
    pub normal: [f64; 2],
    /// `d` (m).
    pub offset: f64,
}

/// A corner that can touch a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The corner `p`, in axes of the body from its centre of mass (m).
    pub corner: [f64; 2],
    /// The plane.
    pub plane: Plane,
    /// Its laws.
    pub law: CornerLaw,
}

/// A body with its contacts. Inputs, as many as there are: force along x and y at the centre of mass (N), torque (N m).
#[derive(Debug, Clone, PartialEq)]
pub struct BodyOnPlanes {
    body: Body,
    touches: Vec<Touch>,
    contacts: Vec<Contact>,
}

impl Plane {
    /// Through the origin, rising at `angle` (rad) along x.
    pub fn rising(angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self {
            normal: [-sin, cos],
            offset: 0.0,
        }
    }

    /// Unit tangent.
    pub fn tangent(&self) -> [f64; 2] {
        [self.normal[1], -self.normal[0]]
    }
}

impl Body {
    /// A homogeneous rectangle.
    pub fn rectangle(mass: f64, [half_length, half_height]: [f64; 2], gravity: f64) -> Self {
        Self {
            mass,
            inertia: mass * (half_length * half_length + half_height * half_height) / 3.0,
            gravity,
        }
    }
}

/// Corners of a rectangle: below left, below right, above right, above left.
pub fn corners_of([half_length, half_height]: [f64; 2]) -> [[f64; 2]; 4] {
    [
        [-half_length, -half_height],
        [half_length, -half_height],
        [half_length, half_height],
        [-half_length, half_height],
    ]
}

impl BodyOnPlanes {
    /// A body with contacts in the order of `touches`.
    pub fn new(body: Body, touches: Vec<Touch>) -> Self {
        Self {
            body,
            contacts: touches.iter().map(|touch| touch.law.contact()).collect(),
            touches,
        }
    }

    /// A body all of whose `corners` can touch one plane.
    pub fn on_plane(body: Body, corners: &[[f64; 2]], plane: Plane, law: CornerLaw) -> Self {
        let touch = |&corner| Touch { corner, plane, law };
        Self::new(body, corners.iter().map(touch).collect())
    }
}

/// `R(theta) p`: a vector of the body in inertial axes.
pub fn turn(theta: f64, [x, y]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = theta.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// `R'(theta) p`: a quarter of a turn ahead.
fn turn_rate(theta: f64, corner: [f64; 2]) -> [f64; 2] {
    let [x, y] = turn(theta, corner);
    [-y, x]
}

fn along(direction: [f64; 2], [x, y]: [f64; 2]) -> f64 {
    direction[0] * x + direction[1] * y
}

impl MechanicalSystem for BodyOnPlanes {
    fn shape(&self) -> Shape {
        Shape::dense(3)
    }

    fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    fn mass(&self, _q: &[f64], mass: &mut BorderedBand) {
        let Body {
            mass: m, inertia, ..
        } = self.body;
        for (i, value) in [m, m, inertia].into_iter().enumerate() {
            mass.add(i, i, value);
        }
    }

    fn force(&self, at: Instant<'_>, force: &mut [f64]) {
        force.copy_from_slice(&[0.0, -self.body.mass * self.body.gravity, 0.0]);
        for (force, input) in force.iter_mut().zip(at.inputs) {
            *force += input;
        }
    }

    fn gaps(&self, q: &[f64], gaps: &mut [f64]) {
        for (gap, touch) in gaps.iter_mut().zip(&self.touches) {
            let [x, y] = turn(q[2], touch.corner);
            *gap = along(touch.plane.normal, [q[0] + x, q[1] + y]) - touch.plane.offset;
        }
    }

    fn directions(&self, q: &[f64], rows: &mut [f64]) {
        for (rows, touch) in rows.chunks_exact_mut(6).zip(&self.touches) {
            let arm = turn_rate(q[2], touch.corner);
            let (n, t) = (touch.plane.normal, touch.plane.tangent());
            rows.copy_from_slice(&[n[0], n[1], along(n, arm), t[0], t[1], along(t, arm)]);
        }
    }

    fn direction_rates(&self, q: &[f64], v: &[f64], rates: &mut [f64]) {
        for (rates, touch) in rates.chunks_exact_mut(2).zip(&self.touches) {
            // R'' p = -R p.
            let arm = turn(q[2], touch.corner).map(|component| -component * v[2] * v[2]);
            rates[0] = along(touch.plane.normal, arm);
            rates[1] = along(touch.plane.tangent(), arm);
        }
    }

    fn energy(&self, q: &[f64], v: &[f64]) -> f64 {
        let Body {
            mass,
            inertia,
            gravity,
        } = self.body;
        0.5 * (mass * (v[0] * v[0] + v[1] * v[1]) + inertia * v[2] * v[2]) + mass * gravity * q[1]
    }
}
