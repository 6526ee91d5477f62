//! Errors of positions by loads that act on one end of a joint and not on the other.
//!
//! A load that both ends feel is taken back by the spring between them. One that only one of them feels pushes the whole mechanism, and
//! nothing takes it back: the acceleration `a` that it causes lasts as long as the steps are like this one. It counts with the way `a T^2`
//! that it makes in the time `T` in which the motion of the marker changes as much as it is large: for an oscillation about 1/omega.
//!
//! What acceleration a load causes is measured: every load input is raised by a constant in a look-ahead that changes no state, and the
//! velocities at its end are compared.

use nalgebra::{UnitQuaternion, Vector3};

use super::error_estimate::{ErrorScales, Estimate, Suspect};
use crate::error::RunError;
use crate::joint::MarkerChange;
use crate::layout::{BoundEnd, DrivenInput, Layout};
use crate::scene::Increment;
use crate::system::Column;
use crate::time::MacroStep;
use crate::workers::{Ahead, Parts, exchange};

/// The responses are measured anew when something has moved by this share of its size: bodies turn, and masses with them.
const MEASURED_FOR: f64 = 0.3;

/// Responses to loads, and how fast the markers move.
pub struct Unbalanced {
    /// Of every input of the layout; those of inputs that are no loads stay empty.
    columns: Vec<Column>,
    /// Number of load inputs of each subsystem.
    raised: Vec<usize>,
    /// Length of the look-ahead that the columns belong to, in s; 0 before the first.
    length: f64,
    /// Path of the motion where they were measured.
    path: f64,
    /// For each joint and end that of its point and that of its turning.
    paces: Vec<[[Pace; 2]; 2]>,
    memory: Vec<f64>,
}

/// The coupling variables at the end of a step, and by how much each row's load at either end is off in the mean over the step.
#[derive(Clone, Copy)]
pub struct Loads<'a> {
    /// Coupling variables.
    pub values: &'a [f64],
    /// What their rotation vectors are relative to.
    pub attitudes: &'a [UnitQuaternion<f64>],
    /// Error of the load of each row at ends a and b.
    pub errors: &'a [[f64; 2]],
    /// The power of the step with which the errors fall.
    pub order: usize,
}

/// The time in which a motion changes as much as it is large.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Pace {
    time: f64,
    velocity: Vector3<f64>,
    /// The same at the end of the step that is tried.
    tried: (f64, Vector3<f64>),
}

impl Pace {
    fn new(span: f64, velocity: Vector3<f64>) -> Self {
        Self {
            time: span,
            velocity,
            tried: (span, velocity),
        }
    }

    /// Size over speed, or the root of size over acceleration; no longer than the time that has gone since it was shorter.
    fn try_step(&mut self, velocity: Vector3<f64>, size: f64, step: f64) -> f64 {
        let acceleration = (velocity - self.velocity).norm() / step;
        let by_speed = size / velocity.norm();
        let by_acceleration = (size / acceleration).sqrt();
        let time = (self.time + step).min(by_speed).min(by_acceleration);
        self.tried = (time, velocity);
        time.max(step)
    }
}

impl Unbalanced {
    /// For the joints of `parts` at a start whose outputs are known, in a run over `span` s.
    pub fn new(parts: &Parts, span: f64) -> Self {
        let layout = &parts.layout;
        let mut raised = vec![0; layout.outputs.len()];
        let column = |input: &DrivenInput| {
            let is_raised = input.is_perturbed && input.drives_load(layout.rows.len());
            let count = &mut raised[input.subsystem];
            let place = is_raised.then_some(*count);
            *count += usize::from(is_raised);
            let mut column = Column::new(input, layout);
            column.place = place;
            column
        };
        let columns = layout.inputs.iter().map(column).collect();
        let pace = |end: &BoundEnd| {
            let motion = end.motion(parts.subsystems[end.subsystem].coupling_values());
            [motion.velocity, motion.omega].map(|velocity| Pace::new(span, velocity))
        };
        let joints = layout.joints.iter();
        Self {
            columns,
            raised,
            length: 0.0,
            path: 0.0,
            paces: joints
                .map(|joint| joint.ends.each_ref().map(pace))
                .collect(),
            memory: Vec::new(),
        }
    }

