//! The impulsive correction behind a step (S2 Sect. 2.5): all closed contacts take part, by Newton's law of impact.

use super::matrix::dot;
use super::mechanics::{Mechanics, StepError};

/// Velocities behind an impact at `q`: `M (v^+ - v^-) = W Lambda` with
/// `0 <= g_N'^+ + eps_N g_N'^-`, `0 <= Lambda_N`, one of them 0, and Coulomb's law for `g_T'^+ + eps_T g_T'^-`
/// (S2 eqs. 11 to 13, 46 to 50; errata of 13). Impulses (N s) go to `impulses`, 0 where a contact takes no part.
pub fn correct(
    mechanics: &mut Mechanics,
    closed: &[bool],
    q: &[f64],
    v: &mut [f64],
    impulses: &mut [f64],
) -> Result<(), StepError> {
    mechanics.factor_mass(q)?;
    mechanics.direct(q, closed);
    mechanics.begin_problem();
    mechanics.add_laws(closed, 0);
    for row in 0..mechanics.problem.len() {
        let before = dot(mechanics.direction(row), v);
        let free = (1.0 + restitution(mechanics, row)) * before;
        mechanics.problem.free.push(free);
    }
    mechanics.add_delassus(1.0, None);
    impulses.fill(0.0);
    mechanics.solve_problem(impulses)?;
    mechanics.judge_problem();
    mechanics.respond(1.0, v);
    Ok(())
}

/// Coefficient of restitution of a row of the problem.
pub fn restitution(mechanics: &Mechanics, row: usize) -> f64 {
    let row = mechanics.active_rows[row];
    let owner = |&index: &usize| {
        let first = mechanics.first_row(index);
        (first..first + mechanics.contacts()[index].rows()).contains(&row)
    };
    let owner = (0..mechanics.contacts().len()).find(owner);
    owner.map_or(0.0, |index| {
        let contact = &mechanics.contacts()[index];
        if row == mechanics.first_row(index) {
            contact.normal_restitution
        } else {
            contact.tangential_restitution
        }
    })
}
