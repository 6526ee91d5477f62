//! Energy that contacts take.

use super::Integrator;
use crate::nonsmooth::matrix::dot;

impl Integrator {
    /// Energy that the forces of an impulsive scheme took over the step: `-dt lambda^T W^T (v_i + v_{i+1}) / 2`, with
    /// the `W` that was evaluated last. For the midpoint rule that is all that contacts take.
    pub(super) fn loss_by_impulses(&self, dt: f64) -> f64 {
        let n = self.next.v.len();
        let rows = self.mechanics.directions.chunks_exact(n.max(1));
        let taken = rows.zip(&self.next.forces).map(|(row, &force)| {
            if force == 0.0 {
                0.0
            } else {
                force * (dot(row, &self.state.v) + dot(row, &self.next.v))
            }
        });
        -0.5 * dt * taken.sum::<f64>()
    }

    /// `-sum lambda_T g_T'` at the end of the step.
    pub(super) fn friction_power_of_next(&mut self) -> f64 {
        let next = &self.next;
        let n = next.v.len();
        let mut power = 0.0;
        let has_friction = self
            .mechanics
            .contacts()
            .iter()
            .any(|contact| contact.tangents > 0);
        if !has_friction || next.forces.iter().all(|&force| force == 0.0) {
            return 0.0;
        }
        self.mechanics.direct(&next.q, &[true]);
        for (index, contact) in self.mechanics.contacts().iter().enumerate() {
            let first = self.mechanics.first_row(index);
            for row in first + 1..first + contact.rows() {
                let direction = &self.mechanics.directions[row * n..][..n];
                power -= next.forces[row] * dot(direction, &next.v);
            }
        }
        power
    }
}
