//! A summary that fits a screen.

use linchpin_tests::process::Workshop;
use linchpin_tests::python::in_repository;

#[test]
fn of_many_subsystems_the_worst_are_shown() {
    let workshop = Workshop::new();
    let scene = in_repository("scenes/chain/64.toml").display().to_string();
    let run = [
        "run",
        &scene,
        "--in-process",
        "--no-plots",
        "--set",
        "scene.t_end=0.02",
        "--out",
        "out",
    ];
    let outcome = workshop.run(&run);
    outcome.exits_with(0);
    let lines: Vec<&str> = outcome.stdout.lines().collect();
    assert!(lines.len() <= 40, "{} lines\n{outcome}", lines.len());
    assert!(
        lines.iter().all(|line| line.chars().count() <= 120),
        "{outcome}"
    );
    let worst: Vec<f64> = lines
        .iter()
        .filter(|line| line.contains("residual of") && line.contains("position"))
        .map(|line| {
            line.split_whitespace()
                .rev()
                .nth(1)
                .unwrap()
                .parse()
                .unwrap()
        })
        .collect();
    assert!(
        worst.len() > 1 && worst.windows(2).all(|pair| pair[0] >= pair[1]),
        "{worst:?}"
    );
    let report: serde_json::Value = serde_json::from_str(&workshop.read("out/run.json")).unwrap();
    let all = report["statistics"]["joints"].as_array().unwrap();
    let positions = all.iter().filter(|own| own["level"] == "position");
    let largest = positions
        .map(|own| own["largest"].as_f64().unwrap())
        .fold(0.0, f64::max);
    assert!((worst[0] - largest).abs() < 1e-3 * largest);
    assert!(outcome.stdout.contains("more subsystems"), "{outcome}");
}
