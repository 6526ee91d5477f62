//! Andrews' squeezer: seven bodies in three loops, five workers.

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;

use linchpin_tests::convergence::assert_least_orders;
use linchpin_tests::evidence;
use linchpin_tests::runs::{Trajectory, run, try_run};
use linchpin_tests::scenes::with_settings;

use super::{at_the_points_of, largest, relative};

const SPLIT: &str = include_str!("../../../scenes/benchmarks/andrews.toml");
const MONOLITH: &str = include_str!("../../../scenes/monolithic/andrews.toml");

/// The solution at 0.03 s of F. Mazzia, C. Magherini, "Test set for initial value problem solvers", release 2.4, Bari
/// 2008, problem "Andrews' squeezing mechanism", computed there by PSIDE: beta, Theta, gamma, Phi, delta, Omega,
/// epsilon, their rates, the rates of these, and the six multipliers.
const PUBLISHED: [f64; 27] = [
    0.1581077119629904e2,
    -0.1575637105984298e2,
    0.4082224013073101e-1,
    -0.5347301163226948,
    0.5244099658805304,
    0.5347301163226948,
    0.1048080741042263e1,
    0.1139920302151208e4,
    -0.1424379294994111e4,
    0.1103291221937134e2,
    0.1929337464421385e2,
    0.5735699284790808,
    -0.1929337464421385e2,
    0.3231791658026955,
    -0.2463176316945196e5,
    0.5185037701610329e5,
    0.3241025686413781e6,
    0.5667493645176213e6,
    0.1674362929479361e5,
    -0.5667493645176222e6,
    0.9826520791458422e4,
    0.199175333373191e3,
    -0.2975531228015052e2,
    0.2306654119098399e2,
    0.3145271365475927e2,
    0.2264249232082739e2,
    0.1161740700019673e2,
];

/// What the seven bodies are called in the monolith, and where they are in the scene.
const BODIES: [(&str, &str); 7] = [
    ("k1-f", "k1.f"),
    ("k2-e", "k2.e"),
    ("k3", "k3.e"),
    ("k4", "k45.e"),
    ("k5", "k45.a"),
    ("k6", "k67.e"),
    ("k7", "k67.a"),
];

/// The hinges between the workers.
const HINGES: [&str; 4] = ["f", "e3", "e4", "e6"];

fn monolith(others: &[&str]) -> Scene {
    let of_body = |(name, _): &(&str, &str)| {
        ["angle", "rate", "alpha"].map(|what| format!("mechanism.{name}_{what}"))
    };
    let of_hinge =
        |name: &&str| ["x", "y"].map(|direction| format!("mechanism.{name}_f{direction}"));
    let angles = BODIES.iter().flat_map(of_body);
    let outputs: Vec<String> = angles.chain(HINGES.iter().flat_map(of_hinge)).collect();
    let outputs = format!("output.variables={outputs:?}");
    with_settings(MONOLITH, "", &[&[outputs.as_str()], others].concat())
}

#[test]
fn one_solver_reaches_the_published_values() {
    let end = run(&monolith(&[]), Place::InProcess);
    let value = |name: &str| *end.column(&format!("mechanism.{name}")).last().unwrap();
    let angles = |what: &str| {
        let [k1, k2, k3, k4, k5, k6, k7] = BODIES.map(|(name, _)| value(&format!("{name}_{what}")));
        [k1, k2 - k1, k3, k4 - k5, k5, k6 - k7, k7]
    };
    let forces = ["e3", "e4", "e6"]
        .iter()
        .flat_map(|name| ["x", "y"].map(|direction| value(&format!("{name}_f{direction}"))));
    let found = ["angle", "rate", "alpha"].into_iter().flat_map(angles);
    let found: Vec<f64> = found.chain(forces).collect();
    for (what, range, most) in [
        ("angles", 0..7, 1e-9),
        ("rates", 7..14, 1e-9),
        ("accelerations", 14..21, 1e-6),
        ("multipliers", 21..27, 1e-6),
    ] {
        let error = relative(&found[range.clone()], &PUBLISHED[range]);
        println!("{what}: {error:.1e}");
        assert!(error < most, "{what}: {error:e}");
    }
}

