//! Whom a worker accepts.

use std::sync::Arc;

use rustls::client::danger::HandshakeSignatureValid;
use rustls::pki_types::{CertificateDer, UnixTime};
use rustls::server::danger::{ClientCertVerified, ClientCertVerifier};
use rustls::{DigitallySignedStruct, DistinguishedName, Error, SignatureScheme};

/// Masters whose certificate is from the authority, and the worker itself, which asks for its own health. Certificates of other
/// workers are not for masters: a worker that is taken over cannot use the others.
#[derive(Debug)]
pub(super) struct Masters {
    verifier: Arc<dyn ClientCertVerifier>,
    own: CertificateDer<'static>,
}

impl Masters {
    pub fn new(verifier: Arc<dyn ClientCertVerifier>, own: CertificateDer<'static>) -> Self {
        Self { verifier, own }
    }
}

impl ClientCertVerifier for Masters {
    fn root_hint_subjects(&self) -> &[DistinguishedName] {
        self.verifier.root_hint_subjects()
    }

    fn verify_client_cert(
        &self,
        certificate: &CertificateDer<'_>,
        intermediates: &[CertificateDer<'_>],
        now: UnixTime,
    ) -> Result<ClientCertVerified, Error> {
        // Whoever shows it has to prove below that the key is there too.
        if *certificate == self.own {
            return Ok(ClientCertVerified::assertion());
        }
        self.verifier
            .verify_client_cert(certificate, intermediates, now)
    }

    fn verify_tls12_signature(
        &self,
        message: &[u8],
        certificate: &CertificateDer<'_>,
        signed: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, Error> {
        self.verifier
            .verify_tls12_signature(message, certificate, signed)
    }

    fn verify_tls13_signature(
        &self,
        message: &[u8],
        certificate: &CertificateDer<'_>,
        signed: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, Error> {
        self.verifier
            .verify_tls13_signature(message, certificate, signed)
    }

    fn supported_verify_schemes(&self) -> Vec<SignatureScheme> {
        self.verifier.supported_verify_schemes()
    }
}
