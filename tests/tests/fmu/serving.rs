//! A worker that serves an FMU beside the command under test.

use linchpin_tests::process::{Running, Workshop, wait_until};
use rustix::process::Signal;

/// The worker; it ends with this.
pub struct Served {
    running: Running,
    address: String,
    /// For its output, and its socket.
    _elsewhere: Workshop,
}

impl Served {
    /// Serves an FMU of the workshop.
    pub fn start(workshop: &Workshop, fmu: &str) -> Self {
        let elsewhere = Workshop::new();
        let socket = elsewhere.path().join("own.sock");
        let address = format!("unix:{}", socket.display());
        let fmu = workshop.path().join(fmu).display().to_string();
        let running = elsewhere.start(&["worker", "--fmu", &fmu, "--listen", &address]);
        wait_until("the worker listens", || socket.exists());
        Self {
            running,
            address,
            _elsewhere: elsewhere,
        }
    }

    /// Where it listens.
    pub fn address(&self) -> &str {
        &self.address
    }

    /// Whether it has ended.
    pub fn has_ended(&mut self) -> bool {
        self.running.has_ended()
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        if !self.running.has_ended() {
            self.running.send(Signal::TERM);
        }
    }
}
