//! How far a run is, as its table shows.

use linchpin_tests::process::{Running, Workshop};
use rustix::process::{Pid, Signal, kill_process};

/// Waits until the table has so many bytes.
#[track_caller]
pub fn wait_for_bytes(running: &mut Running, workshop: &Workshop, folder: &str, bytes: u64) {
    let table = workshop.path().join(folder).join("results.csv");
    running.wait_until("a longer table", |_| {
        table
            .metadata()
            .is_ok_and(|metadata| metadata.len() > bytes)
    });
}

/// Sends a signal to the worker of a subsystem, as soon as it has one process: the place of one that was lost may just be taken.
#[track_caller]
pub fn send(running: &mut Running, subsystem: &str, signal: Signal) {
    let name = format!("/{subsystem}");
    running.wait_until("one worker", |running| running.workers(&name).len() == 1);
    let workers = running.workers(&name);
    kill_process(Pid::from_raw(workers[0]).unwrap(), signal).unwrap();
}
