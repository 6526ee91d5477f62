//! Panels over other quantities, and marked times.

use super::*;

const BLUE: &str = "#0072B2";
const MARK: &str = "#EEB296";

fn wave(count: u32) -> TimePanel {
    let points = (0..count).map(|i| (f64::from(i), (0.1 * f64::from(i)).sin()));
    time_panel("y (m)", Scale::Linear, vec![curve("y", points)])
}

fn portrait(paths: Vec<Curve>) -> Portrait {
    Portrait {
        x_label: "x (m)".into(),
        y_label: "speed (m/s)".into(),
        paths,
    }
}

fn circle(radius: f64, count: u32) -> impl Iterator<Item = (f64, f64)> {
    let angle = move |i: u32| 0.618 * f64::from(i);
    (0..count).map(move |i| (radius * angle(i).cos(), radius * angle(i).sin()))
}

fn marks(t: impl IntoIterator<Item = f64>) -> Vec<TimeMarks> {
    vec![TimeMarks {
        kind: MarkKind::Impact,
        t: t.into_iter().collect(),
    }]
}

#[test]
fn marks_stand_in_every_panel_and_once_in_the_legend() {
    let directory = Directory::new("marks");
    let plot = TimePanels {
        marks: marks([20.0, 80.0, 1000.0, f64::NAN]),
        ..over_time(vec![wave(101), wave(101)])
    };
    plot.write(&directory.stem()).unwrap();
    let svg = directory.svg();
    svg.assert_legible();
    let texts = svg.texts();
    assert_eq!(texts.iter().filter(|text| **text == "impact").count(), 1);
    // The key of the legend, and in each of two panels those on the axis, from top to bottom.
    let lines = svg.polylines(MARK);
    assert_eq!(lines.len(), 1 + 2 * 2);
    for line in &lines {
        assert!(line[0].0 == line[1].0 && line[0].1 < line[1].1, "{line:?}");
    }
    let text = plot.svg("marks").unwrap();
    let (mark, curve) = (text.rfind(MARK), text.rfind(BLUE));
    assert!(mark < curve, "marks are behind curves");
}

#[test]
fn very_many_marks_are_a_band() {
    let directory = Directory::new("band");
    let plot = TimePanels {
        marks: marks((0..4000).map(|i| 30.0 + 0.01 * f64::from(i))),
        ..over_time(vec![wave(101)])
    };
    plot.write(&directory.stem()).unwrap();
    let svg = directory.svg();
    assert_eq!(svg.polylines(MARK).len(), 1 + 2);
    assert_eq!(svg.count("rect", "fill", "#FCEAE1"), 1);
}

#[test]
fn without_marks_nothing_is_said_of_them() {
    let plot = TimePanels {
        marks: marks([]),
        ..over_time(vec![wave(101)])
    };
    assert!(!plot.svg("none").unwrap().contains("impact"));
}

#[test]
fn portraits_have_axes_of_their_own_below_the_panels_over_time() {
    let directory = Directory::new("portraits");
    let pair = || vec![curve("a", circle(1.0, 40)), curve("b", circle(0.5, 40))];
    for count in 0..4 {
        let plot = TimePanels {
            portraits: vec![portrait(pair()); count],
            ..over_time(vec![wave(101)])
        };
        plot.write(&directory.stem()).unwrap();
        let svg = directory.svg();
        svg.assert_legible();
        assert_eq!(svg.shown_size(), directory.png_size());
        let said = |label: &str| svg.texts().iter().filter(|text| **text == label).count();
        assert_eq!(
            (said("t (s)"), said("x (m)"), said("speed (m/s)")),
            (1, count, count)
        );
        assert_eq!(said("a"), count.min(1), "one legend for all");
    }
    let alone = TimePanels {
        portraits: vec![portrait(vec![curve("a", circle(1.0, 40))])],
        ..over_time(Vec::new())
    };
    alone.write(&directory.stem()).unwrap();
    let svg = directory.svg();
    assert_eq!(svg.polylines(BLUE)[0].len(), 40);
    assert!(!svg.texts().contains(&"t (s)"));
}

#[test]
fn a_path_that_wanders_for_long_takes_bounded_room() {
    let leaping = |i: u32| curve(&format!("{i}"), circle(f64::from(i), 60_000));
    let smooth = |i: u32| {
        let fine = circle(f64::from(i), 60_000);
        let turned = fine.zip(0..).map(move |((x, y), n)| {
            let angle = -0.608 * f64::from(n);
            let (sin, cos) = f64::sin_cos(angle);
            (x * cos - y * sin, x * sin + y * cos)
        });
        curve(&format!("{i}"), turned)
    };
    for paths in [[1, 2, 3].map(leaping), [1, 2, 3].map(smooth)] {
        let plot = TimePanels {
            portraits: vec![portrait(paths.into())],
            ..over_time(Vec::new())
        };
        let bytes = plot.svg("wandering").unwrap().len();
        assert!(bytes < 400_000, "{bytes} bytes");
    }
}

#[test]
fn odd_portraits_are_drawn_or_refused() {
    let values = [
        f64::NAN,
        f64::INFINITY,
        0.0,
        1e300,
        -1e300,
        1e-310,
        5.0,
        f64::MAX,
    ];
    for x in values {
        for y in values {
            let plot = TimePanels {
                portraits: vec![portrait(vec![curve("a", [(x, y), (0.0, 1.0)])])],
                ..over_time(Vec::new())
            };
            read::Svg::parse(&plot.svg("odd").unwrap()).assert_legible();
        }
    }
    let nothing = TimePanels {
        portraits: vec![portrait(vec![curve("a", [(f64::NAN, 0.0)])])],
        ..over_time(Vec::new())
    };
    let refused = nothing.svg("nothing");
    assert!(matches!(refused, Err(PlotError::NoData { .. })));
    let crowded = TimePanels {
        portraits: vec![portrait(vec![curve("a", circle(1.0, 4))]); 12],
        ..over_time(vec![wave(10)])
    };
    let refused = crowded.svg("crowded");
    assert!(matches!(
        refused,
        Err(PlotError::TooManyPanels { panels: 13, .. })
    ));
}
