//! Force/displacement coupling by a penalty spring-damper, explicit: what common co-simulation masters do today.
//!
//! The rigid joint is replaced by a stiff spring and damper inside the subsystem at end a; it gets the motion of end b,
//! and end b gets the force `lambda = K g + D g'`. The variables are extrapolated through their past values. Jacobi: all
//! subsystems at once. Gauss-Seidel: one after the other in the order of the scene, later ones with interpolated
//! values of those before them.

use super::condition::check_finite;
use super::layout::DrivenInput;
use super::system::motion_of;
use crate::cosimulation::{Outcome, Parts, exchange};
use crate::error::RunError;
use crate::joint::{Level, Motion};
use crate::results::Verdict;
use crate::signal::History;
use crate::time::MacroStep;

/// In which order the subsystems step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// All at once.
    Jacobi,
    /// One after the other.
    GaussSeidel,
}

/// State of a penalty coupling between two macro steps.
pub struct Penalty {
    order: Order,
    stiffness: f64,
    damping: f64,
    history: History,
    values: Vec<f64>,
}

impl Penalty {
    /// Springs of `stiffness` (N/m) and dampers of `damping` (N s/m), polynomials of degree `degree`; the outputs of
    /// the first macro point are known.
    pub fn new(order: Order, stiffness: f64, damping: f64, degree: usize, parts: &Parts) -> Self {
        let mut method = Self {
            order,
            stiffness,
            damping,
            history: History::new(degree, &[]),
            values: vec![0.0; 3 * parts.layout.rows.len()],
        };
        method.read_variables(parts);
        method.history = History::new(degree, &method.values);
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
        Ok(Outcome {
            verdict: Verdict::Uncorrected,
            solving: 0.0,
        })
    }

    fn all_at_once(&self, parts: &mut Parts, step: MacroStep) -> Result<(), RunError> {
        for input in &parts.layout.inputs {
            let signal = parts.subsystems[input.subsystem].advance_signal(input.place);
            self.history.extrapolate(&input.combination, signal);
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
                        self.history
                            .interpolate(&input.combination, step.length, end, signal);
                    }
                    None => self.history.extrapolate(&input.combination, signal),
                }
            }
            exchange(&mut parts.subsystems[number..=number], step)?;
        }
        Ok(())
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
        for &(variable, factor) in &input.combination {
            let known = self.known_variable(variable, parts, number, step);
            is_known |= known.is_some();
            let value =
                known.unwrap_or_else(|| self.history.extrapolated_value(variable, step.length));
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
                motion[1][0][0] = self.history.extrapolated_value(rows + row, step.length);
                motion[1][1][0] = self.history.extrapolated_value(2 * rows + row, step.length);
                Some(self.force(parts, row, &motion))
            }
            1 if b < number => Some(motion[1][0][0]),
            2 if b < number => Some(motion[1][1][0]),
            _ => None,
        }
    }

    fn read_variables(&mut self, parts: &Parts) {
        let rows = parts.layout.rows.len();
        for row in 0..rows {
            let motion = self.motion(parts, row);
            self.values[row] = self.force(parts, row, &motion);
            self.values[rows + row] = motion[1][0][0];
            self.values[2 * rows + row] = motion[1][1][0];
        }
    }

    fn motion(&self, parts: &Parts, row: usize) -> Motion {
        let joint = parts.layout.rows[row].joint;
        motion_of(&parts.layout, joint, |s| {
            parts.subsystems[s].coupling_values()
        })
    }

    fn force(&self, parts: &Parts, row: usize, motion: &Motion) -> f64 {
        let law = &parts.layout.joint_of(row).law;
        let condition = parts.layout.rows[row].condition;
        self.stiffness * law.condition(condition, Level::Position, motion)
            + self.damping * law.condition(condition, Level::Velocity, motion)
    }
}
