//! What a new user types first: models, templates, pictures of scenes, help of the shell, answers for scripts.

#![allow(clippy::unwrap_used)]

mod answers;
mod graphs;
mod models;
mod shell;
mod summary;
mod templates;

use std::ops::Deref;

use linchpin_tests::process::{Outcome, Workshop};
use serde_json::Value;

/// The standard output of a command as JSON.
#[track_caller]
fn json(outcome: &Outcome) -> Value {
    serde_json::from_str(&outcome.stdout).unwrap_or_else(|error| panic!("{error}\n{outcome}"))
}

/// A command that was run in a folder of its own.
struct Typed {
    outcome: Outcome,
    _workshop: Workshop,
}

impl Deref for Typed {
    type Target = Outcome;

    fn deref(&self) -> &Outcome {
        &self.outcome
    }
}

/// Runs a command in a folder of its own.
fn typed(arguments: &[&str]) -> Typed {
    let workshop = Workshop::new();
    Typed {
        outcome: workshop.run(arguments),
        _workshop: workshop,
    }
}
