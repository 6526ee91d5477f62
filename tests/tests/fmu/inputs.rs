//! What each way to give polynomial inputs to an FMU costs and gains: the table of docs/evidence/fmus.md.

use std::fmt::Write;

use linchpin_tests::convergence::slope_of;
use linchpin_tests::evidence;
use linchpin_tests::fmus::{Equation, Fmi, TestFmu};
use linchpin_tests::process::Workshop;
use serde_json::Value as Json;

use crate::table::table;
use crate::trajectories::built_in;
use crate::{MASSES, run, workshop};

const PAGE: &str = "fmus.md";
const COMMAND: &str =
    "cargo test --release --workspace --test fmu -- --ignored --nocapture table_of_inputs";

const STEPS: [f64; 4] = [8e-3, 4e-3, 2e-3, 1e-3];
const FINEST: f64 = 1e-4;

/// Positions of the second mass at all macro points, and calls for each integration over a step.
fn positions(workshop: &Workshop, step: f64, solver: Option<&str>) -> (Vec<f64>, f64) {
    let step = format!("coupling.macro_step={step}");
    let solver = solver.map(|solver| format!("subsystem.mass2.solver={solver}"));
    let mut settings = vec!["--set", &step];
    settings.extend(solver.iter().flat_map(|own| ["--set", own.as_str()]));
    workshop.run(&run(&settings)).succeeds();
    let about: Json = serde_json::from_str(&workshop.read("out/run.json")).unwrap();
    let own = &about["statistics"]["subsystems"][1];
    let count = |key: &str| own[key].as_f64().unwrap();
    let calls = count("solver_steps") / count("integrations");
    (
        table(&workshop.read("out/results.csv"))["mass2.x"].clone(),
        calls,
    )
}

fn row(name: &str, workshop: &Workshop, solver: Option<&str>, exact: &[f64]) -> (String, f64) {
    let largest = exact.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let mut calls = 0.0;
    let errors = STEPS.map(|step| {
        let (own, counted) = positions(workshop, step, solver);
        calls = counted;
        let every = (step / FINEST).round() as usize;
        let pairs = own.iter().zip(exact.iter().step_by(every));
        pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs())) / largest
    });
    let middle = [1, 2].map(|place| (STEPS[place], errors[place]));
    let order = slope_of(middle.into_iter());
    let mut text = format!("| {name} | {calls:.1} |");
    for error in errors {
        let _ = write!(text, " {error:.1e} |");
    }
    (format!("{text} {order:.1} |\n"), order)
}

#[test]
#[ignore = "a table for the book"]
fn table_of_inputs() {
    let reference = workshop(&built_in(), &TestFmu::new(Equation::Oscillator, Fmi::Two));
    let (exact, _) = positions(&reference, FINEST, None);
    let two = TestFmu::with_varying_inputs(Equation::Oscillator, Fmi::Two);
    let low = TestFmu {
        orders: 1,
        ..two.clone()
    };
    let three = TestFmu::with_varying_inputs(Equation::Oscillator, Fmi::Three);
    let [derivatives, lines, update] = [&two, &low, &three].map(|fmu| workshop(MASSES, fmu));
    let mut text = "| inputs | calls | H = 8 ms | 4 ms | 2 ms | 1 ms | order |\n|---|---|---|---|---|---|---|\n".to_owned();
    let mut orders = Vec::new();
    for (name, workshop, solver, least) in [
        ("built-in model, exact", &reference, None, 4.5),
        ("`input-derivatives`", &derivatives, None, 4.5),
        ("`intermediate-update`", &update, None, 4.5),
        ("`input-derivatives` of order 1", &lines, None, 4.5),
        (
            "`sub-steps`",
            &derivatives,
            Some("{kind=\"sub-steps\"}"),
            4.5,
        ),
        (
            "`sub-steps`, `substeps = 3`",
            &derivatives,
            Some("{kind=\"sub-steps\",substeps=3}"),
            3.5,
        ),
        (
            "`sub-steps`, `substeps = 2`",
            &derivatives,
            Some("{kind=\"sub-steps\",substeps=2}"),
            2.5,
        ),
        (
            "`sub-steps`, `substeps = 1`: the mean",
            &derivatives,
            Some("{kind=\"sub-steps\",substeps=1}"),
            1.5,
        ),
    ] {
        let (line, order) = row(name, workshop, solver, &exact);
        text += &line;
        orders.push((name, order, least));
    }
    evidence::show(PAGE, "inputs of FMUs", COMMAND, &text);
    for (name, order, least) in orders {
        assert!(order > least, "{name}: order {order}");
    }
}
