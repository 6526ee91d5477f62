//! Writes the pages of the reference that come from the program itself:
//! `cargo run --release -p linchpin-tests --example reference`

use std::path::Path;
use std::process::ExitCode;

use linchpin_tests::reference::pages;

fn main() -> ExitCode {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/reference");
    for (name, text) in pages() {
        if let Err(error) = std::fs::write(folder.join(name), text) {
            eprintln!("reference: docs/reference/{name} cannot be written: {error}");
            return ExitCode::FAILURE;
        }
        println!("docs/reference/{name}");
    }
    ExitCode::SUCCESS
}
