//! Workers in Python: the interpreter with the packages that they need, and programs that serve.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;

const REPOSITORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// What `tests/python/setup.sh` has made, on the first call.
#[derive(Debug)]
pub struct Python {
    /// The interpreter.
    pub interpreter: PathBuf,
    /// Folder of the generated stubs, for PYTHONPATH.
    pub stubs: PathBuf,
}

/// The interpreter and the stubs.
pub fn python() -> &'static Python {
    static PYTHON: OnceLock<Python> = OnceLock::new();
    PYTHON.get_or_init(|| {
        let setup = in_repository("tests/python/setup.sh");
        let done = Command::new("bash").arg(&setup).output().unwrap();
        assert!(
            done.status.success(),
            "{}",
            String::from_utf8_lossy(&done.stderr)
        );
        let folder = in_repository("target/python");
        Python {
            interpreter: folder.join("venv/bin/python"),
            stubs: folder.join("stubs"),
        }
    })
}

/// A file or folder of the repository.
///
/// # Panics
/// If there is none.
pub fn in_repository(name: &str) -> PathBuf {
    let path = Path::new(REPOSITORY).join(name);
    let found = path.canonicalize();
    found.unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A worker's program on a Unix socket, which ends with this.
#[derive(Debug)]
pub struct Program {
    child: Child,
    address: String,
}

impl Program {
    /// Starts `script`, which finds its imports in `path`, and waits until it says where it listens.
    pub fn start(script: &Path, path: &Path, socket: &Path) -> Self {
        Self::start_with(script, path, socket, &[])
    }

    /// As [`Program::start`], with further arguments.
    pub fn start_with(script: &Path, path: &Path, socket: &Path, arguments: &[&str]) -> Self {
        let mut command = Command::new(&python().interpreter);
        command
            .arg(script)
            .arg("--listen")
            .arg(format!("unix:{}", socket.display()))
            .args(arguments)
            .env("PYTHONPATH", path)
            .stdin(Stdio::null())
            .stdout(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let mut line = String::new();
        let output = child.stdout.take().unwrap();
        BufReader::new(output).read_line(&mut line).unwrap();
        let address = line.trim().strip_prefix("listening on ").unwrap();
        Self {
            address: address.to_owned(),
            child,
        }
    }

    /// Where it listens.
    pub fn address(&self) -> &str {
        &self.address
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }
}
