//! The internal steps of the last interval, so that they can be repeated.

/// One accepted step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RecordedStep {
    pub tau: f64,
    pub step: f64,
    pub iterations: usize,
    /// Place in the matrix store.
    pub matrices: usize,
}

/// All accepted steps of one interval.
#[derive(Debug, Default)]
pub struct Record {
    start: Vec<f64>,
    length: Option<f64>,
    pub steps: Vec<RecordedStep>,
}

impl Record {
    /// Begins the record of an interval that starts at `y`; it counts once it is completed.
    pub fn begin(&mut self, y: &[f64]) {
        self.start.clear();
        self.start.extend_from_slice(y);
        self.length = None;
        self.steps.clear();
    }

    /// The interval's end was reached.
    pub fn complete(&mut self, length: f64) {
        self.length = Some(length);
    }

    /// Whether this is the interval of the record.
    pub fn is_of(&self, length: f64, y: &[f64]) -> bool {
        self.is_over(length) && self.start == y
    }

    /// Whether this is the length of the record, wherever it started.
    pub fn is_over(&self, length: f64) -> bool {
        self.length == Some(length)
    }
}
