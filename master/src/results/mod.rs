//! What a run tells: rows, residuals, verdicts, statistics.

mod column;
mod contacts;
mod described;
mod fitted_joint;
mod free_velocity;
mod growth;
mod guard;
mod integrations;
mod mechanism;
mod moments;
mod outcome;
mod redundancy;
mod row;
mod singular_passages;
mod statistics;
mod step_degrees;
mod verdict;
mod warning;

pub use crate::accuracy::RunErrors;
pub use column::{Column, MarkerPart, Quantity};
pub use contacts::RecordedContact;
pub(crate) use contacts::outputs as contact_outputs;
pub(crate) use described::described;
pub use fitted_joint::FittedJoint;
pub use free_velocity::FreeVelocity;
pub use guard::Guard;
pub use integrations::{Cause, Integrations};
pub use mechanism::{Mechanism, RecordedJoint, RecordedMarker};
pub use moments::MomentsOf;
pub use outcome::{Outcome, Passes};
pub use redundancy::Redundancy;
pub use row::{OfStep, Row};
pub use singular_passages::SingularPassages;
pub use statistics::{
    ContactStatistics, Corrections, DegreeStatistics, JointResiduals, Recoveries, Rejections,
    Statistics, StepStatistics, SubsystemStatistics,
};
pub use step_degrees::StepDegrees;
pub use verdict::{Defect, Verdict};
pub use warning::Warning;
