//! Columns of a run, each quantity by itself.

use super::*;

/// Curves with these names over a second, at different levels.
fn waves(names: impl IntoIterator<Item = String>) -> Vec<Curve> {
    let wave = |(number, name): (usize, String)| {
        let level = number as f64;
        let points = (0..400).map(move |i| {
            let t = f64::from(i) / 399.0;
            (t, level + (9.7 * t).sin())
        });
        curve(&name, points)
    };
    names.into_iter().enumerate().map(wave).collect()
}

fn numbered(name: &str, count: usize) -> impl Iterator<Item = String> {
    (1..=count).map(move |number| format!("{name}{number}.x"))
}

fn panels(blocks: Vec<Block>) -> QuantityPanels {
    QuantityPanels {
        title: "scene".into(),
        time_label: "t in s".into(),
        blocks,
        marks: Vec::new(),
    }
}

fn block(label: &str, curves: Vec<Curve>) -> Block {
    Block::new(label.into(), Scale::Linear, curves)
}

#[test]
fn every_curve_is_named_even_if_it_is_alone() {
    let directory = Directory::new("single");
    let angle = block("angle in rad", waves(["link1.angle".to_owned()]));
    let force = block("joint force in N", waves(numbered("hinge", 2)));
    panels(vec![angle, force]).write(&directory.stem()).unwrap();
    let svg = directory.svg();
    svg.assert_legible();
    for text in [
        "angle in rad",
        "joint force in N",
        "link1.angle",
        "hinge1.x",
        "hinge2.x",
        "t in s",
    ] {
        assert_eq!(
            svg.texts().iter().filter(|own| **own == text).count(),
            1,
            "{text}"
        );
    }
    assert_eq!(svg.shown_size(), directory.png_size());
}

/// 9 curves are 5 and 4, not 8 and 1.
#[test]
fn more_than_eight_curves_are_small_panels_with_common_axes() {
    for (curves, expected) in [(8, 1), (9, 2), (16, 2), (17, 3), (29, 4)] {
        let directory = Directory::new(&format!("many{curves}"));
        let small = block("position in m", waves(numbered("link", curves)));
        let other = block("angle in rad", waves(numbered("body", 1)));
        panels(vec![other, small]).write(&directory.stem()).unwrap();
        let svg = directory.svg();
        svg.assert_legible();
        let labels = svg
            .texts()
            .iter()
            .filter(|own| **own == "position in m")
            .count();
        assert_eq!(labels, expected, "{curves}");
        for name in numbered("link", curves) {
            assert!(svg.texts().contains(&name.as_str()), "{name}");
        }
        // Every panel shows the same range, wherever its curves are.
        let highest = (curves as f64 / 10.0).floor() * 10.0;
        let ticks = svg
            .texts()
            .iter()
            .filter(|own| **own == format!("{highest}"))
            .count();
        assert!(curves < 10 || ticks >= expected, "{curves}: {ticks}");
    }
}

#[test]
fn impacts_and_repeated_steps_are_told_apart() {
    let directory = Directory::new("both-marks");
    let mut plot = panels(vec![block("position in m", waves(numbered("ball", 1)))]);
    let mark = |kind, t: &[f64]| TimeMarks {
        kind,
        t: t.to_vec(),
    };
    plot.marks = vec![
        mark(MarkKind::Impact, &[0.25, 0.75]),
        mark(MarkKind::Rejection, &[0.5]),
    ];
    plot.write(&directory.stem()).unwrap();
    let svg = directory.svg();
    svg.assert_legible();
    assert_eq!(svg.polylines("#EEB296").len(), 1 + 2);
    assert_eq!(svg.polylines("#BEB2E2").len(), 1 + 1);
    for name in ["impact", "step repeated"] {
        assert!(svg.texts().contains(&name), "{name}");
    }
}

#[test]
fn what_is_left_out_is_told_above_the_panels() {
    let directory = Directory::new("note");
    let mut first = block("position in m", waves(numbered("link", 32)));
    first.note = Some("32 of 63 curves".into());
    let second = first.clone();
    panels(vec![first, second])
        .write(&directory.stem())
        .unwrap();
    let svg = directory.svg();
    svg.assert_legible();
    assert!(svg.texts().contains(&"32 of 63 curves"));
}

#[test]
fn a_picture_without_a_point_is_refused() {
    let nothing = block("position in m", vec![curve("x", [(0.0, f64::NAN)])]);
    let error = panels(vec![nothing]).svg("x").unwrap_err();
    assert!(matches!(error, PlotError::NoData { .. }), "{error}");
}
