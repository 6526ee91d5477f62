//! What a run leaves behind: table, report, picture; and what is read back of them.

pub(crate) mod about;
mod checkpoints;
mod figure;
mod panels;
mod recorded;
mod recorder;
mod recording;
mod report;
mod table;
mod thinned;
mod times;
mod trace;

pub use about::{About, ReportedColumn};
pub use figure::{Target, draw};
pub use panels::Shown;
pub use recorded::{ReadError, Recorded};
pub use recorder::RunRecorder;
pub use recording::{ChosenBy, Plan, Recording};
pub use report::RunReport;
pub use thinned::Thinned;
pub use times::{Impacts, Rejections};
pub use trace::Trace;
