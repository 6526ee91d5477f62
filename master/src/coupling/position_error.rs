//! Errors of positions by the errors of the multipliers, and what a step leaves of the joints open.

use super::columns::Columns;
use super::error_estimate::{ErrorScales, Estimate, Suspect};
use crate::joint::Level;
use crate::system::{System, motion_of};
use crate::time::MacroStep;
use crate::workers::Parts;

/// A correction that was solved for, as far as its error is concerned.
#[derive(Clone, Copy)]
pub struct Correction<'a> {
    /// The system that was solved.
    pub system: &'a System,
    /// Its columns.
    pub columns: &'a Columns,
    /// Change of all unknowns from their prediction.
    pub change: &'a [f64],
    /// Errors of the unknowns of multipliers as positions feel them; 0 for other unknowns.
    pub errors: &'a [f64],
    /// Share of an error in the change.
    pub share: f64,
    /// The power of the step with which errors of positions fall.
    pub order: usize,
}

/// Memory for the estimate.
#[derive(Debug, Clone, Default)]
pub struct PositionErrors {
    raised: Vec<f64>,
    shift: Vec<f64>,
}

impl PositionErrors {
    /// For a system with `size` rows.
    pub fn new(size: usize) -> Self {
        Self {
            raised: Vec::new(),
            shift: vec![0.0; size],
        }
    }

    /// Adds the errors of the positions at all joints, which are the columns times the errors of the multipliers.
    pub fn add_errors(
        &mut self,
        parts: &Parts,
        step: MacroStep,
        correction: Correction<'_>,
        scales: &ErrorScales,
        estimate: &mut Estimate,
    ) {
        let system = correction.system;
        system.raise(&parts.layout, correction.errors, &mut self.raised);
        for number in 0..parts.layout.joints.len() {
            self.estimate_joint(parts, number, step, correction, scales, estimate);
        }
    }

    /// Adds the openings of the joints at the end of the step. A joint that earlier steps left open by more than what is allowed must not open
    /// further, but no step need close it at once, however short: joints close at a rate per step.
    pub fn add_openings(
        &mut self,
        parts: &Parts,
        correction: Correction<'_>,
        scales: &ErrorScales,
        estimate: &mut Estimate,
    ) {
        let system = correction.system;
        system.shift(Level::Position, correction.change, &mut self.shift);
        let ends = system.residual(Level::Position).iter().zip(&self.shift);
        let mut ends = ends.enumerate();
        for (number, joint) in parts.layout.joints.iter().enumerate() {
            let [[length, _], [angle, _]] = openings(parts, number);
            let rows = joint.joint.conditions().zip(&mut ends);
            for (condition, (row, (predicted, shift))) in rows {
                let before = if condition.is_length() { length } else { angle };
                let allowed = scales.allowed_of_opening(&parts.layout, row);
                let inherited = (before - allowed).max(0.0);
                let scaled = ((predicted + shift).abs() - inherited) / allowed;
                estimate.add(scaled, correction.order, Suspect::Opening(row));
            }
        }
    }

    /// What closes the joint again after errors of earlier steps is no error of this one.
    fn estimate_joint(
        &self,
        parts: &Parts,
        number: usize,
        step: MacroStep,
        correction: Correction<'_>,
        scales: &ErrorScales,
        estimate: &mut Estimate,
    ) {
        // How far the joint would be open at the end of the step if no load closed it.
        let inherited = openings(parts, number).map(|[opening, rate]| opening + step.length * rate);
        for end in &parts.layout.joints[number].ends {
            let subsystem = end.subsystem;
            let columns = correction.system.columns_of(&parts.layout, subsystem);
            for output in end.positions() {
                let responses = columns.clone().filter_map(|column| {
                    let response = correction.columns.all()[column].derivatives.get(output)?;
                    Some(response * self.raised[column])
                });
                let is_angle = !end.coordinates().contains(&output);
                let inherited = inherited[usize::from(is_angle)];
                let error = responses.sum::<f64>().abs() - correction.share.abs() * inherited;
                let scaled = error / scales.allowed_of_output(subsystem, output);
                estimate.add(
                    scaled,
                    correction.order,
                    Suspect::Output { subsystem, output },
                );
            }
        }
    }
}

/// How far a joint is open at the start of the step, and how fast it opens, in m and in rad.
fn openings(parts: &Parts, number: usize) -> [[f64; 2]; 2] {
    let layout = &parts.layout;
    let outputs = |subsystem: usize| parts.subsystems[subsystem].coupling_values();
    let motion = motion_of(layout, number, outputs);
    let mut openings = [[0.0_f64; 2]; 2];
    for condition in layout.joints[number].joint.conditions() {
        let values = condition.values(layout.level, &motion);
        let [opening, rate] = &mut openings[usize::from(!condition.is_length())];
        *opening = opening.max(values[0].abs());
        *rate = rate.max(values[1].abs());
    }
    openings
}
