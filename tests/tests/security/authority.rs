//! Certificates that `linchpin certificates` would not make.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use rcgen::{
    CertificateParams, CertifiedIssuer, DnType, ExtendedKeyUsagePurpose, IsCa, KeyPair,
    KeyUsagePurpose,
};
use rustls::crypto::ring;
use rustls::pki_types::pem::PemObject;
use rustls::pki_types::{CertificateDer, PrivateKeyDer};
use rustls::version::TLS13;
use rustls::{ClientConfig, RootCertStore, ServerConfig};
use time::{Duration, OffsetDateTime};

/// An authority of a test.
pub struct Authority(CertifiedIssuer<'static, KeyPair>);

/// A certificate with its key, as PEM.
pub struct Own {
    pub certificate: String,
    pub key: String,
}

impl Authority {
    pub fn new() -> Self {
        let mut params = CertificateParams::new([]).unwrap();
        params.is_ca = IsCa::Ca(rcgen::BasicConstraints::Unconstrained);
        params.key_usages = vec![KeyUsagePurpose::KeyCertSign];
        params
            .distinguished_name
            .push(DnType::CommonName, "authority of a test");
        let key = KeyPair::generate().unwrap();
        Self(CertifiedIssuer::self_signed(params, key).unwrap())
    }

    pub fn pem(&self) -> String {
        self.0.pem()
    }

    /// A certificate that ends so many days from now.
    fn certify(&self, names: &[&str], purpose: ExtendedKeyUsagePurpose, days: i64) -> Own {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        let mut params = CertificateParams::new(names).unwrap();
        params.not_before = OffsetDateTime::now_utc() - Duration::days(10);
        params.not_after = OffsetDateTime::now_utc() + Duration::days(days);
        params.extended_key_usages = vec![purpose];
        let key = KeyPair::generate().unwrap();
        Own {
            certificate: params.signed_by(&key, &self.0).unwrap().pem(),
            key: key.serialize_pem(),
        }
    }

    pub fn master(&self, days: i64) -> Own {
        self.certify(&[], ExtendedKeyUsagePurpose::ClientAuth, days)
    }

    pub fn worker(&self, names: &[&str], days: i64) -> Own {
        self.certify(names, ExtendedKeyUsagePurpose::ServerAuth, days)
    }
}

/// Writes the folder of a master or worker.
pub fn write(folder: &Path, authorities: &str, own: &Own) {
    fs::create_dir_all(folder).unwrap();
    fs::write(folder.join("ca.crt"), authorities).unwrap();
    fs::write(folder.join("tls.crt"), &own.certificate).unwrap();
    fs::write(folder.join("tls.key"), &own.key).unwrap();
}

fn roots(authority: &str) -> RootCertStore {
    let mut roots = RootCertStore::empty();
    for certificate in CertificateDer::pem_slice_iter(authority.as_bytes()) {
        roots.add(certificate.unwrap()).unwrap();
    }
    roots
}

impl Own {
    fn parts(&self) -> (Vec<CertificateDer<'static>>, PrivateKeyDer<'static>) {
        (
            vec![CertificateDer::from_pem_slice(self.certificate.as_bytes()).unwrap()],
            PrivateKeyDer::from_pem_slice(self.key.as_bytes()).unwrap(),
        )
    }
}

/// A client that trusts an authority and shows a certificate, if it has one, whatever that is good for.
pub fn client(authority: &str, own: Option<&Own>) -> Arc<ClientConfig> {
    let config = ClientConfig::builder_with_provider(Arc::new(ring::default_provider()))
        .with_protocol_versions(&[&TLS13])
        .unwrap()
        .with_root_certificates(roots(authority));
    let mut config = match own.map(Own::parts) {
        Some((certificates, key)) => config.with_client_auth_cert(certificates, key).unwrap(),
        None => config.with_no_client_auth(),
    };
    config.alpn_protocols = vec![b"h2".to_vec()];
    Arc::new(config)
}

/// A server that shows a certificate to anyone.
pub fn server(own: &Own) -> Arc<ServerConfig> {
    let (certificates, key) = own.parts();
    let config = ServerConfig::builder_with_provider(Arc::new(ring::default_provider()))
        .with_protocol_versions(&[&TLS13])
        .unwrap()
        .with_no_client_auth()
        .with_single_cert(certificates, key);
    Arc::new(config.unwrap())
}
