//! Solver `exact`: the solution in closed form for polynomial inputs, and for the load that sets in at a time.

use linchpin_proto::polynomial::MAX_NODES;
use linchpin_proto::weights::{MAX_WEIGHTS, add_part};
use linchpin_worker::{Interval, StepFailure};

use super::averages::{self, Averages};
use super::description::{A, V, X};
use super::equation::{Equation, State};
use super::propagator::Propagator;
use crate::mechanics::equation::Driven;
use crate::mechanics::integrals::Integrals;
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
    /// In unit length; absent until integrals are asked for.
    averages: Option<Averages>,
}

/// `H^2 c / m` and `H d / m`.
fn in_unit_length(equation: &Equation, length: f64) -> (f64, f64) {
    let kappa = length * length * equation.stiffness / equation.mass;
    (kappa, length * equation.damping / equation.mass)
}

impl Response {
    fn new(equation: &Equation, length: f64) -> Option<Self> {
        let (kappa, delta) = in_unit_length(equation, length);
        let unit = Propagator::new(kappa, delta)?;
        let [[xx, xv], [vx, vv]] = unit.transition;
        Some(Self {
            length,
            transition: [[xx, xv * length], [vx / length, vv]],
            input: unit.input.map(|[x, v]| {
                let scaled = length / equation.mass;
                [x * scaled * length, v * scaled]
            }),
            averages: None,
        })
    }

    /// Integrals of the displacement over the step from a state under forces.
    fn displacement(
        &mut self,
        equation: &Equation,
        forces: &[f64; MAX_NODES],
        &[x, v]: &State,
        weights: usize,
    ) -> Option<averages::Integrals> {
        if self
            .averages
            .as_ref()
            .is_none_or(|own| own.weights < weights)
        {
            let (kappa, delta) = in_unit_length(equation, self.length);
            self.averages = Averages::new(kappa, delta, weights);
        }
        let own = self.averages.as_ref()?;
        let scaled = self.length / equation.mass * self.length;
        Some(std::array::from_fn(|weight| {
            let by_input = forces
                .iter()
                .zip(&own.input)
                .map(|(force, by)| force * by[weight] * scaled);
            let [by_x, by_v] = [0, 1].map(|cause| own.transition[cause][weight]);
            by_x * x + by_v * (v * self.length) + by_input.sum::<f64>()
        }))
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
    fn response(&mut self, equation: &Equation, length: f64) -> Option<&mut Response> {
        let is_kept = |kept: &Response| kept.length.to_bits() == length.to_bits();
        if let Some(place) = self.kept.iter().position(is_kept) {
            return self.kept.get_mut(place);
        }
        let response = Response::new(equation, length)?;
        if self.kept.len() < MOST_KEPT {
            self.newest = self.kept.len();
            self.kept.push(response);
        } else {
            self.newest = (self.newest + 1) % MOST_KEPT;
            self.kept[self.newest] = response;
        }
        self.kept.get_mut(self.newest)
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
        integrals: &mut Integrals,
    ) -> Result<(), StepFailure> {
        let (from, weights) = (*state, integrals.weights());
        let forces = equation.force_powers(inputs, interval.length);
        let mut moved = self.advance(equation, interval, &forces, state, weights)?;
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
            let later = self.advance(equation, loaded, &forces, &mut response, weights)?;
            let part = [1.0 - loaded.length / interval.length, 1.0];
            add_part(part, 1, &later[..weights], &mut moved[..weights]);
            *state = [state[0] + response[0], state[1] + response[1]];
        }
        if !integrals.is_idle() {
            take(integrals, interval.length, [from, *state], &moved);
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
        weights: usize,
    ) -> Result<averages::Integrals, StepFailure> {
        let overflow = || StepFailure::Recoverable {
            t: interval.start,
            message: format!(
                "the matrix exponential overflows with a step of {} s, stiffness {} N/m, damping {} N s/m, mass {} kg",
                interval.length, equation.stiffness, equation.damping, equation.mass
            ),
        };
        let response = self
            .response(equation, interval.length)
            .ok_or_else(overflow)?;
        let moved = match weights {
            0 => [0.0; MAX_WEIGHTS],
            _ => response
                .displacement(equation, forces, state, weights)
                .ok_or_else(overflow)?,
        };
        response.advance(forces, state);
        Ok(moved)
    }
}

/// Takes the integrals of a step from one state to another, over which the displacement has these.
fn take(
    integrals: &mut Integrals,
    length: f64,
    [from, to]: [State; 2],
    moved: &averages::Integrals,
) {
    let above = |start: f64, moved: &averages::Integrals| {
        let mut all = *moved;
        all[0] += start;
        all
    };
    let rate = |displacement: f64, moved: &averages::Integrals| {
        averages::of_rate(displacement, moved).map(|integral| integral / length)
    };
    let [gone, gained] = [to[0] - from[0], to[1] - from[1]];
    integrals.set(|output| match output {
        X => above(from[0], moved),
        V => rate(gone, moved),
        A => {
            let mut sped = rate(gone, moved);
            sped[0] -= from[1];
            rate(gained, &sped)
        }
        // Which outputs there are was looked up before.
        _ => [f64::NAN; MAX_WEIGHTS],
    });
}
