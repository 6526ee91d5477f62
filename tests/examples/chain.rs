//! Prints the scene of a hanging chain: `cargo run --release --package linchpin-tests --example chain -- LINKS`

use std::process::ExitCode;

use linchpin_tests::chain::scene_text;

fn main() -> ExitCode {
    let argument = std::env::args().nth(1).unwrap_or_default();
    match argument.parse() {
        Ok(links @ 1..) => {
            print!("{}", scene_text(links));
            ExitCode::SUCCESS
        }
        Ok(0) | Err(_) => {
            eprintln!(
                "chain: give the number of links, a whole number of 1 or more, not \"{argument}\""
            );
            ExitCode::FAILURE
        }
    }
}
