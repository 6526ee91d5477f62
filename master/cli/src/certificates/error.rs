//! Why certificates are not made.

use std::io;
use std::path::PathBuf;

use linchpin_proto::certificates::CertificatesError;

/// Why certificates are not made.
#[derive(Debug, thiserror::Error)]
pub enum NewCertificatesError {
    /// Nobody would show them.
    #[error(
        "no worker needs a certificate: {}; give workers by --worker NAME=HOST",
        scene.as_ref().map_or_else(
            || "there is no scene".to_owned(),
            |scene| format!("no subsystem of {} has an address https://HOST:PORT", scene.display())
        )
    )]
    NoWorker {
        /// The scene, if one was given.
        scene: Option<PathBuf>,
    },
    /// They would overwrite others.
    #[error(
        "{} is there already, and nothing was written; remove the folder to replace all certificates in it, or choose another one",
        path.display()
    )]
    There {
        /// The file.
        path: PathBuf,
    },
    /// Those that are there cannot be used.
    #[error("{0}; remove the old ones before")]
    Old(#[from] Box<CertificatesError>),
    /// A file cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Unwritable {
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// They cannot be signed.
    #[error("cannot make certificates: {0}")]
    Unsigned(#[from] rcgen::Error),
}
