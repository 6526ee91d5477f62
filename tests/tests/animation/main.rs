//! `run --animate`: the page against the table of results, and what the option must leave alone.

#![allow(clippy::unwrap_used)]

mod impacts;
mod page;

use std::sync::Arc;

use linchpin_proto::v1;
use linchpin_tests::process::{Peer, Workshop};
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Host, Inputs, Interval, Model, Setup, Snapshot, StepFailure, Subsystem};

use page::{assert_fine, assert_same_times, assert_shows, columns, film, numbers, span};

const DOUBLE_PENDULUM: &str = include_str!("../../../scenes/double-pendulum.toml");
const OSCILLATOR: &str = include_str!("../../../scenes/oscillator.toml");

/// Two bodies in space with a tilted start; the second one's end is held by no joint.
const PAIR: &str = r#"
[scene]
name = "pair"
t_end = 0.3

[coupling]
method = "weighted"
macro_step = 1e-3
jacobian = "every-step"    # kept columns read attitudes

[[subsystem]]
name = "a"
model = "spatial-body"
parameters = { m = 1.3, j1 = 0.11, j2 = 0.23, j3 = 0.19, end_x = 0.4, end_y = -0.1, end_z = 0.2, omega1_0 = 2.0, omega2_0 = -3.0, omega3_0 = 5.0 }

[[subsystem]]
name = "b"
model = "spatial-body"
parameters = { m = 0.7, j1 = 0.05, j2 = 0.09, j3 = 0.13, x0 = 0.4, y0 = -0.1, z0 = 0.2, rx0 = 0.5, ry0 = -0.8, rz0 = 1.1, vx0 = -0.1, vy0 = 1.6, vz0 = 1.0, end_x = -0.3, end_y = 0.2, end_z = 0.7, omega1_0 = 4.0, omega2_0 = 1.0, omega3_0 = -2.0 }

[[joint]]
name = "ball"
kind = "atpoint"
a = "a.end"
b = "b.start"
"#;

/// Runs `scene` with more arguments, in one process.
fn run(scene: &str, more: &[&str]) -> Workshop {
    let workshop = Workshop::new();
    workshop.write("scene.toml", scene);
    let arguments = [
        "run",
        "scene.toml",
        "--out",
        "out",
        "--no-plots",
        "--in-process",
    ];
    workshop.run(&[&arguments[..], more].concat()).succeeds();
    workshop
}

#[test]
fn a_planar_scene() {
    let workshop = run(DOUBLE_PENDULUM, &["--animate"]);
    let page = workshop.read("out/animation.html");
    let film = film(&page);
    let expected: [(&str, &[&str]); 4] = [
        ("link1.tip", &["tip_x", "tip_y", "tip_angle"]),
        ("link1.centre", &["centre_x", "centre_y", "centre_angle"]),
        ("link2.start", &["start_x", "start_y", "start_angle"]),
        ("link2.end", &["end_x", "end_y", "end_angle"]),
    ];
    let table = columns(&workshop, "out/results.csv");
    assert_shows(&film, &table, 2, &expected);
    // The end of link 2 sweeps the whole width.
    assert_fine(&film, span(&table["link2.end_x"]));
    assert_eq!(film["joints"][0]["ends"], serde_json::json!([0, 2]));
    assert_eq!(film["bodies"], serde_json::json!([[0, 1], [2, 3]]));
    assert!(page.contains("501 of the 1001 rows"), "{}", &page[..900]);
}

