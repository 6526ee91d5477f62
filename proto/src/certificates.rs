//! Certificates by which masters and workers know each other: a folder with the own certificate, its key, and the certificate of
//! the authority that made it and those of the peers.

mod error;
mod refusal;
mod verifier;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use rustls::client::WebPkiServerVerifier;
use rustls::client::danger::ServerCertVerifier;
use rustls::crypto::{CryptoProvider, ring};
use rustls::pki_types::pem::PemObject;
use rustls::pki_types::{CertificateDer, PrivateKeyDer, ServerName, UnixTime};
use rustls::server::WebPkiClientVerifier;
use rustls::server::danger::ClientCertVerifier;
use rustls::version::TLS13;
use rustls::{CertificateError, ClientConfig, Error, RootCertStore, ServerConfig};

pub use error::CertificatesError;
pub use refusal::{as_seen_by_master, as_seen_by_worker};
use verifier::Masters;

/// The files of the folder. Secrets of Kubernetes and cert-manager have these names as well.
pub const AUTHORITY: &str = "ca.crt";
/// The own certificate.
pub const CERTIFICATE: &str = "tls.crt";
/// The key of the own certificate.
pub const KEY: &str = "tls.key";

/// HTTP/2, which gRPC needs.
const PROTOCOL: &[u8] = b"h2";

/// The certificates of a folder.
pub struct Certificates {
    folder: PathBuf,
    authority: Arc<RootCertStore>,
    own: Vec<CertificateDer<'static>>,
    key: PrivateKeyDer<'static>,
}

impl Certificates {
    /// Reads the folder.
    ///
    /// # Errors
    /// [`CertificatesError::Unreadable`], [`CertificatesError::NotPem`], [`CertificatesError::NoAuthority`].
    pub fn read(folder: &Path) -> Result<Self, CertificatesError> {
        let authority = certificates(&folder.join(AUTHORITY))?;
        let mut roots = RootCertStore::empty();
        for certificate in authority {
            roots
                .add(certificate)
                .map_err(|error| CertificatesError::NoAuthority {
                    path: folder.join(AUTHORITY),
                    reason: error.to_string(),
                })?;
        }
        let path = folder.join(KEY);
        let key = PrivateKeyDer::from_pem_slice(&read(&path)?)
            .map_err(|error| CertificatesError::not_pem(&path, &error))?;
        Ok(Self {
            authority: Arc::new(roots),
            own: certificates(&folder.join(CERTIFICATE))?,
            key,
            folder: folder.to_owned(),
        })
    }

    /// What a worker accepts connections with: only masters whose certificate is from the same authority.
    ///
    /// # Errors
    /// [`CertificatesError::Unusable`]: the own certificate is not valid now, is from another authority or not for a worker, or has
    /// another key.
    pub fn for_worker(&self) -> Result<Arc<ServerConfig>, CertificatesError> {
        let unusable = |error| self.unusable("a worker", &error);
        self.check_as_worker().map_err(unusable)?;
        let masters = Masters::new(self.client_verifier()?, self.own[0].clone());
        let mut config = ServerConfig::builder_with_provider(provider())
            .with_protocol_versions(&[&TLS13])
            .map_err(unusable)?
            .with_client_cert_verifier(Arc::new(masters))
            .with_single_cert(self.own.clone(), self.key.clone_key())
            .map_err(unusable)?;
        config.alpn_protocols = vec![PROTOCOL.to_vec()];
        Ok(Arc::new(config))
    }

    /// What a master connects with: only to workers whose certificate is from the same authority and for the name by which they are
    /// called.
    ///
    /// # Errors
    /// [`CertificatesError::Unusable`], as for a worker. The certificate of a worker will do too: with it a worker may ask itself
    /// for its health.
    pub fn for_master(&self) -> Result<Arc<ClientConfig>, CertificatesError> {
        let unusable = |error| self.unusable("a master", &error);
        let as_master = self.client_verifier()?.verify_client_cert(
            &self.own[0],
            &self.own[1..],
            UnixTime::now(),
        );
        if let Err(error) = as_master {
            self.check_as_worker().map_err(|_| unusable(error))?;
        }
        let mut config = ClientConfig::builder_with_provider(provider())
            .with_protocol_versions(&[&TLS13])
            .map_err(unusable)?
            .with_root_certificates(Arc::clone(&self.authority))
            .with_client_auth_cert(self.own.clone(), self.key.clone_key())
            .map_err(unusable)?;
        config.alpn_protocols = vec![PROTOCOL.to_vec()];
        Ok(Arc::new(config))
    }

    fn client_verifier(&self) -> Result<Arc<dyn ClientCertVerifier>, CertificatesError> {
        WebPkiClientVerifier::builder_with_provider(Arc::clone(&self.authority), provider())
            .build()
            .map_err(|error| CertificatesError::NoAuthority {
                path: self.folder.join(AUTHORITY),
                reason: error.to_string(),
            })
    }

    /// Whether masters will accept the own certificate, under whatever name.
    fn check_as_worker(&self) -> Result<(), Error> {
        let verifier =
            WebPkiServerVerifier::builder_with_provider(Arc::clone(&self.authority), provider())
                .build()
                .map_err(|error| Error::General(error.to_string()))?;
        let name = ServerName::from(std::net::Ipv4Addr::LOCALHOST);
        let (own, more) = (&self.own[0], &self.own[1..]);
        match verifier.verify_server_cert(own, more, &name, &[], UnixTime::now()) {
            // Its names are looked at last.
            Err(Error::InvalidCertificate(
                CertificateError::NotValidForName | CertificateError::NotValidForNameContext { .. },
            ))
            | Ok(_) => Ok(()),
            Err(error) => Err(error),
        }
    }

    fn unusable(&self, who: &'static str, error: &Error) -> CertificatesError {
        CertificatesError::Unusable {
            path: self.folder.join(CERTIFICATE),
            who,
            reason: refusal::of_own(error),
        }
    }
}

fn provider() -> Arc<CryptoProvider> {
    Arc::new(ring::default_provider())
}

fn read(path: &Path) -> Result<Vec<u8>, CertificatesError> {
    std::fs::read(path).map_err(|source| CertificatesError::Unreadable {
        path: path.to_owned(),
        source,
    })
}

/// The certificates of a file, at least one.
fn certificates(path: &Path) -> Result<Vec<CertificateDer<'static>>, CertificatesError> {
    let text = read(path)?;
    let certificates: Result<Vec<_>, _> = CertificateDer::pem_slice_iter(&text).collect();
    let certificates = certificates.map_err(|error| CertificatesError::not_pem(path, &error))?;
    if certificates.is_empty() {
        return Err(CertificatesError::NotPem {
            path: path.to_owned(),
            reason: "there is no certificate in it".to_owned(),
        });
    }
    Ok(certificates)
}
