//! What a macro step costs beside the bare messages that it needs.
//!
//! One run measures, in turns so that noise of the machine meets all alike:
//!
//! * the macro step of the two-mass oscillator, with the workers in this process, in two processes over Unix sockets
//!   and over TCP, by the exchange stream and by unary calls;
//! * a bare round to two processes of the same messages on open tonic streams, answered by a constant;
//! * a bare round to two processes of as many bytes over raw Unix sockets and raw TCP.
//!
//! `cargo bench --workspace --bench exchange`; `-- --rounds 40` for more rounds.

// A bench stops at the first thing that is not as it should be.
#![allow(clippy::unwrap_used)]

mod bare_stream;
mod macro_steps;
mod process;
mod raw_socket;
mod report;

use clap::Parser;
use linchpin::commands::worker;

use report::{Series, print_table};

/// Steps or rounds of one block; the time of a block is one sample.
const BLOCK: u32 = 500;

#[derive(Parser)]
enum Role {
    /// Serves the built-in models, as `linchpin worker`.
    Worker(worker::Arguments),
    /// Answers every exchange with a constant.
    BareStream { address: String, reply: String },
    /// Answers every `request` bytes with `reply` bytes.
    RawSocket {
        address: String,
        request: usize,
        reply: usize,
    },
}

fn main() {
    let first = std::env::args().nth(1).unwrap_or_default();
    if !first.starts_with("--") && !first.is_empty() {
        serve(Role::parse());
        return;
    }
    let rounds = rounds();
    let mut series = macro_steps::all();
    let messages = macro_steps::messages();
    series.extend(bare_stream::all(&messages));
    series.extend(raw_socket::all(&messages));
    for _ in 0..rounds {
        series.iter_mut().for_each(Series::measure);
    }
    print_table(&series, &messages);
}

/// Number of samples of every series.
fn rounds() -> usize {
    let mut arguments = std::env::args()
        .skip_while(|argument| argument != "--rounds")
        .skip(1);
    arguments.next().map_or(20, |rounds| {
        rounds.parse().expect("--rounds takes a number")
    })
}

fn serve(role: Role) {
    match role {
        Role::Worker(arguments) => worker::execute(&arguments).unwrap(),
        Role::BareStream { address, reply } => bare_stream::serve(&address, &reply),
        Role::RawSocket {
            address,
            request,
            reply,
        } => raw_socket::serve(&address, request, reply),
    }
}
