//! The slider-crank mechanism with a flexible rod (S2 App. C, Fig. 34).
//!
//! Coordinates: angles of crank, rod's frame and slider from the x axis (rad), then those of the rod,
//! `q = (theta_1, theta_2, theta_3, q_f)`. The frame of the rod has its origin at the end of the crank,
//! `R = l_1 (cos theta_1, sin theta_1)` (142). The slider's centre of mass is the end of the rod, so that its mass
//! `m_3` counts as a point mass of the rod; its moment of inertia `J_3` has `theta_3` alone. With the mass `m` of rod
//! and slider, `c = cos(theta_1 - theta_2)`, `s = sin(theta_1 - theta_2)`, `p = I_1 + S_bar q_f`, `w_k = theta_k'`:
//!
//! ```text
//! M_11 = J_1 + m_1 l_1^2/4 + m l_1^2                       M_22 = I_2 + 2 I_3 q_f + q_f^T S_ff q_f     (133 to 137)
//! M_12 = l_1 (s p_y + c p_x)                               M_2f = I_4 + q_f^T S_tilde                  (139)
//! M_1f = l_1 (c S_bar_y - s S_bar_x)                       M_33 = J_3,   M_ff = S_ff                   (130, 132, 144)
//! ```
//!
//! The particles of the rod would have the acceleration `b = -l_1 w_1^2 (c, s) - w_2^2 u + 2 w_2 (-u_y', u_x')` in the
//! frame without second derivatives of the coordinates; its integral with the virtual displacements is the quadratic
//! velocity vector, which is (153) with the errata:
//!
//! ```text
//! Q_1 = -l_1 [ w_2^2 (s p_x - c p_y) + 2 w_2 (s p_y' + c p_x') ]
//! Q_2 = l_1 w_1^2 (s p_x - c p_y) - 2 w_2 (I_3 + q_f^T S_ff) q_f'
//! Q_f = l_1 w_1^2 (c S_bar_x + s S_bar_y)^T + w_2^2 (I_3^T + S_ff q_f) + 2 w_2 S_tilde q_f'
//! ```
//!
//! * [`outputs`]: what is drawn and reported.

pub mod outputs;

use super::guiding;
use super::notch::Notch;
use super::rigid_slider_crank::{Guide, Mechanism};
use super::rod::integrals::product;
use super::rod::{Rectangle, Rod, RodBody, RodError};
use crate::nonsmooth::matrix::{BorderedBand, Shape, add_scaled, dot};
use crate::nonsmooth::system::{Contact, Instant, MechanicalSystem};

/// Angles ahead of the coordinates of the rod.
pub const ANGLES: usize = 3;

/// Bodies and loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlexibleMechanism {
    /// Length of the crank, `l_1` (m).
    pub crank_length: f64,
    /// Mass of the crank, `m_1` (kg).
    pub crank_mass: f64,
    /// Moment of inertia of the crank about its centre of mass, in its middle, `J_1` (kg m^2).
    pub crank_inertia: f64,
    /// The rod.
    pub rod: Rod,
    /// Mass of the slider, `m_3` (kg).
    pub slider_mass: f64,
    /// Moment of inertia of the slider, `J_3` (kg m^2).
    pub slider_inertia: f64,
    /// Acceleration of gravity along -y (m/s^2).
    pub gravity: f64,
    /// Constant torque on the crank (N m).
    pub torque: f64,
    /// Slider and notch.
    pub notch: Notch,
}

/// The mechanism as a system. Its input, if there is one, is a torque on the crank (N m) besides the constant one.
#[derive(Debug, Clone, PartialEq)]
pub struct FlexibleSliderCrank {
    mechanism: FlexibleMechanism,
    body: RodBody,
    guide: Guide,
    contacts: Vec<Contact>,
    /// What is constant of `M`.
    constant_mass: BorderedBand,
    stiffness: BorderedBand,
}

/// Sine and cosine of the angles, and of `theta_1 - theta_2`.
#[derive(Debug, Clone, Copy)]
struct Pose {
    crank: [f64; 2],
    rod: [f64; 2],
    between: [f64; 2],
}

impl Pose {
    fn of(q: &[f64]) -> Self {
        let pair = |angle: f64| <[f64; 2]>::from(angle.sin_cos());
        Self {
            crank: pair(q[0]),
            rod: pair(q[1]),
            between: pair(q[0] - q[1]),
        }
    }
}

