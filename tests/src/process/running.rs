//! A command that has not ended yet.

use std::fs::{self, File};
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus};
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process, kill_process_group};

use super::{Outcome, PATIENCE, holds_within, leftovers};

/// A running `linchpin`. Its outputs go to files in its folder.
pub struct Running {
    child: Child,
    folder: PathBuf,
    command: String,
    started: Instant,
}

const STDOUT: &str = "stdout";
const STDERR: &str = "stderr";

impl Running {
    pub(super) fn start(folder: &Path, mut command: Command) -> Self {
        let shown = format!("{command:?}");
        let file = |name: &str| File::create(folder.join(name)).unwrap();
        let child = command.stdout(file(STDOUT)).stderr(file(STDERR)).spawn();
        let child = child.unwrap_or_else(|error| panic!("{shown}: {error}"));
        Self {
            child,
            folder: folder.to_owned(),
            command: shown,
            started: Instant::now(),
        }
    }

    /// What it wrote to its output so far.
    pub fn stdout(&self) -> String {
        self.text(STDOUT)
    }

    /// What it wrote to its error output so far.
    pub fn stderr(&self) -> String {
        self.text(STDERR)
    }

    fn text(&self, name: &str) -> String {
        String::from_utf8_lossy(&fs::read(self.folder.join(name)).unwrap()).into_owned()
    }

    /// Waits until `condition` holds; fails the test if the command ends before.
    #[track_caller]
    pub fn wait_until(&mut self, what: &str, mut condition: impl FnMut(&Self) -> bool) {
        let give_up = Instant::now() + PATIENCE;
        while !condition(self) {
            if self.child.try_wait().unwrap().is_some() || Instant::now() > give_up {
                panic!("waited in vain: {what}\n{}", self.outcome());
            }
            std::thread::sleep(super::PAUSE);
        }
    }

    /// Waits until the table of results in `folder` has grown to a few rows.
    #[track_caller]
    pub fn wait_for_rows(&mut self, folder: &str) {
        let table = self.folder.join(folder).join("results.csv");
        self.wait_until("rows in results.csv", |_| {
            table.metadata().is_ok_and(|metadata| metadata.len() > 0)
        });
    }

    /// Numbers of the worker processes that it has started and whose command line contains `name`.
    pub fn workers(&self, name: &str) -> Vec<i32> {
        let own = self.child.id() as i32;
        let all = leftovers::processes(&self.folder).into_iter();
        all.filter(|process| process.pid != own && process.command.contains(name))
            .map(|process| process.pid)
            .collect()
    }

    /// Whether it has ended.
    pub fn has_ended(&mut self) -> bool {
        self.child.try_wait().unwrap().is_some()
    }

    /// Ctrl-C at the terminal: SIGINT for the whole process group.
    pub fn press_ctrl_c(&self) {
        kill_process_group(Pid::from_child(&self.child), Signal::INT).unwrap();
    }

    /// Number of the process.
    pub fn id(&self) -> u32 {
        self.child.id()
    }

    /// Sends a signal to this process, not to its workers.
    pub fn send(&self, signal: Signal) {
        kill_process(Pid::from_child(&self.child), signal).unwrap();
    }

    /// Waits for the end.
    #[track_caller]
    pub fn wait(mut self) -> Outcome {
        let ended = holds_within(PATIENCE, &mut || self.child.try_wait().unwrap().is_some());
        assert!(
            ended,
            "it did not end within {PATIENCE:?}\n{}",
            self.outcome()
        );
        self.outcome()
    }

    fn outcome(&mut self) -> Outcome {
        let status = self.child.try_wait().unwrap();
        Outcome {
            command: self.command.clone(),
            folder: self.folder.clone(),
            code: status.and_then(|status| status.code()),
            signal: status.as_ref().and_then(ExitStatus::signal),
            stdout: self.stdout(),
            stderr: self.stderr(),
            time: self.started.elapsed(),
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // Errors mean that it has ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Longest time until the processes of a command that has ended are gone.
pub(super) const AFTERMATH: Duration = Duration::from_secs(2);
