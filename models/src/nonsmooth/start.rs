//! Accelerations at an instant: at the start of a run and behind an impact.

use super::contact::Law;
use super::matrix::dot;
use super::mechanics::{Mechanics, StepError};
use super::state::{Drive, State};
use super::system::Side;

/// Relative velocities below this share of what moves the contact count as 0: the contact stays closed, or sticks.
const STANDSTILL: f64 = 1e-9;

/// Time that is none (s): what the accelerations without contacts make of a relative velocity within it is rounding as
/// well. Where everything stands still there is nothing else to compare rounding with.
const INSTANT: f64 = 1e-12;

/// How accelerations at an instant take contacts into account.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Contacts {
    /// Closed and bilateral contacts act: `M a = f + W lambda` with the laws on acceleration level,
    /// `0 <= g_N''`, `0 <= lambda_N`; sliding contacts rub against their motion, sticking ones by the law for `g_T''`.
    Acting,
    /// `M a = f`, as printed in S2 eqs. (25), (62), (83).
    Ignored,
}

/// Writes accelerations `a`, `A = a` and forces of `state`.
pub fn accelerate(
    mechanics: &mut Mechanics,
    drive: Drive<'_>,
    contacts: Contacts,
    closed: &mut [bool],
    state: &mut State,
) -> Result<(), StepError> {
    mechanics.factor_mass(&state.q)?;
    mechanics.force(drive, state.tau, [&state.q, &state.v], &mut state.a);
    mechanics.factors.solve(&mut state.a);
    if contacts == Contacts::Acting {
        act(mechanics, closed, state)?;
    }
    state.auxiliary.copy_from_slice(&state.a);
    Ok(())
}

/// Contact forces on acceleration level. A contact that opens is taken out of `closed`.
fn act(mechanics: &mut Mechanics, closed: &mut [bool], state: &mut State) -> Result<(), StepError> {
    mechanics.direct(&state.q, closed);
    for (index, closed) in closed.iter_mut().enumerate() {
        let is_unilateral = mechanics.contacts()[index].side == Side::Unilateral;
        if *closed && is_unilateral && motion(mechanics, mechanics.first_row(index), state) > 0.0 {
            *closed = false;
        }
    }
    mechanics.begin_problem();
    mechanics.add_laws(closed, 0);
    if mechanics.problem.is_empty() {
        state.forces.fill(0.0);
        return Ok(());
    }
    let (system, rates) = (&mechanics.system, &mut mechanics.rates);
    system.direction_rates(&state.q, &state.v, rates);
    for row in 0..mechanics.problem.len() {
        let free =
            dot(mechanics.direction(row), &state.a) + mechanics.rates[mechanics.active_rows[row]];
        mechanics.problem.free.push(free);
        slide(mechanics, row, state);
    }
    mechanics.add_delassus(1.0, None);
    mechanics.solve_problem(&mut state.forces)?;
    mechanics.judge_problem();
    mechanics.respond(1.0, &mut state.a);
    Ok(())
}

/// A friction law whose contact slides becomes friction against that direction.
fn slide(mechanics: &mut Mechanics, row: usize, state: &State) {
    let law = mechanics.problem.laws[row];
    let own = mechanics.active_rows[row];
    match law {
        Law::Friction {
            normal,
            coefficient,
        } => {
            let speed = motion(mechanics, own, state);
            if speed != 0.0 {
                let factor = -coefficient * speed.signum();
                mechanics.problem.laws[row] = Law::Sliding { normal, factor };
            }
        }
        Law::Disc {
            normal,
            coefficient,
        } => {
            let speeds = [
                motion(mechanics, own, state),
                motion(mechanics, own + 1, state),
            ];
            let size = speeds[0].hypot(speeds[1]);
            if size > 0.0 {
                for (offset, speed) in speeds.into_iter().enumerate() {
                    let factor = -coefficient * speed / size;
                    mechanics.problem.laws[row + offset] = Law::Sliding { normal, factor };
                }
            }
        }
        Law::Equality | Law::Normal | Law::Second | Law::Sliding { .. } => {}
    }
}

/// Relative velocity of a row whose accelerations are those without contacts; 0 if it is rounding.
fn motion(mechanics: &Mechanics, row: usize, state: &State) -> f64 {
    let velocity = relative_velocity(mechanics, row, &state.v);
    let n = mechanics.order();
    let direction = &mechanics.directions[row * n..][..n];
    let size = dot(direction, direction) * dot(&state.a, &state.a);
    if velocity.abs() <= INSTANT * size.sqrt() {
        0.0
    } else {
        velocity
    }
}

/// Relative velocity of a row; 0 if it is rounding of what it is the sum of.
pub fn relative_velocity(mechanics: &Mechanics, row: usize, v: &[f64]) -> f64 {
    let n = mechanics.order();
    let direction = &mechanics.directions[row * n..][..n];
    let size: f64 = direction.iter().zip(v).map(|(d, v)| (d * v).abs()).sum();
    let velocity = dot(direction, v);
    if velocity.abs() <= STANDSTILL * size {
        0.0
    } else {
        velocity
    }
}