/// The largest errors of the angles, of the rates, and of the hinge forces over all macro points, each relative to the
/// largest value of the same quantity. The forces without those at the last point: no step begins there, so these are
/// the ends of the last polynomials, of the order p + 1.
fn errors(found: &Trajectory) -> [f64; 3] {
    let exact = at_the_points_of(found, &monolith(&[]));
    let before_end = found.rows.len() - 1;
    let of = |rows: usize, pairs: Vec<(String, String)>| {
        let columns = pairs
            .iter()
            .map(|(own, other)| (found.column(own), exact.column(other)));
        let columns: Vec<_> = columns.collect();
        largest(
            columns
                .iter()
                .map(|(found, exact)| relative(&found[..rows], &exact[..rows])),
        )
    };
    let of_bodies = |what: &str| {
        let pair = |(name, place): &(&str, &str)| {
            (
                format!("{place}_{what}"),
                format!("mechanism.{name}_{what}"),
            )
        };
        of(found.rows.len(), BODIES.iter().map(pair).collect())
    };
    let pair = |name: &&str| {
        ["x", "y"].map(|direction| {
            (
                format!("{name}.lambda.{direction}"),
                format!("mechanism.{name}_f{direction}"),
            )
        })
    };
    let forces = of(before_end, HINGES.iter().flat_map(pair).collect());
    [of_bodies("angle"), of_bodies("rate"), forces]
}

fn split(coupling: &str, others: &[&str]) -> Scene {
    with_settings(SPLIT, coupling, others)
}

/// Every step is corrected until its defect is that of the solvers, with columns of its own.
const CONVERGED: &str = "iterations={most=6,tolerance=1e-10} jacobian=every-step";

/// Angles, rates and hinge forces have the order 2p + 1. With degree 4 the steps are so long that higher powers of H
/// still matter, and below 2e-4 s the errors are those of the solvers.
#[test]
fn orders() {
    for (degree, steps, least) in [
        (2, [2e-4, 1.5e-4, 1e-4], [4.9, 5.0, 5.0]),
        (3, [3e-4, 2e-4, 1.5e-4], [6.9, 7.0, 6.8]),
        (4, [3e-4, 2.5e-4, 2e-4], [8.8, 8.8, 8.4]),
    ] {
        let errors = steps.map(|h| {
            let coupling = format!("degree={degree} macro_step={h:e} {CONVERGED}");
            errors(&run(
                &split(&coupling, &["scene.t_end=0.012"]),
                Place::InProcess,
            ))
        });
        assert_least_orders(&format!("degree {degree}"), &steps, &errors, least);
    }
}

fn with_tolerance(degree: &str, tolerance: f64) -> Trajectory {
    let coupling = format!("degree={degree} tolerance={tolerance:e} macro_step=1e-5");
    run(&split(&coupling, &[]), Place::InProcess)
}

#[test]
fn the_second_degree_meets_a_tolerance() {
    for tolerance in [1e-5, 1e-6] {
        let [angles, ..] = errors(&with_tolerance("2", tolerance));
        println!("tolerance {tolerance:e}: {angles:.1e}");
        assert!(angles < 10.0 * tolerance, "{tolerance:e}: {angles:e}");
    }
}

#[test]
fn higher_degrees_meet_a_tolerance() {
    for (degree, tolerance) in [("3", 1e-6), ("4", 1e-6), ("automatic", 1e-6)] {
        let [angles, ..] = errors(&with_tolerance(degree, tolerance));
        println!("degree {degree}, tolerance {tolerance:e}: {angles:.1e}");
        assert!(
            angles < 10.0 * tolerance,
            "{degree} {tolerance:e}: {angles:e}"
        );
    }
}

const COMMAND: &str = "cargo test --release -p linchpin-tests --test benchmarks -- --ignored --nocapture table_of_andrews";

/// The longest fixed macro steps, of those a fifth shorter each, whose angles are as accurate as wanted.
#[test]
#[ignore = "prints a table of docs/evidence/benchmarks.md, and writes it with LINCHPIN_WRITE=1"]
fn table_of_andrews() {
    let mut table = String::from(
        "| wanted | degree | H, s | angles | rates | hinge forces | macro steps | integrations | exchanges |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for (wanted, degree, first) in [
        (1e-6, 2, 240),
        (1e-6, 3, 80),
        (1e-6, 4, 50),
        (1e-9, 2, 960),
        (1e-9, 3, 250),
        (1e-9, 4, 110),
    ] {
        let mut steps: u32 = first;
        loop {
            let h = 0.03 / f64::from(steps);
            let coupling =
                format!("degree={degree} macro_step={h:e} iterations={{most=3,tolerance=1e-8}}");
            let found = try_run(
                &split(&coupling, &[]),
                Place::InProcess,
                &Options::default(),
            );
            if let Ok(found) = found {
                let [angles, rates, forces] = errors(&found);
                if angles <= wanted {
                    let counts = &found.statistics;
                    table += &format!(
                        "| {wanted:.0e} | {degree} | {h:.1e} | {angles:.1e} | {rates:.1e} | {forces:.1e} | {} | {} | {} |\n",
                        counts.macro_steps, counts.integrations, counts.exchanges,
                    );
                    break;
                }
            }
            steps += steps / 4;
        }
    }
    evidence::show("benchmarks.md", "andrews", COMMAND, &table);
}
