//! Impacts across joints: split mechanisms against whole ones and closed forms.

#![allow(clippy::unwrap_used)]

mod bits;
mod double_pendulum;
mod exchanges;
mod mistakes;
mod split;

use linchpin::connect::Place;
use linchpin_master::scene::{Override, Scene, parse};
use linchpin_tests::runs::{Trajectory, run};

/// Crank | rod and slider.
const SPLIT: &str = include_str!("../../../scenes/s2/split-slider-crank.toml");
/// The same with the numbers of Table 2.
const DRIVEN: &str = include_str!("../../../scenes/s2/split-slider-crank-torque.toml");
const WHOLE: &str = include_str!("../../../scenes/s2/slider-crank.toml");
const PENDULUM: &str = include_str!("../../../scenes/s2/double-pendulum-stop.toml");

fn scene(text: &str, overrides: &[&str]) -> Scene {
    let overrides: Vec<Override> = overrides.iter().map(|own| own.parse().unwrap()).collect();
    parse(text, "scene.toml", &overrides).unwrap_or_else(|errors| panic!("{errors}"))
}

fn here(text: &str, overrides: &[&str]) -> Trajectory {
    run(&scene(text, overrides), Place::InProcess)
}

/// The last value of a column.
fn last(trajectory: &Trajectory, column: &str) -> f64 {
    *trajectory.column(column).last().unwrap()
}

/// Largest absolute value of some columns.
fn largest(trajectory: &Trajectory, columns: &[&str]) -> f64 {
    let all = columns.iter().flat_map(|name| trajectory.column(name));
    all.fold(0.0, |most: f64, value| most.max(value.abs()))
}
