//! The multibody models against closed forms, other models and conserved quantities.

#![allow(clippy::unwrap_used)]

mod chains;
#[path = "../common/mod.rs"]
mod common;
mod conserved;
mod extremes;
mod formulations;
mod mistakes;
mod motion;
mod planar;
mod spatial;
mod start_mistakes;

use common::Solver;
use common::body::Body;
use common::mechanisms::{Given, values, with};

/// Both formulations by their names.
const FORMULATIONS: [&str; 2] = ["absolute", "minimal"];

/// A composition in motion.
fn build(
    model: &str,
    composition: &[(&str, Given)],
    formulation: &'static str,
    solver: Solver,
) -> Body {
    let chosen = [("formulation", Given::Text(formulation))];
    Body::with_values(model, values(&with(composition, &chosen)), solver)
}

fn planar(composition: &[(&str, Given)], formulation: &'static str, solver: Solver) -> Body {
    build("planar-multibody", composition, formulation, solver)
}

fn spatial(composition: &[(&str, Given)], formulation: &'static str, solver: Solver) -> Body {
    build("spatial-multibody", composition, formulation, solver)
}
