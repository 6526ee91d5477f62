//! The error of a step of Hermite coupling, from predicted against corrected curves.

use super::Hermite;
use crate::coupling::attempts::CHORD_ORDER;
use crate::coupling::error_estimate::{ErrorScales, Estimate, Suspect};
use crate::coupling::position_error::Correction;
use crate::time::MacroStep;
use crate::workers::Parts;

/// Mean error of exchanged motion over the step, per difference between predicted and corrected end: the curve of degree 4 misses
/// `s^3 (s - 1)^2`, whose mean is 1/60, times a term that falls faster than the difference does.
const MOTION_SHARE: f64 = 1.0 / 60.0;

/// The power of the step with which that difference falls.
const MOTION_ORDER: usize = 4;

impl Hermite {
    /// Positions feel what the polynomials of the multipliers miss; exchanged motion and signals are off by the mean error of their curves.
    pub(super) fn estimate(
        &mut self,
        parts: &Parts,
        step: MacroStep,
        scales: &ErrorScales,
    ) -> Estimate {
        let mut estimate = Estimate::NONE;
        let rows = parts.layout.rows.len();
        let unknowns = self.end.system.unknowns();
        let loads = (0..rows).map(|row| unknowns.of(row).end).max().unwrap_or(0);
        let shares = self.arcs.load_error();
        self.errors.fill(0.0);
        for (error, change) in self.errors[..loads].iter_mut().zip(&self.change) {
            *error = shares.position * change;
            estimate.change = estimate.change.max(change.abs());
        }
        let correction = Correction {
            system: &self.end.system,
            columns: &self.end.columns,
            change: &self.change,
            errors: &self.errors,
            share: shares.position,
            order: shares.order + 2,
        };
        self.position_errors
            .add_errors(parts, step, correction, scales, &mut estimate);
        self.position_errors
            .add_openings(parts, correction, scales, &mut estimate);
        self.add_errors_of_exchanged(parts, step, scales, &mut estimate);
        estimate
    }

    fn add_errors_of_exchanged(
        &self,
        parts: &Parts,
        step: MacroStep,
        scales: &ErrorScales,
        estimate: &mut Estimate,
    ) {
        for exchanged in &parts.layout.exchanged {
            let allowed = scales.allowed_of_variable(exchanged.subsystem, exchanged.what);
            for variable in exchanged.first..exchanged.first + exchanged.size() {
                let change = self.change[self.end.system.unknowns().of(variable).start];
                let start = self.arcs.chord_start(variable);
                let chord = start.and_then(|start| self.attempts.chord_error(variable, start));
                let (error, order) = match (exchanged.rates.is_some(), chord) {
                    (true, _) => (MOTION_SHARE * change, MOTION_ORDER),
                    (false, Some(error)) => (error, CHORD_ORDER),
                    (false, None) => {
                        let shares = self.arcs.signal_error(variable, step.length);
                        (shares.mean * change, shares.order)
                    }
                };
                estimate.add(error.abs() / allowed, order, Suspect::Variable(variable));
            }
        }
    }
}
