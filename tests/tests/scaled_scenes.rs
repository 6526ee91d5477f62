//! Scenes of other mass, length and time give the same results, in those units.
//!
//! Factors are powers of two, and the time goes with the root of the length, as gravity wants it: scaled results have the bits of the others.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_models::reference::CompositeJoint;
use linchpin_proto::v1::{self, value::Kind};
use linchpin_tests::in_space::joints::unit;
use linchpin_tests::in_space::pair::Pair;
use linchpin_tests::runs::{Trajectory, try_run};
use linchpin_tests::scenes::with_settings;

/// Powers of two by which masses and times are multiplied; lengths go with the square of the time.
#[derive(Debug, Clone, Copy)]
struct Scale {
    mass: i32,
    time: i32,
}

impl Scale {
    /// The factor of a unit such as `kg m^2` or `N s/m`.
    fn of(self, unit: &str) -> f64 {
        let mut exponent = 0;
        let mut sign = 1;
        let spaced = unit.replace('/', " / ");
        for token in spaced.split_whitespace() {
            if token == "/" {
                sign = -1;
                continue;
            }
            let (name, power) = token.split_once('^').unwrap_or((token, "1"));
            let power: i32 = power.parse().unwrap();
            let one = match name.trim_matches(['(', ')']) {
                "kg" => self.mass,
                "m" => 2 * self.time,
                "s" => self.time,
                "N" => self.mass,
                "J" => self.mass + 2 * self.time,
                "1" | "rad" | "-" => 0,
                other => panic!("unit {other} of {unit}"),
            };
            exponent += sign * power * one;
        }
        2.0_f64.powi(exponent)
    }

    fn scale(self, value: &mut v1::Value, unit: &str) {
        match value.kind.as_mut() {
            Some(Kind::Number(number)) => *number *= self.of(unit),
            Some(Kind::Numbers(numbers)) => {
                for number in &mut numbers.values {
                    *number *= self.of(unit);
                }
            }
            _ => {}
        }
    }

    fn apply(self, scene: &mut Scene) {
        let models = linchpin_models::models();
        let seconds = self.of("s");
        scene.t_start *= seconds;
        scene.t_end *= seconds;
        scene.coupling.macro_step *= seconds;
        if let Some(control) = &mut scene.coupling.step_control {
            control.least_step *= seconds;
            control.greatest_step *= seconds;
        }
        for subsystem in &mut scene.subsystems {
            let name = subsystem.model.clone().unwrap();
            let described = models.iter().map(|model| model.describe());
            let model = described
                .into_iter()
                .find(|model| model.name == name)
                .unwrap();
            for parameter in &model.parameters {
                let written = subsystem.parameters.entry(parameter.name.clone());
                let default = parameter.default.map(|number| v1::Value {
                    kind: Some(Kind::Number(number)),
                });
                match (written, default) {
                    (std::collections::btree_map::Entry::Occupied(mut value), _) => {
                        self.scale(value.get_mut(), &parameter.unit);
                    }
                    (std::collections::btree_map::Entry::Vacant(place), Some(mut default)) => {
                        self.scale(&mut default, &parameter.unit);
                        place.insert(default);
                    }
                    _ => {}
                }
            }
        }
        for subsystem in &mut scene.subsystems {
            for (name, option) in subsystem.solver.iter_mut().flat_map(|own| &mut own.options) {
                if name == "step" {
                    self.scale(option, "s");
                }
            }
        }
        for joint in &mut scene.joints {
            for point in joint.geometry.points.iter_mut().flatten().flatten() {
                *point *= self.of("m");
            }
        }
    }
}

/// Two masses on springs that start off the origin.
const MASSES: &str = r#"
[scene]
name = "masses"
t_end = 0.7
[[subsystem]]
name = "one"
model = "oscillator"
parameters = { m = 1.3, c = 900.0, d = 11.0, x0 = 0.37, v0 = 2.0 }
solver = { kind = "rk4", step = 1e-3 }
[[subsystem]]
name = "other"
model = "oscillator"
parameters = { m = 0.2, c = 70.0, d = 0.3, x0 = 0.37, v0 = 2.0 }
solver = { kind = "rk4", step = 1e-3 }
[[joint]]
name = "link"
kind = "rigid-link"
a = "one"
b = "other"
"#;

/// Two links that start at rest.
const LINKS: &str = r#"
[scene]
name = "links"
t_end = 0.5
[[subsystem]]
name = "upper"
model = "pendulum"
parameters = { m = 1.7, inertia = 0.3, length = 1.25, angle0 = 0.0 }
solver = { kind = "rk4", step = 1e-3 }
[[subsystem]]
name = "lower"
model = "planar-body"
parameters = { m = 0.6, inertia = 0.04, length = 0.75, x0 = 1.25, y0 = 0.0, angle0 = 0.0 }
solver = { kind = "rk4", step = 1e-3 }
[[joint]]
name = "hinge"
kind = "atpoint"
a = "upper.tip"
b = "lower.start"
"#;

