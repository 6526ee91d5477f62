//! The folder that a command writes to: whose it is, and what `run.json` says of the command.
//!
//! * [`checkpoint`]: what a run needs to go on when its process has ended;
//! * [`folder`]: one command at a time writes to a folder;
//! * [`part`]: that of one part of a study, and all parts together;
//! * [`program`]: which program writes, where and since when;
//! * [`status`]: `run.json`, from the first moment to the end;
//! * [`study`]: that of a study;
//! * [`worker_logs`]: what the workers of a run print.

pub mod checkpoint;
pub mod folder;
pub mod part;
pub mod program;
pub mod status;
pub mod study;
pub mod worker_logs;

pub use folder::OutputFolder;
pub use program::Program;
pub use status::{Ending, StatusFile};
