//! A time series in bounded memory, for pictures.

use linchpin_master::results::Drawn;

use super::Thinned;

/// Most points that are kept.
const MOST_POINTS: usize = 1 << 16;

/// Points `(t, y)` of a long run.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Result column.
    pub name: String,
    /// What it shows.
    pub kind: Drawn,
    /// Times in s and values.
    pub points: Thinned<(f64, f64)>,
}

impl Trace {
    /// An empty series of a result column.
    pub fn new(name: &str, kind: Drawn) -> Self {
        Self {
            name: name.to_owned(),
            kind,
            points: Thinned::at_most(MOST_POINTS),
        }
    }
}
