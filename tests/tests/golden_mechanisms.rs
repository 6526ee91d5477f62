//! Trajectories of independent prototypes (`golden/s1/README.md`) for the double pendulum and the slider-crank.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::setup::Options;
use linchpin_tests::golden::{Record, number, records};
use linchpin_tests::runs::try_run;
use linchpin_tests::scenes::with_settings;

const DOUBLE_PENDULUM: Mechanism = Mechanism {
    model: "DP",
    cases: 6,
    scene: include_str!("../../scenes/double-pendulum.toml"),
    multipliers: &[
        ("u1(lambda|lambda_x)", "hinge.lambda.x"),
        ("u2(gamma_j|lambda_y)", "hinge.lambda.y"),
    ],
    start: &[-1.839375, -0.613125],
};

const SLIDER_CRANK: Mechanism = Mechanism {
    model: "SC",
    cases: 5,
    scene: include_str!("../../scenes/slider-crank.toml"),
    multipliers: &[("u1(lambda|lambda_x)", "slider.lambda")],
    start: &[5.124820],
};

/// A mechanism of two links, `link1` and `link2`.
struct Mechanism {
    /// In the table of settings.
    model: &'static str,
    cases: usize,
    scene: &'static str,
    /// Golden column and result column.
    multipliers: &'static [(&'static str, &'static str)],
    /// Multipliers at the start, to six digits.
    start: &'static [f64],
}

/// Golden column, result column, what it holds.
const MOTION: [(&str, &str, Quantity); 4] = [
    ("phi1", "link1.angle", Quantity::Angle),
    ("omega1", "link1.rate", Quantity::Rate),
    ("phi2", "link2.angle", Quantity::Angle),
    ("omega2", "link2.rate", Quantity::Rate),
];

#[derive(Clone, Copy, PartialEq)]
enum Quantity {
    Angle,
    Rate,
    Multiplier,
}

/// Tolerances relative to the largest value: angles, rates, multipliers.
type Tolerances = [f64; 3];

const TIGHT: &str = "subsystem.*.solver={ kind = \"radau5\", rtol = 1e-13, atol = 1e-13 }";
const DEFAULT: &str = "subsystem.*.solver={ kind = \"radau5\" }";

#[test]
fn the_double_pendulum_with_tight_solvers() {
    compare_all(&DOUBLE_PENDULUM, TIGHT, [1e-9, 1e-8, 1e-6]);
}

/// A solver tolerance of 1e-8 lets the rates, which are below 0.1 rad/s in the first steps, be off by 1e-7 of their size,
/// and over H = 1e-3 such a rate is a force of 1e-5 N.
#[test]
fn the_double_pendulum_with_default_solvers() {
    compare_all(&DOUBLE_PENDULUM, DEFAULT, [1e-7, 1e-6, 5e-6]);
}

#[test]
fn the_slider_crank_with_tight_solvers() {
    compare_all(&SLIDER_CRANK, TIGHT, [1e-9, 1e-8, 1e-6]);
}

#[test]
fn the_slider_crank_with_default_solvers() {
    compare_all(&SLIDER_CRANK, DEFAULT, [1e-7, 1e-6, 5e-6]);
}

fn compare_all(mechanism: &Mechanism, solver: &str, tolerances: Tolerances) {
    let points = records("planar.csv");
    let cases = records("planar_settings.csv");
    let cases = cases.iter().filter(|case| case["model"] == mechanism.model);
    let cases: Vec<_> = cases.collect();
    assert_eq!(cases.len(), mechanism.cases);
    let mut failures = Vec::new();
    for case in cases {
        let of_case: Vec<_> = points
            .iter()
            .filter(|point| point["id"] == case["id"])
            .collect();
        assert_eq!(of_case.len(), 10);
        for (column, difference, quantity) in differences(mechanism, case, &of_case, solver) {
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
    mechanism: &Mechanism,
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
        "method={method} index={index} {}={p} {}={q} macro_step={h} degree={k} exchanged_degree={k} jacobian=every-step",
        names[0],
        names[1],
        k = case["k"],
    );
    let t_end = format!("scene.t_end={:?}", last * number(case, "H"));
    let scene = with_settings(mechanism.scene, &coupling, &[&t_end, solver]);
    let mut options = Options::default();
    if case["startup"] == "const" {
        options.established = Some(vec![mechanism.start.to_vec(); 4]);
    }
    let trajectory = try_run(&scene, Place::InProcess, &options).unwrap();
    for (&(_, column), start) in mechanism.multipliers.iter().zip(mechanism.start) {
        assert!((trajectory.column(column)[0] - start).abs() < 5e-6 * start.abs());
    }
    let difference = |(golden, column, quantity): (&str, &'static str, Quantity)| {
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
    let multipliers = mechanism.multipliers.iter();
    let multipliers = multipliers.map(|&(golden, column)| (golden, column, Quantity::Multiplier));
    MOTION
        .into_iter()
        .chain(multipliers)
        .map(difference)
        .collect()
}
