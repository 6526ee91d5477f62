//! Contacts and impacts of a slider in its notch, in the animation and in the plots.

use linchpin_tests::process::Workshop;
use serde_json::Value;

use crate::page::{columns, film, numbers};
use crate::run;

const SLIDER_CRANK: &str = include_str!("../../../scenes/s2/slider-crank.toml");

fn names(film: &Value, places: &Value) -> Vec<String> {
    let places = numbers(places).into_iter().map(|place| place as usize);
    let name = |place: usize| film["markers"][place]["name"].as_str().unwrap().to_owned();
    places.map(name).collect()
}

#[test]
fn outlines_and_contacts_of_the_slider() {
    let magnified = ["--set", "subsystem.mechanism.parameters.magnification=10"];
    let workshop = run(SLIDER_CRANK, &[&["--animate"][..], &magnified].concat());
    let film = film(&workshop.read("out/animation.html"));
    let lines = film["bodies"].as_array().unwrap();
    let lines: Vec<Vec<String>> = lines.iter().map(|line| names(&film, line)).collect();
    let slider = ["slider1", "slider2", "slider3", "slider4", "slider5"];
    let expected: [&[&str]; 4] = [
        &["crank", "pin", "slider"],
        &slider,
        &["upper1", "upper2"],
        &["lower1", "lower2"],
    ];
    assert_eq!(lines, expected);
    let table = columns(&workshop, "out/results.csv");
    let column = |name: &str| &table[&format!("mechanism.{name}")];
    for (first, last) in column("slider1_y").iter().zip(column("slider5_y")) {
        assert_eq!(first, last, "the outline is closed");
    }
    // The centre of the slider, ten times as high, is in the middle between opposite corners.
    let opposite = column("slider1_y").iter().zip(column("slider3_y"));
    for ((one, other), height) in opposite.zip(column("slider_y")) {
        assert!((0.5 * (one + other) - 10.0 * height).abs() < 1e-15);
    }
    assert!(column("upper1_y").iter().all(|y| *y == 0.025 + 10.0 * 1e-3));

    let forces = |number: usize| column(&format!("normal_corner{number}"));
    let all = (1..=4).flat_map(forces).copied();
    let largest = all.fold(0.0, f64::max);
    assert!(largest > 1.0);
    for (contact, number) in film["contacts"].as_array().unwrap().iter().zip(1..) {
        let marker = contact["marker"].as_u64().unwrap() as usize;
        assert_eq!(film["markers"][marker]["name"], format!("corner{number}"));
        for (radius, force) in numbers(&contact["radii"]).iter().zip(forces(number)) {
            let expected = match force / largest {
                share if share > 1e-9 => (10.0 * (3.0 + 8.0 * share.sqrt())).round(),
                _ => 0.0,
            };
            assert_eq!(*radius, expected);
        }
        let impulses = column(&format!("impulse_corner{number}"));
        for (flash, impulse) in numbers(&contact["flashes"]).iter().zip(impulses) {
            assert_eq!(*flash > 0.0, *impulse > 0.0);
        }
    }
}

/// Impulses of the corners add up to those of the mechanism, and there are some.
#[test]
fn impulses_of_the_corners_add_up() {
    let table = columns(&run(SLIDER_CRANK, &["--animate"]), "out/results.csv");
    let column = |name: &str| &table[&format!("mechanism.{name}")];
    let mut hits = 0;
    for row in 0..table["t"].len() {
        let corner = |number| column(&format!("impulse_corner{number}"))[row];
        let sum: f64 = (1..=4).map(corner).sum();
        assert!((sum - column("impulse")[row]).abs() < 1e-12);
        assert_eq!(sum > 0.0, column("impacts")[row] > 0.0);
        hits += usize::from(sum > 0.0);
    }
    assert!(hits > 10, "{hits}");
}

/// The picture of a run, with more arguments; the scene writes into the same folder as `run`.
fn picture(scene: &str) -> (Workshop, String) {
    let workshop = Workshop::new();
    workshop.write("scene.toml", scene);
    let arguments = ["run", "scene.toml", "--out", "out", "--in-process"];
    workshop.run(&arguments).succeeds();
    let svg = workshop.read("out/results.svg");
    (workshop, svg)
}

/// Colour of the marks.
const MARK: &str = "#EEB296";

#[test]
fn plots_mark_impacts_where_they_are_recorded() {
    let (_, svg) = picture(SLIDER_CRANK);
    // 16 impacts in each of five panels over time, some so close that they are a band, and a key.
    let marks = svg.matches(MARK).count();
    assert!((5 * 10 + 1..=5 * 16 + 1).contains(&marks), "{marks}");
    assert_eq!(svg.matches("\nimpact\n").count(), 1);
    for label in ["x in m", "y in m", "t in s"] {
        assert_eq!(svg.matches(&format!("\n{label}\n")).count(), 1, "{label}");
    }
    let silent = SLIDER_CRANK.replace("\"mechanism.impacts\", ", "");
    assert!(!picture(&silent).1.contains(MARK));
}

/// Cases in one picture: a curve for each case, over the time and over a column.
#[test]
fn cases_are_drawn_over_each_other() {
    let case = |name: &str, value: f64| {
        let key = "subsystem.mechanism.parameters.restitution";
        format!("\n[[case]]\nname = \"{name}\"\nset = {{ \"{key}\" = {value} }}\n")
    };
    let (head, _) = SLIDER_CRANK.split_once("[[output.panel]]").unwrap();
    let panels = "[[output.panel]]\nlabel = \"height\"\ncolumns = [\"mechanism.slider_y\"]\n\
                  [[output.panel]]\nlabel = \"path\"\ncolumns = [\"mechanism.slider_y\"]\n\
                  over = \"mechanism.slider_x\"\n";
    let scene = format!("{head}{panels}{}{}", case("soft", 0.1), case("hard", 0.8));
    let (workshop, svg) = picture(&scene);
    for text in ["soft", "hard", "mechanism.slider_x", "height", "path"] {
        assert_eq!(svg.matches(&format!("\n{text}\n")).count(), 1, "{text}");
    }
    assert!(!svg.contains("slider_y"));
    assert!(workshop.path().join("out/hard/results.csv").exists());
}

#[test]
fn an_unknown_column_of_an_axis_is_told_with_the_nearest() {
    let workshop = Workshop::new();
    let scene = SLIDER_CRANK.replace(
        "over = \"mechanism.slider_x\"",
        "over = \"mechanism.slidr_x\"",
    );
    workshop.write("scene.toml", scene);
    let arguments = ["run", "scene.toml", "--out", "out", "--in-process"];
    workshop.run(&arguments).fails(
        2,
        &[
            "`over` of panel \"y in m\"",
            "no column \"mechanism.slidr_x\"",
            "did you mean \"mechanism.slider_x\"?",
        ],
    );
}