impl FlexibleMechanism {
    /// A rigid mechanism with a rod of `elements` elements instead of the rigid one: of the same length, and with the
    /// rectangular section that gives it the same mass and inertia, see [`Rectangle::of_inertia`]. `material`: Young's
    /// modulus (N/m^2) and density (kg/m^3).
    ///
    /// # Errors
    /// [`RodError`].
    pub fn of(
        mechanism: &Mechanism,
        elements: usize,
        material: [f64; 2],
    ) -> Result<Self, RodError> {
        let [crank_length, length] = mechanism.lengths;
        let [crank_mass, mass, slider_mass] = mechanism.masses;
        let [crank_inertia, inertia, slider_inertia] = mechanism.inertias;
        let rectangle = Rectangle::of_inertia(mass, inertia, length, material[1])?;
        Ok(Self {
            crank_length,
            crank_mass,
            crank_inertia,
            rod: Rod::new(length, elements, material, rectangle.section()),
            slider_mass,
            slider_inertia,
            gravity: mechanism.gravity,
            torque: mechanism.torque,
            notch: mechanism.notch,
        })
    }
}

impl FlexibleSliderCrank {
    /// A mechanism with a guide.
    ///
    /// # Errors
    /// [`RodError`].
    pub fn new(mechanism: FlexibleMechanism, guide: Guide) -> Result<Self, RodError> {
        let body = RodBody::new(mechanism.rod, mechanism.slider_mass)?;
        let shape = Shape {
            border: ANGLES,
            banded: body.count(),
            half_bandwidth: body.integrals.elastic.shape().half_bandwidth,
        };
        let mut system = Self {
            contacts: guide.contacts(),
            constant_mass: BorderedBand::zeros(shape),
            stiffness: BorderedBand::zeros(shape),
            mechanism,
            body,
            guide,
        };
        system.fill_constant_matrices();
        Ok(system)
    }

    fn fill_constant_matrices(&mut self) {
        let (mechanism, integrals) = (&self.mechanism, &self.body.integrals);
        let (l1, mass) = (mechanism.crank_length, &mut self.constant_mass);
        let crank = mechanism.crank_inertia + 0.25 * mechanism.crank_mass * l1 * l1;
        mass.add(0, 0, crank + integrals.mass * l1 * l1);
        mass.add(1, 1, integrals.second_moment);
        mass.add(2, 2, mechanism.slider_inertia);
        for (i, &turn) in integrals.turn.iter().enumerate() {
            mass.add_symmetric(1, ANGLES + i, turn);
        }
        mass.add_band(&integrals.elastic);
        self.stiffness.add_band(&integrals.stiffness);
    }

    /// As described.
    pub fn mechanism(&self) -> &FlexibleMechanism {
        &self.mechanism
    }

    /// The rod with the slider's mass.
    pub fn body(&self) -> &RodBody {
        &self.body
    }

    /// Weight of what the crank carries at its end, as a moment about its bearing when it is level (N m).
    fn crank_moment(&self) -> f64 {
        let mechanism = &self.mechanism;
        let carried = 0.5 * mechanism.crank_mass + self.body.integrals.mass;
        carried * mechanism.gravity * mechanism.crank_length
    }
}

impl MechanicalSystem for FlexibleSliderCrank {
    fn shape(&self) -> Shape {
        self.constant_mass.shape()
    }

    fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    fn mass(&self, q: &[f64], mass: &mut BorderedBand) {
        let integrals = &self.body.integrals;
        let l1 = self.mechanism.crank_length;
        let [s, c] = Pose::of(q).between;
        let q_f = &q[ANGLES..];
        let [px, py] = integrals.moment_of_mass(q_f);
        mass.add_scaled(1.0, &self.constant_mass);
        mass.add_symmetric(0, 1, l1 * (s * py + c * px));
        mass.add(1, 1, integrals.second_moment_change(q_f));
        let [along, across] = &integrals.mean;
        for i in 0..q_f.len() {
            let column = ANGLES + i;
            mass.add_symmetric(0, column, l1 * (c * across[i] - s * along[i]));
            // q_f^T S_tilde, which is skew.
            mass.add_symmetric(1, column, -integrals.skew.row_times(i, q_f));
        }
    }

    fn force(&self, at: Instant<'_>, force: &mut [f64]) {
        let integrals = &self.body.integrals;
        let (l1, gravity) = (self.mechanism.crank_length, self.mechanism.gravity);
        let pose = Pose::of(at.q);
        let ([s, c], [s2, c2]) = (pose.between, pose.rod);
        let (q_f, v_f) = (&at.q[ANGLES..], &at.v[ANGLES..]);
        let [w1, w2] = [at.v[0], at.v[1]];
        let [px, py] = integrals.moment_of_mass(q_f);
        let [px_rate, py_rate] = integrals.momentum(v_f);
        let (head, tail) = force.split_at_mut(ANGLES);

        // S_ff q_f, which two of the terms have.
        tail.fill(0.0);
        integrals.elastic.multiply_add(1.0, q_f, tail);
        let stretching = dot(&integrals.stretch, v_f) + dot(tail, v_f);
        let arm = s * px - c * py;
        let coriolis = s * py_rate + c * px_rate;
        let torque = self.mechanism.torque + at.inputs.first().copied().unwrap_or(0.0);
        head[0] = torque
            - l1 * (w2 * w2 * arm + 2.0 * w2 * coriolis)
            - self.crank_moment() * pose.crank[1];
        head[1] = l1 * w1 * w1 * arm - 2.0 * w2 * stretching - gravity * (c2 * px - s2 * py);
        head[2] = 0.0;

        let push = l1 * w1 * w1;
        let [by_along, by_across] = [push * c - gravity * s2, push * s - gravity * c2];
        let [along, across] = &integrals.mean;
        for (i, force) in tail.iter_mut().enumerate() {
            *force = w2 * w2 * (integrals.stretch[i] + *force)
                + by_along * along[i]
                + by_across * across[i];
        }
        integrals.skew.multiply_add(2.0 * w2, v_f, tail);
        integrals.stiffness.multiply_add(-1.0, q_f, tail);
        let damping = self.mechanism.rod.material_damping;
        if damping > 0.0 {
            integrals.stiffness.multiply_add(-damping, v_f, tail);
        }
    }

