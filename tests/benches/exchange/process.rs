//! Processes of this very program in another role.

use std::process::{Child, Command, Stdio};

/// A process that ends with its owner.
pub struct Process(Child);

impl Process {
    /// Starts this program with `arguments`; its input stays open as long as the owner lives.
    pub fn start(arguments: &[&str]) -> Self {
        let program = std::env::current_exe().unwrap();
        let mut command = Command::new(program);
        command
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::null());
        Self(command.spawn().unwrap())
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.0.kill().unwrap();
        self.0.wait().unwrap();
    }
}
