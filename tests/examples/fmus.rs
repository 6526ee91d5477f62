//! Writes the FMUs of the guide: `cargo run --release -p linchpin-tests --example fmus FOLDER`.

use std::path::PathBuf;

fn main() {
    let folder = std::env::args_os().nth(1).unwrap_or_else(|| ".".into());
    linchpin_tests::fmus::write_examples(&PathBuf::from(folder));
}
