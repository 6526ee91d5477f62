//! Solver `exact`: the solution in closed form for polynomial inputs, and for the load that sets in at a time.

use linchpin_proto::polynomial::MAX_NODES;
use linchpin_worker::{Interval, StepFailure};

use super::equation::{Equation, State};
use super::propagator::Propagator;
use crate::mechanics::equation::Driven;
use crate::mechanics::run::Solver;

/// Most step lengths whose matrix exponentials are kept: a step that is cut at instants has as many parts of lengths of their own.
const MOST_KEPT: usize = 24;

/// The matrix exponential of the equation of motion, kept for the step lengths used last: a run may end with
/// a shorter step, steps are cut at instants, and a load that sets in within a step acts over a part of it.
#[derive(Debug, Default)]
pub struct Exact {
    kept: Vec<Response>,
    /// The one that was made last.
    newest: usize,
    steps: u64,
}

/// Increments of `(x, v)` over a step of one length.
#[derive(Debug)]
struct Response {
    length: f64,
    transition: [[f64; 2]; 2],
    input: [[f64; 2]; MAX_NODES],
}

impl Response {
    fn new(equation: &Equation, length: f64) -> Option<Self> {
        let kappa = length * length * equation.stiffness / equation.mass;
        let delta = length * equation.damping / equation.mass;
        let unit = Propagator::new(kappa, delta)?;
        let [[xx, xv], [vx, vv]] = unit.transition;
        Some(Self {
            length,
            transition: [[xx, xv * length], [vx / length, vv]],
            input: unit.input.map(|[x, v]| {
                let scaled = length / equation.mass;
                [x * scaled * length, v * scaled]
            }),
        })
    }

    fn advance(&self, forces: &[f64; MAX_NODES], state: &mut State) {
        let [x, v] = *state;
        let increment = |by_state: [f64; 2], row: usize| {
            let by_input: f64 = forces
                .iter()
                .zip(&self.input)
                .map(|(force, by)| force * by[row])
                .sum();
            by_state[0] * x + by_state[1] * v + by_input
        };
        *state = [
            x + increment(self.transition[0], 0),
            v + increment(self.transition[1], 1),
        ];
    }
}

impl Exact {
    fn response(&mut self, equation: &Equation, length: f64) -> Option<&Response> {
        let is_kept = |kept: &Response| kept.length.to_bits() == length.to_bits();
        if let Some(place) = self.kept.iter().position(is_kept) {
            return self.kept.get(place);
        }
        let response = Response::new(equation, length)?;
        if self.kept.len() < MOST_KEPT {
            self.newest = self.kept.len();
            self.kept.push(response);
        } else {
            self.newest = (self.newest + 1) % MOST_KEPT;
            self.kept[self.newest] = response;
        }
        self.kept.get(self.newest)
    }
}

impl Solver<Equation> for Exact {
    fn step(
        &mut self,
        &Driven {
            equation,
            inputs,
            start,
            ..
        }: &Driven<Equation>,
        interval: Interval,
        state: &mut State,
    ) -> Result<(), StepFailure> {
        self.advance(
            equation,
            interval,
            &equation.force_powers(inputs, interval.length),
            state,
        )?;
        // The equation is linear: the load adds the motion that it makes alone, from rest and from the time at which it sets in.
        if start.is_some() && equation.load.force != 0.0 && interval.end() > equation.load.from {
            let from = interval.start.max(equation.load.from);
            let loaded = Interval {
                start: from,
                length: interval.end() - from,
            };
            let mut forces = [0.0; MAX_NODES];
            forces[0] = equation.load.force;
            let mut response = [0.0; 2];
            self.advance(equation, loaded, &forces, &mut response)?;
            *state = [state[0] + response[0], state[1] + response[1]];
        }
        self.steps += 1;
        Ok(())
    }

    fn internal_steps(&self) -> u64 {
        self.steps
    }
}

impl Exact {
    fn advance(
        &mut self,
        equation: &Equation,
        interval: Interval,
        forces: &[f64; MAX_NODES],
        state: &mut State,
    ) -> Result<(), StepFailure> {
        let response = self.response(equation, interval.length).ok_or_else(|| StepFailure::Recoverable {
            t: interval.start,
            message: format!(
                "the matrix exponential overflows with a step of {} s, stiffness {} N/m, damping {} N s/m, mass {} kg",
                interval.length, equation.stiffness, equation.damping, equation.mass
            ),
        })?;
        response.advance(forces, state);
        Ok(())
    }
}
