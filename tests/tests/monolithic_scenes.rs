//! The shipped monolithic scenes against solutions in minimal coordinates, and against coupled runs.

#![allow(clippy::unwrap_used, missing_docs)]

use std::path::Path;

use linchpin::connect::Place;
use linchpin_master::scene;
use linchpin_models::reference::{DoublePendulum, SliderCrank, SpatialChain};
use linchpin_tests::runs::{Trajectory, run};

fn monolithic(name: &str, subsystem: &str, outputs: &[&str]) -> Trajectory {
    let file = format!(
        "{}/../scenes/monolithic/{name}.toml",
        env!("CARGO_MANIFEST_DIR")
    );
    let outputs: Vec<String> = outputs
        .iter()
        .map(|name| format!("{subsystem}.{name}"))
        .collect();
    let variables = format!("output.variables={outputs:?}").parse().unwrap();
    let scene = scene::load(Path::new(&file), &[variables]).unwrap();
    run(&scene, Place::InProcess)
}

/// Largest difference over the largest size.
fn error(found: &[f64], exact: impl ExactSizeIterator<Item = f64>) -> f64 {
    assert_eq!(found.len(), exact.len());
    let pairs = found.iter().zip(exact);
    let [difference, size] = pairs.fold([0.0f64; 2], |[difference, size], (found, exact)| {
        [difference.max((found - exact).abs()), size.max(exact.abs())]
    });
    difference / size
}

fn assert_close(what: &str, found: &[f64], exact: impl ExactSizeIterator<Item = f64>) {
    let error = error(found, exact);
    println!("{what}: {error:.1e}");
    assert!(error < 1e-9, "{what}: {error:e}");
}

#[test]
fn double_pendulum() {
    let outputs = [
        "link1-tip_angle",
        "link2-end_angle",
        "hinge_fx",
        "hinge_fy",
        "energy",
    ];
    let found = monolithic("double-pendulum", "pendulum", &outputs);
    let exact = DoublePendulum::schweizer_lu()
        .motions(&found.column("t"))
        .unwrap();
    let column = |name: &str| found.column(&format!("pendulum.{name}"));
    for link in [0, 1] {
        assert_close(
            outputs[link],
            &column(outputs[link]),
            exact.iter().map(|m| m.angles[link]),
        );
        let force = outputs[2 + link];
        assert_close(
            force,
            &column(force),
            exact.iter().map(|m| m.hinge_forces[0][link]),
        );
    }
    assert_close("energy", &column("energy"), exact.iter().map(|m| m.energy));
}

#[test]
fn slider_crank() {
    let outputs = ["link1-tip_angle", "link2-tip_angle", "energy"];
    let found = monolithic("slider-crank", "mechanism", &outputs);
    let exact = SliderCrank::schweizer_lu()
        .motions(&found.column("t"))
        .unwrap();
    let column = |name: &str| found.column(&format!("mechanism.{name}"));
    for link in [0, 1] {
        assert_close(
            outputs[link],
            &column(outputs[link]),
            exact.iter().map(|m| m.angles[link]),
        );
    }
    assert_close("energy", &column("energy"), exact.iter().map(|m| m.energy));
}

#[test]
fn double_pendulums_in_space() {
    for (name, chain) in [
        (
            "universal-pendulum",
            SpatialChain::universal_double_pendulum(),
        ),
        (
            "revolute-pendulum",
            SpatialChain::revolute_double_pendulum(),
        ),
    ] {
        let outputs = ["lower-end_x", "lower-end_y", "lower-end_z", "energy"];
        let found = monolithic(name, "mechanism", &outputs);
        let exact = chain.motions(&found.column("t")).unwrap();
        let column = |name: &str| found.column(&format!("mechanism.{name}"));
        for (axis, output) in outputs[..3].iter().enumerate() {
            let position = exact.iter().map(|motion| motion.bodies[1].position[axis]);
            assert_close(output, &column(output), position);
        }
        assert_close("energy", &column("energy"), exact.iter().map(|m| m.energy));
    }
}
