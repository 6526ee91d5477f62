//! The oscillator as a subsystem: state, outputs and snapshots are the same for all solvers.

use linchpin_worker::{Inputs, Interval, Snapshot, StepFailure, Subsystem};

use super::description::{A, F, PARTNER_V, PARTNER_X, V, X};
use super::equation::Equation;

/// Position (m) and velocity (m/s).
pub type State = [f64; 2];

/// How the equation of motion is advanced in time.
pub trait Solver: Send {
    /// Advances `state` over `interval`.
    fn step(
        &mut self,
        equation: &Equation,
        interval: Interval,
        inputs: &Inputs,
        state: &mut State,
    ) -> Result<(), StepFailure>;

    /// Advances `state` with the internal steps of the last [`Solver::step`].
    fn perturbed_step(
        &mut self,
        equation: &Equation,
        interval: Interval,
        inputs: &Inputs,
        state: &mut State,
    ) -> Result<(), StepFailure> {
        self.step(equation, interval, inputs, state)
    }

    /// What the next step depends on besides the state, as one number; 0 if there is nothing.
    fn memory(&self) -> f64 {
        0.0
    }

    /// Goes back to a memory.
    fn recall(&mut self, _memory: f64) {}

    /// Internal steps since the start.
    fn internal_steps(&self) -> u64;

    /// Error tolerance at a state.
    fn tolerance(&self, _state: &State) -> Option<f64> {
        None
    }
}

/// One oscillator in motion.
pub struct Run<S> {
    equation: Equation,
    state: State,
    solver: S,
}

impl<S: Solver> Run<S> {
    pub fn new(equation: Equation, start: State, solver: S) -> Self {
        Self {
            equation,
            state: start,
            solver,
        }
    }

    /// A step that fails leaves the state as it was.
    fn commit(&mut self, reached: State, interval: Interval) -> Result<(), StepFailure> {
        if !reached.iter().all(|value| value.is_finite()) {
            return Err(StepFailure::Recoverable {
                t: interval.end(),
                message: format!("the state became x = {}, v = {}", reached[0], reached[1]),
            });
        }
        self.state = reached;
        Ok(())
    }
}

impl<S: Solver> Subsystem for Run<S> {
    fn step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        let mut reached = self.state;
        self.solver
            .step(&self.equation, interval, inputs, &mut reached)?;
        self.commit(reached, interval)
    }

    fn perturbed_step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        let mut reached = self.state;
        self.solver
            .perturbed_step(&self.equation, interval, inputs, &mut reached)?;
        self.commit(reached, interval)
    }

    fn outputs(
        &mut self,
        _t: f64,
        inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        let [x, v] = self.state;
        for (value, &output) in values.iter_mut().zip(wanted) {
            *value = match output {
                X => x,
                V => v,
                A => {
                    let u = self
                        .equation
                        .force(inputs[F], inputs[PARTNER_X], inputs[PARTNER_V]);
                    self.equation.acceleration(x, v, u)
                }
                unknown => {
                    return Err(StepFailure::Fatal {
                        message: format!("the oscillator has the outputs 0 to {A}, not {unknown}"),
                    });
                }
            };
        }
        Ok(())
    }

    fn snapshot(&self, into: &mut Snapshot) {
        let [x, v] = self.state;
        into.put(&[x, v, self.solver.memory()]);
    }

    fn restore(&mut self, from: &Snapshot) -> Result<(), StepFailure> {
        let mut kept = [0.0; 3];
        from.get(&mut kept)?;
        let [x, v, memory] = kept;
        self.state = [x, v];
        self.solver.recall(memory);
        Ok(())
    }

    fn internal_steps(&self) -> u64 {
        self.solver.internal_steps()
    }

    fn tolerance(&self) -> Option<f64> {
        self.solver.tolerance(&self.state)
    }
}
