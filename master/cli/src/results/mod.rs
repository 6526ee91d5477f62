//! What a run leaves behind: table, report, picture.

mod figure;
mod recorder;
mod report;
mod trace;

pub use figure::draw;
pub use recorder::RunRecorder;
pub use report::RunReport;
pub use trace::Trace;
