//! Who gets in, and who does not: certificates, plain text, permissions of sockets, and whose an instance is.

#![allow(clippy::unwrap_used)]

mod authority;
mod certificates;
mod instances;
mod masters;
mod plain_text;
mod runs;
mod strangers;
mod texts;
mod token;

use std::net::TcpListener;
use std::path::Path;
use std::process::Command;

use linchpin_tests::process::{Running, Workshop};
use linchpin_tests::python::{in_repository, python};

/// A worker process with the certificates of a folder.
pub struct Worker {
    /// Its output goes there.
    workshop: Workshop,
    running: Running,
    /// As a scene names it.
    pub address: String,
}

impl Worker {
    /// It listens at a port that the system chooses.
    pub fn start(certificates: &Path) -> Self {
        Self::start_at(0, certificates)
    }

    /// With other flags.
    pub fn start_with(flags: &[&str]) -> Self {
        let command = [&["worker", "--listen", "127.0.0.1:0"], flags].concat();
        Self::listening(Workshop::new(), &command)
    }

    /// At a port of our choice.
    pub fn start_at(port: u16, certificates: &Path) -> Self {
        let address = format!("127.0.0.1:{port}");
        let command = ["worker", "--listen", &address, "--certificates", OWN];
        Self::listening(with_copy(certificates), &command)
    }

    /// One of the Python SDK, with an oscillator.
    pub fn in_python(certificates: &Path) -> Self {
        Self::python(with_copy(certificates), &["--certificates", OWN])
    }

    /// One of the Python SDK, with other flags.
    pub fn in_python_with(flags: &[&str]) -> Self {
        Self::python(Workshop::new(), flags)
    }

    fn python(workshop: Workshop, flags: &[&str]) -> Self {
        let mut command = Command::new(&python().interpreter);
        command
            .arg(in_repository("worker/python/tests/models.py"))
            .args(["--listen", "127.0.0.1:0"])
            .args(flags)
            .current_dir(workshop.path())
            .env("PYTHONPATH", in_repository("worker/python/src"));
        let running = workshop.start_command(command);
        Self::once_listening(workshop, running)
    }

    fn listening(workshop: Workshop, command: &[&str]) -> Self {
        let running = workshop.start(command);
        Self::once_listening(workshop, running)
    }

    fn once_listening(workshop: Workshop, mut running: Running) -> Self {
        running.wait_until("an address", |own| own.stdout().ends_with('\n'));
        let address = running.stdout().trim().replace("listening on ", "");
        Self {
            workshop,
            running,
            address,
        }
    }

    /// Its port.
    pub fn port(&self) -> u16 {
        self.address.rsplit(':').next().unwrap().parse().unwrap()
    }

    /// What it has logged.
    pub fn log(&self) -> String {
        self.workshop.read("stderr")
    }

    /// Waits until it has logged words.
    #[track_caller]
    pub fn wait_for(&self, words: &str) {
        linchpin_tests::process::wait_until(words, || self.log().contains(words));
    }

    /// The process.
    pub fn running(&self) -> &Running {
        &self.running
    }
}

/// Folder of a worker's certificates in its own workshop.
const OWN: &str = "own";

/// A workshop with a copy of certificates, as on another machine: its worker has nothing to do with ours.
fn with_copy(certificates: &Path) -> Workshop {
    let workshop = Workshop::new();
    std::fs::create_dir(workshop.path().join(OWN)).unwrap();
    for file in ["ca.crt", "tls.crt", "tls.key"] {
        let copy = workshop.path().join(OWN).join(file);
        std::fs::copy(certificates.join(file), copy).unwrap();
    }
    workshop
}

/// A folder with the certificates of a master and the workers mass1 and mass2, in `certificates`.
pub fn certified() -> Workshop {
    let workshop = Workshop::new();
    let make = [
        "certificates",
        "certificates",
        "--worker",
        "mass1=worker.example.org",
        "--worker",
        "mass2=127.0.0.1",
    ];
    workshop.run(&make).succeeds();
    workshop
}

/// A port that is free now.
pub fn free_port() -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    listener.local_addr().unwrap().port()
}
