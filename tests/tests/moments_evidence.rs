//! Hermite coupling of degree 2 to 5: the tables of errors, cost and stability.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin::error_norm::ColumnError;
use linchpin_models::reference::DoublePendulum;
use linchpin_tests::errors::closed_form;
use linchpin_tests::evidence;
use linchpin_tests::position_pair::position_pair;
use linchpin_tests::random_pairs::Tally;
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::{oscillator_with, with_settings};

const PAGE: &str = "methods.md";

const COMMAND: &str =
    "cargo test --release -p linchpin-tests --test moments_evidence -- --ignored --nocapture";

const DEGREES: [usize; 4] = [2, 3, 4, 5];

const STEPS: [f64; 3] = [1e-1, 5e-2, 2.5e-2];

/// Error of columns together, each with its exact values.
fn error(trajectory: &Trajectory, columns: &[(&str, Vec<f64>)]) -> f64 {
    let errors = columns.iter().map(|(name, exact)| {
        let mut error = ColumnError::default();
        for (value, exact) in trajectory.column(name).into_iter().zip(exact) {
            error.add(value, *exact);
        }
        error
    });
    ColumnError::together(errors).normalised()
}

fn row(degree: usize, h: f64, errors: &[f64], trajectory: &Trajectory) -> String {
    let errors: Vec<String> = errors.iter().map(|error| format!("{error:.1e}")).collect();
    format!(
        "| {degree} | {h:e} | {} | {} | {} |\n",
        errors.join(" | "),
        trajectory.integrations,
        trajectory.statistics.exchanges
    )
}

#[test]
#[ignore = "prints a table of docs/evidence/methods.md, and writes it with LINCHPIN_WRITE=1"]
fn oscillator() {
    let mut table = String::from(
        "| degree | H | x | v | lambda | integrations | exchanges |\n|---|---|---|---|---|---|---|\n",
    );
    for degree in DEGREES {
        for h in STEPS {
            let coupling = format!("method=hermite degree={degree} macro_step={h:e}");
            let velocity = "output.variables=[\"mass1.v\"]";
            let scene = oscillator_with(&coupling, &["scene.t_end=1", velocity]);
            let trajectory = run(&scene, Place::InProcess);
            let exact = closed_form(&scene);
            let times = trajectory.column("t");
            let errors = ["mass1.x", "mass1.v", "link.lambda"].map(|name| {
                let values = times.iter().map(|&t| exact(name, t).unwrap());
                error(&trajectory, &[(name, values.collect())])
            });
            table += &row(degree, h, &errors, &trajectory);
        }
    }
    evidence::show(PAGE, "degrees on the oscillator", COMMAND, &table);
}

const DOUBLE_PENDULUM: &str = include_str!("../../scenes/double-pendulum.toml");

#[test]
#[ignore = "prints a table of docs/evidence/methods.md, and writes it with LINCHPIN_WRITE=1"]
fn double_pendulum() {
    let mut table = String::from(
        "| degree | H | angles | rates | lambda | integrations | exchanges |\n|---|---|---|---|---|---|---|\n",
    );
    for degree in DEGREES {
        for h in STEPS {
            let coupling = format!("method=hermite degree={degree} macro_step={h:e}");
            let others = [
                "scene.t_end=1",
                "subsystem.*.solver={ kind = \"radau5\", rtol = 1e-12, atol = 1e-12 }",
                "coupling.iterations={ most = 4, tolerance = 1e-12 }",
                "output.variables=[\"link1.angle\", \"link2.angle\", \"link1.rate\", \"link2.rate\"]",
            ];
            let scene = with_settings(DOUBLE_PENDULUM, &coupling, &others);
            let trajectory = run(&scene, Place::InProcess);
            let times = trajectory.column("t");
            let motions = DoublePendulum::schweizer_lu().motions(&times).unwrap();
            let of_links = |what: &str, exact: &dyn Fn(usize, usize) -> f64| {
                let columns = [0, 1].map(|link| {
                    let values = (0..times.len()).map(|point| exact(point, link));
                    (
                        format!("link{}.{what}", link + 1),
                        values.collect::<Vec<_>>(),
                    )
                });
                let columns = columns
                    .each_ref()
                    .map(|(name, exact)| (&name[..], exact.clone()));
                error(&trajectory, &columns)
            };
            let forces = ["hinge.lambda.x", "hinge.lambda.y"];
            let force = |axis: usize| {
                motions
                    .iter()
                    .map(|one| one.hinge_forces[0][axis])
                    .collect()
            };
            let errors = [
                of_links("angle", &|point, link| motions[point].angles[link]),
                of_links("rate", &|point, link| motions[point].rates[link]),
                error(&trajectory, &[(forces[0], force(0)), (forces[1], force(1))]),
            ];
            table += &row(degree, h, &errors, &trajectory);
        }
    }
    evidence::show(PAGE, "degrees on the double pendulum", COMMAND, &table);
}

#[test]
#[ignore = "prints a table of docs/evidence/methods.md, and writes it with LINCHPIN_WRITE=1"]
fn connected_positions() {
    let mut table =
        String::from("| degree | H | x | integrations | exchanges |\n|---|---|---|---|---|\n");
    for degree in DEGREES {
        for h in [2e-2, 1e-2] {
            let (error, trajectory) = position_pair(&format!("degree={degree} macro_step={h:e}"));
            table += &row(degree, h, &[error], &trajectory);
        }
    }
    evidence::show(PAGE, "degrees of connected signals", COMMAND, &table);
}

/// The first 2000 of the pairs that the other methods are judged by.
#[test]
#[ignore = "prints a table of docs/evidence/methods.md, and writes it with LINCHPIN_WRITE=1"]
fn random_pairs() {
    let mut table = String::from(
        "| degree | instants | unstable | largest radius | of these with H resolving both masses | out of reach |\n|---|---|---|---|---|---|\n",
    );
    let tally = |degree: usize, instants: usize| {
        let coupling = match degree {
            2 => "method=hermite degree=2".to_owned(),
            _ => format!("method=hermite degree={degree} instants={instants} limiter=off"),
        };
        let tally = Tally::of(&coupling, 7, 2000);
        let resolved = tally.unstable.iter().filter(|(pair, _)| pair.is_resolved());
        let radius = tally
            .unstable
            .iter()
            .map(|(_, radius)| *radius)
            .fold(0.0, f64::max);
        let radius = if radius > 0.0 {
            format!("{radius:.3}")
        } else {
            String::new()
        };
        let instants = if degree == 2 {
            "none".to_owned()
        } else {
            instants.to_string()
        };
        for (pair, why) in &tally.out_of_reach {
            println!("{coupling}: {why}\n    {pair:?}");
        }
        format!(
            "| {degree} | {instants} | {} | {radius} | {} | {} |\n",
            tally.unstable.len(),
            resolved.count(),
            tally.out_of_reach.len()
        )
    };
    table += &tally(2, 0);
    for degree in [3, 4, 5] {
        for instants in [4, 8, 16] {
            table += &tally(degree, instants.max(degree - 1));
        }
    }
    evidence::show(PAGE, "random pairs by degree", COMMAND, &table);
}
