//! The parts of a scene file.

use linchpin_master::joint::composite::Frame;
use linchpin_models::reference::{BodyMotion, CompositeJoint, RigidBody};
use nalgebra::{UnitQuaternion, Vector3};

use super::joints::name;

/// Adaptive solver whose errors are far below those of a coupling.
pub const SOLVER: &str = "solver = { kind = \"radau5\", rtol = 1e-12, atol = 1e-12 }";

/// Head of a scene with the coupling that the suites measure: weighted multipliers of index 1 with k = 1.
pub fn head(name: &str, t_end: f64) -> String {
    format!(
        "[scene]\nname = \"{name}\"\nt_end = {t_end:?}\n\n[coupling]\nmethod = \"weighted\"\nmacro_step = 1e-3\n\
         degree = 1\nexchanged_degree = 2\n"
    )
}

/// A `spatial-body` that starts with `motion`; its markers `start` and `end` stand at `markers`.
pub fn body(
    name: &str,
    body: &RigidBody,
    motion: &BodyMotion,
    markers: [Vector3<f64>; 2],
    gravity: f64,
) -> String {
    let turn = UnitQuaternion::new_unchecked(motion.attitude).scaled_axis();
    let vectors = [
        (["j1", "j2", "j3"], body.moments),
        (["start_x", "start_y", "start_z"], markers[0]),
        (["end_x", "end_y", "end_z"], markers[1]),
        (["x0", "y0", "z0"], motion.position),
        (["rx0", "ry0", "rz0"], turn),
        (["vx0", "vy0", "vz0"], motion.velocity),
        (["omega1_0", "omega2_0", "omega3_0"], motion.omega),
    ];
    let vectors = vectors.map(|(names, v)| {
        let parts = names
            .iter()
            .zip(v.iter())
            .map(|(key, value)| format!(", {key} = {value:?}"));
        parts.collect::<String>()
    });
    format!(
        "\n[[subsystem]]\nname = \"{name}\"\nmodel = \"spatial-body\"\n\
         parameters = {{ m = {:?}, gravity = {gravity:?}{} }}\n{SOLVER}\n",
        body.m,
        vectors.concat()
    )
}

/// A joint between the markers `sides`.
pub fn joint(name_: &str, joint: &CompositeJoint, sides: [&str; 2], frame: &Frame) -> String {
    let [a, b] = sides;
    let mut text = format!(
        "\n[[joint]]\nname = \"{name_}\"\nkind = \"{}\"\na = \"{a}\"\nb = \"{b}\"\n",
        name(joint)
    );
    let mut list = |key: &str, values: &[f64]| text += &format!("{key} = {values:?}\n");
    let has_points = !matches!(
        joint,
        CompositeJoint::Orientation | CompositeJoint::Perpendicular(_)
    );
    if has_points {
        list("point_a", frame.points[0].as_slice());
        list("point_b", frame.points[1].as_slice());
    }
    match joint {
        CompositeJoint::Universal(_)
        | CompositeJoint::Perpendicular(_)
        | CompositeJoint::Revolute(_)
        | CompositeJoint::Cylindrical(_)
        | CompositeJoint::Planar(_) => {
            list("axis_a", frame.axes[0].as_slice());
            list("axis_b", frame.axes[1].as_slice());
        }
        CompositeJoint::Translational(_)
        | CompositeJoint::Inline(_)
        | CompositeJoint::InPlane(_) => {
            list("axis_b", frame.axes[1].as_slice());
        }
        _ => {}
    }
    let keeps_attitude = matches!(
        joint,
        CompositeJoint::Orientation | CompositeJoint::Translational(_) | CompositeJoint::Weld
    );
    if keeps_attitude {
        let q = frame.attitude;
        list("attitude", &[q.w, q.i, q.j, q.k]);
    }
    text
}

/// The outputs that tell the motions of `spatial-body` subsystems.
pub fn output(bodies: &[&str]) -> String {
    let names = bodies.iter().flat_map(|body| {
        super::compare::BODY_OUTPUTS
            .iter()
            .map(move |output| format!("\"{body}.{output}\""))
    });
    let names: Vec<String> = names.collect();
    format!("\n[output]\nvariables = [{}]\n", names.join(", "))
}
