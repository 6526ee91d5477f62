//! Force/force coupling by penalty spring-dampers, explicit: what common co-simulation masters do today.
//!
//! A spring and a damper stand in place of every condition `g` of a joint. At each macro point the multiplier is their load,
//! `lambda = -s (K g + D g')`, with `s` the [`load_power`](crate::joint::Condition::load_power) of the condition, so that a
//! condition that is open is pulled shut; exchanged variables are what the outputs show, `w = y`. All are extrapolated
//! over the next step through their past values, and no macro step is repeated.
//!
//! Jacobi: all subsystems step at once. Gauss-Seidel: one after the other in the order of the scene; the end values of
//! the coupling variables follow from the outputs of those that have stepped and the extrapolated outputs of the others,
//! and the inputs are interpolated through them.

use std::ops::Range;

use std::time::Duration;

use super::condition::check_finite;
use super::uncorrected::Uncorrected;
use crate::error::RunError;
use crate::joint::Level;
use crate::layout::{Layout, Over, Row};
use crate::scene::{Order, Spring};
use crate::signal::{Curve, History, Lagrange, Variables};
use crate::system::motion_of;
use crate::time::MacroStep;
use crate::workers::{Parts, exchange};

/// State of a penalty coupling between two macro steps.
pub struct Penalty {
    springs: Vec<Spring>,
    history: History,
    /// Coupling variables at the end of the step, as far as they are known.
    ends: Vec<f64>,
    memory: Vec<f64>,
    sequence: Option<Sequence>,
}

/// What one subsystem after the other needs: the coupling outputs of all subsystems, one behind the other.
struct Sequence {
    outputs: History,
    /// At the end of the step: extrapolated until the subsystem has stepped.
    ends: Vec<f64>,
    places: Vec<Range<usize>>,
}

impl Penalty {
    /// One spring for each row; `history` holds the coupling variables up to the first macro point, where the outputs are known.
    /// With Gauss-Seidel the outputs are extrapolated with `output_degree`.
    pub fn new(
        order: Order,
        springs: Vec<Spring>,
        history: History,
        output_degree: usize,
        parts: &Parts,
    ) -> Self {
        let size = parts.layout.variables();
        Self {
            springs,
            history,
            ends: vec![0.0; size],
            memory: vec![0.0; size],
            sequence: match order {
                Order::Jacobi => None,
                Order::GaussSeidel => Some(Sequence::new(output_degree, parts)),
            },
        }
    }

    fn all_at_once(&mut self, parts: &mut Parts, step: MacroStep) -> Result<(), RunError> {
        for number in 0..parts.subsystems.len() {
            self.request_advance(parts, number, step);
        }
        exchange(&mut parts.subsystems, step)?;
        let subsystems = &parts.subsystems;
        let outputs = |subsystem: usize| subsystems[subsystem].coupling_values();
        self.take(&parts.layout, outputs, |_| true);
        Ok(())
    }

    fn one_after_the_other(&mut self, parts: &mut Parts, step: MacroStep) -> Result<(), RunError> {
        extrapolate(&self.history, step, &mut self.ends);
        if let Some(sequence) = &mut self.sequence {
            extrapolate(&sequence.outputs, step, &mut sequence.ends);
        }
        for number in 0..parts.subsystems.len() {
            self.request_advance(parts, number, step);
            exchange(&mut parts.subsystems[number..=number], step)?;
            let Some(mut sequence) = self.sequence.take() else {
                return Ok(());
            };
            let own = sequence.places[number].clone();
            sequence.ends[own].copy_from_slice(parts.subsystems[number].coupling_values());
            let outputs = |subsystem: usize| &sequence.ends[sequence.places[subsystem].clone()];
            self.take(&parts.layout, outputs, |subsystem| subsystem == number);
            self.sequence = Some(sequence);
        }
        Ok(())
    }

