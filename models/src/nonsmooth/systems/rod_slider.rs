//! Rod and slider of the slider-crank mechanism with a clearance between slider and notch, without the crank.
//!
//! Coordinates: place of the pin at the first end of the rod, angles of rod and slider from the x axis,
//! `q = (x, y, theta_2, theta_3)` (m, m, rad, rad). The slider's centre of mass is the other end of the rod. With the
//! mass `m = m_2 + m_3`, `S = (m_2/2 + m_3) l_2`, `B = J_2 + m_2 l_2^2/4 + m_3 l_2^2`, `s = sin theta_2`,
//! `c = cos theta_2` and `w = theta_2'`
//!
//! ```text
//!     |  m     0    -S s  0   |
//! M = |  0     m     S c  0   |     f = ( S c w^2 + f_x,  S s w^2 - m g + f_y,  -S g c + M,  0 )
//!     | -S s   S c   B    0   |
//!     |  0     0     0    J_3 |
//! ```

use super::guiding;
use super::notch::Notch;
use super::rigid_slider_crank::Guide;
use crate::nonsmooth::matrix::{BorderedBand, Shape};
use crate::nonsmooth::system::{Contact, Instant, MechanicalSystem};

/// Coordinates.
pub const ORDER: usize = 4;

/// Length, masses and weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RodWithSlider {
    /// Length of the rod, `l_2` (m).
    pub length: f64,
    /// Rod, slider (kg).
    pub masses: [f64; 2],
    /// Moments of inertia about the centres of mass (kg m^2).
    pub inertias: [f64; 2],
    /// Acceleration of gravity along -y (m/s^2).
    pub gravity: f64,
    /// Slider and notch.
    pub notch: Notch,
}

/// Rod and slider as a system. Inputs: force along x and y at the pin (N), moment on the rod (N m).
#[derive(Debug, Clone, PartialEq)]
pub struct RodSlider {
    bodies: RodWithSlider,
    guide: Guide,
    contacts: Vec<Contact>,
}

impl RodSlider {
    /// Rod and slider with a guide.
    pub fn new(bodies: RodWithSlider, guide: Guide) -> Self {
        let contacts = guide.contacts();
        Self {
            bodies,
            guide,
            contacts,
        }
    }

    /// Its data.
    pub fn bodies(&self) -> &RodWithSlider {
        &self.bodies
    }

    /// `m`.
    fn mass_of_both(&self) -> f64 {
        self.bodies.masses.iter().sum()
    }

    /// `S`: moment of mass about the pin (kg m).
    fn moment_of_mass(&self) -> f64 {
        let [rod, slider] = self.bodies.masses;
        (0.5 * rod + slider) * self.bodies.length
    }

    /// `B`: moment of inertia about the pin (kg m^2).
    fn inertia(&self) -> f64 {
        let [rod, slider] = self.bodies.masses;
        self.bodies.inertias[0] + (0.25 * rod + slider) * self.bodies.length * self.bodies.length
    }

    /// Centre of the slider.
    pub fn slider(&self, q: &[f64]) -> [f64; 2] {
        let (sin, cos) = q[2].sin_cos();
        [
            q[0] + self.bodies.length * cos,
            q[1] + self.bodies.length * sin,
        ]
    }
}

impl MechanicalSystem for RodSlider {
    fn shape(&self) -> Shape {
        Shape::dense(ORDER)
    }

    fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    fn mass(&self, q: &[f64], mass: &mut BorderedBand) {
        let (sin, cos) = q[2].sin_cos();
        let moment = self.moment_of_mass();
        mass.add(0, 0, self.mass_of_both());
        mass.add(1, 1, self.mass_of_both());
        mass.add_symmetric(0, 2, -moment * sin);
        mass.add_symmetric(1, 2, moment * cos);
        mass.add(2, 2, self.inertia());
        mass.add(3, 3, self.bodies.inertias[1]);
    }

    fn force(&self, at: Instant<'_>, force: &mut [f64]) {
        let (sin, cos) = at.q[2].sin_cos();
        let (moment, gravity) = (self.moment_of_mass(), self.bodies.gravity);
        let load = |place: usize| at.inputs.get(place).copied().unwrap_or(0.0);
        let away = moment * at.v[2] * at.v[2];
        force[0] = away * cos + load(0);
        force[1] = away * sin - self.mass_of_both() * gravity + load(1);
        force[2] = -moment * gravity * cos + load(2);
        force[3] = 0.0;
    }

    fn gaps(&self, q: &[f64], gaps: &mut [f64]) {
        let [_, y] = self.slider(q);
        self.guide.gaps(&self.bodies.notch, y, q[3], gaps);
    }

    fn directions(&self, q: &[f64], rows: &mut [f64]) {
        let (sin, cos) = q[2].sin_cos();
        let length = self.bodies.length;
        let guiding = guiding::rows(self.guide, &self.bodies.notch, q[3]);
        for (row, guiding) in rows.chunks_exact_mut(ORDER).zip(guiding) {
            let [x, y] = guiding.by_place;
            row.copy_from_slice(&[x, y, length * (y * cos - x * sin), guiding.by_angle]);
        }
    }

    fn direction_rates(&self, q: &[f64], v: &[f64], rates: &mut [f64]) {
        let (sin, cos) = q[2].sin_cos();
        let towards = -self.bodies.length * v[2] * v[2];
        let guiding = guiding::rows(self.guide, &self.bodies.notch, q[3]);
        for (rate, guiding) in rates.iter_mut().zip(guiding) {
            let [x, y] = guiding.by_place;
            *rate = towards * (x * cos + y * sin) + guiding.by_angle_twice * v[3] * v[3];
        }
    }

    fn energy(&self, q: &[f64], v: &[f64]) -> f64 {
        let (sin, cos) = q[2].sin_cos();
        let (mass, moment) = (self.mass_of_both(), self.moment_of_mass());
        let kinetic = 0.5 * mass * (v[0] * v[0] + v[1] * v[1])
            + moment * v[2] * (v[1] * cos - v[0] * sin)
            + 0.5 * self.inertia() * v[2] * v[2]
            + 0.5 * self.bodies.inertias[1] * v[3] * v[3];
        kinetic + self.bodies.gravity * (mass * q[1] + moment * sin)
    }
}
