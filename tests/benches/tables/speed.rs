//! Speed against error of all schemes beside Siconos.

use std::fmt::Write;

use super::runs::{SCHEMES, SETTINGS, T_END, run, unilateral};
use super::siconos;

const STEPS: [f64; 5] = [1e-4, 5e-5, 1e-5, 5e-6, 1e-6];
/// Distance of the samples of the event-driven reference (s).
const INTERVAL: f64 = 1e-3;
/// Runs of which the fastest counts.
const REPETITIONS: usize = 5;

/// Time and error of one run.
#[derive(Clone, Copy)]
struct Point {
    seconds: f64,
    error: f64,
}

/// The table.
pub fn table() -> String {
    let exact = event_driven();
    let samples = exact.len();
    let mut text = String::from(
        "## Speed against error, with clearance\n\n\
         Largest error of an angle (rad) at 50 instants against the event-driven reference\n\
         (`tests/golden/s2/event_table1.csv`), time of the run to 0.05 s. Siconos: Moreau-Jean, theta = 1/2,\n\
         compiled callbacks, enumerative contact solver.\n\n\
         | scheme | dt in s | us a step | ms a run | error |\n|---|---|---|---|---|\n",
    );
    let mut curves: Vec<(String, Vec<Point>)> = Vec::new();
    for (name, scheme) in SCHEMES {
        let points = STEPS.map(|dt| {
            let runs = (0..REPETITIONS).map(|_| run(unilateral(), scheme, SETTINGS, dt, INTERVAL));
            let runs: Vec<_> = runs.collect();
            let seconds = runs
                .iter()
                .map(|run| run.seconds_per_step)
                .fold(f64::INFINITY, f64::min);
            point(&mut text, name, dt, seconds, &runs[0].samples, &exact)
        });
        curves.push((name.to_owned(), points.to_vec()));
    }
    let others: Option<Vec<Point>> = STEPS
        .into_iter()
        .map(|dt| {
            let run = siconos::run(dt, T_END, samples)?;
            Some(point(
                &mut text,
                "Siconos",
                dt,
                run.seconds_per_step,
                &run.samples,
                &exact,
            ))
        })
        .collect();
    match others {
        Some(others) => compare(&mut text, &curves, &others),
        None => text.push_str("\nSiconos is not installed: its rows are missing.\n"),
    }
    text
}

fn point(
    text: &mut String,
    name: &str,
    dt: f64,
    seconds: f64,
    samples: &[[f64; 3]],
    exact: &[[f64; 3]],
) -> Point {
    let differences = samples.iter().zip(exact);
    let differences =
        differences.flat_map(|(own, exact)| [0, 1, 2].map(|i| (own[i] - exact[i]).abs()));
    let error = differences.fold(0.0, f64::max);
    let steps = T_END / dt;
    let _ = writeln!(
        text,
        "| {name} | {dt:e} | {:.2} | {:.2} | {error:.1e} |",
        seconds * 1e6,
        seconds * steps * 1e3
    );
    Point {
        seconds: seconds * steps,
        error,
    }
}

/// Time of Siconos over the time of each scheme for the error that Siconos has with its finest step.
fn compare(text: &mut String, curves: &[(String, Vec<Point>)], others: &[Point]) {
    let finest = others[others.len() - 1];
    let _ = writeln!(
        text,
        "\nFor the error that Siconos has with its finest step, {:.1e} rad (times between the rows by straight lines\n\
         in logarithms):\n\n\
         | scheme | ms a run | faster than Siconos by |\n|---|---|---|",
        finest.error
    );
    for (name, points) in curves {
        let (seconds, is_bound) = time_for(finest.error, points);
        let sign = if is_bound { "at least " } else { "" };
        let _ = writeln!(
            text,
            "| {name} | {:.3} | {sign}{:.0} |",
            seconds * 1e3,
            finest.seconds / seconds
        );
    }
}

/// Time for an error; whether it is that of the coarsest step, which has a smaller one.
fn time_for(error: f64, points: &[Point]) -> (f64, bool) {
    if points[0].error <= error {
        return (points[0].seconds, true);
    }
    for pair in points.windows(2) {
        let [coarse, fine] = [pair[0], pair[1]];
        if fine.error <= error {
            let share = (coarse.error / error).ln() / (coarse.error / fine.error).ln();
            return (
                coarse.seconds * (fine.seconds / coarse.seconds).powf(share),
                false,
            );
        }
    }
    (f64::INFINITY, false)
}

fn event_driven() -> Vec<[f64; 3]> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/golden/s2/event_table1.csv");
    let text = std::fs::read_to_string(path).unwrap();
    let numbers = |line: &str| {
        let fields: Vec<f64> = line
            .split(',')
            .map(|field| field.parse().unwrap())
            .collect();
        [fields[1], fields[2], fields[3]]
    };
    text.lines().skip(1).map(numbers).collect()
}