/// The dots of a closed joint coincide where it holds, away from both markers.
#[test]
fn a_joint_is_drawn_where_it_holds() {
    // Tip of link 1 plus (-0.2, 0.1) in its axes, at 45 degrees, less (0.3, 0.1) in those of link 2, at -45 degrees.
    let scene = DOUBLE_PENDULUM
        .replace(
            "x0 = 0.7071067811865476, y0 = 0.7071067811865476",
            "x0 = 0.21213203435596426, y0 = 0.7778174593052023",
        )
        .replace(
            "b = \"link2.start\"",
            "b = \"link2.start\"\npoint_a = [-0.2, 0.1]\npoint_b = [0.3, 0.1]",
        );
    let page = run(&scene, &["--animate"]).read("out/animation.html");
    let centres = |group: &str| -> Vec<(f64, f64)> {
        let (_, rest) = page.split_once(&format!("<g id=\"{group}\">")).unwrap();
        let circles = rest
            .split_once("\n</g>\n")
            .unwrap()
            .0
            .split("<circle cx=\"")
            .skip(1);
        let centre = |circle: &str| {
            let mut numbers = circle.split('"');
            (
                numbers.next().unwrap().parse().unwrap(),
                numbers.nth(1).unwrap().parse().unwrap(),
            )
        };
        circles.map(centre).collect()
    };
    let apart = |(x, y): (f64, f64), other: (f64, f64)| (x - other.0).hypot(y - other.1);
    let [tip, _, start, _] = centres("markers")[..] else {
        panic!("four markers")
    };
    let [a, b] = centres("joints")[..] else {
        panic!("one joint")
    };
    assert!(apart(a, b) < 0.15, "{a:?} {b:?}");
    // Lengths of the two points, by the same scale.
    let scale = film(&page)["view"]["scale"].as_f64().unwrap();
    assert!((apart(tip, a) - scale * 0.2_f64.hypot(0.1)).abs() < 0.15);
    assert!((apart(start, b) - scale * 0.3_f64.hypot(0.1)).abs() < 0.15);
}

#[test]
fn a_scene_in_space() {
    let workshop = run(PAIR, &["--animate"]);
    let film = film(&workshop.read("out/animation.html"));
    let start = [
        "start_x", "start_y", "start_z", "start_qw", "start_qx", "start_qy", "start_qz",
    ];
    let end = [
        "end_x", "end_y", "end_z", "end_qw", "end_qx", "end_qy", "end_qz",
    ];
    let expected: [(&str, &[&str]); 4] = [
        ("a.start", &start),
        ("a.end", &end),
        ("b.start", &start),
        ("b.end", &end),
    ];
    assert_shows(&film, &columns(&workshop, "out/results.csv"), 1, &expected);
    assert_eq!(film["joints"][0]["ends"], serde_json::json!([1, 2]));
    assert!(film["view"]["turn"].is_object() && film["scenery"].is_object());
}

#[test]
fn masses_on_a_line_have_lanes() {
    let workshop = run(OSCILLATOR, &["--animate", "--set", "output.every=10"]);
    let film = film(&workshop.read("out/animation.html"));
    let expected: [(&str, &[&str]); 2] = [("mass1.mass", &["x"]), ("mass2.mass", &["x"])];
    let table = columns(&workshop, "out/results.csv");
    assert_shows(&film, &table, 1, &expected);
    assert_fine(&film, span(&table["mass1.x"]));
    let lanes: Vec<f64> = [0, 1]
        .map(|number| film["markers"][number]["lane"].as_f64().unwrap())
        .into();
    assert!(lanes[0] > lanes[1]);
}

/// Nothing but what stands in the file is needed to show it.
#[test]
fn the_page_is_complete() {
    for scene in [DOUBLE_PENDULUM, PAIR, OSCILLATOR] {
        let page = run(scene, &["--animate"]).read("out/animation.html");
        for reference in [
            "http:", "https:", "//", "src=", "href", "url(", "@import", "import(", "fetch(",
            "XMLHttp",
        ] {
            // Comments of the script are no references.
            let lines = page
                .lines()
                .filter(|line| !line.trim_start().starts_with("// "));
            for line in lines {
                assert!(!line.contains(reference), "{reference} in {line}");
            }
        }
        assert!(page.len() < 300_000, "{}", page.len());
    }
}

