//! Why an FMU cannot be served.

use std::path::PathBuf;

/// An FMU that cannot be read or loaded.
#[derive(Debug, thiserror::Error)]
pub enum FmuError {
    /// The file cannot be opened.
    #[error(
        "cannot open the FMU {}: {source}; the path counts from the folder of the scene, on the command line from the \
         current one", path.display()
    )]
    Open {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The file is no sound archive.
    #[error("{} is no sound FMU: {reason}; export or copy it anew", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// An entry would be written outside the folder of the FMU.
    #[error(
        "{}: the entry \"{entry}\" would be written outside the folder of the FMU; it was not unpacked. Do not trust this \
         file", path.display()
    )]
    Outside {
        /// The file.
        path: PathBuf,
        /// Name of the entry.
        entry: String,
    },
    /// Too large when unpacked.
    #[error(
        "{}: unpacked it would have more than {limit} bytes, the most that is allowed; remove resources from it that are not \
         needed", path.display()
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// The limit.
        limit: u64,
    },
    /// The folder to unpack to cannot be written.
    #[error("cannot unpack {}: {source}; set TMPDIR to a writable place", path.display())]
    Unpack {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The description says something that is not understood.
    #[error("{}: modelDescription.xml: {reason}", path.display())]
    Description {
        /// The file.
        path: PathBuf,
        /// What is wrong, what is allowed.
        reason: String,
    },
    /// It has no library for this machine.
    #[error(
        "{} has no library for this machine: {wanted} is missing, and it has {}; export it for Linux on x86_64",
        path.display(),
        libraries(.found)
    )]
    Platform {
        /// The file.
        path: PathBuf,
        /// The file that is needed.
        wanted: String,
        /// Folders of other platforms.
        found: Vec<String>,
    },
    /// Another machine than those that are served.
    #[error(
        "FMUs are served on Linux and x86_64 only, and this is {}, {}",
        std::env::consts::OS,
        std::env::consts::ARCH
    )]
    Machine,
    /// The library cannot be loaded.
    #[error("{}: its library cannot be loaded: {reason}", path.display())]
    Load {
        /// The file.
        path: PathBuf,
        /// The loader's reason.
        reason: String,
    },
    /// The library lacks a function.
    #[error(
        "{}: its library has no function {function}, which FMI {version} demands{}; export it anew",
        path.display(),
        because(.flag.as_deref())
    )]
    Function {
        /// The file.
        path: PathBuf,
        /// Name of the function.
        function: String,
        /// Version of FMI.
        version: &'static str,
        /// The flag of the description for which it is needed.
        flag: Option<String>,
    },
    /// This build cannot load libraries.
    #[error(
        "{}: this linchpin is linked statically and cannot load the library of an FMU; build the dynamic one with `cargo \
         build --release`, and serve the FMU with that", path.display()
    )]
    Static {
        /// The file.
        path: PathBuf,
    },
}

fn libraries(folders: &[String]) -> String {
    match folders {
        [] => "none at all".to_owned(),
        folders => format!("libraries for {}", folders.join(", ")),
    }
}

fn because(flag: Option<&str>) -> String {
    flag.map_or_else(String::new, |flag| format!(" because it says {flag}"))
}
