//! Two oscillators with a spring and a damper between them: the model that a penalty coupling converges to.

use faer::linalg::solvers::Solve;
use faer::{Mat, c64, mat};
use linchpin_models::oscillator::OscillatorParameters;

/// The exact motion of two oscillators with a spring-damper between them.
#[derive(Debug, Clone)]
pub struct SpringPair {
    eigenvalues: Vec<c64>,
    /// Column j is the part of the motion with eigenvalue j at the start: `(x_a, v_a, x_b, v_b)`.
    modes: Mat<c64>,
    stiffness: f64,
    damping: f64,
}

impl SpringPair {
    /// Oscillators `a` and `b`, with `stiffness` (N/m) and `damping` (N s/m) between them.
    pub fn new(
        a: &OscillatorParameters,
        b: &OscillatorParameters,
        stiffness: f64,
        damping: f64,
    ) -> Self {
        let (k, d) = (stiffness, damping);
        let matrix = mat![
            [0.0, 1.0, 0.0, 0.0],
            [-(a.c + k) / a.m, -(a.d + d) / a.m, k / a.m, d / a.m],
            [0.0, 0.0, 0.0, 1.0],
            [k / b.m, d / b.m, -(b.c + k) / b.m, -(b.d + d) / b.m],
        ];
        let eigen = matrix.eigen().unwrap();
        let start = [a.x0, a.v0, b.x0, b.v0];
        let start = Mat::from_fn(4, 1, |row, _| c64::new(start[row], 0.0));
        let shares = eigen.U().partial_piv_lu().solve(&start);
        Self {
            eigenvalues: eigen.S().column_vector().iter().copied().collect(),
            modes: Mat::from_fn(4, 4, |row, mode| eigen.U()[(row, mode)] * shares[(mode, 0)]),
            stiffness,
            damping,
        }
    }

    /// `(x_a, v_a, x_b, v_b)` at `t` seconds after the start.
    pub fn state(&self, t: f64) -> [f64; 4] {
        std::array::from_fn(|row| {
            let modes = self.eigenvalues.iter().enumerate();
            modes
                .map(|(mode, eigenvalue)| (self.modes[(row, mode)] * (eigenvalue * t).exp()).re)
                .sum()
        })
    }

    /// Force of the spring-damper at `t`: on `a` in its direction of motion, on `b` against it.
    pub fn force(&self, t: f64) -> f64 {
        let [x_a, v_a, x_b, v_b] = self.state(t);
        self.stiffness * (x_b - x_a) + self.damping * (v_b - v_a)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::masses::FOUR;

    #[test]
    fn the_equations_of_motion_hold() {
        let [a, b, ..] = FOUR;
        let pair = SpringPair::new(&a, &b, 3e4, 17.0);
        assert!(
            (pair.state(0.0)[0] - a.x0).abs() < 1e-14 && (pair.state(0.0)[3] - b.v0).abs() < 1e-11
        );
        let (t, step) = (0.0317, 1e-5);
        let (before, now, after) = (pair.state(t - step), pair.state(t), pair.state(t + step));
        let slope = |row: usize| (after[row] - before[row]) / (2.0 * step);
        assert!((slope(0) / now[1] - 1.0).abs() < 1e-5 && (slope(2) / now[3] - 1.0).abs() < 1e-5);
        let [x_a, v_a, x_b, v_b] = now;
        let force = pair.force(t);
        let forces = [
            force - a.c * x_a - a.d * v_a,
            -force - b.c * x_b - b.d * v_b,
        ];
        assert!(
            (a.m * slope(1) / forces[0] - 1.0).abs() < 1e-5,
            "{} {}",
            a.m * slope(1),
            forces[0]
        );
        assert!((b.m * slope(3) / forces[1] - 1.0).abs() < 1e-5);
    }
}