/// Without the option the positions that no joint reads are neither recorded nor sent, and what is there keeps its bits.
#[test]
fn the_option_changes_no_result() {
    let plain = run(PAIR, &[]);
    assert!(!plain.path().join("out/animation.html").exists());
    let before = columns(&plain, "out/results.csv");
    let after = columns(&run(PAIR, &["--animate"]), "out/results.csv");
    assert!(!before.contains_key("b.end_x") && !before.contains_key("a.end_qw"));
    for (name, values) in &before {
        let bits =
            |values: &[f64]| -> Vec<u64> { values.iter().map(|value| value.to_bits()).collect() };
        assert_eq!(bits(values), bits(&after[name]), "{name}");
    }
    assert_eq!(after.len() - before.len(), 2 * 4 + 2 * 7);
}

#[test]
fn every_case_has_a_page() {
    let cases = "\n[[case]]\nname = \"k = 0\"\nset = { \"coupling.degree\" = 0 }\n\
                 [[case]]\nname = \"soft & <slow>\"\nset = { \"coupling.degree\" = 1 }\n";
    let workshop = run(&format!("{PAIR}{cases}"), &["--animate"]);
    for (folder, title) in [
        ("k-0", "pair [k = 0]"),
        ("soft-slow", "pair [soft &amp; &lt;slow&gt;]"),
    ] {
        let page = workshop.read(&format!("out/{folder}/animation.html"));
        assert!(
            page.contains(&format!("<title>{title}</title>")),
            "{}",
            &page[..500]
        );
        let table = columns(&workshop, &format!("out/{folder}/results.csv"));
        assert_same_times(&numbers(&film(&page)["t"]), &table["t"]);
    }
    assert!(!workshop.path().join("out/animation.html").exists());
}

/// A run that shows nothing leaves no page of an earlier one.
#[test]
fn an_earlier_page_does_not_stay() {
    let workshop = run(PAIR, &["--animate"]);
    let again = [
        "run",
        "scene.toml",
        "--out",
        "out",
        "--no-plots",
        "--in-process",
    ];
    workshop.run(&again).succeeds();
    assert!(!workshop.path().join("out/animation.html").exists());
}

/// A model without markers.
struct Kettle;

impl Model for Kettle {
    fn describe(&self) -> v1::Model {
        v1::Model {
            name: "kettle".into(),
            ..v1::Model::default()
        }
    }

    fn initialize(&self, _: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        Ok(Box::new(Kettle))
    }
}

impl Subsystem for Kettle {
    fn step(&mut self, _: Interval, _: &Inputs) -> Result<(), StepFailure> {
        Ok(())
    }

    fn outputs(
        &mut self,
        _: f64,
        _: &[f64],
        _: &[usize],
        _: &mut [f64],
    ) -> Result<(), StepFailure> {
        Ok(())
    }

    fn snapshot(&self, _: &mut Snapshot) {}

    fn restore(&mut self, _: &Snapshot) -> Result<(), StepFailure> {
        Ok(())
    }
}

#[test]
fn nothing_to_show_is_said_before_the_run() {
    let workshop = Workshop::new();
    let peer = Peer::serve(&workshop, Arc::new(Host::new(vec![Box::new(Kettle)])));
    let scene = format!(
        "[scene]\nname = \"tea\"\nt_end = 1.0\n[coupling]\nmethod = \"weighted\"\nmacro_step = 0.1\n\
         [[subsystem]]\nname = \"kettle\"\naddress = \"{}\"\n",
        peer.address()
    );
    workshop.write("scene.toml", scene);
    let arguments = ["run", "scene.toml", "--out", "out", "--no-plots"];
    workshop
        .run(&[&arguments[..], &["--animate"]].concat())
        .fails(
            2,
            &[
                "--animate",
                "no subsystem",
                "marker with a position",
                "run without it",
            ],
        );
    assert!(!workshop.path().join("out/results.csv").exists());
    workshop.run(&arguments).succeeds();
}
