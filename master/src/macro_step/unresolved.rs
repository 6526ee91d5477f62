//! Connected signals that the polynomials over a macro step do not resolve: jumps, pulses, vibrations of many periods.

use super::correcting::Correcting;
use crate::accuracy::{Estimate, Suspect, Tolerance};
use crate::layout::What;
use crate::system::{Outputs, moved};
use crate::workers::Ahead;

/// A curve that misses its signal inside the step by more than this share of what the signal does there says nothing about it.
const UNRESOLVED: f64 = 0.02;

impl Correcting<'_> {
    /// Adds signals that the step does not resolve. Moments of the difference between curve and signal vanish whatever is between them, so the
    /// values themselves are compared at the instants that the worker tells: the error is what the curve misses.
    pub fn add_unresolved_signals(&mut self, tolerance: &Tolerance, estimate: &mut Estimate) {
        let inside = &self.layout.inside;
        if inside.shares.is_empty() {
            return;
        }
        let ahead = self.workers.looked(Ahead::Step);
        let now = self.workers.now();
        let own = &mut *self.own;
        let system = &own.end.system;
        system.raise(self.layout, &own.change, &mut own.raised);
        let curves = self.method.point().inside;
        for exchanged in self
            .layout
            .exchanged
            .iter()
            .filter(|one| one.rates.is_none())
        {
            let What::Output(place) = exchanged.what else {
                continue;
            };
            let subsystem = exchanged.subsystem;
            let outputs = self.layout.outputs[subsystem].len();
            let start = now.of(subsystem)[place];
            let mut range = [start, start];
            let mut missed: f64 = 0.0;
            // Integrals are met like moments, and say nothing of what is between.
            for (look, curve) in curves.iter().enumerate().skip(inside.weights) {
                let told = inside.find(subsystem, look, place);
                let Some(told) = told.filter(|told| *told < ahead.inside(subsystem).len()) else {
                    continue;
                };
                let columns = system.columns_of(self.layout, subsystem);
                let all = own.end.columns.all();
                let change = moved(all, columns, outputs + told, &own.raised);
                let value = ahead.inside(subsystem)[told] + change;
                range = [range[0].min(value), range[1].max(value)];
                missed = missed.max((curve[exchanged.first] - value).abs());
            }
            if missed > UNRESOLVED * (range[1] - range[0]) {
                let allowed = tolerance.allowed_in_step(subsystem, exchanged.what);
                estimate.add_error(missed, allowed, 1, Suspect::Variable(exchanged.first));
            }
        }
    }
}
