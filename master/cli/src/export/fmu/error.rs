//! Why a scene is no FMU.

use std::path::PathBuf;

use linchpin_master::RunError;
use linchpin_master::scene::SceneErrors;

/// Why a scene cannot be exported, or what was exported cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum FmuExportError {
    /// Mistakes in the scene.
    #[error(transparent)]
    Scene(Box<SceneErrors>),
    /// The scene does not start.
    #[error(transparent)]
    Run(Box<RunError>),
    /// No setting.
    #[error("\"{0}\" is no setting of a scene; write KEY=VALUE")]
    NoSetting(String),
    /// A scene with cases.
    #[error("the scene has cases, and an FMU has one of them: give --case with one of {}", .0.join(", "))]
    WhichCase(Vec<String>),
    /// No such case.
    #[error("the scene has no case \"{name}\"; {}", cases(known))]
    NoCase {
        /// What was asked for.
        name: String,
        /// Those that there are.
        known: Vec<String>,
    },
    /// No such output.
    #[error("the scene has no result column \"{name}\"; name others in output.variables; it has: {}", known.join(", "))]
    NoOutput {
        /// What was asked for.
        name: String,
        /// Those that there are.
        known: Vec<String>,
    },
    /// No such parameter.
    #[error("\"{name}\" is no parameter with a number: write SUBSYSTEM.NAME; the scene has: {}", known.join(", "))]
    NoParameter {
        /// What was asked for.
        name: String,
        /// Those that there are.
        known: Vec<String>,
    },
    /// A name twice.
    #[error("\"{0}\" is given twice")]
    Twice(String),
    /// FMUs in the scene.
    #[error(
        "subsystem \"{0}\" is an FMU itself, which a scene inside an FMU cannot serve; start it as a worker, and give its address"
    )]
    FmuInside(String),
    /// The library is not where the program is.
    #[error(
        "there is no {}: the library that runs a scene inside an FMU is built with `cargo build --release --workspace`, and belongs beside the program",
        path.display()
    )]
    NoLibrary {
        /// Where it is looked for.
        path: PathBuf,
    },
    /// The archive cannot be written.
    #[error("{}: {what}", path.display())]
    Unwritable {
        /// The archive.
        path: PathBuf,
        /// The reason.
        what: String,
    },
    /// The resources of an FMU cannot be read.
    #[error("{}: {what}; the FMU is damaged, or was not unpacked as a whole", path.display())]
    Resources {
        /// The file.
        path: PathBuf,
        /// The reason.
        what: String,
    },
}

fn cases(known: &[String]) -> String {
    match known {
        [] => "it has none".to_owned(),
        known => format!("it has: {}", known.join(", ")),
    }
}
