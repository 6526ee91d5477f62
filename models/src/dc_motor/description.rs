//! What the model tells a master about itself.

use linchpin_proto::v1;

use crate::mechanics::describe::{at_zero, input, needed, output, state};
use crate::mechanics::markers::PLANAR;

/// Place of the outputs of the pin, behind those of the shaft.
pub const PIN: usize = PLANAR.outputs_per_marker();
/// Place of the angle, behind those of the pin.
pub const ANGLE: usize = 2 * PLANAR.outputs_per_marker();
/// Place of its rate.
pub const RATE: usize = ANGLE + 1;
/// Place of the current.
pub const CURRENT: usize = ANGLE + 2;
/// Place of the torque of the current.
pub const TORQUE: usize = ANGLE + 3;
/// Place of the electric power.
pub const POWER: usize = ANGLE + 4;
/// Place of the stored energy.
pub const STORED_ENERGY: usize = ANGLE + 5;

const SHAFT_MARKER: &str = "shaft";
const PIN_MARKER: &str = "pin";

pub fn model() -> v1::Model {
    let base = PLANAR.model([SHAFT_MARKER, PIN_MARKER], own_outputs());
    let voltage = input("voltage", "V", "voltage at the armature");
    v1::Model {
        name: "dc-motor".to_owned(),
        description:
            "Direct-current motor with a constant field; its rotor is a balanced crank in the plane"
                .to_owned(),
        inputs: std::iter::once(voltage).chain(base.inputs).collect(),
        parameters: parameters(),
        states: vec![
            state("angle", "angle0"),
            state("rate", "rate0"),
            state("current", "current0"),
        ],
        ..base
    }
}

fn own_outputs() -> [v1::Variable; 6] {
    [
        output("angle", "rad", "angle of the crank from the x axis"),
        output("rate", "rad/s", "rate of the angle"),
        output("current", "A", "current in the armature"),
        output("torque", "N m", "torque of the current on the rotor"),
        output(
            "power",
            "W",
            "electric power taken in, voltage times current",
        ),
        output(
            "stored_energy",
            "J",
            "kinetic energy of the rotor and energy of the current in the inductance",
        ),
    ]
}

fn parameters() -> Vec<v1::Parameter> {
    vec![
        needed(
            "inertia",
            "kg m^2",
            "moment of inertia of the rotor and what is fixed to it about the shaft, greater than 0",
        ),
        needed(
            "resistance",
            "ohm",
            "resistance of the armature, 0 or greater",
        ),
        needed(
            "inductance",
            "H",
            "inductance of the armature, greater than 0",
        ),
        needed("back_emf", "V s/rad", "induced voltage per rate"),
        needed(
            "torque_constant",
            "N m/A",
            "torque per current; equal to back_emf if nothing else takes power",
        ),
        at_zero(
            "friction",
            "N m s/rad",
            "viscous friction of the rotor, 0 or greater",
        ),
        at_zero(
            "crank",
            "m",
            "distance from the shaft to the marker pin, 0 or greater",
        ),
        at_zero("shaft_x", "m", "place of the shaft"),
        at_zero("shaft_y", "m", "place of the shaft"),
        at_zero("angle0", "rad", "angle at the start, from the x axis"),
        at_zero("rate0", "rad/s", "rate of the angle at the start"),
        at_zero("current0", "A", "current at the start"),
    ]
}
