//! `linchpin graph`.

use linchpin_tests::process::Workshop;
use linchpin_tests::python::in_repository;

#[test]
fn a_mechanism_that_closes_is_drawn() {
    let workshop = Workshop::new();
    let scene = in_repository("scenes/four-bar.toml").display().to_string();
    let outcome = workshop.run(&["graph", &scene]);
    outcome.succeeds();
    let svg = &outcome.stdout;
    assert!(
        svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""),
        "{svg}"
    );
    // Four bodies, and four hinges as lines of one or more pieces.
    assert_eq!(svg.matches("class=\"box\"").count(), 4);
    assert!(svg.matches("class=\"joint\"").count() >= 4);
    assert!(svg.matches(">revolute<").count() == 4 && !svg.contains("class=\"signal\""));
    workshop
        .run(&["graph", &scene, "--file", "four-bar.svg"])
        .succeeds();
    assert_eq!(workshop.read("four-bar.svg"), *svg);
}

/// The labels of a chain stand apart, and the picture is as large as what it shows.
#[test]
fn labels_do_not_touch() {
    let workshop = Workshop::new();
    let scene = in_repository("scenes/chain/8.toml").display().to_string();
    let svg = workshop.run(&["graph", &scene]).stdout;
    let number = |text: &str, name: &str| -> f64 {
        let (_, rest) = text.split_once(&format!(" {name}=\"")).unwrap();
        rest.split('"').next().unwrap().parse().unwrap()
    };
    let mut labels: Vec<[f64; 4]> = Vec::new();
    for line in svg.lines().filter(|line| line.starts_with("<text")) {
        let text = line.split('>').nth(1).unwrap().split('<').next().unwrap();
        let (x, y) = (number(line, "x"), number(line, "y"));
        let half = 14.0 * 0.6 * text.chars().count() as f64 / 2.0;
        labels.push([x - half, x + half, y - 11.0, y + 3.0]);
    }
    assert!(labels.len() > 16);
    for (place, one) in labels.iter().enumerate() {
        for other in &labels[..place] {
            let apart = one[0] >= other[1]
                || other[0] >= one[1]
                || one[2] >= other[3]
                || other[2] >= one[3];
            assert!(apart, "{one:?} {other:?}");
        }
    }
}

#[test]
fn graphviz_gets_the_same() {
    let workshop = Workshop::new();
    let scene = in_repository("scenes/motor/driven-link.toml")
        .display()
        .to_string();
    let outcome = workshop.run(&["graph", &scene, "--format", "dot"]);
    outcome.succeeds();
    let lines: Vec<&str> = outcome.stdout.lines().map(str::trim).collect();
    assert_eq!(lines[0], "digraph \"motor-driven-link\" {");
    let signal = "\"motor\" -> \"controller\" [label=\"rate \u{2192} measured\", style=dashed];";
    assert!(lines.contains(&signal), "{outcome}");
    let joints = lines
        .iter()
        .filter(|line| line.contains("dir=none"))
        .count();
    assert_eq!(joints, 2);
}

#[test]
fn a_scene_that_is_wrong_has_no_graph() {
    let workshop = Workshop::new();
    workshop.write("scene.toml", "[scene]\nname = \"x\"\n");
    workshop
        .run(&["graph", "scene.toml"])
        .fails(2, &["scene.toml"]);
    let scene = in_repository("scenes/four-bar.toml").display().to_string();
    workshop
        .run(&["graph", &scene, "--file", "no/x.svg"])
        .fails(1, &["no/x.svg"]);
}