    /// Measures the responses from the present macro point over `step`, if they have to be. `value` gives the present value of an input.
    pub fn measure(
        &mut self,
        parts: &mut Parts,
        step: MacroStep,
        scales: &ErrorScales,
        value: impl Fn(&DrivenInput) -> f64,
    ) -> Result<(), RunError> {
        let path = scales.longest_path();
        if self.length > 0.0 && path - self.path < MEASURED_FOR {
            return Ok(());
        }
        (self.length, self.path) = (step.length, path);
        parts.forgo_advance();
        parts.prepare_prediction(step.start, step.length);
        self.request(parts, value);
        exchange(&mut parts.subsystems, step)?;
        parts.forgo_prediction();
        for (input, column) in parts.layout.inputs.iter().zip(&mut self.columns) {
            let subsystem = &parts.subsystems[input.subsystem];
            let (predicted, perturbed) = subsystem.looked(Ahead::Step);
            if let Some(place) = column.place {
                column.difference(predicted, &perturbed[place].values);
            }
        }
        Ok(())
    }

    fn request(&mut self, parts: &mut Parts, value: impl Fn(&DrivenInput) -> f64) {
        for (subsystem, &raised) in parts.subsystems.iter_mut().zip(&self.raised) {
            if subsystem.is_read() {
                let look = subsystem.look(Ahead::Step);
                look.perturbed.resize_with(raised, Default::default);
            }
        }
        for (input, column) in parts.layout.inputs.iter().zip(&mut self.columns) {
            let subsystem = &mut parts.subsystems[input.subsystem];
            if !subsystem.is_read() {
                continue;
            }
            let now = value(input);
            let signal = subsystem.look_signal(Ahead::Step, input.place);
            signal.set_constant(now);
            let Some(place) = column.place else {
                continue;
            };
            column.choose_increment(Increment::Automatic, now, None);
            let raised = subsystem.perturbed_signal(Ahead::Step, place, input.place);
            raised.set_constant(now + column.increment);
        }
    }

    /// Adds the errors of the positions at all joints at the end of `step`, which was tried.
    pub fn estimate(
        &mut self,
        parts: &Parts,
        step: MacroStep,
        loads: Loads<'_>,
        scales: &ErrorScales,
        estimate: &mut Estimate,
    ) {
        for joint in 0..parts.layout.joints.len() {
            for (place, end) in parts.layout.joints[joint].ends.iter().enumerate() {
                let outputs = parts.subsystems[end.subsystem].coupling_values();
                let motion = end.motion(outputs);
                let error = self.acceleration(&parts.layout, end, outputs, loads);
                let point = end.coordinates().first().copied();
                let mut places = end.positions();
                let turning = places.find(|place| !end.coordinates().contains(place));
                let parts = [
                    (point, motion.velocity, error.velocity),
                    (turning, motion.omega, error.omega),
                ];
                for ((output, velocity, error), pace) in
                    parts.into_iter().zip(&mut self.paces[joint][place])
                {
                    let Some(output) = output else { continue };
                    let subsystem = end.subsystem;
                    let size = scales.size_of_output(subsystem, output);
                    let time = pace.try_step(velocity, size, step.length);
                    let way = error.norm() * time * time;
                    let allowed = scales.allowed_of_output(subsystem, output);
                    let suspect = Suspect::Output { subsystem, output };
                    estimate.add(way / allowed, loads.order, suspect);
                }
            }
        }
    }

    /// The acceleration of a marker by the errors of all loads on its subsystem, as rates of its velocities.
    fn acceleration(
        &mut self,
        layout: &Layout,
        end: &BoundEnd,
        outputs: &[f64],
        loads: Loads<'_>,
    ) -> MarkerChange {
        let memory = &mut self.memory;
        memory.clear();
        memory.extend_from_slice(loads.values);
        for (row, errors) in loads.errors.iter().enumerate() {
            for (own, error) in layout.joint_of(row).ends.iter().zip(errors) {
                if own.subsystem == end.subsystem {
                    memory[row] += error;
                }
            }
        }
        let mut sum = MarkerChange::default();
        for number in layout.input_range(end.subsystem) {
            let (input, column) = (&layout.inputs[number], &self.columns[number]);
            if column.place.is_none() {
                continue;
            }
            let off = input.value(memory, loads.attitudes);
            let error = off - input.value(loads.values, loads.attitudes);
            let response = end.change(outputs, &column.derivatives);
            sum.velocity += response.velocity * (error / self.length);
            sum.omega += response.omega * (error / self.length);
        }
        sum
    }

    /// The step that was tried stays.
    pub fn move_on(&mut self) {
        for pace in self.paces.iter_mut().flatten().flatten() {
            (pace.time, pace.velocity) = pace.tried;
        }
    }
}
