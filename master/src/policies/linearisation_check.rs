//! What a correction promises, and what the workers make of it.

use crate::joint::Level;
use crate::layout::Layout;
use crate::results::{Defect, Verdict};
use crate::system::{Outputs, System, motion_of};

/// The position conditions of the prediction, and their linear shift under the correction.
pub struct LinearisationCheck {
    predicted: Vec<f64>,
    shift: Vec<f64>,
    /// Size of the first correction of the step, if there are several.
    scales: Vec<f64>,
}

impl LinearisationCheck {
    /// For a system with `size` rows.
    pub fn new(size: usize) -> Self {
        Self {
            predicted: vec![0.0; size],
            shift: vec![0.0; size],
            scales: vec![0.0; size],
        }
    }

    /// Keeps what `system` says of the prediction.
    pub fn take(&mut self, system: &System) {
        self.predicted
            .copy_from_slice(system.residual(Level::Position));
    }

    /// A new macro step begins.
    pub fn forget(&mut self) {
        self.scales.fill(0.0);
    }

    /// Keeps the size of a correction that another one follows in the same macro step.
    pub fn remember(&mut self, system: &System, change: &[f64]) {
        system.shift(Level::Position, change, &mut self.shift);
        let terms = self.predicted.iter().zip(&self.shift);
        for (scale, (predicted, shift)) in self.scales.iter_mut().zip(terms) {
            *scale = predicted.abs().max(shift.abs()).max(*scale);
        }
    }

    /// Compares the position conditions at the outputs after the advance with what their linearisation in `system` promised
    /// for the `change` of the unknowns.
    pub fn judge(
        &mut self,
        system: &System,
        layout: &Layout,
        outputs: &dyn Outputs,
        change: &[f64],
    ) -> Verdict {
        system.shift(Level::Position, change, &mut self.shift);
        let corrected = |subsystem: usize| outputs.of(subsystem);
        let mut defect = Defect::default();
        let terms = self.predicted.iter().zip(&self.shift);
        let mut terms = terms.zip(&self.scales);
        for (number, joint) in layout.joints.iter().enumerate() {
            let motion = motion_of(layout, number, corrected);
            let rows = joint.joint.conditions().zip(&mut terms);
            for (condition, ((predicted, shift), first)) in rows {
                let found = condition.value(Level::Position, &motion);
                let extent = condition.extent(Level::Position, &motion);
                let scale = predicted.abs().max(shift.abs()).max(*first);
                defect.add(predicted + shift, scale, found, extent);
            }
        }
        defect.verdict()
    }
}
