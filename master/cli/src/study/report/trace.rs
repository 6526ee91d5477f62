//! Residual and energy over time.

use std::convert::Infallible;

use linchpin_master::results::{Quantity, Row};
use serde::{Deserialize, Serialize};

use crate::results::Thinned;
use crate::simulate::Recorder;
use crate::study::columns::{Column, Kind, places, sum};
use crate::study::reference::Reference;

/// Most points of a curve.
const MOST_POINTS: usize = 1024;

/// What one run shows over time; as far as it came, if it diverged.
#[derive(Serialize, Deserialize)]
pub struct Trace {
    /// Largest residual on position level of all joints (m, rad).
    pub residual: Thinned<(f64, f64)>,
    /// Deviation of the energy from that of the reference, over the largest energy of the reference so far.
    pub energy: Thinned<(f64, f64)>,
}

impl Default for Trace {
    fn default() -> Self {
        Self {
            residual: Thinned::at_most(MOST_POINTS),
            energy: Thinned::at_most(MOST_POINTS),
        }
    }
}

/// Records a [`Trace`].
pub struct TraceRecorder<'a> {
    reference: &'a Reference,
    columns: &'a [Column],
    residuals: Vec<usize>,
    energy: Option<(usize, Vec<usize>)>,
    largest_energy: f64,
    trace: Trace,
}

impl<'a> TraceRecorder<'a> {
    /// Of the judged columns only the energy is looked at.
    pub fn new(reference: &'a Reference, columns: &'a [Column]) -> Self {
        Self {
            reference,
            columns,
            residuals: Vec::new(),
            energy: None,
            largest_energy: 0.0,
            trace: Trace::default(),
        }
    }

    /// What was recorded.
    pub fn into_trace(self) -> Trace {
        self.trace
    }
}

impl Recorder for TraceRecorder<'_> {
    type Error = Infallible;

    fn begin(&mut self, row: &Row) -> Result<(), Infallible> {
        let all = 0..row.columns().len();
        self.residuals = all
            .filter(|place| {
                let quantity = row.descriptions()[*place].quantity;
                quantity == Quantity::Residual && row.is_drawn(*place)
            })
            .collect();
        let columns = self.columns.iter();
        let energy = columns
            .enumerate()
            .find(|(_, own)| own.kind == Kind::Energy);
        self.energy = energy.and_then(|(number, own)| Some((number, places(row, &own.name)?)));
        Ok(())
    }

    fn record(&mut self, row: &Row) -> Result<(), Infallible> {
        let t = row.values()[0];
        let sizes = self
            .residuals
            .iter()
            .map(|place| row.values()[*place].abs());
        if let Some(largest) = sizes.reduce(f64::max) {
            self.trace.residual.push(|| (t, largest));
        }
        if let Some((number, places)) = &self.energy
            && let Some(exact) = self.reference.value(*number, t)
        {
            self.largest_energy = self.largest_energy.max(exact.abs());
            let deviation = (sum(row, places) - exact).abs() / self.largest_energy;
            self.trace.energy.push(|| (t, deviation));
        }
        Ok(())
    }
}
