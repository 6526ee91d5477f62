//! Trajectories of independent prototypes (`golden/s1/README.md`), with the exact and with an adaptive solver.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_tests::golden::{Record, number, records};
use linchpin_tests::runs::run;
use linchpin_tests::scenes::{RADAU5, oscillator_with};

/// Golden column, result column, tolerance relative to the largest value of the column.
type Comparison = (&'static str, &'static str, f64);

const STATES: [(&str, &str); 4] = [
    ("x1", "mass1.x"),
    ("v1", "mass1.v"),
    ("x2", "mass2.x"),
    ("v2", "mass2.v"),
];

/// The multiplier of an index-3 coupling amplifies differences of the positions by 1/H^2.
const INDEX_3_LAMBDA: f64 = 1e-5;

#[test]
fn exact_solver() {
    compare_all(&[], 1e-9, 1e-7);
}

#[test]
fn radau5_at_1e_8() {
    compare_all(&[RADAU5], 1e-7, 1e-6);
}

fn compare_all(solver: &[&str], state: f64, lambda: f64) {
    let points = records("oscillator.csv");
    let mut failures = Vec::new();
    let cases = records("oscillator_settings.csv");
    for case in &cases {
        let of_case: Vec<_> = points
            .iter()
            .filter(|point| point["id"] == case["id"])
            .collect();
        let last = of_case
            .iter()
            .map(|point| number(point, "N"))
            .fold(0.0, f64::max);
        let scene = scene(case, last, solver);
        let lambda = if is_index_3(case) {
            INDEX_3_LAMBDA
        } else {
            lambda
        };
        let states = STATES
            .iter()
            .map(|&(golden, column)| (golden, column, state));
        let comparisons = states.chain([("lambda", "link.lambda", lambda)]);
        failures.extend(differences(&case["id"], &scene, &of_case, comparisons));
    }
    assert!(
        cases.len() == 11 && points.len() == 110,
        "{} cases, {} points",
        cases.len(),
        points.len()
    );
    assert!(
        failures.is_empty(),
        "relative differences above tolerance:\n{}",
        failures.join("\n")
    );
}

fn differences(
    id: &str,
    scene: &Scene,
    points: &[&Record],
    comparisons: impl Iterator<Item = Comparison>,
) -> Vec<String> {
    let trajectory = run(scene, Place::InProcess);
    let mut failures = Vec::new();
    for (golden, column, tolerance) in comparisons {
        let found = trajectory.column(column);
        let largest = points
            .iter()
            .map(|point| number(point, golden).abs())
            .fold(0.0, f64::max);
        let difference = |point: &&Record| {
            let n = number(point, "N") as usize;
            (found[n] - number(point, golden)).abs() / largest
        };
        let worst = points.iter().map(difference).fold(0.0, f64::max);
        if worst > tolerance {
            failures.push(format!("{id} {golden}: {worst:.2e}, allowed {tolerance:e}"));
        }
    }
    failures
}

fn scene(case: &Record, last: f64, solver: &[&str]) -> Scene {
    let (method, p, q) = (&case["method"], &case["p(beta|a|mu)"], &case["q(gamma|b)"]);
    let parameters = match method.as_str() {
        "baumgarte" => format!("index={} beta={p} gamma={q}", index(case)),
        "weighted" => format!("index={} a={p} b={q}", index(case)),
        "explicit" => format!("mu={p}"),
        other => panic!("unknown method {other}"),
    };
    let (h, degree) = (&case["H"], &case["k"]);
    let coupling = format!("method={method} {parameters} macro_step={h} degree={degree}");
    let mut others = vec![
        format!("scene.t_end={:?}", last * number(case, "H")),
        "output.variables=[\"mass1.v\", \"mass2.v\"]".to_owned(),
    ];
    for mass in ["1", "2"] {
        for (parameter, own) in [
            ("m", mass),
            ("c", mass),
            ("d", mass),
            ("x0", ""),
            ("v0", ""),
        ] {
            let value = &case[&format!("{parameter}{own}")];
            others.push(format!(
                "subsystem.mass{mass}.parameters.{parameter}={value}"
            ));
        }
    }
    let others: Vec<&str> = others
        .iter()
        .map(String::as_str)
        .chain(solver.iter().copied())
        .collect();
    oscillator_with(&coupling, &others)
}

fn index(case: &Record) -> usize {
    let is_zero = |name: &str| number(case, name) == 0.0;
    1 + usize::from(is_zero("p(beta|a|mu)")) + usize::from(is_zero("q(gamma|b)"))
}

fn is_index_3(case: &Record) -> bool {
    case["method"] != "explicit" && index(case) == 3
}
