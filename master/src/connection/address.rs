//! Where a worker listens, and whether it may be called there in plain text.

use std::net::IpAddr;
use std::sync::Arc;

use linchpin_proto::token::Token;
use rustls::ClientConfig;
use tonic::transport::Uri;

/// The address of a worker.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum WorkerAddress {
    /// `unix:/PATH`
    Unix,
    /// `http://HOST:PORT`: plain text.
    Plain(Host),
    /// `https://HOST:PORT`: TLS.
    Tls(Host),
}

/// A machine and a port.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Host {
    /// Its name or number.
    pub name: String,
    /// The port.
    pub port: u16,
}

impl Host {
    /// Whether it is this machine for sure.
    pub(super) fn is_loopback(&self) -> bool {
        let number = self.name.parse::<IpAddr>();
        number.map_or(self.name == "localhost", |number| number.is_loopback())
    }
}

impl WorkerAddress {
    /// Reads `http://HOST:PORT`, `https://HOST:PORT` or `unix:/PATH`.
    pub fn parse(text: &str) -> Option<Self> {
        if let Some(path) = text.strip_prefix("unix:/") {
            let is_path = !path.trim_matches('/').is_empty() && !path.contains('\0');
            return is_path.then_some(Self::Unix);
        }
        let uri: Uri = text.parse().ok()?;
        if uri.path_and_query().is_some_and(|path| path != "/") {
            return None;
        }
        let name = uri.host()?.trim_start_matches('[').trim_end_matches(']');
        let host = Host {
            name: name.to_owned(),
            port: uri.port_u16().filter(|port| *port > 0)?,
        };
        match uri.scheme_str() {
            _ if name.is_empty() => None,
            Some("http") => Some(Self::Plain(host)),
            Some("https") => Some(Self::Tls(host)),
            _ => None,
        }
    }
}

/// By what right a master calls workers.
#[derive(Debug, Clone, Default)]
pub struct Access {
    /// Certificates for TLS.
    pub tls: Option<Arc<ClientConfig>>,
    /// Whether workers of other machines may be called in plain text.
    pub plain_text: bool,
    /// What is shown to workers, but not in plain text over a network.
    pub token: Option<Token>,
}

/// Why a worker is not called.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoAccess {
    /// It is reached by TLS, and there are no certificates.
    NoCertificates,
    /// It would be called in plain text over a network.
    PlainText,
}

impl WorkerAddress {
    /// Whether a master may call the worker.
    ///
    /// # Errors
    /// [`NoAccess`].
    pub fn check(&self, has_certificates: bool, plain_text: bool) -> Result<(), NoAccess> {
        match self {
            Self::Tls(_) if !has_certificates => Err(NoAccess::NoCertificates),
            Self::Plain(host) if !(plain_text || host.is_loopback()) => Err(NoAccess::PlainText),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checked(text: &str) -> Result<(), NoAccess> {
        WorkerAddress::parse(text).unwrap().check(false, false)
    }

    #[test]
    fn plain_text_stays_on_this_machine() {
        for own in [
            "unix:/a",
            "http://127.0.0.1:7",
            "http://[::1]:7",
            "http://localhost:7/",
        ] {
            assert_eq!(checked(own), Ok(()), "{own}");
        }
        for other in [
            "http://worker:7",
            "http://10.0.0.1:7",
            "http://localhost.evil:7",
        ] {
            assert_eq!(checked(other), Err(NoAccess::PlainText), "{other}");
            assert_eq!(
                WorkerAddress::parse(other).unwrap().check(false, true),
                Ok(())
            );
        }
        assert_eq!(
            checked("https://127.0.0.1:7"),
            Err(NoAccess::NoCertificates)
        );
    }

    #[test]
    fn what_is_no_address_is_refused() {
        for wrong in [
            "",
            "h:1",
            "tcp://h:1",
            "http://h",
            "http://h:0",
            "https://:1",
            "unix:a",
            "http://h:1/path",
        ] {
            assert_eq!(WorkerAddress::parse(wrong), None, "{wrong}");
        }
    }
}
