//! Trajectories of independent prototypes (`golden/s1/README.md`) for the double pendulum.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::cosimulation::Options;
use linchpin_tests::golden::{Record, number, records};
use linchpin_tests::runs::try_run;
use linchpin_tests::scenes::with_settings;

const SCENE: &str = include_str!("../../scenes/double-pendulum.toml");

/// Golden column, result column, what it holds.
const COLUMNS: [(&str, &str, Quantity); 6] = [
    ("phi1", "link1.angle", Quantity::Angle),
    ("omega1", "link1.rate", Quantity::Rate),
    ("phi2", "link2.angle", Quantity::Angle),
    ("omega2", "link2.rate", Quantity::Rate),
    (
        "u1(lambda|lambda_x)",
        "hinge.lambda.x",
        Quantity::Multiplier,
    ),
    (
        "u2(gamma_j|lambda_y)",
        "hinge.lambda.y",
        Quantity::Multiplier,
    ),
];

#[derive(Clone, Copy, PartialEq)]
enum Quantity {
    Angle,
    Rate,
    Multiplier,
}

/// Tolerances relative to the largest value: angles, rates, multipliers.
type Tolerances = [f64; 3];

#[test]
fn with_tight_solvers() {
    let tight = "subsystem.*.solver={ kind = \"radau5\", rtol = 1e-13, atol = 1e-13 }";
    compare_all(tight, [1e-9, 1e-8, 1e-6]);
}

/// A solver tolerance of 1e-8 lets the rates, which are below 0.1 rad/s in the first steps, be off by 1e-7 of their size,
/// and over H = 1e-3 such a rate is a force of 1e-5 N.
#[test]
fn with_default_solvers() {
    compare_all(
        "subsystem.*.solver={ kind = \"radau5\" }",
        [1e-7, 1e-6, 5e-6],
    );
}

fn compare_all(solver: &str, tolerances: Tolerances) {
    let points = records("planar.csv");
    let cases = records("planar_settings.csv");
    let cases: Vec<_> = cases.iter().filter(|case| case["model"] == "DP").collect();
    assert_eq!(cases.len(), 6);
    let mut failures = Vec::new();
    for case in cases {
        let of_case: Vec<_> = points
            .iter()
            .filter(|point| point["id"] == case["id"])
            .collect();
        assert_eq!(of_case.len(), 10);
        for (column, difference, quantity) in differences(case, &of_case, solver) {
            let is_index_3 = number(case, "p(beta|a)") == 0.0;
            let tolerance = match quantity {
                // Positions over H^2.
                Quantity::Multiplier if is_index_3 => 1e-5,
                _ => tolerances[quantity as usize],
            };
            println!("{} {column}: {difference:.2e}", case["id"]);
            if difference > tolerance {
                failures.push(format!(
                    "{} {column}: {difference:.2e} > {tolerance:e}",
                    case["id"]
                ));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Largest difference of every column relative to its largest value.
fn differences(
    case: &Record,
    points: &[&Record],
    solver: &str,
) -> Vec<(&'static str, f64, Quantity)> {
    let last = points
        .iter()
        .map(|point| number(point, "N"))
        .fold(0.0, f64::max);
    let (method, p, q, h) = (
        &case["method"],
        &case["p(beta|a)"],
        &case["q(gamma|b)"],
        &case["H"],
    );
    let names = if method == "baumgarte" {
        ["beta", "gamma"]
    } else {
        ["a", "b"]
    };
    let index = 1 + [p, q]
        .iter()
        .filter(|value| value.parse() == Ok(0.0))
        .count();
    let coupling = format!(
        "method={method} index={index} {}={p} {}={q} macro_step={h} degree={}",
        names[0], names[1], case["k"]
    );
    let t_end = format!("scene.t_end={:?}", last * number(case, "H"));
    let scene = with_settings(SCENE, &coupling, &[&t_end, solver]);
    let mut options = Options::default();
    if case["startup"] == "const" {
        options.established = Some(vec![vec![-1.839375, -0.613125]; 4]);
    }
    let trajectory = try_run(&scene, Place::InProcess, &options).unwrap();
    let difference = |&(golden, column, quantity): &(&str, &'static str, Quantity)| {
        let found = trajectory.column(column);
        let size = points
            .iter()
            .map(|point| number(point, golden).abs())
            .fold(0.0, f64::max);
        let off = |point: &&Record| {
            (found[number(point, "N") as usize] - number(point, golden)).abs() / size
        };
        (column, points.iter().map(off).fold(0.0, f64::max), quantity)
    };
    COLUMNS.iter().map(difference).collect()
}
