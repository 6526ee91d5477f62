//! Parameters of the toy.

use linchpin_worker::setup::SetupError;

use crate::nonsmooth::subsystem::keys::{Key, Parameters, number, refused};
use crate::nonsmooth::system::MechanicalSystem;
use crate::nonsmooth::systems::notch::CornerLaw;
use crate::nonsmooth::systems::woodpecker::Toy;

/// Height, angles of sleeve and bird, and their rates at the start.
const START: [[&str; 3]; 2] = [["y0", "phi_m0", "phi_s0"], ["vy0", "omega_m0", "omega_s0"]];

/// Defaults: the data of Glocker 1995, and the state of the periodic motion in which the sleeve begins to slide.
pub const KEYS: &[Key] = &[
    number("m_sleeve", "kg", 3e-4, "mass of the sleeve, greater than 0"),
    number("m_bird", "kg", 4.5e-3, "mass of the bird, greater than 0"),
    number(
        "j_sleeve",
        "kg m^2",
        5e-9,
        "moment of inertia of the sleeve about its centre, greater than 0",
    ),
    number(
        "j_bird",
        "kg m^2",
        7e-7,
        "moment of inertia of the bird about its centre, greater than 0",
    ),
    number(
        "spring",
        "N m/rad",
        5.6e-3,
        "stiffness of the spring between sleeve and bird, 0 or greater",
    ),
    number("gravity", "m/s^2", 9.81, "acceleration of gravity along -y"),
    number(
        "pole_radius",
        "m",
        2.5e-3,
        "radius of the pole, greater than 0",
    ),
    number(
        "sleeve_radius",
        "m",
        3.1e-3,
        "inner radius of the sleeve, greater than that of the pole",
    ),
    number(
        "sleeve_half_height",
        "m",
        5.8e-3,
        "half height of the sleeve, greater than 0",
    ),
    number(
        "sleeve_arm",
        "m",
        0.01,
        "from the middle of the sleeve to the spring, greater than 0",
    ),
    number(
        "bird_arm",
        "m",
        0.015,
        "from the spring to the centre of the bird, greater than 0",
    ),
    number(
        "beak_reach",
        "m",
        0.0201,
        "from the centre of the bird to the tip of its beak, towards the pole, greater than 0",
    ),
    number(
        "beak_height",
        "m",
        0.02,
        "height of the beak above the centre of the bird, greater than 0",
    ),
    number(
        "beak_restitution",
        "1",
        0.5,
        "Newton's coefficient of the beak, 0 to 1",
    ),
    number(
        "sleeve_restitution",
        "1",
        0.0,
        "Newton's coefficient of the edges of the sleeve, 0 to 1",
    ),
    number(
        "friction",
        "1",
        0.3,
        "Coulomb's coefficient of all contacts, 0 or greater",
    ),
    number("y0", "m", 0.0, "height of the sleeve at the start"),
    number("phi_m0", "rad", -0.1036, "angle of the sleeve at the start"),
    number("phi_s0", "rad", -0.2788, "angle of the bird at the start"),
    number("vy0", "m/s", -0.3411, "velocity of the sleeve at the start"),
    number("omega_m0", "rad/s", 0.0, "rate of the sleeve at the start"),
    number(
        "omega_s0",
        "rad/s",
        -7.4583,
        "rate of the bird at the start",
    ),
    number(
        "pole_top",
        "m",
        0.04,
        "upper end of the pole in the animation",
    ),
    number(
        "pole_bottom",
        "m",
        -0.2,
        "lower end of the pole in the animation, below the upper one",
    ),
];

/// Masses, lengths, laws.
pub fn toy(parameters: &Parameters<'_>) -> Result<Toy, SetupError> {
    let positive = |name| parameters.positive(name);
    let friction = parameters.non_negative("friction")?;
    let law = |name| {
        Ok::<CornerLaw, SetupError>(CornerLaw {
            normal_restitution: parameters.restitution(name)?,
            tangential_restitution: 0.0,
            friction,
        })
    };
    let edge = law("sleeve_restitution")?;
    let pole_radius = positive("pole_radius")?;
    let allowed = "it must be greater than pole_radius";
    Ok(Toy {
        masses: [positive("m_sleeve")?, positive("m_bird")?],
        inertias: [positive("j_sleeve")?, positive("j_bird")?],
        spring: parameters.non_negative("spring")?,
        gravity: parameters.number("gravity")?,
        pole_radius,
        sleeve: [
            parameters.number_in("sleeve_radius", allowed, |radius| radius > pole_radius)?,
            positive("sleeve_half_height")?,
        ],
        arms: [positive("sleeve_arm")?, positive("bird_arm")?],
        beak: [positive("beak_reach")?, positive("beak_height")?],
        laws: [law("beak_restitution")?, edge, edge],
    })
}

/// Coordinates and velocities at the start. They may be rounded: contacts may be as deep in the pole as a hundredth of
/// the play of the sleeve.
pub fn start(
    parameters: &Parameters<'_>,
    system: &impl MechanicalSystem,
) -> Result<[[f64; 3]; 2], SetupError> {
    let mut start = [[0.0; 3]; 2];
    for (values, names) in start.iter_mut().zip(START) {
        for (value, name) in values.iter_mut().zip(names) {
            *value = parameters.number(name)?;
        }
    }
    let mut gaps = [0.0; 3];
    system.gaps(&start[0], &mut gaps);
    let play = parameters.number("sleeve_radius")? - parameters.number("pole_radius")?;
    let parts = [
        ("phi_s0", "the beak"),
        ("phi_m0", "the lower edge of the sleeve"),
        ("phi_m0", "the upper edge of the sleeve"),
    ];
    for (gap, (name, part)) in gaps.into_iter().zip(parts) {
        if gap < -0.01 * play {
            let reason = format!("{part} would be {:.3e} m inside the pole", -gap);
            return Err(refused(name, reason));
        }
    }
    Ok(start)
}

/// Upper and lower end of the pole as it is drawn (m).
pub fn pole(parameters: &Parameters<'_>) -> Result<[f64; 2], SetupError> {
    let top = parameters.number("pole_top")?;
    let allowed = "it must be below pole_top";
    let bottom = parameters.number_in("pole_bottom", allowed, |bottom| bottom < top)?;
    Ok([top, bottom])
}
