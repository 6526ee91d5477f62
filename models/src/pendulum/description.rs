//! What the model tells a master about itself.

use linchpin_proto::v1;

use crate::mechanics::describe::{at_zero, gravity, needed, output, state};
use crate::mechanics::markers::PLANAR;

/// Outputs of one marker.
pub const OUTPUTS_PER_MARKER: usize = PLANAR.outputs_per_marker();
/// Place of the angle among the outputs, behind those of the markers.
pub const ANGLE: usize = 2 * OUTPUTS_PER_MARKER;
/// Place of its rate.
pub const RATE: usize = ANGLE + 1;
/// Place of the energy.
pub const ENERGY: usize = ANGLE + 2;

const TIP: &str = "tip";
const CENTRE: &str = "centre";

pub fn model() -> v1::Model {
    v1::Model {
        name: "pendulum".to_owned(),
        description:
            "Rigid link in the plane on a hinge in the ground, with a torsional spring and damper"
                .to_owned(),
        parameters: parameters(),
        states: vec![state("angle", "angle0"), state("rate", "rate0")],
        ..PLANAR.model([TIP, CENTRE], own_outputs())
    }
}

fn own_outputs() -> [v1::Variable; 3] {
    [
        output("angle", "rad", "angle of the link from the x axis"),
        output("rate", "rad/s", "rate of the angle"),
        output(
            "energy",
            "J",
            "kinetic energy, potential energy above y = 0 and energy of the spring",
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
            "distance from the hinge to the tip, greater than 0",
        ),
        at_zero(
            "offset",
            "m",
            "from the middle of the link to its centre of mass, positive towards the tip",
        ),
        at_zero("hinge_x", "m", "place of the hinge"),
        at_zero("hinge_y", "m", "place of the hinge"),
        gravity("y"),
        at_zero(
            "spring",
            "N m/rad",
            "stiffness of the torsional spring in the hinge, 0 or greater",
        ),
        at_zero("damping", "N m s/rad", "damping in the hinge, 0 or greater"),
        at_zero("rest_angle", "rad", "angle at which the spring is relaxed"),
        at_zero("angle0", "rad", "angle at the start, from the x axis"),
        at_zero("rate0", "rad/s", "rate of the angle at the start"),
    ]
}
