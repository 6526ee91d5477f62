//! `linchpin`: distributed co-simulation with rigid joints.

use std::io::IsTerminal;
use std::process::ExitCode;

use clap::Parser;
use linchpin::command_line::Arguments;
use linchpin::diagnostics;
use tracing_subscriber::prelude::*;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let lines = tracing_subscriber::fmt::layer()
        .with_writer(std::io::stderr)
        .with_ansi(std::io::stderr().is_terminal());
    tracing_subscriber::registry()
        .with(lines)
        .with(arguments.log().clone())
        .init();
    match arguments.execute() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            diagnostics::show(&error, std::io::stderr().is_terminal());
            ExitCode::from(error.exit_code())
        }
    }
}
