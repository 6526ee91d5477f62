//! What a command left behind: processes and socket folders.

use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use rustix::process::{Pid, Signal, kill_process};

/// A process that belongs to a folder.
#[derive(Debug)]
pub struct Process {
    pub pid: i32,
    pub command: String,
}

/// Processes that know `folder` by their command line or their environment, which descendants inherit.
pub fn processes(folder: &Path) -> Vec<Process> {
    let entries = fs::read_dir("/proc").unwrap().flatten();
    let pids = entries.filter_map(|entry| entry.file_name().to_str()?.parse().ok());
    pids.filter(|pid| *pid != std::process::id() as i32)
        .filter_map(|pid| belongs_to(folder, pid))
        .collect()
}

/// A process that has ended but was not waited for has neither command line nor environment.
fn belongs_to(folder: &Path, pid: i32) -> Option<Process> {
    let read = |name: &str| fs::read(format!("/proc/{pid}/{name}")).unwrap_or_default();
    let command = read("cmdline");
    let wanted = folder.as_os_str().as_bytes();
    let knows = |text: &[u8]| text.windows(wanted.len()).any(|part| part == wanted);
    (knows(&command) || knows(&read("environ"))).then(|| Process {
        pid,
        command: String::from_utf8_lossy(&command).replace('\0', " "),
    })
}

/// Ends all processes of `folder`.
pub fn end_all(folder: &Path) {
    for process in processes(folder) {
        // It may have ended by itself meanwhile.
        let _ = kill_process(Pid::from_raw(process.pid).unwrap(), Signal::KILL);
    }
}

/// Folders for sockets in `folder`.
pub fn socket_folders(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder)
        .expect("the workshop is still open")
        .flatten();
    entries
        .filter(|entry| entry.file_name().to_string_lossy().starts_with("linchpin-"))
        .map(|entry| entry.path())
        .collect()
}
