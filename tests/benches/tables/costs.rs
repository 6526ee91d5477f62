//! Tables 3 and 5: what a step costs, bilateral and unilateral.

use std::fmt::Write;

use linchpin_models::nonsmooth::mechanics::Counters;
use linchpin_models::nonsmooth::systems::rigid_slider_crank::Guide;

use super::runs::{SCHEMES, SETTINGS, T_END, run, unilateral};

const DT: f64 = 1e-5;
/// Runs of each scheme, in turn.
const REPETITIONS: usize = 15;

/// Both tables.
pub fn tables() -> String {
    let bilateral = Guide::Bilateral { friction: 0.01 };
    let mut text = String::new();
    let paper = [1.0, 1.35, 4.15, 4.35, 5.00];
    table(
        &mut text,
        "Table 3: cost of a step, without clearance, dt = 1e-5 s",
        bilateral,
        paper,
    );
    let paper = [1.0, 1.15, 2.72, 3.15, 3.40];
    table(
        &mut text,
        "Table 5: cost of a step, with clearance, dt = 1e-5 s",
        unilateral(),
        paper,
    );
    text
}

fn table(text: &mut String, title: &str, guide: Guide, paper: [f64; 5]) {
    let mut least = [f64::INFINITY; 5];
    let mut counters = [Counters::default(); 5];
    for _ in 0..REPETITIONS {
        for (place, (_, scheme)) in SCHEMES.into_iter().enumerate() {
            let run = run(guide, scheme, SETTINGS, DT, T_END);
            least[place] = least[place].min(run.seconds_per_step);
            counters[place] = run.counters;
        }
    }
    let _ = writeln!(text, "## {title}\n");
    let _ = writeln!(
        text,
        "| scheme | relative time | paper | us a step | iterations | evaluations | factorisations | \
         contact iterations |"
    );
    let _ = writeln!(text, "|---|---|---|---|---|---|---|---|");
    for (place, (name, _)) in SCHEMES.into_iter().enumerate() {
        let own = counters[place];
        let per_step = |count: u64| count as f64 / own.steps as f64;
        let _ = writeln!(
            text,
            "| {name} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} |",
            least[place] / least[0],
            paper[place],
            least[place] * 1e6,
            per_step(own.iterations),
            per_step(own.evaluations),
            per_step(own.factorisations),
            per_step(own.contact_iterations),
        );
    }
    let _ = writeln!(
        text,
        "\nIterations of stages, evaluations of mass matrix and forces, factorisations and iterations of the contact\n\
         solver are numbers for a step.\n"
    );
}
