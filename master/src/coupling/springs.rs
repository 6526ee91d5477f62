//! Force/displacement coupling by a spring-damper inside one of the models, explicit.
//!
//! The rigid joint is replaced by a stiff spring and damper inside the subsystem at end a; it gets the motion of end b,
//! and end b gets the force `lambda = K g + D g'`. The variables are extrapolated through their past values. Jacobi: all
//! subsystems at once. Gauss-Seidel: one after the other in the order of the scene, later ones with interpolated
//! values of those before them.

use std::time::Duration;

use super::condition::check_finite;
use super::layout::DrivenInput;
use super::layout::input::Source;
use super::system::motion_of;
use crate::cosimulation::{Outcome, Parts, exchange};
use crate::error::RunError;
use crate::joint::{Level, Motion};
use crate::scene::Order;
use crate::signal::{Curve, History, Variables};
use crate::time::MacroStep;

use linchpin_proto::v1::Signal;

/// State of a force/displacement coupling between two macro steps.
pub struct Springs {
    order: Order,
    stiffness: f64,
    damping: f64,
    history: History,
    values: Vec<f64>,
}

impl Springs {
    /// Springs of `stiffness` (N/m) and dampers of `damping` (N s/m), polynomials of degree `degree`; the outputs of
    /// the first macro point are known.
    pub fn new(order: Order, stiffness: f64, damping: f64, degree: usize, parts: &Parts) -> Self {
        let mut method = Self {
            order,
            stiffness,
            damping,
            history: History::new(Variables::default(), &[], Vec::new()),
            values: vec![0.0; 3 * parts.layout.rows.len()],
        };
        method.read_variables(parts);
        let variables = Variables {
            degrees: vec![degree; method.values.len()],
            rotations: Vec::new(),
        };
        method.history = History::new(variables, &method.values, Vec::new());
        method
    }

    /// Forces of the springs at the present macro point, one for each joint.
    pub fn multipliers(&self) -> &[f64] {
        let newest = self.history.newest();
        &newest[..newest.len() / 3]
    }

    /// One macro step.
    pub fn macro_step(&mut self, parts: &mut Parts, step: MacroStep) -> Result<Outcome, RunError> {
        parts.prepare_advance(step);
        match self.order {
            Order::Jacobi => self.all_at_once(parts, step)?,
            Order::GaussSeidel => self.one_after_the_other(parts, step)?,
        }
        self.read_variables(parts);
        self.history.push(step.length, &self.values);
        check_finite(self.multipliers(), parts, step)?;
        Ok(Outcome::of_step(step, Duration::ZERO))
    }

    fn all_at_once(&self, parts: &mut Parts, step: MacroStep) -> Result<(), RunError> {
        for input in &parts.layout.inputs {
            let signal = parts.subsystems[input.subsystem].advance_signal(input.place);
            self.send(input, Curve::Extrapolated, step, signal);
        }
        exchange(&mut parts.subsystems, step)
    }

    fn one_after_the_other(&self, parts: &mut Parts, step: MacroStep) -> Result<(), RunError> {
        for number in 0..parts.subsystems.len() {
            for input in parts.layout.inputs_of(number) {
                let end = self.end_value(input, parts, number, step);
                let signal = parts.subsystems[number].advance_signal(input.place);
                match end {
                    Some(end) => {
                        self.send(input, Curve::Interpolated(&self.values), step, signal);
                        signal.values[0] = end;
                    }
                    None => self.send(input, Curve::Extrapolated, step, signal),
                }
            }
            exchange(&mut parts.subsystems[number..=number], step)?;
        }
        Ok(())
    }

    fn send(&self, input: &DrivenInput, curve: Curve<'_>, step: MacroStep, signal: &mut Signal) {
        if let Source::Sum(combination) = &input.source {
            self.history.signal(combination, curve, step.length, signal);
        }
    }

    /// Value of a variable at the end of the step, extrapolated.
    fn extrapolated(&self, variable: usize, step: MacroStep) -> f64 {
        self.history
            .value(variable, Curve::Extrapolated, step.length, step.length)
    }

    /// Value of an input at the end of the step, if a subsystem before `number` has determined part of it.
    fn end_value(
        &self,
        input: &DrivenInput,
        parts: &Parts,
        number: usize,
        step: MacroStep,
    ) -> Option<f64> {
        let mut is_known = false;
        let mut sum = 0.0;
        let Source::Sum(combination) = &input.source else {
            return None;
        };
        for &(variable, factor) in combination {
            let known = self.known_variable(variable, parts, number, step);
            is_known |= known.is_some();
            let value = known.unwrap_or_else(|| self.extrapolated(variable, step));
            sum += factor * value;
        }
        is_known.then_some(sum)
    }

    fn known_variable(
        &self,
        variable: usize,
        parts: &Parts,
        number: usize,
        step: MacroStep,
    ) -> Option<f64> {
        let rows = parts.layout.rows.len();
        let row = variable % rows;
        let ends = &parts.layout.joint_of(row).ends;
        let [a, b] = ends.each_ref().map(|end| end.subsystem);
        let mut motion = self.motion(parts, row);
        match variable / rows {
            0 if a < number => {
                // End b, which takes this force, has not stepped: the spring has seen its extrapolated motion.
                motion[1].pose.position.x = self.extrapolated(rows + row, step);
                motion[1].velocity.x = self.extrapolated(2 * rows + row, step);
                Some(self.force(parts, row, &motion))
            }
            1 if b < number => Some(motion[1].pose.position.x),
            2 if b < number => Some(motion[1].velocity.x),
            _ => None,
        }
    }

    fn read_variables(&mut self, parts: &Parts) {
        let rows = parts.layout.rows.len();
        for row in 0..rows {
            let motion = self.motion(parts, row);
            self.values[row] = self.force(parts, row, &motion);
            self.values[rows + row] = motion[1].pose.position.x;
            self.values[2 * rows + row] = motion[1].velocity.x;
        }
    }

    fn motion(&self, parts: &Parts, row: usize) -> Motion {
        let joint = parts.layout.rows[row].joint;
        motion_of(&parts.layout, joint, |s| {
            parts.subsystems[s].coupling_values()
        })
    }

    fn force(&self, parts: &Parts, row: usize, motion: &Motion) -> f64 {
        let condition = parts.layout.rows[row].condition;
        let condition = parts.layout.joint_of(row).joint.condition(condition);
        self.stiffness * condition.value(Level::Position, motion)
            + self.damping * condition.value(Level::Velocity, motion)
    }
}
