//! What a chain of n links with one worker each costs over n = 2 .. 64.
//!
//! * one solution of the coupling system, dense and sparse, for chains, rings, trees and stars of bodies: from here comes
//!   where [`LinearSolver`](linchpin_master::system::solve::LinearSolver) changes from one to the other;
//! * the macro step with the workers in this process and as n processes over Unix sockets;
//! * what the master adds to the solvers' time in this process, with Hermite coupling and with the weighted method;
//! * the memory of the master after a thousand and after ten thousand macro steps.
//!
//! `cargo bench -p linchpin-tests --bench chain` prints the tables of `docs/evidence/cost.md` and draws its picture to
//! `target/chain-cost.svg`; `-- solver`, `-- steps`, `-- methods` and `-- memory` do one part, and with `--write` the tables go into the page. Every
//! time is the least of sixty short blocks, so that other work of the machine counts little.

// A bench stops at the first thing that is not as it should be.
#![allow(clippy::unwrap_used)]

mod macro_steps;
mod memory;
mod methods;
mod picture;
mod solver;

use clap::Parser;
use linchpin::commands::worker;
use linchpin_tests::evidence;

/// Blocks of one measurement.
const BLOCKS: usize = 60;

const LINKS: [usize; 6] = [2, 4, 8, 16, 32, 64];

#[derive(Parser)]
enum Role {
    /// Serves the built-in models, as `linchpin worker`.
    Worker(worker::Arguments),
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments.first().is_some_and(|first| first == "worker") {
        let Role::Worker(arguments) = Role::parse();
        worker::execute(&arguments).unwrap();
        return;
    }
    let parts: Vec<&String> = arguments
        .iter()
        .filter(|argument| !argument.starts_with("--"))
        .collect();
    let is_wanted = |part| parts.is_empty() || parts.iter().any(|wanted| *wanted == part);
    if is_wanted("methods") {
        methods::show();
    }
    if is_wanted("memory") {
        memory::show();
    }
    let solutions = is_wanted("solver").then(solver::show);
    if is_wanted("steps") {
        let costs = macro_steps::show();
        if let Some(solutions) = solutions {
            picture::draw(&costs, &solutions);
        }
    }
}

/// Prints a table of the page, and writes it there if that is wanted.
fn show(name: &str, table: &str) {
    const COMMAND: &str = "cargo bench -p linchpin-tests --bench chain -- --write";
    evidence::show("cost.md", name, COMMAND, table);
}

/// The least time in us that one of `count` turns takes, over all blocks.
fn least_time(count: usize, mut turn: impl FnMut()) -> f64 {
    let block = |_| {
        let started = std::time::Instant::now();
        (0..count).for_each(|_| turn());
        started.elapsed().as_secs_f64() * 1e6 / count as f64
    };
    (0..BLOCKS).map(block).fold(f64::INFINITY, f64::min)
}
