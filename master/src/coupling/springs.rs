//! Force/displacement coupling by a spring-damper inside one of the models, explicit.
//!
//! The rigid joint is replaced by a stiff spring and damper inside the subsystem at end a; it gets the motion of end b,
//! and end b gets the force `lambda = K g + D g'`. The variables are extrapolated through their past values. Jacobi: all
//! subsystems at once. Gauss-Seidel: one after the other in the order of the scene, later ones with interpolated
//! values of those before them.
//!
//! Error of a step: the spring has seen end b by `delta` beside its place, `delta'` beside its velocity. That is the exact motion with a
//! spring whose end is displaced by `(K delta + D delta') / K`. What end b feels more than the spring itself is
//! [unbalanced](super::unbalanced).

use std::time::Duration;

use super::condition::check_finite;
use super::error_estimate::{ErrorScales, Estimate, Suspect};
use super::unbalanced::{Loads, Unbalanced};
use super::uncorrected::{Uncorrected, displacement};
use crate::error::RunError;
use crate::joint::{Level, Motion};
use crate::layout::DrivenInput;
use crate::layout::input::Source;
use crate::scene::{Order, Spring};
use crate::signal::{Curve, History, Variables};
use crate::system::motion_of;
use crate::time::MacroStep;
use crate::workers::{Parts, exchange};

use linchpin_proto::v1::Signal;

/// State of a force/displacement coupling between two macro steps.
pub struct Springs {
    order: Order,
    spring: Spring,
    history: History,
    values: Vec<f64>,
    /// Errors of the forces of each row at its ends.
    errors: Vec<[f64; 2]>,
    /// Present if steps vary.
    unbalanced: Option<Unbalanced>,
}

impl Springs {
    /// Polynomials of degree `degree`; the outputs of the first macro point are known.
    pub fn new(order: Order, spring: Spring, degree: usize, parts: &Parts) -> Self {
        let mut method = Self {
            order,
            spring,
            history: History::new(Variables::default(), &[], Vec::new()),
            values: vec![0.0; 3 * parts.layout.rows.len()],
            errors: vec![[0.0; 2]; parts.layout.rows.len()],
            unbalanced: None,
        };
        method.read_variables(parts);
        let variables = Variables {
            degrees: vec![degree; method.values.len()],
            rotations: Vec::new(),
        };
        method.history = History::new(variables, &method.values, Vec::new());
        method
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

    /// Value of a variable at the end of the step under which the subsystem that it drives has stepped: at `number`.
    fn used(&self, variable: usize, parts: &Parts, number: usize, step: MacroStep) -> f64 {
        let known = match self.order {
            Order::Jacobi => None,
            Order::GaussSeidel => self.known_variable(variable, parts, number, step),
        };
        known.unwrap_or_else(|| self.extrapolated(variable, step))
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

    /// Mean errors over the step in row `row`: of the spring's force by what it saw of end b, and of the force on end b.
    fn misses(&self, parts: &Parts, row: usize, step: MacroStep) -> [f64; 2] {
        let rows = parts.layout.rows.len();
        let [a, b] = parts.layout.joint_of(row).ends.each_ref();
        // That of the end value, and what the curve through that misses within the step.
        let miss = |variable: usize, number: usize| {
            let used = self.used(variable, parts, number, step);
            let miss = self.history.extrapolation_miss(variable, step.length);
            let within = self.history.error_shares(variable, step.length);
            miss.mean * (self.values[variable] - used)
                + within.mean * (used - self.extrapolated(variable, step))
        };
        let seen = [rows + row, 2 * rows + row].map(|variable| miss(variable, a.subsystem));
        let Spring { stiffness, damping } = self.spring;
        [
            stiffness * seen[0] + damping * seen[1],
            miss(row, b.subsystem),
        ]
    }

    fn force(&self, parts: &Parts, row: usize, motion: &Motion) -> f64 {
        let condition = parts.layout.rows[row].condition;
        let condition = parts.layout.joint_of(row).joint.condition(condition);
        self.spring.stiffness * condition.value(Level::Position, motion)
            + self.spring.damping * condition.value(Level::Velocity, motion)
    }
}

impl Uncorrected for Springs {
    /// Forces of the springs, one for each joint.
    fn multipliers(&self) -> &[f64] {
        let newest = self.history.newest();
        &newest[..newest.len() / 3]
    }

    fn prepare_estimate(
        &mut self,
        parts: &mut Parts,
        step: MacroStep,
        scales: &ErrorScales,
    ) -> Result<(), RunError> {
        let span = scales.span();
        let unbalanced = &mut self.unbalanced;
        let unbalanced = unbalanced.get_or_insert_with(|| Unbalanced::new(parts, span));
        let newest = self.history.newest();
        unbalanced.measure(parts, step, scales, |input| input.value(newest, &[]))
    }

    fn advance(&mut self, parts: &mut Parts, step: MacroStep) -> Result<Duration, RunError> {
        parts.prepare_advance(step);
        match self.order {
            Order::Jacobi => self.all_at_once(parts, step)?,
            Order::GaussSeidel => self.one_after_the_other(parts, step)?,
        }
        self.read_variables(parts);
        let rows = parts.layout.rows.len();
        check_finite(&self.values[..rows], parts, step)?;
        Ok(Duration::ZERO)
    }

    fn error_estimate(&mut self, parts: &Parts, step: MacroStep, scales: &ErrorScales) -> Estimate {
        let mut estimate = Estimate::NONE;
        let mut order = 1;
        for row in 0..parts.layout.rows.len() {
            let miss = self.history.extrapolation_miss(row, step.length);
            let [at_spring, at_b] = self.misses(parts, row, step);
            let displaced = displacement(&self.spring, at_spring, scales.span());
            let scaled = displaced.abs() / scales.allowed_of_opening(&parts.layout, row);
            estimate.add(scaled, miss.order, Suspect::Opening(row));
            estimate.change = estimate.change.max(at_b.abs());
            self.errors[row] = [0.0, at_spring - at_b];
            order = miss.order;
        }
        let loads = Loads {
            values: &self.values,
            attitudes: &[],
            errors: &self.errors,
            order,
        };
        if let Some(unbalanced) = &mut self.unbalanced {
            unbalanced.estimate(parts, step, loads, scales, &mut estimate);
        }
        estimate
    }

    fn move_on(&mut self, step: MacroStep) {
        self.history.push(step.length, &self.values);
        if let Some(unbalanced) = &mut self.unbalanced {
            unbalanced.move_on();
        }
    }

    fn multipliers_at(&self, parts: &Parts, sample: usize, multipliers: &mut [f64]) {
        let outputs = |subsystem: usize| parts.subsystems[subsystem].sample(sample);
        for (row, multiplier) in multipliers.iter_mut().enumerate() {
            let joint = parts.layout.rows[row].joint;
            let motion = motion_of(&parts.layout, joint, outputs);
            *multiplier = self.force(parts, row, &motion);
        }
    }
}
