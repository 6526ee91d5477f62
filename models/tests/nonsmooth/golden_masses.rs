//! The model problem of S2 Sect. 2.8 against golden data.

use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::systems::masses::{End, Masses};

use super::golden::{Row, rows, runs};
use super::stand::Stand;

const Q: [&str; 3] = ["q1", "q2", "q3"];
const V: [&str; 3] = ["v1", "v2", "v3"];

/// Compares a run with its rows, to `tolerance` of the largest value of the same kind.
fn compare(run: &[Row], system: Masses, settings: Settings, tolerance: f64, with_force: bool) {
    let mut stand = Stand::new(system, run[0].scheme(), settings, [&[0.0; 3], &[0.0; 3]]);
    let dt = run[0].get("dt");
    let largest = |columns: &[&str]| {
        let values = run.iter().flat_map(|row| row.list(columns));
        values.fold(0.0, |a: f64, b| a.max(b.abs()))
    };
    let sizes = [largest(&Q), largest(&V)];
    let mut done = 0;
    for row in run {
        let number = (row.get("t") / dt).round() as usize;
        stand.steps(number - done, dt);
        done = number;
        for (columns, own, size) in [(Q, stand.q(), sizes[0]), (V, stand.v(), sizes[1])] {
            for (column, own) in columns.iter().zip(own) {
                let expected = row.get(column);
                assert!(
                    (own - expected).abs() <= tolerance * size,
                    "{} rho {} dt {dt} t {}: {column} = {own:e}, golden {expected:e}",
                    row.name,
                    row.get("rho"),
                    row.get("t"),
                );
            }
        }
        if with_force && number > 0 {
            let (own, expected) = (stand.integrator.state.forces[0], row.get("lambda"));
            assert!(
                (own - expected).abs() <= 1e-7 * largest(&["lambda"]),
                "{} t {}: lambda = {own:e}, golden {expected:e}",
                row.name,
                row.get("t"),
            );
        }
    }
}

#[test]
fn with_a_stiff_spring() {
    for run in runs(rows("model_a.csv"), |row| {
        (row.name.clone(), row.get("rho"))
    }) {
        compare(
            &run,
            Masses::of_paper(End::Spring(1e7)),
            Settings::default(),
            1e-9,
            false,
        );
    }
}

#[test]
fn with_a_constraint() {
    let key = |row: &Row| {
        let numbers = ["rho", "k", "dt", "a0mode"].map(|column| row.get(column).to_bits());
        (row.name.clone(), numbers)
    };
    for run in runs(rows("model_b.csv"), key) {
        let system = Masses {
            springs: [run[0].get("k"); 3],
            ..Masses::of_paper(End::Constraint)
        };
        let settings = Settings {
            has_consistent_start: run[0].get("a0mode") == 1.0,
            ..Settings::default()
        };
        compare(&run, system, settings, 1e-9, true);
    }
}
