//! Loads evaluated in the workers and loads that the master sends as force and moment: the same motion to the order of
//! the method.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_models::reference::CompositeJoint;
use linchpin_tests::convergence::slope_of;
use linchpin_tests::in_space::compare::{motions, pose_errors};
use linchpin_tests::in_space::joints::{name, unit};
use linchpin_tests::in_space::pair::Pair;
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::with_settings;

const STEPS: [f64; 3] = [4e-3, 2e-3, 1e-3];

/// Couplings with the order of their positions.
const COUPLINGS: [(&str, f64); 3] = [
    ("degree=1 exchanged_degree=2", 3.0),
    ("degree=0 exchanged_degree=2", 3.0),
    ("degree=0 exchanged_degree=0", 1.0),
];

const T_END: f64 = 0.24;

/// Runs a scene in both forms at each macro step and asserts the order of what `difference` finds between them.
fn assert_orders(what: &str, text: &str, difference: impl Fn(&[Trajectory; 2]) -> f64) {
    for (coupling, order) in COUPLINGS {
        let differences = STEPS.map(|h| {
            let forms = ["worker", "master"].map(|loads| {
                let coupling = format!("{coupling} macro_step={h} loads={loads}");
                run(&with_settings(text, &coupling, &[]), Place::InProcess)
            });
            difference(&forms)
        });
        let observed = slope_of(STEPS.into_iter().zip(differences));
        println!("{what}, {coupling}: {observed:.2} of {differences:?}");
        assert!(
            observed > order - 0.15,
            "{what}, {coupling}: order {observed} of {differences:?}"
        );
    }
}

#[test]
fn joints_in_space() {
    let axis = unit(3.0, -1.0, 2.0);
    for joint in [
        CompositeJoint::Revolute(axis),
        CompositeJoint::Cylindrical(axis),
    ] {
        let text = Pair::floating(joint).scene_text(T_END);
        assert_orders(name(&joint), &text, |forms| {
            let bodies = ["inner", "outer"].map(|body| {
                let [one, other] = forms.each_ref().map(|run| motions(run, body));
                let [position, attitude] = pose_errors(&one, other.iter());
                position.max(attitude)
            });
            bodies[0].max(bodies[1])
        });
    }
}

/// A slide along a tilted axis of link b, 0.3 m from its start; both links turn and the slide is on the way.
fn slide() -> String {
    let (angle_b, rate) = (0.4_f64, 2.3);
    let (axis, kept) = (0.7_f64, 1.1);
    let along = |angle: f64, length: f64| [length * angle.cos(), length * angle.sin()];
    // From the start of b to the start of a: first to the point in b, then along the axis.
    let offset = along(angle_b + 0.35, 0.3);
    let slide = along(angle_b + axis, 0.2);
    let sliding = along(angle_b + axis, -1.7);
    let [x, y] = [offset[0] + slide[0], offset[1] + slide[1]];
    let [vx, vy] = [-rate * y + sliding[0], rate * x + sliding[1]];
    let point = along(0.35, 0.3);
    let direction = along(axis, 1.0);
    format!(
        r#"
[scene]
name = "slide"
t_end = {T_END:?}

[coupling]
method = "weighted"
macro_step = 1e-3

[[subsystem]]
name = "a"
model = "planar-body"
parameters = {{ m = 1.3, inertia = 0.09, length = 0.8, x0 = {x:?}, y0 = {y:?}, angle0 = {angle_a:?}, vx0 = {vx:?}, vy0 = {vy:?}, rate0 = {rate:?} }}
solver = {{ kind = "radau5", rtol = 1e-12, atol = 1e-12 }}

[[subsystem]]
name = "b"
model = "planar-body"
parameters = {{ m = 0.7, inertia = 0.05, length = 0.6, gravity = 0.0, angle0 = {angle_b:?}, rate0 = {rate:?} }}
solver = {{ kind = "radau5", rtol = 1e-12, atol = 1e-12 }}

[[joint]]
name = "slide"
kind = "translational"
a = "a.start"
b = "b.start"
point_b = {point:?}
axis_b = {direction:?}
angle = {kept:?}

[output]
variables = ["a.x", "a.y", "a.angle", "b.x", "b.y", "b.angle"]
"#,
        angle_a = angle_b + kept,
    )
}

#[test]
fn a_slide_in_the_plane() {
    assert_orders("translational", &slide(), |[one, other]| {
        let columns = ["a.x", "a.y", "a.angle", "b.x", "b.y", "b.angle"];
        let differences = columns.into_iter().flat_map(|column| {
            let pairs = one.column(column).into_iter().zip(other.column(column));
            pairs.map(|(one, other)| (one - other).abs())
        });
        differences.fold(0.0, f64::max)
    });
}
