//! What a correction promises, and what the workers make of it.

use super::system::{System, motion_of};
use crate::cosimulation::Parts;
use crate::joint::Level;
use crate::results::{Defect, Verdict};

/// The position conditions of the prediction, and their linear shift under the correction.
pub struct Promise {
    predicted: Vec<f64>,
    shift: Vec<f64>,
}

impl Promise {
    /// For a system with `size` rows.
    pub fn new(size: usize) -> Self {
        Self {
            predicted: vec![0.0; size],
            shift: vec![0.0; size],
        }
    }

    /// Keeps what `system` says of the prediction.
    pub fn take(&mut self, system: &System) {
        self.predicted
            .copy_from_slice(system.residual(Level::Position));
    }

    /// Compares the position conditions at the outputs after the advance with what their linearisation in `system` promised
    /// for the `change` of the unknowns.
    pub fn judge(&mut self, system: &System, parts: &Parts, change: &[f64]) -> Verdict {
        system.shift(Level::Position, change, &mut self.shift);
        let corrected = |subsystem: usize| parts.subsystems[subsystem].coupling_values();
        let mut defect = Defect::default();
        let mut terms = self.predicted.iter().zip(&self.shift);
        for (number, joint) in parts.layout.joints.iter().enumerate() {
            let motion = motion_of(&parts.layout, number, corrected);
            let rows = joint.joint.conditions().zip(&mut terms);
            for (condition, (predicted, shift)) in rows {
                let found = condition.value(Level::Position, &motion);
                let extent = condition.extent(Level::Position, &motion);
                defect.add(*predicted, *shift, found, extent);
            }
        }
        defect.verdict()
    }
}
