//! What the runs of a convergence study are compared with.

use std::convert::Infallible;

use linchpin_master::results::Row;

use crate::closed_form::{self, ClosedForm};
use crate::simulate::Recorder;
use crate::study::runs::Kind;

/// Exact or nearly exact values of the judged columns.
pub enum Reference {
    /// The exact solution.
    ClosedForm {
        solution: ClosedForm,
        quantities: Vec<Option<closed_form::Quantity>>,
    },
    /// A run with a small macro step.
    Run(Trajectory),
}

impl Reference {
    pub fn closed_form(solution: ClosedForm, columns: &[(String, Kind)]) -> Self {
        let quantities = columns.iter().map(|(column, _)| solution.quantity(column));
        Self::ClosedForm {
            quantities: quantities.collect(),
            solution,
        }
    }

    /// Value of a column at time `t`; `None` where nothing is known.
    pub fn value(&self, column: usize, t: f64) -> Option<f64> {
        match self {
            Self::ClosedForm {
                solution,
                quantities,
            } => solution.value(quantities[column]?, t),
            Self::Run(trajectory) => trajectory.value(column, t),
        }
    }
}

/// The macro points of a run.
pub struct Trajectory {
    t: Vec<f64>,
    /// Row after row.
    values: Vec<f64>,
    columns: usize,
    largest_step: f64,
}

/// Macro points of two grids are the same if they differ by less than this share of a step.
const SAME_POINT: f64 = 1e-6;

impl Trajectory {
    fn value(&self, column: usize, t: f64) -> Option<f64> {
        let tolerance = SAME_POINT * self.largest_step;
        let place = self.t.partition_point(|&known| known < t - tolerance);
        let known = self.t.get(place)?;
        let is_common = (known - t).abs() <= tolerance;
        is_common.then(|| self.values[place * self.columns + column])
    }
}

/// Keeps a whole run.
pub struct TrajectoryRecorder<'a> {
    columns: &'a [(String, Kind)],
    places: Vec<Option<usize>>,
    trajectory: Trajectory,
}

impl<'a> TrajectoryRecorder<'a> {
    pub fn new(columns: &'a [(String, Kind)]) -> Self {
        Self {
            columns,
            places: Vec::new(),
            trajectory: Trajectory {
                t: Vec::new(),
                values: Vec::new(),
                columns: columns.len(),
                largest_step: 0.0,
            },
        }
    }

    pub fn into_reference(self) -> Reference {
        Reference::Run(self.trajectory)
    }
}

impl Recorder for TrajectoryRecorder<'_> {
    type Error = Infallible;

    fn begin(&mut self, row: &Row) -> Result<(), Infallible> {
        self.places = places(row, self.columns);
        Ok(())
    }

    fn record(&mut self, row: &Row) -> Result<(), Infallible> {
        let (t, own) = (row.values()[0], &mut self.trajectory);
        if let Some(before) = own.t.last() {
            own.largest_step = own.largest_step.max(t - before);
        }
        own.t.push(t);
        let values = self.places.iter();
        own.values
            .extend(values.map(|place| place.map_or(f64::NAN, |place| row.values()[place])));
        Ok(())
    }
}

/// Where the judged columns stand in a row.
pub fn places(row: &Row, columns: &[(String, Kind)]) -> Vec<Option<usize>> {
    let place = |(column, _): &(String, Kind)| row.columns().iter().position(|name| name == column);
    columns.iter().map(place).collect()
}
