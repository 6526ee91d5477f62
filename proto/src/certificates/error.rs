//! Why certificates cannot be used.

use std::io;
use std::path::{Path, PathBuf};

use rustls::pki_types::pem;

use super::{AUTHORITY, CERTIFICATE, KEY};

/// Why the certificates of a folder cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum CertificatesError {
    /// A file cannot be read.
    #[error(
        "cannot read {}: {source}; a folder of certificates has {AUTHORITY}, {CERTIFICATE} and {KEY}, as linchpin certificates \
         makes them, and its path counts from the current folder",
        path.display()
    )]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// A file is not what it should be.
    #[error("{}: {reason}; it must be a file in PEM, as linchpin certificates makes them", path.display())]
    NotPem {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// No authority can be made of a certificate.
    #[error("{} is not the certificate of an authority: {reason}; take the one that made the certificates of both ends", path.display())]
    NoAuthority {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// Every peer would refuse it.
    #[error("{} will not do for {who}: {reason}; make new ones with linchpin certificates", path.display())]
    Unusable {
        /// The file.
        path: PathBuf,
        /// What it was to be used for.
        who: &'static str,
        /// What is wrong with it.
        reason: String,
    },
}

impl CertificatesError {
    pub(super) fn not_pem(path: &Path, error: &pem::Error) -> Self {
        let reason = match error {
            pem::Error::NoItemsFound => "there is no key in it".to_owned(),
            other => other.to_string(),
        };
        Self::NotPem {
            path: path.to_owned(),
            reason,
        }
    }
}
