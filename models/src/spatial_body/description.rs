//! What the model tells a master about itself.

use linchpin_proto::v1;

use crate::mechanics::describe::{at_zero, gravity, needed, output};
use crate::mechanics::markers::SPATIAL;

/// Outputs of one marker.
pub const OUTPUTS_PER_MARKER: usize = SPATIAL.outputs_per_marker();
/// Place of the centre's position among the outputs, behind those of the markers.
pub const POSITION: usize = 2 * OUTPUTS_PER_MARKER;
/// Place of the centre's velocity.
pub const VELOCITY: usize = POSITION + 3;
/// Place of the angular velocity in the body's axes.
pub const OMEGA: usize = VELOCITY + 3;
/// Place of the energy.
pub const ENERGY: usize = OMEGA + 3;

const START: &str = "start";
const END: &str = "end";

pub fn model() -> v1::Model {
    v1::Model {
        name: "spatial-body".to_owned(),
        description: "Free rigid body in space with two markers".to_owned(),
        parameters: parameters(),
        ..SPATIAL.model([START, END], own_outputs())
    }
}

fn own_outputs() -> [v1::Variable; 10] {
    [
        output("x", "m", "position of the centre of mass in x"),
        output("y", "m", "position of the centre of mass in y"),
        output("z", "m", "position of the centre of mass in z"),
        output("vx", "m/s", "velocity of the centre of mass in x"),
        output("vy", "m/s", "velocity of the centre of mass in y"),
        output("vz", "m/s", "velocity of the centre of mass in z"),
        output("omega1", "rad/s", "angular velocity about principal axis 1"),
        output("omega2", "rad/s", "angular velocity about principal axis 2"),
        output("omega3", "rad/s", "angular velocity about principal axis 3"),
        output(
            "energy",
            "J",
            "kinetic energy and potential energy above z = 0",
        ),
    ]
}

fn parameters() -> Vec<v1::Parameter> {
    let inertia = |name, axis| {
        let description = format!(
            "moment of inertia about principal axis {axis}, greater than 0, at most the sum of the other two"
        );
        needed(name, "kg m^2", &description)
    };
    let in_body = |name, marker, axis| {
        let description =
            format!("place of marker {marker} on principal axis {axis}, from the centre of mass");
        at_zero(name, "m", &description)
    };
    let mut parameters = vec![
        needed("m", "kg", "mass, greater than 0"),
        inertia("j1", 1),
        inertia("j2", 2),
        inertia("j3", 3),
        gravity("z"),
        in_body("start_x", START, 1),
        in_body("start_y", START, 2),
        in_body("start_z", START, 3),
        in_body("end_x", END, 1),
        in_body("end_y", END, 2),
        in_body("end_z", END, 3),
    ];
    parameters.extend(start_parameters());
    parameters
}

fn start_parameters() -> [v1::Parameter; 12] {
    let rotation = |name| {
        let description =
            "rotation vector that turns the axes of space into those of the body at the start";
        at_zero(name, "rad", description)
    };
    let centre = |name, unit, what| {
        let description = format!("{what} of the centre of mass in space at the start");
        at_zero(name, unit, &description)
    };
    let omega = |name, axis| {
        let description = format!("angular velocity about principal axis {axis} at the start");
        at_zero(name, "rad/s", &description)
    };
    [
        centre("x0", "m", "position"),
        centre("y0", "m", "position"),
        centre("z0", "m", "position"),
        rotation("rx0"),
        rotation("ry0"),
        rotation("rz0"),
        centre("vx0", "m/s", "velocity"),
        centre("vy0", "m/s", "velocity"),
        centre("vz0", "m/s", "velocity"),
        omega("omega1_0", 1),
        omega("omega2_0", 2),
        omega("omega3_0", 3),
    ]
}
