//! The chain of equal links in absolute angles.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::ReferenceError;
use super::links::{GroundHinge, Link, LinkMotion, LinkedPendulum, check_links};
use crate::integrators::Ode;

/// Any number of equal links, each on the tip of the one before, the first on a hinge in the ground with a torsional
/// spring and damper.
///
/// With the angles `p_i` from the x axis, the links numbered from 0 and `o_i` links outside of link `i`, Lagrange's
/// equations are `sum_j c_ij (cos(p_i - p_j) p_j'' + sin(p_i - p_j) p_j'^2) = -m g l (1/2 + o_i) cos p_i + moment_i`,
/// `c_ii = J + m l^2 (1/4 + o_i)`, `c_ij = m l^2 (1/2 + o_max(i,j))`.
///
/// Long chains move chaotically: an error grows by a constant factor in every swing, so trust the end of a long run
/// only after a comparison with a slightly different start.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// Each link.
    pub link: Link,
    /// Spring and damper of the first link.
    pub hinge: GroundHinge,
    /// Acceleration of gravity in -y (m/s^2).
    pub gravity: f64,
    /// Angles at the start (rad), one for each link.
    pub angles: Vec<f64>,
    /// Rates at the start (rad/s), one for each link.
    pub rates: Vec<f64>,
}

impl Chain {
    /// The motion at `times` (s since the start), which must ascend from 0; Radau IIA with the tolerance 1e-12.
    ///
    /// # Errors
    /// [`ReferenceError`] if there is no link, a parameter is out of its range, angles and rates differ in number, the
    /// times do not ascend, or the integration fails.
    pub fn motions(&self, times: &[f64]) -> Result<Vec<LinkMotion>, ReferenceError> {
        let (angles, rates) = (self.angles.len(), self.rates.len());
        if angles != rates {
            return Err(ReferenceError::UnequalStart { angles, rates });
        }
        if angles == 0 {
            return Err(ReferenceError::NoLink);
        }
        let start = [self.angles.as_slice(), &self.rates].concat();
        let link = std::iter::once(&self.link);
        check_links(link, &self.hinge, self.gravity, start.iter().copied())?;
        LinkedPendulum::motions(self, &start, times)
    }

    /// Number of links outside of link `i`.
    fn outside(&self, i: usize) -> f64 {
        (self.angles.len() - 1 - i) as f64
    }

    /// `c_ij`.
    fn coefficient(&self, i: usize, j: usize) -> f64 {
        let Link { m, inertia, length } = self.link;
        if i == j {
            inertia + m * length * length * (0.25 + self.outside(i))
        } else {
            m * length * length * (0.5 + self.outside(i.max(j)))
        }
    }

    /// Moment of the weight of link `i` and the links outside of it when it lies along the x axis.
    fn weight(&self, i: usize) -> f64 {
        self.link.m * self.gravity * self.link.length * (0.5 + self.outside(i))
    }

    /// Angular accelerations; not a number if the mass matrix has lost its definiteness to overflow.
    fn accelerations(&self, angles: &[f64], rates: &[f64]) -> DVector<f64> {
        let n = angles.len();
        let mass = DMatrix::from_fn(n, n, |i, j| {
            self.coefficient(i, j) * (angles[i] - angles[j]).cos()
        });
        let mut moments = DVector::from_fn(n, |i, _| {
            let centrifugal = |j: usize| {
                self.coefficient(i, j) * (angles[i] - angles[j]).sin() * rates[j].powi(2)
            };
            -self.weight(i) * angles[i].cos() - (0..n).map(centrifugal).sum::<f64>()
        });
        moments[0] += self.hinge.moment(angles[0], rates[0]);
        match Cholesky::new(mass) {
            Some(factors) => factors.solve(&moments),
            None => DVector::repeat(n, f64::NAN),
        }
    }

    /// What Newton's laws of the links outside of a hinge lack is the force on them; its reaction is summed from the
    /// tip of the chain to the ground.
    fn hinge_forces(&self, angles: &[f64], rates: &[f64]) -> Vec<[f64; 2]> {
        let Link { m, length, .. } = self.link;
        let accelerations = self.accelerations(angles, rates);
        let mut root = [0.0; 2];
        let mut forces = Vec::with_capacity(angles.len());
        for (i, alpha) in accelerations.iter().enumerate() {
            let (sin, cos) = angles[i].sin_cos();
            let across = 0.5 * length * alpha;
            let inward = 0.5 * length * rates[i].powi(2);
            let half = [-across * sin - inward * cos, across * cos - inward * sin];
            let centre = [root[0] + half[0], root[1] + half[1]];
            forces.push([-m * centre[0], -m * (centre[1] + self.gravity)]);
            root = [centre[0] + half[0], centre[1] + half[1]];
        }
        for i in (1..forces.len()).rev() {
            let [x, y] = forces[i];
            forces[i - 1][0] += x;
            forces[i - 1][1] += y;
        }
        // The first one is the force on the ground.
        forces.remove(0);
        forces
    }

    fn energy(&self, angles: &[f64], rates: &[f64]) -> f64 {
        let mut energy = self.hinge.energy(angles[0]);
        for i in 0..angles.len() {
            energy += self.weight(i) * angles[i].sin();
            for j in 0..angles.len() {
                let cos = (angles[i] - angles[j]).cos();
                energy += 0.5 * self.coefficient(i, j) * cos * rates[i] * rates[j];
            }
        }
        energy
    }
}

impl Ode for Chain {
    fn derivative(&self, _: f64, y: &[f64], dy: &mut [f64]) {
        let (angles, rates) = y.split_at(self.angles.len());
        let (angle_rates, rate_rates) = dy.split_at_mut(self.angles.len());
        angle_rates.copy_from_slice(rates);
        rate_rates.copy_from_slice(self.accelerations(angles, rates).as_slice());
    }
}

impl LinkedPendulum for Chain {
    fn motion(&self, t: f64, state: &[f64]) -> LinkMotion {
        let (angles, rates) = state.split_at(self.angles.len());
        LinkMotion {
            t,
            angles: angles.to_vec(),
            rates: rates.to_vec(),
            hinge_forces: self.hinge_forces(angles, rates),
            energy: self.energy(angles, rates),
        }
    }
}