const METHODS: [&str; 7] = [
    "method=weighted degree=1 macro_step=@",
    "method=hermite macro_step=@",
    "method=hermite degree=4 macro_step=@",
    "method=weighted tolerance=1e-5",
    "method=hermite tolerance=1e-4",
    "method=hermite degree=automatic tolerance=1e-6",
    "method=weighted degree=automatic tolerance=1e-4",
];

fn run(scene: &Scene) -> Trajectory {
    try_run(scene, Place::InProcess, &Options::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// Whether two values differ by a power of two: whatever the unit of a column.
fn is_scaled(one: f64, other: f64) -> bool {
    let ratio = other / one;
    one.to_bits() == other.to_bits() || ratio == ratio.log2().round().exp2()
}

/// In space forces and moments are unknowns of one system: which of its rows has the largest entry depends on the unit of length, and with it
/// what is rounded.
#[test]
fn long_and_short_scenes_in_space_give_scaled_results() {
    for (joint, method) in joints()
        .iter()
        .flat_map(|joint| METHODS.map(|own| (joint, own)))
    {
        let scene = in_space(joint, method);
        let plain = run(&scene);
        for (mass, time) in [(0, 15), (0, -15), (-20, 9)] {
            let scale = Scale { mass, time };
            let mut scaled = scene.clone();
            scale.apply(&mut scaled);
            let found = run(&scaled);
            let place = format!("{} {method} {scale:?}", scene.name);
            let most = match &scene.coupling.step_control {
                Some(control) => control.tolerance,
                None => 1e-9,
            };
            for (column, name) in plain.columns.iter().enumerate() {
                let unit = match name.rsplit('_').next() {
                    _ if name.contains("omega") || name.contains("alpha") => continue,
                    Some("x" | "y" | "z") => scale.of("m"),
                    Some("qw" | "qx" | "qy" | "qz") => 1.0,
                    _ => continue,
                };
                let [one, other] = [&plain, &found].map(|run| run.rows[run.rows.len() - 1][column]);
                let off = (other / unit - one).abs();
                assert!(off < most, "{place}: {name} = {one:e}, scaled {other:e}");
            }
        }
    }
}

fn joints() -> [CompositeJoint; 2] {
    [
        CompositeJoint::Weld,
        CompositeJoint::Revolute(unit(1.0, 2.0, -0.5)),
    ]
}

fn in_space(joint: &CompositeJoint, method: &str) -> Scene {
    let text = Pair::turning(*joint, 1.0).scene_text(0.25);
    let rk4 = "subsystem.*.solver={ kind = 'rk4', step = 1e-3 }";
    with_settings(&text, &method.replace('@', "6e-3"), &[rk4])
}

fn in_plane((text, step): (&str, &str), method: &str) -> Scene {
    with_settings(text, &method.replace('@', step), &[])
}

#[test]
fn scaled_scenes_give_scaled_bits() {
    let in_plane = [(MASSES, "7e-3"), (LINKS, "9e-3")].map(|scene| {
        let of_method = METHODS.map(|method| self::in_plane(scene, method));
        let all = &[(30, 0), (-30, 0), (0, 15), (0, -15), (-20, 9)][..];
        (of_method.to_vec(), all)
    });
    // A degree that is lowered leaves conditions on multipliers alone, whose size among those on attitudes is not that of a mass.
    let fixed = METHODS
        .iter()
        .filter(|method| !method.contains("hermite degree=automatic"));
    let in_space = joints().map(|joint| {
        let of_method = fixed.clone().map(|method| self::in_space(&joint, method));
        (of_method.collect(), &[(30, 0), (-30, 0)][..])
    });
    for (scenes, scales) in in_plane.iter().chain(&in_space) {
        for scene in scenes {
            let plain = run(scene);
            for &(mass, time) in *scales {
                assert_scaled(scene, &plain, Scale { mass, time });
            }
        }
    }
}

fn assert_scaled(scene: &Scene, plain: &Trajectory, scale: Scale) {
    let mut scaled = scene.clone();
    scale.apply(&mut scaled);
    let found = run(&scaled);
    let place = format!("{} {:?} {scale:?}", scene.name, scene.coupling);
    assert_eq!(found.rows.len(), plain.rows.len(), "{place}");
    assert_eq!(found.integrations, plain.integrations, "{place}");
    for (row, (one, other)) in plain.rows.iter().zip(&found.rows).enumerate() {
        for ((name, one), other) in plain.columns.iter().zip(one).zip(other) {
            // An estimate that is rounding is a difference of what is rounded otherwise.
            let is_rounding = name == "error_estimate" && one.max(*other) < 1e-13;
            assert!(
                is_rounding || is_scaled(*one, *other),
                "{place}, row {row}: {name} = {one:e}, scaled {other:e}"
            );
        }
    }
}