    /// Fills in the advance of one subsystem. Through an end value that is extrapolated itself, the interpolation is the
    /// extrapolation.
    fn request_advance(&mut self, parts: &mut Parts, number: usize, step: MacroStep) {
        let mut over = Over {
            curves: &Lagrange {
                history: &self.history,
                curve: match self.sequence {
                    None => Curve::Extrapolated,
                    Some(_) => Curve::Interpolated(&self.ends),
                },
                length: step.length,
            },
            memory: &mut self.memory,
        };
        let subsystem = &mut parts.subsystems[number];
        for input in parts.layout.inputs_of(number) {
            input.signal(&mut over, subsystem.advance_signal(input.place));
        }
    }

    /// Takes over the end values of the coupling variables that depend on a subsystem that is `new`.
    fn take<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64] + Copy,
        is_new: impl Fn(usize) -> bool,
    ) {
        for (row, spring) in self.springs.iter().enumerate() {
            let ends = &layout.joint_of(row).ends;
            if ends.iter().any(|end| is_new(end.subsystem)) {
                self.ends[row] = spring_load(layout, row, spring, outputs);
            }
        }
        let history = &self.history;
        for exchanged in layout.exchanged.iter().filter(|one| is_new(one.subsystem)) {
            let own = outputs(exchanged.subsystem);
            let value = exchanged.read(own, history.attitudes(), history.newest());
            let places = exchanged.first..exchanged.first + exchanged.size();
            self.ends[places].copy_from_slice(&value.as_slice()[..exchanged.size()]);
        }
    }
}

impl Uncorrected for Penalty {
    /// Loads of the springs, one for each row.
    fn multipliers(&self) -> &[f64] {
        &self.history.newest()[..self.springs.len()]
    }

    fn advance(&mut self, parts: &mut Parts, step: MacroStep) -> Result<Duration, RunError> {
        parts.prepare_advance(step);
        match self.sequence {
            None => self.all_at_once(parts, step)?,
            Some(_) => self.one_after_the_other(parts, step)?,
        }
        check_finite(&self.ends, parts, step)?;
        Ok(Duration::ZERO)
    }

    fn move_on(&mut self, step: MacroStep) {
        self.history.push(step.length, &self.ends);
        if let Some(sequence) = &mut self.sequence {
            sequence.outputs.push(step.length, &sequence.ends);
        }
    }

    fn multipliers_at(&self, parts: &Parts, sample: usize, multipliers: &mut [f64]) {
        let outputs = |subsystem: usize| parts.subsystems[subsystem].sample(sample);
        write_loads(&self.springs, &parts.layout, outputs, multipliers);
    }
}

impl Sequence {
    fn new(degree: usize, parts: &Parts) -> Self {
        let mut newest = Vec::new();
        let places = parts.subsystems.iter().map(|subsystem| {
            let start = newest.len();
            newest.extend_from_slice(subsystem.coupling_values());
            start..newest.len()
        });
        let places = places.collect();
        let variables = Variables {
            degrees: vec![degree; newest.len()],
            rotations: Vec::new(),
        };
        Self {
            outputs: History::new(variables, &newest, Vec::new()),
            ends: newest,
            places,
        }
    }
}

/// Writes the loads of the springs under these outputs of all subsystems, one for each row, in front of `values`.
pub fn write_loads<'a>(
    springs: &[Spring],
    layout: &Layout,
    outputs: impl Fn(usize) -> &'a [f64] + Copy,
    values: &mut [f64],
) {
    for (row, (spring, value)) in springs.iter().zip(values).enumerate() {
        *value = spring_load(layout, row, spring, outputs);
    }
}

/// Load of the spring in place of a row: `-s (K g + D g')`.
fn spring_load<'a>(
    layout: &Layout,
    row: usize,
    spring: &Spring,
    outputs: impl Fn(usize) -> &'a [f64],
) -> f64 {
    let Row { joint, condition } = layout.rows[row];
    let motion = motion_of(layout, joint, outputs);
    let condition = layout.joints[joint].joint.condition(condition);
    let [g, rate, _] = condition.values(Level::Velocity, &motion);
    -condition.load_power() * (spring.stiffness * g + spring.damping * rate)
}

/// All variables of `history` at the end of the step.
fn extrapolate(history: &History, step: MacroStep, ends: &mut [f64]) {
    for (variable, end) in ends.iter_mut().enumerate() {
        *end = history.value(variable, Curve::Extrapolated, step.length, step.length);
    }
}
