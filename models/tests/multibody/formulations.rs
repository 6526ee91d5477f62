//! Absolute and minimal coordinates are two derivations of one motion.

use crate::common::body::{Body, TIGHT, difference};
use crate::common::cases::{CASES, Case};

/// Largest difference of all outputs, reactions of the joints included, under loads at all markers.
fn largest_difference(absolute: Case, minimal: Case) -> f64 {
    assert!(minimal.is_minimal && !absolute.is_minimal);
    let mut runs = [absolute, minimal].map(|case| Body::of(case, TIGHT));
    let outputs = runs[0].model.outputs.iter();
    let outputs: Vec<String> = outputs.map(|output| output.name.clone()).collect();
    let mut largest: f64 = 0.0;
    for run in &mut runs {
        run.drive_all(7.0);
    }
    for _ in 0..30 {
        let [absolute, minimal] = runs.each_mut().map(|run| run.read(&outputs));
        for ((name, absolute), minimal) in outputs.iter().zip(&absolute).zip(&minimal) {
            let error = (absolute - minimal).abs() / (1.0 + minimal.abs());
            assert!(
                error < 1e-7,
                "{name}: {absolute} {minimal} at t = {}",
                runs[0].t
            );
            largest = largest.max(error);
        }
        runs.iter_mut().for_each(|run| run.advance(0.05));
    }
    largest
}

/// The trees in absolute and in minimal coordinates.
const TREES: [[Case; 2]; 2] = [[CASES[5], CASES[6]], [CASES[8], CASES[9]]];

#[test]
fn trees_move_in_the_same_way_in_both() {
    for [absolute, minimal] in TREES {
        let largest = largest_difference(absolute, minimal);
        println!("{}: {largest:e}", absolute.model);
    }
}

/// A quaternion told apart by its sign is another one; both formulations start from the scene's.
#[test]
fn the_start_is_that_of_the_scene_in_both() {
    for cases in TREES {
        let [absolute, minimal] = cases.map(|case| {
            let mut run = Body::of(case, TIGHT);
            let markers = run.model.markers.clone().into_iter();
            let names: Vec<String> = markers
                .flat_map(|marker| [marker.position, marker.velocity].concat())
                .collect();
            run.read(&names)
        });
        let error = difference(&absolute, &minimal);
        assert!(error < 1e-14, "{}: {error:e}", cases[0].model);
    }
}
