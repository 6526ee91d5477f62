//! What Python workers need.

use std::path::{Path, PathBuf};
use std::process::Command;

const REPOSITORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// The interpreter and where the stubs are; both are made on the first call.
pub fn python() -> (PathBuf, PathBuf) {
    let setup = Path::new(REPOSITORY).join("tests/python/setup.sh");
    let done = Command::new("bash").arg(&setup).output().unwrap();
    assert!(
        done.status.success(),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
    let folder = Path::new(REPOSITORY)
        .join("target/python")
        .canonicalize()
        .unwrap();
    (folder.join("venv/bin/python"), folder.join("stubs"))
}
