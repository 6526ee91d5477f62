//! Where a worker listens.

use std::fmt;
use std::io::ErrorKind;
use std::net::SocketAddr;
use std::os::unix::fs::FileTypeExt;
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// A TCP address or the path of a Unix socket.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Address {
    /// `127.0.0.1:50051`; port 0 lets the system choose.
    Tcp(SocketAddr),
    /// `unix:/run/linchpin/mass1.sock`
    Unix(PathBuf),
}

/// Text that is no address.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("\"{text}\" is no address to listen on; write IP:PORT (as 127.0.0.1:50051) or unix:/PATH")]
pub struct AddressError {
    text: String,
}

impl Address {
    pub(super) fn is_local(&self) -> bool {
        match self {
            Self::Tcp(address) => address.ip().is_loopback(),
            Self::Unix(_) => true,
        }
    }
}

impl FromStr for Address {
    type Err = AddressError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let wrong = || AddressError {
            text: text.to_owned(),
        };
        match text.strip_prefix("unix:") {
            Some(path) if path.starts_with('/') => Ok(Self::Unix(path.into())),
            Some(_) => Err(wrong()),
            None => text.parse().map(Self::Tcp).map_err(|_| wrong()),
        }
    }
}

/// As a master writes it in a scene.
impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Tcp(address) => write!(f, "http://{address}"),
            Self::Unix(path) => write!(f, "unix:{}", path.display()),
        }
    }
}

/// Whether a file is a socket; `None` if there is none.
pub(super) fn is_socket(path: &Path) -> Option<bool> {
    let found = path.symlink_metadata().ok()?;
    Some(found.file_type().is_socket())
}

/// Removes the socket file of a worker that is gone; the file of a living one stays and makes `bind` fail.
pub(super) fn clear_stale(path: &Path) -> std::io::Result<()> {
    if is_socket(path) != Some(true) {
        return Ok(());
    }
    match UnixStream::connect(path) {
        Err(error) if error.kind() == ErrorKind::ConnectionRefused => std::fs::remove_file(path),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_read_and_refused() {
        assert_eq!("unix:/a/b".parse(), Ok(Address::Unix("/a/b".into())));
        assert_eq!(
            "127.0.0.1:7".parse::<Address>().unwrap().to_string(),
            "http://127.0.0.1:7"
        );
        for wrong in [
            "localhost",
            "unix:relative",
            "1.2.3.4",
            "http://127.0.0.1:7",
            "",
        ] {
            assert!(wrong.parse::<Address>().is_err(), "{wrong}");
        }
    }
}
