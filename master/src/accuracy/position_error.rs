//! Errors of positions by the errors of the multipliers, and what a step leaves of the joints open.

use super::estimate::{Estimate, Suspect};
use super::tolerance::Tolerance;
use crate::joint::Level;
use crate::layout::Layout;
use crate::system::{Column, Outputs, System, motion_of, moved};

/// A correction that was solved for, as far as its error is concerned.
#[derive(Clone, Copy)]
pub struct Correction<'a> {
    /// What is coupled.
    pub layout: &'a Layout,
    /// The coupling outputs at the start of the step.
    pub outputs: &'a dyn Outputs,
    /// Length of the step (s).
    pub step: f64,
    /// The system that was solved.
    pub system: &'a System,
    /// Its columns.
    pub columns: &'a [Column],
    /// Change of all unknowns from their prediction.
    pub change: &'a [f64],
    /// Errors of the unknowns of multipliers as positions feel them; 0 for other unknowns.
    pub errors: &'a [f64],
    /// Share of an error in the change.
    pub share: f64,
    /// The power of the step with which errors of positions fall.
    pub order: usize,
}

/// A difference between two solutions.
#[derive(Clone, Copy)]
pub struct Difference<'a> {
    /// What is coupled.
    pub layout: &'a Layout,
    /// The coupling outputs at the start of the step, if what joints inherit open from there is no part of the difference.
    pub outputs: Option<&'a dyn Outputs>,
    /// Length of the step (s).
    pub step: f64,
    /// The system that was solved.
    pub system: &'a System,
    /// Its columns.
    pub columns: &'a [Column],
    /// The difference of all unknowns.
    pub unknowns: &'a [f64],
}

