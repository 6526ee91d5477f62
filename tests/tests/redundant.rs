//! Two hinges where one would do: the door moves as with one, each hinge takes its part of the load, and the run says that they share it.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::results::Warning;
use linchpin_master::scene::Scene;
use linchpin_models::reference::CompositeJoint;
use linchpin_tests::in_space::joints::unit;
use linchpin_tests::in_space::pair::Pair;
use linchpin_tests::in_space::text;
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::with_settings;

/// Distance between the hinges in m.
const APART: f64 = 0.45;

/// Two tumbling bodies with so many hinges along one axis, which is tilted in both.
fn door(hinges: u8, coupling: &str) -> Scene {
    let pair = Pair::turning(CompositeJoint::Revolute(unit(1.0, 2.0, -0.5)), 1.0);
    let mut text = pair.scene_text(0.3);
    for number in 1..hinges {
        let mut frame = pair.frame();
        for (point, axis) in frame.points.iter_mut().zip(frame.axes) {
            *point += APART * f64::from(number) * axis;
        }
        let ends = ["outer.start", "inner.end"];
        text += &text::joint(&format!("hinge{number}"), &pair.joint, ends, &frame);
    }
    with_settings(&text, coupling, &[])
}

fn largest_difference(found: &Trajectory, other: &Trajectory) -> f64 {
    let mut largest: f64 = 0.0;
    for part in ["x", "y", "z", "qw", "qx", "qy", "qz"] {
        let name = &format!("outer.start_{part}");
        let pairs = found.column(name).into_iter().zip(other.column(name));
        largest = pairs.fold(largest, |largest, (one, other)| {
            largest.max((one - other).abs())
        });
    }
    largest
}

#[test]
fn a_door_on_two_hinges_moves_as_on_one() {
    for (coupling, most) in [
        ("method=hermite macro_step=7e-3", 1e-11),
        ("method=hermite degree=3 macro_step=7e-3", 1e-13),
        ("method=weighted degree=2 macro_step=3e-3", 1e-8),
        ("method=baumgarte degree=2 macro_step=3e-3", 1e-8),
    ] {
        let coupling = format!("{coupling} iterations={{most=6,tolerance=1e-10}}");
        let one = run(&door(1, &coupling), Place::InProcess);
        let two = run(&door(2, &coupling), Place::InProcess);
        let off = largest_difference(&two, &one);
        println!("{coupling}: {off:.1e}");
        assert!(off < most, "{coupling}: {off:e}");
        let told = &two.statistics.redundancy;
        assert_eq!(
            (told.conditions, &told.joints[..]),
            (5, &["hinge1".to_owned(), "joint".to_owned()][..])
        );
        let warnings = two.statistics.warnings();
        let names_joints = |warning: &Warning| warning.to_string().contains("hinge1, joint");
        assert!(warnings.iter().any(names_joints), "{warnings:?}");
        assert!(one.statistics.redundancy.joints.is_empty());
    }
}

/// Steps that follow a tolerance, and three hinges.
#[test]
fn a_tolerance_is_met_with_three_hinges() {
    for degree in ["2", "automatic"] {
        let coupling = format!("method=hermite degree={degree} tolerance=1e-6");
        let one = run(&door(1, &coupling), Place::InProcess);
        let three = run(&door(3, &coupling), Place::InProcess);
        assert_eq!(three.statistics.redundancy.conditions, 10);
        let end = |run: &Trajectory, name: &str| *run.column(name).last().unwrap();
        for axis in ["x", "y", "z"] {
            let name = format!("outer.start_{axis}");
            let off = (end(&three, &name) - end(&one, &name)).abs();
            assert!(off < 1e-5, "degree {degree}: {name} differs by {off:e}");
        }
    }
}

/// At rest in its weight each of two hinges beside the centre takes half of it: the multipliers of least norm.
#[test]
fn least_norm_shares_the_load() {
    let two = run(&door(2, "method=hermite macro_step=7e-3"), Place::InProcess);
    let one = run(&door(1, "method=hermite macro_step=7e-3"), Place::InProcess);
    for axis in ["x", "y", "z"] {
        let first =
            |run: &Trajectory, joint: &str| run.column(&format!("{joint}.lambda.{axis}"))[0];
        let sum = first(&two, "joint") + first(&two, "hinge1");
        let alone = first(&one, "joint");
        assert!(
            (sum - alone).abs() < 1e-9 * (1.0 + alone.abs()),
            "{axis}: {sum} {alone}"
        );
    }
    let square = |run: &Trajectory| -> f64 {
        let names = run.columns.iter().filter(|name| name.contains("lambda"));
        names.map(|name| run.column(name)[0].powi(2)).sum()
    };
    assert!(
        square(&two) < square(&one),
        "{} {}",
        square(&two),
        square(&one)
    );
}

/// Multipliers that the scene gives need no search at the start, but share the load as well.
#[test]
fn given_multipliers_are_redundant_as_well() {
    let coupling = "method=hermite degree=3 macro_step=7e-3";
    let found = run(&door(2, coupling), Place::InProcess);
    let mut scene = door(2, coupling);
    for joint in &mut scene.joints {
        let start = format!("{}.lambda.", joint.name);
        let names = found.columns.iter().filter(|name| name.starts_with(&start));
        joint.multiplier = Some(names.map(|name| found.column(name)[0]).collect());
    }
    let given = run(&scene, Place::InProcess);
    assert_eq!(given.statistics.redundancy, found.statistics.redundancy);
    let off = largest_difference(&given, &found);
    assert!(off < 1e-13, "{off:e}");
}
