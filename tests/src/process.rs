//! The program `linchpin` as a user runs it: in a folder of its own, with a time limit, and with an eye on what it
//! leaves behind.

mod leftovers;
mod outcome;
mod peer;
mod running;

use std::fs;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

pub use outcome::Outcome;
pub use peer::Peer;
pub use running::Running;

/// Longest time that a condition is waited for.
pub const PATIENCE: Duration = Duration::from_secs(20);

/// Pause between two looks at a condition.
const PAUSE: Duration = Duration::from_millis(2);

/// Waits until `condition` holds; fails the test with `what` if it never does.
#[track_caller]
pub fn wait_until(what: &str, mut condition: impl FnMut() -> bool) {
    assert!(
        holds_within(PATIENCE, &mut condition),
        "waited in vain: {what}"
    );
}

fn holds_within(limit: Duration, condition: &mut dyn FnMut() -> bool) -> bool {
    let give_up = Instant::now() + limit;
    loop {
        if condition() {
            return true;
        }
        if Instant::now() > give_up {
            return false;
        }
        std::thread::sleep(PAUSE);
    }
}

/// A temporary folder in which `linchpin` runs. Its socket folders are made there as well, so whatever belongs to a run
/// in this folder can be told from the rest of the machine. It stays if the test fails.
pub struct Workshop {
    folder: TempDir,
}

impl Workshop {
    /// An empty folder.
    pub fn new() -> Self {
        Self {
            folder: TempDir::with_prefix("workshop-").unwrap(),
        }
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Writes a file.
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path().join(name);
        fs::write(&path, content).unwrap();
        path
    }

    /// Text of a file.
    #[track_caller]
    pub fn read(&self, name: &str) -> String {
        let path = self.path().join(name);
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    }

    /// Removes the folders for sockets that a master has left that was killed.
    pub fn clear(&self) {
        for folder in leftovers::socket_folders(self.path()) {
            fs::remove_dir_all(folder).unwrap();
        }
    }

    /// `linchpin` with `arguments`, to be run in this folder.
    pub fn command<S: AsRef<str>>(&self, arguments: &[S]) -> Command {
        let mut command = Command::new(program());
        command
            .args(arguments.iter().map(AsRef::as_ref))
            .current_dir(self.path())
            .env("TMPDIR", self.path())
            .env_remove("LINCHPIN_LOG")
            .stdin(Stdio::null())
            // As a shell with job control does it, so that a signal can be sent to this command alone.
            .process_group(0);
        command
    }

    /// Starts `linchpin` with `arguments`.
    pub fn start<S: AsRef<str>>(&self, arguments: &[S]) -> Running {
        self.start_command(self.command(arguments))
    }

    /// Starts a command that was made by [`Workshop::command`].
    pub fn start_command(&self, command: Command) -> Running {
        Running::start(self.path(), command)
    }

    /// Runs `linchpin` with `arguments` to its end.
    #[track_caller]
    pub fn run<S: AsRef<str>>(&self, arguments: &[S]) -> Outcome {
        self.start(arguments).wait()
    }
}

impl Default for Workshop {
    fn default() -> Self {
        Self::new()
    }
}

impl Drop for Workshop {
    fn drop(&mut self) {
        leftovers::end_all(self.path());
        if std::thread::panicking() {
            self.folder.disable_cleanup(true);
        }
    }
}

/// That a scene with these settings writes the same table whether its workers are processes or not.
#[track_caller]
pub fn assert_same_bytes_in_processes(scene: &str, settings: &[&str]) {
    let workshop = Workshop::new();
    workshop.write("scene.toml", scene);
    let table = |name: &str, more: &[&str]| {
        let mut arguments = vec!["run", "scene.toml", "--out", name, "--no-plots", "--quiet"];
        arguments.extend(settings.iter().flat_map(|own| ["--set", own]));
        arguments.extend(more);
        workshop.run(&arguments).succeeds();
        workshop.read(&format!("{name}/results.csv"))
    };
    assert_eq!(table("processes", &[]), table("one", &["--in-process"]));
}

/// The binary beside the test executable: cargo builds it there for tests of the whole workspace.
fn program() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let program = test
        .parent()
        .and_then(Path::parent)
        .unwrap()
        .join("linchpin");
    assert!(
        program.is_file(),
        "there is no {}; run `cargo build --release --workspace` first",
        program.display()
    );
    program
}
