//! Tables 3 to 6 of S2 with our own figures beside the paper's, and speed against error beside Siconos.
//!
//! `cargo bench -p linchpin-models --bench tables` prints them; `-- --write` writes them to `docs/evidence/nonsmooth-tables.md`.
//! Times are the least of several runs in turn, so that other work of the machine counts little; errors and counts are
//! the same on every machine. Siconos takes part where `python3-siconos` and a C compiler are installed.

// A bench stops at the first thing that is not as it should be.
#![allow(clippy::unwrap_used)]

mod costs;
mod errors;
mod rod;
mod runs;
mod siconos;
mod speed;

use std::path::Path;

/// Where the tables go.
const DOCUMENT: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../docs/evidence/nonsmooth-tables.md"
);

const HEAD: &str = "# Schemes for nonsmooth mechanics: cost and error

Written by `cargo bench -p linchpin-models --bench tables -- --write`. S2 is Rezaei & Schindler; its figures stand in
the columns \"paper\". The mechanism is the rigid slider-crank of its Table 1. Times are the least of several runs on one
core.
";

fn main() {
    let parts = [
        HEAD.to_owned(),
        costs::tables(),
        errors::tables(),
        speed::table(),
        rod::tables(),
    ];
    let text = parts.join("\n");
    println!("{text}");
    if std::env::args().any(|argument| argument == "--write") {
        std::fs::write(Path::new(DOCUMENT), text).unwrap();
    }
}
