//! The impulsive correction behind a step (S2 Sect. 2.5): all closed contacts take part, by Newton's law of impact.

use super::matrix::{add_scaled, dot};
use super::mechanics::{Mechanics, StepError};
use super::partners::Partners;

/// What the joints of a system do in its impacts.
#[derive(Debug)]
pub enum AtJoints<'a> {
    /// Nothing: it has no partners, or they take no part.
    Nothing,
    /// Partners answer with impulses of their own.
    Partners(&'a mut Partners),
    /// Impulses of loads, one for each input.
    Loads(&'a [f64]),
}

/// Velocities behind an impact at `q`: `M (v^+ - v^-) = W Lambda` with
/// `0 <= g_N'^+ + eps_N g_N'^-`, `0 <= Lambda_N`, one of them 0, and Coulomb's law for `g_T'^+ + eps_T g_T'^-`
/// (S2 eqs. 11 to 13, 46 to 50; errata of 13). Impulses (N s) go to `impulses`, 0 where a contact takes no part.
///
/// Given loads add `M^-1 J^T P` to the velocities; partners answer with an impulse, see [`Partners`]. Returns the energy that the impulses
/// at the joints bring (J), `P^T J (v^- + v^+) / 2`.
pub fn correct(
    mechanics: &mut Mechanics,
    closed: &[bool],
    q: &[f64],
    v: &mut [f64],
    impulses: &mut [f64],
    mut at_joints: AtJoints<'_>,
) -> Result<f64, StepError> {
    mechanics.factor_mass(q)?;
    mechanics.direct(q, closed);
    mechanics.begin_problem();
    mechanics.add_laws(closed, 0);
    for row in 0..mechanics.problem.len() {
        let before = dot(mechanics.direction(row), v);
        let free = (1.0 + restitution(mechanics, row)) * before;
        mechanics.problem.free.push(free);
    }
    let mut work = 0.0;
    let mut impulse = Vec::new();
    if let AtJoints::Loads(loads) = at_joints {
        impulse.resize(q.len(), 0.0);
        mechanics.load_direction([q, v], loads, &mut impulse);
        work += 0.5 * dot(&impulse, v);
        let mut jump = impulse.clone();
        mechanics.factors.solve(&mut jump);
        add_scaled(1.0, &jump, v);
        for row in 0..mechanics.problem.len() {
            mechanics.problem.free[row] += dot(mechanics.direction(row), &jump);
        }
    }
    mechanics.add_delassus(1.0, None);
    if let AtJoints::Partners(partners) = &mut at_joints {
        partners.take_part(mechanics, [q, v])?;
    }
    impulses.fill(0.0);
    mechanics.solve_problem(impulses)?;
    mechanics.judge_problem();
    if let AtJoints::Partners(partners) = at_joints {
        partners.answer(mechanics.unknowns());
        work += 0.5 * partners.power(v);
        mechanics.respond(1.0, v);
        partners.respond(v);
        work += 0.5 * partners.power(v);
    } else {
        mechanics.respond(1.0, v);
        if !impulse.is_empty() {
            work += 0.5 * dot(&impulse, v);
        }
    }
    Ok(work)
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
