//! What a run tells: rows, residuals, verdicts, statistics.

mod guard;
mod row;
mod statistics;
mod verdict;

pub use guard::Guard;
pub use row::{Drawn, Row};
pub use statistics::{JointResiduals, Statistics, StepStatistics, SubsystemStatistics};
pub use verdict::{Defect, Verdict};
