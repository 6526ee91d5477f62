//! The command line with connections: the motor scenes in one process and in several give an equal results.csv, byte by
//! byte, and scenes without joints are drawn.

use linchpin_tests::process::Workshop;

use crate::drive::{text, without_connections};

const SCENES: [&str; 2] = [
    include_str!("../../../scenes/motor/slider-crank.toml"),
    include_str!("../../../scenes/motor/driven-link.toml"),
];

fn table(workshop: &Workshop, name: &str, more: &[&str]) -> String {
    let mut arguments = vec!["run", "scene.toml", "--out", name, "--no-plots", "--quiet"];
    arguments.extend(["--set", "scene.t_end=0.05"]);
    arguments.extend(more);
    workshop.run(&arguments).succeeds();
    workshop.read(&format!("{name}/results.csv"))
}

#[test]
fn results_do_not_depend_on_where_the_workers_are() {
    for scene in SCENES {
        let workshop = Workshop::new();
        workshop.write("scene.toml", scene);
        for method in ["weighted", "explicit"] {
            let method = format!("coupling.method={method}");
            let mut settings = vec!["--set", &method];
            if method.ends_with("explicit") {
                settings.extend(["--set", "coupling.mu=10H", "--set", "coupling.degree=0"]);
                settings.extend(["--set", "coupling.exchanged_degree=0"]);
            }
            let run =
                |name: &str, more: &[&str]| table(&workshop, name, &[&settings[..], more].concat());
            let expected = run("in-process", &["--in-process"]);
            assert_eq!(expected.lines().count(), 1 + 1 + 50);
            assert_eq!(run("threads", &["--in-process", "--threads"]), expected);
            assert_eq!(run("processes", &[]), expected);
            let unary = ["--set", "subsystem.*.calls=unary"];
            assert_eq!(run("unary", &unary), expected);
        }
    }
}

#[test]
fn a_scene_without_joints_is_drawn() {
    let workshop = Workshop::new();
    workshop.write("scene.toml", text());
    let run = ["run", "scene.toml", "--out", "out", "--quiet"];
    workshop.run(&run).succeeds();
    let picture = workshop.read("out/results.svg");
    assert!(picture.starts_with("<svg") || picture.starts_with("<?xml"));
    let finest = "[converge]\nmacro_steps = [1e-2, 5e-3, 2.5e-3]\n";
    workshop.write("scene.toml", text() + finest);
    let converge = ["converge", "scene.toml", "--out", "study", "--quiet"];
    workshop.run(&converge).succeeds();
}

#[test]
fn a_scene_with_nothing_to_draw_has_no_picture() {
    let workshop = Workshop::new();
    let text = without_connections();
    let (scene, _) = text.split_once("[output]").unwrap();
    workshop.write("scene.toml", scene);
    let run = ["run", "scene.toml", "--out", "out", "--quiet"];
    workshop.run(&run).succeeds();
    assert!(workshop.read("out/results.csv").starts_with("t\n"));
    assert!(!workshop.path().join("out/results.svg").exists());
}
