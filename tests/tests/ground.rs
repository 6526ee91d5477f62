//! `ground` as the end of a joint, against models that have their hinge inside.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::setup::Options;
use linchpin_tests::runs::{Trajectory, run, try_run};
use linchpin_tests::scenes::with_settings;

const TIGHT: &str = "subsystem.*.solver={ kind = \"radau5\", rtol = 1e-12, atol = 1e-12 }";

const HUNG: &str = r#"
[scene]
name = "hung"
t_end = 1.0
[[subsystem]]
name = "rod"
model = "planar-body"
parameters = { m = 2.0, inertia = 0.19, length = 1.1, x0 = 0.3, y0 = 0.2, angle0 = -0.4 }
[[joint]]
name = "pin"
kind = "atpoint"
a = "ground"
point_a = [0.3, 0.2]
b = "rod.start"
"#;

const PENDULUM: &str = r#"
[scene]
name = "pendulum"
t_end = 1.0
[coupling]
macro_step = 1e-2
[[subsystem]]
name = "rod"
model = "pendulum"
parameters = { m = 2.0, inertia = 0.19, length = 1.1, angle0 = -0.4 }
[output]
variables = ["rod.tip_angle"]
"#;

const TOP: &str = r#"
[scene]
name = "flywheel"
t_end = 0.8
[[subsystem]]
name = "wheel"
model = "spatial-body"
[subsystem.parameters]
m = 1.5
j1 = 0.02
j2 = 0.03
j3 = 0.04
start_x = -0.2
x0 = 0.2
gravity = 0.0
omega3_0 = 5.0
vy0 = 1.0
[[joint]]
name = "bearing"
kind = "revolute"
a = "wheel.start"
axis_a = [0.0, 0.0, 1.0]
b = "ground"
axis_b = [0.0, 0.0, 1.0]
"#;

fn last(run: &Trajectory, column: &str) -> f64 {
    *run.column(column).last().unwrap()
}

#[test]
fn a_rod_on_a_pin_is_a_pendulum() {
    let angle = last(
        &run(&with_settings(PENDULUM, "", &[TIGHT]), Place::InProcess),
        "rod.tip_angle",
    );
    let variables = "output.variables=[\"rod.angle\"]";
    for (coupling, most) in [
        ("method=hermite macro_step=1e-2", 2e-8),
        (
            "method=hermite degree=3 macro_step=1e-2 iterations={most=5,tolerance=1e-10}",
            1e-10,
        ),
        ("method=hermite tolerance=1e-7", 1e-6),
        ("method=weighted degree=2 macro_step=2e-3", 1e-6),
        ("method=baumgarte macro_step=2e-3 degree=2", 1e-6),
    ] {
        let found = run(
            &with_settings(HUNG, coupling, &[TIGHT, variables]),
            Place::InProcess,
        );
        let off = (last(&found, "rod.angle") - angle).abs();
        println!("{coupling}: {off:.1e}");
        assert!(off < most, "{coupling}: {off:e}");
        assert!(
            found.statistics.warnings().is_empty(),
            "{:?}",
            found.statistics.warnings()
        );
        assert!(found.statistics.redundancy.joints.is_empty());
    }
}

/// A wheel on an axle that stands: it turns on at its rate, and its centre goes round.
#[test]
fn a_wheel_on_an_axle_turns_on() {
    for coupling in [
        "method=hermite degree=3 macro_step=1e-2",
        "method=weighted tolerance=1e-6",
    ] {
        let found = run(&with_settings(TOP, coupling, &[TIGHT]), Place::InProcess);
        let turned = 5.0 * 0.8_f64;
        let half = (last(&found, "wheel.start_qz") / last(&found, "wheel.start_qw")).atan();
        let off = (half - 0.5 * turned).rem_euclid(std::f64::consts::PI);
        let off = off.min(std::f64::consts::PI - off);
        assert!(off < 1e-6, "{coupling}: {off:e}");
    }
}

#[test]
fn a_mass_on_the_ground_stays_there() {
    let text = "[scene]\nname = \"held\"\nt_end = 0.5\n[[subsystem]]\nname = \"m\"\nmodel = \"oscillator\"\n\
                parameters = { m = 2.0, c = 70.0, load = 3.5 }\n\
                [[joint]]\nname = \"link\"\nkind = \"rigid-link\"\na = \"m\"\nb = \"ground\"\n";
    for coupling in [
        "macro_step=1e-2",
        "degree=4 macro_step=1e-2",
        "degree=3 moments=integrals macro_step=1e-2",
    ] {
        let found = run(&with_settings(text, coupling, &[]), Place::InProcess);
        assert!(last(&found, "m.x").abs() < 1e-15, "{coupling}");
        assert!(
            (last(&found, "link.lambda").abs() - 3.5).abs() < 1e-9,
            "{coupling}"
        );
    }
}

#[test]
fn what_the_ground_is_not() {
    let refused = |from: &str, to: &str| {
        let coupling = "[coupling]\nmacro_step = 1e-2\n[[subsystem]]";
        let text = HUNG.replace(from, to).replace("[[subsystem]]", coupling);
        let scene = linchpin_master::scene::parse(&text, "hung.toml", &[]);
        match scene {
            Err(error) => error.to_string(),
            Ok(scene) => try_run(&scene, Place::InProcess, &Options::default())
                .unwrap_err()
                .to_string(),
        }
    };
    let no_marker = refused("\"ground\"", "\"ground.floor\"");
    for word in ["floor", "ground"] {
        assert!(no_marker.contains(word), "{no_marker}");
    }
    let both = refused("\"rod.start\"", "\"ground\"");
    assert!(both.contains("ground"), "{both}");
    let kinds = refused("\"ground\"", "\"ground.space\"");
    assert!(
        kinds.contains("spatial") && kinds.contains("planar"),
        "{kinds}"
    );
}
