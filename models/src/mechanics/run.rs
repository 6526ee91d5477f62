//! An equation of motion as a subsystem: state, outputs and snapshots are the same for all solvers.

use linchpin_worker::{Inputs, Interval, Snapshot, StepFailure, Subsystem};

use super::equation::{Driven, EquationOfMotion, Vector};
use super::integrals::Integrals;
use super::joint_loads::JointLoads;

/// How an equation of motion is advanced in time.
pub trait Solver<E: EquationOfMotion>: Send {
    /// Advances `state` over `interval`, and the integrals over it, which begin at 0.
    fn step(
        &mut self,
        driven: &Driven<E>,
        interval: Interval,
        state: &mut E::State,
        integrals: &mut Integrals,
    ) -> Result<(), StepFailure>;

    /// Advances `state` with the internal steps of the last [`Solver::step`].
    fn perturbed_step(
        &mut self,
        driven: &Driven<E>,
        interval: Interval,
        state: &mut E::State,
        integrals: &mut Integrals,
    ) -> Result<(), StepFailure> {
        self.step(driven, interval, state, integrals)
    }

    /// Advances `response`, of a linear equation under `direction`, over the internal steps that `driven` needs from `state`:
    /// the derivative of what [`Solver::step`] computes. For solvers whose internal steps depend on the interval only it is
    /// a step. The integrals are those of the response.
    fn respond(
        &mut self,
        _driven: &Driven<E>,
        direction: &Driven<E>,
        interval: Interval,
        _state: &E::State,
        response: &mut E::State,
        integrals: &mut Integrals,
    ) -> Result<(), StepFailure> {
        self.step(direction, interval, response, integrals)
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
    fn tolerance(&self, _state: &E::State) -> Option<f64> {
        None
    }
}

/// One subsystem in motion.
pub struct Run<E: EquationOfMotion, S> {
    equation: E,
    joint_loads: JointLoads,
    state: E::State,
    solver: S,
    integrals: Integrals,
    /// What a snapshot holds: the state, then the solver's memory.
    kept: Vec<f64>,
}

impl<E: EquationOfMotion, S: Solver<E>> Run<E, S> {
    pub fn new(equation: E, joint_loads: JointLoads, start: E::State, solver: S) -> Self {
        Self {
            equation,
            joint_loads,
            state: start,
            solver,
            integrals: Integrals::default(),
            kept: vec![0.0; E::STATE_NAMES.len() + 1],
        }
    }

    /// A step that fails leaves the state as it was.
    fn advance(
        &mut self,
        interval: Interval,
        inputs: &Inputs,
        step: impl FnOnce(
            &mut S,
            &Driven<E>,
            Interval,
            &mut E::State,
            &mut Integrals,
        ) -> Result<(), StepFailure>,
    ) -> Result<(), StepFailure> {
        let driven = Driven {
            equation: &self.equation,
            inputs,
            joint_loads: &self.joint_loads,
            start: Some(interval.start),
        };
        let mut reached = self.state;
        let integrals = &mut self.integrals;
        integrals.begin();
        step(&mut self.solver, &driven, interval, &mut reached, integrals)?;
        self.equation.settle(&mut reached);
        let mut values = reached.as_ref().iter().zip(E::STATE_NAMES);
        if let Some((value, name)) = values.find(|(value, _)| !value.is_finite()) {
            return Err(StepFailure::Recoverable {
                t: interval.end(),
                message: format!("the state {name} became {value}"),
            });
        }
        self.state = reached;
        Ok(())
    }
}

fn read<E: EquationOfMotion>(
    equation: &E,
    state: &E::State,
    inputs: &E::Inputs,
    wanted: &[usize],
    values: &mut [f64],
) -> Result<(), StepFailure> {
    for (value, &output) in values.iter_mut().zip(wanted) {
        let computed = equation.output(state, inputs, output);
        *value = computed.ok_or_else(|| StepFailure::Fatal {
            message: format!("the model has no output number {output}"),
        })?;
    }
    Ok(())
}

impl<E: EquationOfMotion, S: Solver<E>> Subsystem for Run<E, S> {
    fn step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        self.advance(interval, inputs, S::step)
    }

    fn perturbed_step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        self.advance(interval, inputs, S::perturbed_step)
    }

    fn outputs(
        &mut self,
        t: f64,
        inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        let mut u = self.joint_loads.inputs(&self.equation, &self.state, inputs);
        self.equation.add_own_loads(t, &mut u);
        read(&self.equation, &self.state, &u, wanted, values)
    }

    fn derivative(
        &mut self,
        interval: Interval,
        inputs: &Inputs,
        direction: &Inputs,
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        if !E::IS_LINEAR || !self.joint_loads.is_empty() {
            return Err(StepFailure::NotOffered {
                what: "directional derivatives",
            });
        }
        let driven = |inputs, start| Driven {
            equation: &self.equation,
            inputs,
            joint_loads: &self.joint_loads,
            start,
        };
        let mut response = E::State::ZERO;
        if interval.length > 0.0 {
            self.integrals.begin();
            self.solver.respond(
                &driven(inputs, Some(interval.start)),
                &driven(direction, None),
                interval,
                &self.state,
                &mut response,
                &mut self.integrals,
            )?;
        }
        let mut u = E::Inputs::ZERO;
        direction.values_at(interval.length, u.as_mut());
        read(&self.equation, &response, &u, wanted, values)
    }

    /// Rates are linear in loads, and positions have rates that do not depend on them.
    fn impulse(&mut self, t: f64, inputs: &[f64], impulses: &[f64]) -> Result<(), StepFailure> {
        let raised: Vec<f64> = inputs.iter().zip(impulses).map(|(u, p)| u + p).collect();
        let rate = |inputs: &[f64]| {
            let mut u = self.joint_loads.inputs(&self.equation, &self.state, inputs);
            self.equation.add_own_loads(t, &mut u);
            self.equation.rate(&self.state, &u)
        };
        let (with, without) = (rate(&raised), rate(inputs));
        let jumps = with.as_ref().iter().zip(without.as_ref());
        for (own, (with, without)) in self.state.as_mut().iter_mut().zip(jumps) {
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
        into.put(self.state.as_ref());
        into.put(&[self.solver.memory()]);
    }

    fn restore(&mut self, from: &Snapshot) -> Result<(), StepFailure> {
        from.get(&mut self.kept)?;
        if let [state @ .., memory] = &self.kept[..] {
            self.state.as_mut().copy_from_slice(state);
            self.solver.recall(*memory);
        }
        Ok(())
    }

    fn internal_steps(&self) -> u64 {
        self.solver.internal_steps()
    }

    fn tolerance(&self) -> Option<f64> {
        self.solver.tolerance(&self.state)
    }
}
