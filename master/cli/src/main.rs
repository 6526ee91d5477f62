//! `linchpin`: distributed co-simulation with rigid joints.

use std::io::IsTerminal;
use std::process::ExitCode;

use clap::Parser;
use linchpin::command_line::Arguments;
use linchpin::{diagnostics, log};

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    log::begin(&arguments.log());
    match arguments.execute() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            diagnostics::show(&error, std::io::stderr().is_terminal());
            ExitCode::from(error.exit_code())
        }
    }
}
