//! The oscillator scene of S1 with settings changed.

use linchpin_master::scene::{Override, Scene, parse};

const OSCILLATOR: &str = include_str!("../../scenes/oscillator.toml");

/// `scenes/oscillator.toml` with other `coupling` settings, given as `"index=1 beta=2e-3 gamma=1e-6"`.
pub fn oscillator(coupling: &str) -> Scene {
    oscillator_with(coupling, &[])
}

/// Like [`oscillator`], with more overrides, each as `"key=value"`.
pub fn oscillator_with(coupling: &str, others: &[&str]) -> Scene {
    with_settings(OSCILLATOR, coupling, others)
}

/// [`oscillator`] with Hermite coupling over 1 s, in macro steps of `h` (s), with the velocities among its results.
pub fn hermite_oscillator(coupling: &str, h: f64) -> Scene {
    let coupling = format!("method=hermite {coupling} macro_step={h:e}");
    let velocities = "output.variables=[\"mass1.v\", \"mass2.v\"]";
    oscillator_with(&coupling, &["scene.t_end=1", velocities])
}

/// A scene given as text with other `coupling` settings and more overrides.
pub fn with_settings(text: &str, coupling: &str, others: &[&str]) -> Scene {
    let coupling = coupling
        .split_whitespace()
        .map(|setting| format!("coupling.{setting}"));
    let others = others.iter().map(|setting| (*setting).to_owned());
    let overrides: Vec<Override> = coupling
        .chain(others)
        .map(|setting| setting.parse().unwrap())
        .collect();
    parse(text, "test scene", &overrides).unwrap_or_else(|errors| panic!("{errors}"))
}

/// The override that gives all masses the solver Radau IIA(5) with its default tolerances.
pub const RADAU5: &str = "subsystem.*.solver={ kind = \"radau5\" }";
