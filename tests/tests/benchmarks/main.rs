//! Benchmark mechanisms, cut at their hinges into workers, against the same mechanisms in one solver and against
//! published values.

#![allow(clippy::unwrap_used, missing_docs)]

mod andrews;
mod bricard;
mod double_four_bar;

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_tests::runs::{Trajectory, try_run};

/// A mechanism in one solver at the macro points of a run, whose fixed macro step has to divide its time.
fn at_the_points_of(run: &Trajectory, monolith: &Scene) -> Trajectory {
    let times = run.column("t");
    let lengths = times.windows(2).map(|pair| pair[1] - pair[0]);
    let mut monolith = monolith.clone();
    monolith.t_end = times[times.len() - 1];
    let options = Options {
        step_lengths: Some(lengths.collect()),
        ..Options::default()
    };
    let found = try_run(&monolith, Place::InProcess, &options).unwrap();
    let off = found.column("t").into_iter().zip(&times);
    let off = largest(off.map(|(found, time)| (found - time).abs()));
    assert!(
        found.rows.len() == times.len() && off < 1e-12,
        "{off:e} {times:?} {:?}",
        found.column("t")
    );
    found
}

/// Largest difference of two columns over the largest size of the second one.
fn relative(found: &[f64], exact: &[f64]) -> f64 {
    let differences = found
        .iter()
        .zip(exact)
        .map(|(found, exact)| (found - exact).abs());
    largest(differences) / largest(exact.iter().map(|value| value.abs()))
}

fn largest(sizes: impl Iterator<Item = f64>) -> f64 {
    // A number that is none must not be lost.
    sizes.fold(0.0, |most, size| if size <= most { most } else { size })
}
