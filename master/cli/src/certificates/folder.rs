//! The folder of one master or worker, which nobody else may read.

use std::fs::{self, DirBuilder, OpenOptions, Permissions};
use std::io::{self, Write};
use std::os::unix::fs::{DirBuilderExt, OpenOptionsExt, PermissionsExt, chown};
use std::path::Path;

use linchpin_proto::certificates::{AUTHORITY, CERTIFICATE, KEY};

use super::NewCertificatesError;

const FILES: [&str; 3] = [AUTHORITY, CERTIFICATE, KEY];

/// Who may read a folder, by numbers of user and group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Owner {
    /// Number of the user.
    pub user: u32,
    /// Number of the group.
    pub group: u32,
}

/// A certificate with its key, as PEM.
pub(super) struct Certified {
    pub certificate: String,
    pub key: String,
}

/// Whether all files are there.
pub(super) fn is_whole(folder: &Path) -> bool {
    FILES.iter().all(|file| folder.join(file).exists())
}

pub(super) fn refuse_overwriting(folder: &Path) -> Result<(), NewCertificatesError> {
    let there = FILES.map(|file| folder.join(file)).into_iter();
    match there
        .into_iter()
        .find(|path| path.symlink_metadata().is_ok())
    {
        Some(path) => Err(NewCertificatesError::There { path }),
        None => Ok(()),
    }
}

/// Writes the files. Their permissions do not depend on the umask.
pub(super) fn write(
    folder: &Path,
    authority: &str,
    own: &Certified,
    owner: Option<Owner>,
) -> Result<(), NewCertificatesError> {
    let on = |path: &Path| {
        let path = path.to_owned();
        move |source: io::Error| NewCertificatesError::Unwritable { path, source }
    };
    let mut builder = DirBuilder::new();
    let made = builder.recursive(true).mode(0o700).create(folder);
    made.and_then(|()| fs::set_permissions(folder, Permissions::from_mode(0o700)))
        .map_err(on(folder))?;
    for (file, text) in FILES
        .into_iter()
        .zip([authority, &own.certificate, &own.key])
    {
        let path = folder.join(file);
        write_file(&path, text, owner).map_err(on(&path))?;
    }
    give(folder, owner).map_err(on(folder))
}

fn write_file(path: &Path, text: &str, owner: Option<Owner>) -> io::Result<()> {
    let mut options = OpenOptions::new();
    let mut file = options
        .write(true)
        .create_new(true)
        .mode(0o600)
        .open(path)?;
    file.set_permissions(Permissions::from_mode(0o600))?;
    file.write_all(text.as_bytes())?;
    file.sync_all()?;
    give(path, owner)
}

fn give(path: &Path, owner: Option<Owner>) -> io::Result<()> {
    owner.map_or(Ok(()), |owner| {
        chown(path, Some(owner.user), Some(owner.group))
    })
}