/// How many times its size the closing of an open joint moves positions, or velocities times the length of the step, at most.
const CLOSING: f64 = 4.0;

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

    /// The largest difference over what is allowed: of positions at the joints, of velocities there times the length of the step, and of
    /// connected signals, at the end of the step. What closes a joint again that earlier steps have left open by more than is allowed is no
    /// difference of this one.
    pub fn largest(&mut self, difference: Difference<'_>, tolerance: &Tolerance) -> Estimate {
        let Difference {
            layout,
            system,
            unknowns,
            ..
        } = difference;
        let mut estimate = Estimate::NONE;
        system.raise(layout, unknowns, &mut self.raised);
        let ends = layout.joints.iter().enumerate();
        for (number, end) in
            ends.flat_map(|(number, joint)| joint.ends.iter().map(move |end| (number, end)))
        {
            let inherited = difference
                .outputs
                .map_or([[0.0; 2]; 2], |outputs| openings(layout, outputs, number));
            let inherited = inherited.map(|[opening, rate]| opening + difference.step * rate);
            let subsystem = end.subsystem;
            let columns = system.columns_of(layout, subsystem);
            let change = |output: usize| {
                moved(difference.columns, columns.clone(), output, &self.raised).abs()
            };
            let mut allowed_angle = f64::INFINITY;
            for output in end.positions() {
                let allowed = tolerance.allowed_of_output(subsystem, output);
                let is_angle = !end.coordinates().contains(&output);
                if is_angle {
                    allowed_angle = allowed_angle.min(allowed);
                }
                let change = beyond(change(output), inherited[usize::from(is_angle)], allowed);
                let suspect = Suspect::Output { subsystem, output };
                estimate.add_error(change, allowed, 1, suspect);
            }
            let coordinates = end.coordinates().iter();
            let allowed =
                coordinates.map(|&place| (tolerance.allowed_of_output(subsystem, place), 0));
            let allowed = allowed.chain(std::iter::repeat((allowed_angle, 1)));
            for (output, (allowed, kind)) in end.places(Level::Velocity).zip(allowed) {
                let change = beyond(difference.step * change(output), inherited[kind], allowed);
                let suspect = Suspect::Output { subsystem, output };
                estimate.add_error(change, allowed, 1, suspect);
            }
        }
        for exchanged in layout.exchanged.iter().filter(|one| one.rates.is_none()) {
            let allowed = tolerance.allowed_in_step(exchanged.subsystem, exchanged.what);
            for variable in exchanged.first..exchanged.first + exchanged.size() {
                let change = unknowns[system.unknowns().of(variable).start].abs();
                estimate.add_error(change, allowed, 1, Suspect::Variable(variable));
            }
        }
        estimate
    }

    /// Visits the positions at all joints: subsystem and output, whether it is a length, and by how much multipliers of these values move it over
    /// the step.
    pub fn visit_effects(
        &mut self,
        layout: &Layout,
        end: (&System, &[Column]),
        unknowns: &[f64],
        visit: &mut dyn FnMut([usize; 2], bool, f64),
    ) {
        let (system, all) = end;
        system.raise(layout, unknowns, &mut self.raised);
        for end in layout.joints.iter().flat_map(|joint| &joint.ends) {
            let columns = system.columns_of(layout, end.subsystem);
            for output in end.positions() {
                let effect = moved(all, columns.clone(), output, &self.raised);
                let is_length = end.coordinates().contains(&output);
                visit([end.subsystem, output], is_length, effect);
            }
        }
    }

    /// Adds the errors of the positions at all joints, which are the columns times the errors of the multipliers.
    pub fn add_errors(
        &mut self,
        correction: Correction<'_>,
        tolerance: &Tolerance,
        estimate: &mut Estimate,
    ) {
        let Correction { system, layout, .. } = correction;
        system.raise(layout, correction.errors, &mut self.raised);
        for number in 0..layout.joints.len() {
            self.estimate_joint(number, correction, tolerance, estimate);
        }
    }

    /// Adds the openings of the joints at the end of the step. A joint that earlier steps left open by more than what is allowed must not open
    /// further, but no step need close it at once, however short: joints close at a rate per step.
    pub fn add_openings(
        &mut self,
        correction: Correction<'_>,
        tolerance: &Tolerance,
        estimate: &mut Estimate,
    ) {
        let Correction {
            system,
            layout,
            outputs,
            ..
        } = correction;
        system.shift(Level::Position, correction.change, &mut self.shift);
        let ends = system.residual(Level::Position).iter().zip(&self.shift);
        let mut ends = ends.enumerate();
        for (number, joint) in layout.joints.iter().enumerate() {
            let [[length, _], [angle, _]] = openings(layout, outputs, number);
            let rows = joint.joint.conditions().zip(&mut ends);
            for (condition, (row, (predicted, shift))) in rows {
                let before = if condition.is_length() { length } else { angle };
                let allowed = tolerance.allowed_of_opening(layout, row);
                let inherited = (before - allowed).max(0.0);
                let opening = (predicted + shift).abs() - inherited;
                estimate.add_error(opening, allowed, correction.order, Suspect::Opening(row));
            }
        }
    }

    /// What closes the joint again after errors of earlier steps is no error of this one.
    fn estimate_joint(
        &self,
        number: usize,
        correction: Correction<'_>,
        tolerance: &Tolerance,
        estimate: &mut Estimate,
    ) {
        let Correction {
            layout,
            outputs,
            step,
            ..
        } = correction;
        // How far the joint would be open at the end of the step if no load closed it.
        let inherited =
            openings(layout, outputs, number).map(|[opening, rate]| opening + step * rate);
        for end in &layout.joints[number].ends {
            let subsystem = end.subsystem;
            let columns = correction.system.columns_of(layout, subsystem);
            for output in end.positions() {
                let change = moved(correction.columns, columns.clone(), output, &self.raised);
                let is_angle = !end.coordinates().contains(&output);
                let inherited = inherited[usize::from(is_angle)];
                let error = change.abs() - correction.share.abs() * inherited;
                let allowed = tolerance.allowed_of_output(subsystem, output);
                let suspect = Suspect::Output { subsystem, output };
                estimate.add_error(error, allowed, correction.order, suspect);
            }
        }
    }
}

/// The part of a change that does not close what is open by more than `allowed`. While joints close nothing is known of the error, which is
/// no reason for longer steps: half of what is allowed remains.
fn beyond(change: f64, open: f64, allowed: f64) -> f64 {
    let closing = CLOSING * (open - allowed).max(0.0);
    (change - closing).max(change.min(0.5 * allowed))
}

/// How far a joint is open at the start of the step, and how fast it opens, in m and in rad.
fn openings(layout: &Layout, outputs: &dyn Outputs, number: usize) -> [[f64; 2]; 2] {
    let motion = motion_of(layout, number, |subsystem| outputs.of(subsystem));
    let mut openings = [[0.0_f64; 2]; 2];
    for condition in layout.joints[number].joint.conditions() {
        let values = condition.values(layout.level, &motion);
        let [opening, rate] = &mut openings[usize::from(!condition.is_length())];
        *opening = opening.max(values[0].abs());
        *rate = rate.max(values[1].abs());
    }
    openings
}
