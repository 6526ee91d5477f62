//! The slider-crank of S2 Table 1 without clearance and without friction, in its one coordinate.

use crate::integrators::radau::{Radau, Tolerances};
use crate::integrators::{IntegrationError, Ode};
use crate::nonsmooth::matrix::BorderedBand;
use crate::nonsmooth::system::{Instant, MechanicalSystem};
use crate::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism, RigidSliderCrank};

/// Error of the reference, relative and absolute (rad).
const TOLERANCE: f64 = 1e-13;

/// A slider that stays on the x axis.
///
/// With `l_1 sin(theta_1) + l_2 sin(theta_2) = 0` the rod turns by `theta_2' = kappa theta_1'`, and
/// `theta_2'' = kappa theta_1'' + sigma` with `kappa = -l_1 c_1/(l_2 c_2)`,
/// `sigma = (l_1 s_1 theta_1'^2 + l_2 s_2 theta_2'^2)/(l_2 c_2)`. With `J = (1, kappa)` the equation of motion is
/// `J^T M J theta_1'' = J^T (f - M (0, sigma))`.
#[derive(Debug, Clone)]
pub struct GuidedSliderCrank {
    system: RigidSliderCrank,
}

/// Angles and rates of crank and rod.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GuidedMotion {
    /// `(theta_1, theta_2)` (rad).
    pub angles: [f64; 2],
    /// Their rates (rad/s).
    pub rates: [f64; 2],
}

impl GuidedSliderCrank {
    /// A mechanism; its notch does not matter.
    pub fn new(mechanism: Mechanism) -> Self {
        Self {
            system: RigidSliderCrank::new(mechanism, Guide::Free),
        }
    }

    /// Motion at the times `interval`, `2 interval`, ... (s), `count` of them, from `theta_1 = 0` with a rate of the crank.
    ///
    /// # Errors
    /// [`IntegrationError`] if the integrator stops, as where the rod is across the axis.
    pub fn motion(
        &self,
        rate: f64,
        interval: f64,
        count: usize,
    ) -> Result<Vec<GuidedMotion>, IntegrationError> {
        let tolerances = Tolerances {
            relative: TOLERANCE,
            absolute: TOLERANCE,
        };
        let mut radau = Radau::new(2, tolerances);
        let mut y = [0.0, rate];
        let motion = (0..count).map(|_| {
            radau.integrate(self, interval, &mut y)?;
            Ok(self.at(y))
        });
        motion.collect()
    }

    fn at(&self, [angle, rate]: [f64; 2]) -> GuidedMotion {
        let [l1, l2] = self.system.mechanism().lengths;
        let rod = -(l1 * angle.sin() / l2).asin();
        GuidedMotion {
            angles: [angle, rod],
            rates: [rate, -l1 * angle.cos() / (l2 * rod.cos()) * rate],
        }
    }
}

impl Ode for GuidedSliderCrank {
    fn derivative(&self, _tau: f64, y: &[f64], dy: &mut [f64]) {
        let [l1, l2] = self.system.mechanism().lengths;
        let GuidedMotion { angles, rates } = self.at([y[0], y[1]]);
        let across = l2 * angles[1].cos();
        let kappa = -l1 * angles[0].cos() / across;
        let squares = rates.map(|rate| rate * rate);
        let sigma =
            (l1 * angles[0].sin() * squares[0] + l2 * angles[1].sin() * squares[1]) / across;

        let (q, v) = ([angles[0], angles[1], 0.0], [rates[0], rates[1], 0.0]);
        let mut mass = BorderedBand::zeros(self.system.shape());
        self.system.mass(&q, &mut mass);
        let mut force = [0.0; 3];
        let at = Instant {
            t: 0.0,
            q: &q,
            v: &v,
            inputs: &[],
        };
        self.system.force(at, &mut force);
        mass.multiply_add(-1.0, &[0.0, sigma, 0.0], &mut force);
        let mut inertia = [0.0; 3];
        mass.multiply_add(1.0, &[1.0, kappa, 0.0], &mut inertia);
        dy[0] = y[1];
        dy[1] = (force[0] + kappa * force[1]) / (inertia[0] + kappa * inertia[1]);
    }
}
