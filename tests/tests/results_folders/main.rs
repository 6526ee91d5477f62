//! What is made of the folder of a run afterwards, without running again.

#![allow(clippy::unwrap_used)]

mod differences;
mod plots;

use linchpin_tests::process::Workshop;

const OSCILLATOR: &str = include_str!("../../../scenes/oscillator.toml");
const DOUBLE_PENDULUM: &str = include_str!("../../../scenes/double-pendulum.toml");

/// A folder with `scene.toml` and its run in `out`, with more arguments.
fn run(scene: &str, more: &[&str]) -> Workshop {
    let workshop = Workshop::new();
    workshop.write("scene.toml", scene);
    run_again(&workshop, "out", more);
    workshop
}

/// One more run of the scene in another folder.
fn run_again(workshop: &Workshop, out: &str, more: &[&str]) {
    let arguments = ["run", "scene.toml", "--in-process", "--quiet", "--out", out];
    workshop.run(&[&arguments[..], more].concat()).succeeds();
}

/// Arguments that set keys of a scene.
fn set<'a>(settings: &[&'a str]) -> Vec<&'a str> {
    settings.iter().flat_map(|own| ["--set", own]).collect()
}
