//! A formulation in motion: state, outputs, snapshots, solvers.

use linchpin_worker::setup::SetupError;
use linchpin_worker::{Inputs, Interval, Setup, Snapshot, StepFailure, Subsystem};

use super::formulation::{Driven, Formulation};
use super::outputs::{Output, outputs};
use crate::integrators::radau::{Radau, Tolerances};
use crate::integrators::{Cause, IntegrationError, Quadrature, Rk4, gauss};
use crate::mechanics::adaptive::at;
use crate::mechanics::fixed::parts;
use crate::mechanics::integrals::Integrals;
use crate::mechanics::solvers::{Choice, choose};

/// One multibody subsystem.
pub struct Run {
    formulation: Box<dyn Formulation>,
    outputs: Vec<Output>,
    state: Vec<f64>,
    reached: Vec<f64>,
    solver: Solver,
    integrals: Integrals,
    /// What a snapshot holds: the state, then the solver's memory.
    kept: Vec<f64>,
}

/// How it is advanced in time.
enum Solver {
    Adaptive {
        radau: Box<Radau>,
        tolerances: Tolerances,
    },
    Fixed {
        rk4: Rk4,
        step: f64,
        steps: u64,
    },
}

/// Whether internal steps are chosen or repeated.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Steps {
    Chosen,
    Repeated,
}

impl Run {
    /// From the start of a formulation, with the solver of `setup`.
    ///
    /// # Errors
    /// [`SetupError`] if the solver or its options are not allowed.
    pub fn new(formulation: Box<dyn Formulation>, setup: &Setup) -> Result<Self, SetupError> {
        let state = formulation.start();
        let dimension = state.len();
        let solver = match choose(setup)? {
            Choice::Adaptive(tolerances) => Solver::Adaptive {
                radau: Box::new(Radau::new(dimension, tolerances)),
                tolerances,
            },
            Choice::Fixed(step) => Solver::Fixed {
                rk4: Rk4::new(dimension),
                step,
                steps: 0,
            },
        };
        Ok(Self {
            outputs: outputs(formulation.system()),
            formulation,
            reached: state.clone(),
            kept: vec![0.0; dimension + 1],
            state,
            solver,
            integrals: Integrals::default(),
        })
    }

    /// A step that fails leaves the state as it was.
    fn advance(
        &mut self,
        interval: Interval,
        inputs: &Inputs,
        steps: Steps,
    ) -> Result<(), StepFailure> {
        self.reached.copy_from_slice(&self.state);
        let ode = Driven {
            formulation: &*self.formulation,
            start: interval.start,
            inputs,
        };
        self.integrals.begin();
        let mut beside = Integrating {
            driven: &ode,
            outputs: &self.outputs,
            length: interval.length,
            integrals: &mut self.integrals,
        };
        // Without a state nothing is integrated: all motion is prescribed.
        if self.reached.is_empty() {
            for [node, weight] in gauss(PRESCRIBED_POINTS) {
                beside.add(node * interval.length, &[], weight * interval.length);
            }
        } else {
            let state = &mut self.reached;
            self.solver
                .advance(&ode, (interval, steps), state, &mut beside)?;
        }
        let t = interval.end();
        let mut values = self.reached.iter().zip(self.formulation.state_names());
        if let Some((value, name)) = values.find(|(value, _)| !value.is_finite()) {
            let message = format!("the state {name} became {value}");
            return Err(StepFailure::Recoverable { t, message });
        }
        let settled = self.formulation.settle(t, &mut self.reached);
        settled.map_err(|unsettled| StepFailure::Recoverable {
            t,
            message: unsettled.to_string(),
        })?;
        std::mem::swap(&mut self.state, &mut self.reached);
        Ok(())
    }
}

impl Solver {
    fn advance(
        &mut self,
        ode: &Driven<'_>,
        (interval, steps): (Interval, Steps),
        state: &mut [f64],
        beside: &mut impl Quadrature,
    ) -> Result<(), StepFailure> {
        match self {
            Self::Adaptive { radau, .. } => {
                let is_repeated =
                    steps == Steps::Repeated && radau.has_recorded_over(interval.length);
                let advanced = if is_repeated {
                    radau.replay_beside(ode, state, beside)
                } else {
                    radau.integrate_beside(ode, interval.length, state, beside)
                };
                advanced.map_err(|error| failure(interval, error))
            }
            Self::Fixed { rk4, step, steps } => {
                let parts = parts(interval, *step)?;
                rk4.integrate_beside(ode, (interval.length, parts), state, beside)
                    .map_err(|error| at(interval, error))?;
                *steps += parts;
                Ok(())
            }
        }
    }

    /// What the next step depends on besides the state; 0 if there is nothing.
    fn memory(&self) -> f64 {
        match self {
            Self::Adaptive { radau, .. } => radau.proposed_step(),
            Self::Fixed { .. } => 0.0,
        }
    }
}

