//! Tables 3 to 6 of S2 with our own figures beside the paper's, and speed against error beside Siconos.
//!
//! `cargo bench -p linchpin-tests --bench tables` prints them; `-- --write` writes them to `docs/evidence/nonsmooth-tables.md`.
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

use std::fs;

use linchpin_tests::evidence::{Stamp, is_to_be_written, path};

/// Where the tables go.
const PAGE: &str = "nonsmooth-tables.md";

const COMMAND: &str = "cargo bench -p linchpin-tests --bench tables -- --write";

const HEAD: &str = "# Schemes for nonsmooth mechanics: cost and error

The whole page is written by its command. S2 is Rezaei & Schindler; its figures stand in the columns \"paper\". The
mechanism is the rigid slider-crank of its Table 1. Times are the least of several runs on one core.
";

fn main() {
    let parts = [
        HEAD.to_owned(),
        format!("{}\n", Stamp::of(COMMAND)),
        costs::tables(),
        errors::tables(),
        speed::table(),
        rod::tables(),
    ];
    let text = parts.join("\n");
    println!("{text}");
    if is_to_be_written() {
        fs::write(path(PAGE), text).unwrap();
    }
}
