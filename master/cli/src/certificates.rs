//! An authority, and what it certifies for one scene: a master and its workers.
//!
//! The key of the authority never leaves the memory of the process: what was not made with the others is not trusted by them, and
//! whoever takes over a machine can add nothing. A set is replaced as a whole.

mod error;
mod folder;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use linchpin_proto::certificates::Certificates;
use rcgen::{
    BasicConstraints, CertificateParams, CertifiedIssuer, DnType, ExtendedKeyUsagePurpose, IsCa,
    KeyPair, KeyUsagePurpose,
};
use time::OffsetDateTime;

pub use error::NewCertificatesError;
pub use folder::Owner;

/// By which a worker is called on its own machine, by health checks.
const OWN_NAMES: [&str; 3] = ["localhost", "127.0.0.1", "::1"];

/// How far the clocks of the machines may differ.
const SKEW: Duration = Duration::from_secs(3600);

/// The certificates of a scene.
#[derive(Debug, Clone)]
pub struct Wanted {
    /// Name of the scene, for those who look at a certificate.
    pub scene: String,
    /// The workers, and the names and addresses by which the master calls each.
    pub workers: BTreeMap<String, Vec<String>>,
    /// How long they are valid.
    pub lifetime: Duration,
}

/// Folder of the master, in that of all.
const MASTER: &str = "master";

impl Wanted {
    /// The folder of each, and the names that its certificate is for.
    pub fn folders(&self, all: &Path) -> Vec<(PathBuf, Vec<String>)> {
        let workers = self.workers.iter().map(|(name, hosts)| {
            let mut names = hosts.clone();
            names.extend(OWN_NAMES.map(str::to_owned));
            let mut listed = Vec::new();
            names.retain(|name| {
                let is_new = !listed.contains(name);
                listed.push(name.clone());
                is_new
            });
            (all.join("workers").join(name), names)
        });
        std::iter::once((all.join(MASTER), Vec::new()))
            .chain(workers)
            .collect()
    }

    /// Whether all of them are there and will do.
    ///
    /// # Errors
    /// They are there, but cannot be used.
    pub fn are_there(&self, all: &Path) -> Result<bool, NewCertificatesError> {
        let folders = self.folders(all);
        if folders.iter().any(|(folder, _)| !folder::is_whole(folder)) {
            return Ok(false);
        }
        for (folder, names) in &folders {
            let own = Certificates::read(folder).map_err(Box::new)?;
            match names.is_empty() {
                true => drop(own.for_master().map_err(Box::new)?),
                false => drop(own.for_worker().map_err(Box::new)?),
            }
        }
        Ok(true)
    }

    /// Makes all of them. Whatever is there stays, and is an error.
    ///
    /// # Errors
    /// [`NewCertificatesError`].
    pub fn make(&self, all: &Path, owner: Option<Owner>) -> Result<(), NewCertificatesError> {
        let folders = self.folders(all);
        for (folder, _) in &folders {
            folder::refuse_overwriting(folder)?;
        }
        let authority = self.authority()?;
        for (folder, names) in folders {
            let own = self.certify(&authority, names)?;
            folder::write(&folder, &authority.pem(), &own, owner)?;
        }
        Ok(())
    }

    fn authority(&self) -> Result<CertifiedIssuer<'static, KeyPair>, rcgen::Error> {
        let mut params = self.valid(Vec::new())?;
        params.is_ca = IsCa::Ca(BasicConstraints::Constrained(0));
        params.key_usages = vec![KeyUsagePurpose::KeyCertSign, KeyUsagePurpose::CrlSign];
        params
            .distinguished_name
            .push(DnType::CommonName, format!("authority of {}", self.scene));
        CertifiedIssuer::self_signed(params, KeyPair::generate()?)
    }

    /// A worker has names, a master has none: it is never called.
    fn certify(
        &self,
        authority: &CertifiedIssuer<'_, KeyPair>,
        names: Vec<String>,
    ) -> Result<folder::Certified, rcgen::Error> {
        let (purpose, title) = match names.first() {
            Some(name) => (ExtendedKeyUsagePurpose::ServerAuth, name.clone()),
            None => (
                ExtendedKeyUsagePurpose::ClientAuth,
                format!("{MASTER} of {}", self.scene),
            ),
        };
        let mut params = self.valid(names)?;
        params.distinguished_name.push(DnType::CommonName, title);
        params.key_usages = vec![KeyUsagePurpose::DigitalSignature];
        params.extended_key_usages = vec![purpose];
        params.use_authority_key_identifier_extension = true;
        let key = KeyPair::generate()?;
        let certificate = params.signed_by(&key, authority)?;
        Ok(folder::Certified {
            certificate: certificate.pem(),
            key: key.serialize_pem(),
        })
    }

    fn valid(&self, names: Vec<String>) -> Result<CertificateParams, rcgen::Error> {
        let mut params = CertificateParams::new(names)?;
        let now = SystemTime::now();
        params.not_before = OffsetDateTime::from(now - SKEW);
        params.not_after = OffsetDateTime::from(now + self.lifetime);
        params.distinguished_name = rcgen::DistinguishedName::new();
        Ok(params)
    }
}