/// In a singular position the right-hand side is not a number: there the message names the likely cause.
fn failure(interval: Interval, error: IntegrationError) -> StepFailure {
    match (error.cause, at(interval, error)) {
        (Cause::NotFinite, StepFailure::Recoverable { t, message }) => StepFailure::Recoverable {
            t,
            message: format!("{message}: overflow, or a singular position of the mechanism"),
        },
        (_, failure) => failure,
    }
}

/// Points of the quadrature along a prescribed motion: exact to rounding where it turns by some radians within a step.
const PRESCRIBED_POINTS: usize = 16;

/// Outputs, integrated over a step of this length (s).
struct Integrating<'a> {
    driven: &'a Driven<'a>,
    outputs: &'a [Output],
    length: f64,
    integrals: &'a mut Integrals,
}

impl Quadrature for Integrating<'_> {
    fn add(&mut self, tau: f64, y: &[f64], weight: f64) {
        if self.integrals.is_idle() {
            return;
        }
        let Driven {
            formulation,
            start,
            inputs,
        } = *self.driven;
        let (system, t) = (formulation.system(), start + tau);
        let kinematics = formulation.kinematics(t, y);
        let needs_dynamics =
            |&number: &usize| self.outputs[number].needs_dynamics(system.dimension);
        // In a singular position there are none, and what needs them is not a number.
        let dynamics = match self.integrals.outputs().iter().any(needs_dynamics) {
            true => {
                let mut values = vec![0.0; inputs.len()];
                inputs.values_at(tau, &mut values);
                formulation.dynamics(t, y, &values)
            }
            false => None,
        };
        self.integrals
            .add(tau / self.length, weight / self.length, |number| {
                self.outputs[number].value(system, &kinematics, dynamics.as_ref())
            });
    }

    fn longest_step(&self, length: f64) -> f64 {
        self.integrals.longest_step(length)
    }
}

impl Subsystem for Run {
    fn step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        self.advance(interval, inputs, Steps::Chosen)
    }

    fn perturbed_step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        self.advance(interval, inputs, Steps::Repeated)
    }

    fn outputs(
        &mut self,
        t: f64,
        inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        let system = self.formulation.system();
        let kinematics = self.formulation.kinematics(t, &self.state);
        let known = |number: usize| {
            self.outputs.get(number).ok_or_else(|| StepFailure::Fatal {
                message: format!("the model has no output number {number}"),
            })
        };
        let mut dynamics = None;
        for (value, &number) in values.iter_mut().zip(wanted) {
            let output = known(number)?;
            if output.needs_dynamics(system.dimension) && dynamics.is_none() {
                let solved = self.formulation.dynamics(t, &self.state, inputs);
                dynamics = Some(solved.ok_or_else(|| StepFailure::Recoverable {
                    t,
                    message: "accelerations and reactions are not determined: the mechanism is in a singular position"
                        .to_owned(),
                })?);
            }
            *value = output.value(system, &kinematics, dynamics.as_ref());
        }
        Ok(())
    }

    /// Rates are linear in loads, and positions have rates that do not depend on them.
    fn impulse(&mut self, t: f64, inputs: &[f64], impulses: &[f64]) -> Result<(), StepFailure> {
        let raised: Vec<f64> = inputs.iter().zip(impulses).map(|(u, p)| u + p).collect();
        let mut without = vec![0.0; self.state.len()];
        self.formulation
            .rate(t, &self.state, &raised, &mut self.reached);
        self.formulation.rate(t, &self.state, inputs, &mut without);
        for (own, (with, without)) in self.state.iter_mut().zip(self.reached.iter().zip(without)) {
            *own += with - without;
        }
        Ok(())
    }

    fn integrate_outputs(&mut self, outputs: &[usize], weights: usize) -> Result<(), StepFailure> {
        self.integrals.choose(outputs, weights);
        Ok(())
    }

    fn integrals(&self, values: &mut [f64]) -> Result<(), StepFailure> {
        self.integrals.read(values);
        Ok(())
    }

    fn snapshot(&self, into: &mut Snapshot) {
        into.put(&self.state);
        into.put(&[self.solver.memory()]);
    }

    fn restore(&mut self, from: &Snapshot) -> Result<(), StepFailure> {
        from.get(&mut self.kept)?;
        if let [state @ .., memory] = &self.kept[..] {
            self.state.copy_from_slice(state);
            if let Solver::Adaptive { radau, .. } = &mut self.solver {
                radau.propose_step(*memory);
            }
        }
        Ok(())
    }

    fn internal_steps(&self) -> u64 {
        match &self.solver {
            Solver::Adaptive { radau, .. } => radau.steps(),
            Solver::Fixed { steps, .. } => *steps,
        }
    }

    fn tolerance(&self) -> Option<f64> {
        match &self.solver {
            Solver::Adaptive { tolerances, .. } => {
                let largest = self.state.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
                Some(tolerances.at(largest))
            }
            Solver::Fixed { .. } => None,
        }
    }
}
