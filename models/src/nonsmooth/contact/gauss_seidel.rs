//! Projections contact by contact (nonsmooth Gauss-Seidel; Jean 1999, Moreau 1999).

use super::problem::{Law, Problem, onto_disc};

/// Sweeps after which it is given up.
const MOST_SWEEPS: usize = 4000;
/// Sweeps between two looks at the residual.
const LOOK: usize = 8;

/// Improves `x` until the residual (m/s) is at most `tolerance` times the scale of the problem; the sweeps that it
/// took, or `None` if it does not get there.
///
/// Every row takes the force that meets its own law while the other forces are held, `r = 1/G_kk`. It needs no matrix
/// of full rank: dependent contacts share their forces as the order of the rows has it.
pub fn solve(problem: &Problem, tolerance: f64, x: &mut [f64]) -> Option<usize> {
    for sweep in 1..=MOST_SWEEPS {
        for row in 0..problem.len() {
            relax(problem, row, x);
        }
        if sweep % LOOK == 0 && problem.residual(x) <= tolerance * problem.scale(x) {
            return Some(sweep);
        }
    }
    None
}

fn relax(problem: &Problem, row: usize, x: &mut [f64]) {
    let weight = 1.0 / problem.diagonal(row);
    match problem.laws[row] {
        Law::Disc {
            normal,
            coefficient,
        } => {
            let weight = weight.min(1.0 / problem.diagonal(row + 1));
            let target = [row, row + 1].map(|row| x[row] - weight * problem.velocity(row, x));
            let projected = onto_disc(coefficient * x[normal].abs(), target);
            x[row..row + 2].copy_from_slice(&projected);
        }
        _ => x[row] -= problem.defect(row, weight, x)[0],
    }
}
