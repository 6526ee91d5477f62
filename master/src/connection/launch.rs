//! Starting worker processes, and making sure that none outlives its master.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fs::Permissions;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::CommandExt;
use std::path::PathBuf;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process_group};
use tempfile::TempDir;

use super::ExitMessage;
use super::output::{WorkerLogs, WorkerOutput};

/// Placeholder for the address in a worker's command.
const ADDRESS: &str = "{address}";

/// How long a worker may take to end once its input is closed, before it is killed.
const GRACE: Duration = Duration::from_millis(500);

/// How long a process whose connection was lost may take until the system says how it ended.
const EXIT_TIMEOUT: Duration = Duration::from_millis(100);

/// Longest path of a Unix socket in bytes.
const LONGEST_PATH: usize = 107;

/// Why a worker process could not be started.
#[derive(Debug, thiserror::Error)]
pub enum LaunchError {
    /// No folder for sockets.
    #[error(
        "cannot make a folder for the sockets of the workers: {source}; set TMPDIR to a writable place"
    )]
    Folder {
        /// The system's reason.
        source: std::io::Error,
    },
    /// The command is empty.
    #[error("the command is empty; give at least the program")]
    NoProgram,
    /// The path of the socket is too long.
    #[error(
        "the socket {} would have a path of more than {LONGEST_PATH} bytes, the most that the system allows; give \
         the subsystem a shorter name, or set TMPDIR to a shorter path",
        path.display()
    )]
    PathTooLong {
        /// The path.
        path: PathBuf,
    },
    /// No pipe or thread for what the worker prints.
    #[error(
        "cannot read what the workers print: {source}; see the limits of open files and processes (`ulimit -a`)"
    )]
    Pipe {
        /// The system's reason.
        source: std::io::Error,
    },
    /// The program cannot run.
    #[error(
        "cannot start `{command}`: {source}; a program without / in its name is searched in PATH, any other path \
         counts from the current folder"
    )]
    Spawn {
        /// The command.
        command: String,
        /// The system's reason.
        source: std::io::Error,
    },
}

/// Starts workers, each on a Unix socket of its own in a private folder.
pub struct Launcher {
    folder: TempDir,
    logs: WorkerLogs,
    names: Mutex<BTreeSet<String>>,
}

impl Launcher {
    /// Makes the folder; what the workers print goes to `logs`.
    pub fn new(logs: WorkerLogs) -> Result<Self, LaunchError> {
        let folder = tempfile::Builder::new()
            .prefix("linchpin-")
            // Otherwise it would depend on the umask who can reach the workers.
            .permissions(Permissions::from_mode(0o700))
            .tempdir()
            .map_err(|source| LaunchError::Folder { source })?;
        Ok(Self {
            folder,
            logs,
            names: Mutex::default(),
        })
    }

    /// Starts `command` for subsystem `name`. `{address}` in it becomes the address to listen on; without the
    /// placeholder, `--listen ADDRESS` is appended.
    pub fn start(&self, name: &str, command: &[String]) -> Result<WorkerProcess, LaunchError> {
        let (program, arguments) = command.split_first().ok_or(LaunchError::NoProgram)?;
        let name = self.unused(name);
        let socket = self.folder.path().join(format!("{name}.sock"));
        if socket.as_os_str().len() > LONGEST_PATH {
            return Err(LaunchError::PathTooLong { path: socket });
        }
        let address = format!("unix:{}", socket.display());
        let mut process = Command::new(program);
        process.args(
            arguments
                .iter()
                .map(|argument| argument.replace(ADDRESS, &address)),
        );
        if !command.iter().any(|argument| argument.contains(ADDRESS)) {
            process.args(["--listen", &address]);
        }
        let no_pipe = |source| LaunchError::Pipe { source };
        let (output, printed) = std::io::pipe().map_err(no_pipe)?;
        let also_printed = printed.try_clone().map_err(no_pipe)?;
        process
            .stdin(Stdio::piped())
            .stdout(also_printed)
            .stderr(printed)
            // What a worker that is killed leaves behind, such as an unpacked FMU, goes with the folder.
            .env("TMPDIR", self.folder.path())
            // What a worker in Python prints is to be read when it prints it.
            .env("PYTHONUNBUFFERED", "1")
            // A group of its own: Ctrl-C at the terminal reaches the master only, which then ends its workers, and a
            // worker ends together with whatever it has started.
            .process_group(0);
        die_with_parent(&mut process);
        let child = process.spawn().map_err(|source| LaunchError::Spawn {
            command: command.join(" "),
            source,
        })?;
        // It holds the other end of the pipe, which would never be closed.
        drop(process);
        let announcement = format!("listening on {address}");
        let output =
            WorkerOutput::follow(output, &name, announcement, &self.logs).map_err(no_pipe)?;
        Ok(WorkerProcess {
            child: RefCell::new(child),
            address,
            output,
        })
    }
}

