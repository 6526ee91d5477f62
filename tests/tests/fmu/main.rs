//! FMUs of FMI 2.0 and 3.0 as workers: trajectories, grades, faults, states, and the conformance kit.

#![allow(clippy::unwrap_used, missing_docs)]

mod faults;
mod grades;
mod inputs;
mod kit;
mod mistakes;
mod serving;
mod table;
mod trajectories;

use linchpin_tests::fmus::TestFmu;
use linchpin_tests::process::Workshop;

/// The oscillators of the guide, the second one served by an FMU.
pub const MASSES: &str = r#"
[scene]
name = "masses"
t_end = 0.2

[coupling]
macro_step = 2e-3

[[subsystem]]
name = "mass1"
model = "oscillator"
parameters = { m = 1.0, c = 1000.0, d = 10.0, v0 = 100.0 }

[[subsystem]]
name = "mass2"
fmu = "mass.fmu"
[subsystem.parameters]
m = 2.0
c = 1000.0
d = 10.0
v = 100.0
[subsystem.parameters.marker.mass]
kind = "scalar"
names = "*"

[[joint]]
name = "link"
kind = "rigid-link"
a = "mass1"
b = "mass2"
"#;

/// A folder with a scene and the FMU `mass.fmu` of it.
pub fn workshop(scene: &str, fmu: &TestFmu) -> Workshop {
    let workshop = Workshop::new();
    workshop.write("scene.toml", scene);
    fmu.write(&workshop.path().join("mass.fmu"));
    workshop
}

/// `run scene.toml --out out` with more arguments.
pub fn run<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [
        &["run", "scene.toml", "--out", "out", "--no-plots", "--quiet"],
        more,
    ]
    .concat()
}
