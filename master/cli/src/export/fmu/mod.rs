//! A scene as an FMU for co-simulation: the scene and what it shows, a description of both, and the library that runs it.
//!
//! * [`contents`]: what the library finds in the archive;
//! * [`variables`]: what an importer sees;
//! * `description`: `modelDescription.xml`;
//! * [`archive`]: the file.

pub mod archive;
pub mod contents;
mod description;
mod error;
pub mod variables;

pub use contents::Contents;
pub use description::Version;
pub use error::FmuExportError;
pub use variables::Exported;
