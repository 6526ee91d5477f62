//! What a run tells: rows, residuals, verdicts, statistics.

mod guard;
mod integrations;
mod row;
mod statistics;
mod verdict;

pub use guard::Guard;
pub use integrations::{Cause, Integrations};
pub use row::{Drawn, Row};
pub use statistics::{
    ContactStatistics, Corrections, DegreeStatistics, JointResiduals, Rejections, Statistics,
    StepStatistics, SubsystemStatistics,
};
pub use verdict::{Defect, Verdict};
