//! What a run leaves behind: table, report, picture.

mod about;
mod checkpoints;
mod figure;
mod impacts;
mod recorder;
mod report;
mod table;
mod thinned;
mod trace;

pub use about::About;
pub use figure::draw;
pub use impacts::Impacts;
pub use recorder::RunRecorder;
pub use report::RunReport;
pub use thinned::Thinned;
pub use trace::Trace;
