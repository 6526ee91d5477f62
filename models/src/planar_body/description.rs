//! What the model tells a master about itself.

use linchpin_proto::v1;

use crate::mechanics::describe::{at_zero, gravity, needed, output, state};
use crate::mechanics::markers::PLANAR;

/// Outputs of one marker.
pub const OUTPUTS_PER_MARKER: usize = PLANAR.outputs_per_marker();
/// Place of the first output behind those of the markers: the states, in their order.
pub const STATES: usize = 2 * OUTPUTS_PER_MARKER;
/// Place of the energy.
pub const ENERGY: usize = STATES + 6;

const START: &str = "start";
const END: &str = "end";

pub fn model() -> v1::Model {
    v1::Model {
        name: "planar-body".to_owned(),
        description: "Free rigid link in the plane with a marker at each end".to_owned(),
        parameters: parameters(),
        states: vec![
            state("start_x", "x0"),
            state("start_y", "y0"),
            state("start_angle", "angle0"),
            state("start_vx", "vx0"),
            state("start_vy", "vy0"),
            state("start_rate", "rate0"),
        ],
        ..PLANAR.model([START, END], own_outputs())
    }
}

fn own_outputs() -> [v1::Variable; 7] {
    [
        output("x", "m", "position of the centre of mass in x"),
        output("y", "m", "position of the centre of mass in y"),
        output("angle", "rad", "angle of the link from the x axis"),
        output("vx", "m/s", "velocity of the centre of mass in x"),
        output("vy", "m/s", "velocity of the centre of mass in y"),
        output("rate", "rad/s", "rate of the angle"),
        output(
            "energy",
            "J",
            "kinetic energy and potential energy above y = 0",
        ),
    ]
}

fn parameters() -> Vec<v1::Parameter> {
    vec![
        needed("m", "kg", "mass, greater than 0"),
        needed(
            "inertia",
            "kg m^2",
            "moment of inertia about the centre of mass, greater than 0",
        ),
        needed(
            "length",
            "m",
            "distance from marker start to marker end, greater than 0; the centre of mass is in the middle",
        ),
        gravity("y"),
        at_zero("x0", "m", "position of marker start in x at the start"),
        at_zero("y0", "m", "position of marker start in y at the start"),
        at_zero("angle0", "rad", "angle at the start, from the x axis"),
        at_zero("vx0", "m/s", "velocity of marker start in x at the start"),
        at_zero("vy0", "m/s", "velocity of marker start in y at the start"),
        at_zero("rate0", "rad/s", "rate of the angle at the start"),
    ]
}
