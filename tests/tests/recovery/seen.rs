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

/// Sends a signal to the worker of a subsystem, which has one process now.
#[track_caller]
pub fn send(running: &Running, subsystem: &str, signal: Signal) {
    let workers = running.workers(&format!("/{subsystem}"));
    assert_eq!(workers.len(), 1, "{workers:?}");
    kill_process(Pid::from_raw(workers[0]).unwrap(), signal).unwrap();
}