impl Launcher {
    /// The name of a subsystem, with a number behind it if a worker of that name was started before.
    fn unused(&self, name: &str) -> String {
        let mut used = self.names.lock().unwrap_or_else(PoisonError::into_inner);
        let numbered = (2_u64..).map(|number| format!("{name}-{number}"));
        let mut names = std::iter::once(name.to_owned()).chain(numbered);
        let unused = names.find(|name| !used.contains(name)).unwrap_or_default();
        used.insert(unused.clone());
        unused
    }
}

/// Asks the kernel to end the worker with its master, however the master ends.
#[cfg(target_os = "linux")]
#[allow(
    unsafe_code,
    reason = "`pre_exec` is unsafe because its closure runs between fork and exec; this one makes a single system call"
)]
fn die_with_parent(command: &mut Command) {
    let set_signal = || {
        rustix::process::set_parent_process_death_signal(Some(Signal::KILL))
            .map_err(std::io::Error::from)
    };
    // SAFETY: the closure neither allocates nor takes locks.
    unsafe { command.pre_exec(set_signal) };
}

/// Other systems rely on the closed standard input.
#[cfg(not(target_os = "linux"))]
fn die_with_parent(_: &mut Command) {}

/// A running worker. Dropping it ends it.
pub struct WorkerProcess {
    child: RefCell<Child>,
    address: String,
    output: WorkerOutput,
}

impl WorkerProcess {
    /// Where it listens, as in a scene.
    pub fn address(&self) -> &str {
        &self.address
    }

    /// Number of the process.
    pub fn id(&self) -> u32 {
        self.child.borrow().id()
    }

    /// Whether it ended, and how.
    pub fn ended(&self) -> Option<ExitStatus> {
        self.child.borrow_mut().try_wait().ok().flatten()
    }

    /// How it ended and what it said last; for a process whose connection was lost, which is about to end.
    pub fn exit_message(&self) -> ExitMessage {
        let give_up = Instant::now() + EXIT_TIMEOUT;
        while self.ended().is_none() && Instant::now() < give_up {
            std::thread::sleep(Duration::from_millis(1));
        }
        let status = self.ended();
        ExitMessage {
            status,
            printed: self.output.printed(status.is_some()).map(Box::new),
        }
    }
}

impl WorkerProcess {
    /// Closes its input, which asks a Linchpin worker to end, and waits for that for a moment.
    pub async fn end(&mut self) {
        drop(self.child.get_mut().stdin.take());
        let give_up = Instant::now() + GRACE;
        while Instant::now() < give_up && self.ended().is_none() {
            tokio::time::sleep(Duration::from_millis(1)).await;
        }
    }
}

impl Drop for WorkerProcess {
    fn drop(&mut self) {
        let child = self.child.get_mut();
        // Errors here mean that it is gone already, with all that it has started.
        let _ = kill_process_group(Pid::from_child(child), Signal::KILL);
        let _ = child.wait();
    }
}