    fn tangents(
        &self,
        _at: Instant<'_>,
        stiffness: &mut BorderedBand,
        damping: &mut BorderedBand,
    ) -> bool {
        stiffness.add_scaled(1.0, &self.stiffness);
        let material = self.mechanism.rod.material_damping;
        if material > 0.0 {
            damping.add_scaled(material, &self.stiffness);
        }
        true
    }

    fn gaps(&self, q: &[f64], gaps: &mut [f64]) {
        let [_, y] = self.slider(q);
        self.guide.gaps(&self.mechanism.notch, y, q[2], gaps);
    }

    fn directions(&self, q: &[f64], rows: &mut [f64]) {
        let moved = self.slider_by_coordinates(q);
        let guiding = guiding::rows(self.guide, &self.mechanism.notch, q[2]);
        for (row, guiding) in rows.chunks_exact_mut(q.len()).zip(guiding) {
            moved.write(guiding.by_place, row);
            row[2] = guiding.by_angle;
        }
    }

    fn direction_rates(&self, q: &[f64], v: &[f64], rates: &mut [f64]) {
        let [x, y] = self.slider_acceleration_of_velocities(q, v);
        let guiding = guiding::rows(self.guide, &self.mechanism.notch, q[2]);
        for (rate, guiding) in rates.iter_mut().zip(guiding) {
            let [by_x, by_y] = guiding.by_place;
            *rate = by_x * x + by_y * y + guiding.by_angle_twice * v[2] * v[2];
        }
    }

    fn energy(&self, q: &[f64], v: &[f64]) -> f64 {
        let (mechanism, integrals) = (&self.mechanism, &self.body.integrals);
        let pose = Pose::of(q);
        let ([s, c], [s2, c2]) = (pose.between, pose.rod);
        let (q_f, v_f) = (&q[ANGLES..], &v[ANGLES..]);
        let [px, py] = integrals.moment_of_mass(q_f);
        let [px_rate, py_rate] = integrals.momentum(v_f);
        let crank = 0.5 * self.constant_mass.get(0, 0) * v[0] * v[0];
        let slider = 0.5 * mechanism.slider_inertia * v[2] * v[2];
        // Velocity of the frame's origin in the frame, and of the particles there.
        let origin = mechanism.crank_length * v[0];
        let moving = origin * (c * (px * v[1] + py_rate) - s * (-py * v[1] + px_rate));
        let second_moment = integrals.second_moment + integrals.second_moment_change(q_f);
        let turning = dot(&integrals.turn, v_f) + product(&integrals.skew, q_f, v_f);
        let rod = 0.5 * second_moment * v[1] * v[1]
            + v[1] * turning
            + 0.5 * product(&integrals.elastic, v_f, v_f);
        let strain = 0.5 * product(&integrals.stiffness, q_f, q_f);
        let weight = self.crank_moment() * pose.crank[0] + mechanism.gravity * (s2 * px + c2 * py);
        crank + slider + moving + rod + strain + weight
    }
}

/// Rows of the coordinates by which the slider's centre moves.
struct Moved<'a> {
    /// `l_1 (-sin, cos)` of the crank.
    crank: [f64; 2],
    /// The same from the end of the crank to the slider.
    rod: [f64; 2],
    /// Sine and cosine of the frame.
    frame: [f64; 2],
    end: &'a [Vec<f64>; 2],
}

impl Moved<'_> {
    /// Writes the row of `a x + b y`; the slider's angle has no part in it.
    fn write(&self, [a, b]: [f64; 2], row: &mut [f64]) {
        let [sin, cos] = self.frame;
        let (along, across) = (a * cos + b * sin, b * cos - a * sin);
        row[0] = a * self.crank[0] + b * self.crank[1];
        row[1] = a * self.rod[0] + b * self.rod[1];
        row[2] = 0.0;
        let tail = &mut row[ANGLES..];
        tail.fill(0.0);
        add_scaled(along, &self.end[0], tail);
        add_scaled(across, &self.end[1], tail);
    }
}
