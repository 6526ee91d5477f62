//! One mass on a spring: the linear system of a single degree of freedom (S2 eq. 93).

use crate::nonsmooth::matrix::{BorderedBand, Shape};
use crate::nonsmooth::system::{Contact, Instant, MechanicalSystem};

/// `q'' + omega^2 q = 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oscillator {
    /// Angular frequency (rad/s).
    pub omega: f64,
}

impl Oscillator {
    /// With period 1 s.
    pub const UNIT_PERIOD: Self = Self {
        omega: std::f64::consts::TAU,
    };

    fn stiffness(&self) -> f64 {
        self.omega * self.omega
    }
}

impl MechanicalSystem for Oscillator {
    fn shape(&self) -> Shape {
        Shape::dense(1)
    }

    fn contacts(&self) -> &[Contact] {
        &[]
    }

    fn mass(&self, _q: &[f64], mass: &mut BorderedBand) {
        mass.add(0, 0, 1.0);
    }

    fn force(&self, at: Instant<'_>, force: &mut [f64]) {
        force[0] = -self.stiffness() * at.q[0];
    }

    fn tangents(
        &self,
        _at: Instant<'_>,
        stiffness: &mut BorderedBand,
        _damping: &mut BorderedBand,
    ) -> bool {
        stiffness.add(0, 0, self.stiffness());
        true
    }

    fn gaps(&self, _q: &[f64], _gaps: &mut [f64]) {}

    fn directions(&self, _q: &[f64], _rows: &mut [f64]) {}

    fn direction_rates(&self, _q: &[f64], _v: &[f64], _rates: &mut [f64]) {}

    fn energy(&self, q: &[f64], v: &[f64]) -> f64 {
        0.5 * (v[0] * v[0] + self.stiffness() * q[0] * q[0])
    }
}
