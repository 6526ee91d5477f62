//! Parameters of the model.

use linchpin_worker::setup::SetupError;

use crate::nonsmooth::subsystem::keys::{Key, Parameters, absent, number, refused, text};
use crate::nonsmooth::systems::flexible_slider_crank::FlexibleMechanism;
use crate::nonsmooth::systems::notch::{CornerLaw, Notch};
use crate::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism};
use crate::nonsmooth::systems::rod::{Rectangle, Reference, Rod, RotaryInertia};

/// Angles and their rates at the start.
pub const START: [[&str; 3]; 2] = [
    ["theta1_0", "theta2_0", "theta3_0"],
    ["omega1_0", "omega2_0", "omega3_0"],
];

/// Defaults are those of S2 Table 1.
pub const KEYS: &[Key] = &[
    number("l1", "m", 0.153, "length of the crank, greater than 0"),
    number("l2", "m", 0.306, "length of the rod, greater than 0"),
    number("a", "m", 0.05, "half length of the slider, greater than 0"),
    number("b", "m", 0.025, "half height of the slider, greater than 0"),
    number(
        "c",
        "m",
        1e-3,
        "clearance on each side of the slider, 0 or greater",
    ),
    number("m1", "kg", 0.038, "mass of the crank, greater than 0"),
    number("m2", "kg", 0.038, "mass of the rod, greater than 0"),
    number("m3", "kg", 0.076, "mass of the slider, greater than 0"),
    number(
        "j1",
        "kg m^2",
        7.4e-5,
        "moment of inertia of the crank about its centre, greater than 0",
    ),
    number(
        "j2",
        "kg m^2",
        5.9e-4,
        "moment of inertia of the rod about its centre, greater than 0",
    ),
    number(
        "j3",
        "kg m^2",
        2.7e-6,
        "moment of inertia of the slider about its centre, greater than 0",
    ),
    number("gravity", "m/s^2", 9.81, "acceleration of gravity along -y"),
    number(
        "constant_torque",
        "N m",
        0.0,
        "torque on the crank that is always there",
    ),
    number(
        "restitution",
        "1",
        0.4,
        "Newton's coefficient of the corners in normal direction, 0 to 1",
    ),
    number(
        "tangential_restitution",
        "1",
        0.0,
        "the same in tangential direction, 0 to 1",
    ),
    number(
        "friction",
        "1",
        0.01,
        "Coulomb's coefficient of the corners, 0 or greater",
    ),
    text(
        "guide",
        &["clearance", "bilateral", "free"],
        "\"clearance\" (the default): corners and walls; \"bilateral\": y = 0 and angle 0 without clearance; \
         \"free\": no notch",
    ),
    number(
        "elements",
        "1",
        0.0,
        "elements of the rod, a whole number to 10000; 0: the rod is rigid",
    ),
    absent(
        "modes",
        "1",
        "modes of the rod that are kept, a whole number from 1; if absent all nodal values are coordinates",
    ),
    text(
        "reference",
        &["tangential", "pinned"],
        "what the frame of the flexible rod is tied to: \"tangential\" to its root (the default), \"pinned\" to both \
         ends",
    ),
    text(
        "rotary_inertia",
        &["frame", "consistent"],
        "inertia of rotating sections: \"frame\" as in the paper (the default), \"consistent\" also for bending",
    ),
    number(
        "youngs_modulus",
        "N/m^2",
        2e11,
        "Young's modulus of the rod, greater than 0",
    ),
    number(
        "density",
        "kg/m^3",
        7800.0,
        "density of the rod, greater than 0; its section follows from m2 and j2",
    ),
    absent(
        "width",
        "m",
        "width of the rod's section across the plane; with depth, instead of the section of m2 and j2",
    ),
    absent(
        "depth",
        "m",
        "depth of the rod's section in the plane; with width, which must give the mass m2",
    ),
    number(
        "material_damping",
        "s",
        0.0,
        "stiffness-proportional damping of the rod, 0 or greater",
    ),
    number(
        "magnification",
        "1",
        1.0,
        "of clearance and tilt in the markers that are only drawn (slider, corner, upper, lower), 1 or greater",
    ),
    number(
        "bending_magnification",
        "1",
        1.0,
        "of the deflection of the rod in the markers that are only drawn (rod), 1 or greater",
    ),
    number("theta1_0", "rad", 0.0, "angle of the crank at the start"),
    number("theta2_0", "rad", 0.0, "angle of the rod at the start"),
    number("theta3_0", "rad", 0.0, "angle of the slider at the start"),
    number("omega1_0", "rad/s", 0.0, "rate of the crank at the start"),
    number("omega2_0", "rad/s", 0.0, "rate of the rod at the start"),
    number("omega3_0", "rad/s", 0.0, "rate of the slider at the start"),
];

/// The parameter of this name, for models of a part of the mechanism.
pub const fn key(name: &str) -> Key {
    let mut place = 0;
    while !is_same(KEYS[place].name.as_bytes(), name.as_bytes()) {
        place += 1;
    }
    KEYS[place]
}

const fn is_same(one: &[u8], other: &[u8]) -> bool {
    let mut place = 0;
    while place < one.len() && place < other.len() && one[place] == other[place] {
        place += 1;
    }
    place == one.len() && place == other.len()
}

/// Any numbers.
pub fn numbers<const N: usize>(
    parameters: &Parameters<'_>,
    names: [&str; N],
) -> Result<[f64; N], SetupError> {
    let mut numbers = [0.0; N];
    for (number, name) in numbers.iter_mut().zip(names) {
        *number = parameters.number(name)?;
    }
    Ok(numbers)
}

/// Lengths, masses, loads.
pub fn mechanism(parameters: &Parameters<'_>) -> Result<Mechanism, SetupError> {
    let positive = |name| parameters.positive(name);
    Ok(Mechanism {
        lengths: [positive("l1")?, positive("l2")?],
        masses: [positive("m1")?, positive("m2")?, positive("m3")?],
        inertias: [positive("j1")?, positive("j2")?, positive("j3")?],
        gravity: parameters.number("gravity")?,
        torque: parameters.number("constant_torque")?,
        notch: notch(parameters)?,
    })
}

/// Slider and notch.
pub fn notch(parameters: &Parameters<'_>) -> Result<Notch, SetupError> {
    Ok(Notch {
        half_length: parameters.positive("a")?,
        half_height: parameters.positive("b")?,
        clearance: parameters.non_negative("c")?,
    })
}

/// What guides the slider.
pub fn guide(parameters: &Parameters<'_>) -> Result<Guide, SetupError> {
    let friction = parameters.non_negative("friction")?;
    Ok(match parameters.choice("guide")? {
        "bilateral" => Guide::Bilateral { friction },
        "free" => Guide::Free,
        _ => Guide::Clearance(CornerLaw {
            normal_restitution: parameters.restitution("restitution")?,
            tangential_restitution: parameters.restitution("tangential_restitution")?,
            friction,
        }),
    })
}

/// How much larger than they are clearance and deflection are drawn.
pub fn magnifications(parameters: &Parameters<'_>) -> Result<[f64; 2], SetupError> {
    Ok([
        magnification(parameters)?,
        at_least_one(parameters, "bending_magnification")?,
    ])
}

/// How much larger than it is the clearance is drawn.
pub fn magnification(parameters: &Parameters<'_>) -> Result<f64, SetupError> {
    at_least_one(parameters, "magnification")
}

fn at_least_one(parameters: &Parameters<'_>, name: &str) -> Result<f64, SetupError> {
    parameters.number_in(name, "it must be 1 or greater", |value| value >= 1.0)
}

/// Elements of the rod; 0 if it is rigid.
pub fn elements(parameters: &Parameters<'_>) -> Result<usize, SetupError> {
    let allowed = "it must be a whole number from 0 to 10000";
    parameters.count("elements", allowed, 0)
}

/// The mechanism with a flexible rod, if a scene asks for one.
pub fn flexible(
    parameters: &Parameters<'_>,
    mechanism: &Mechanism,
) -> Result<Option<FlexibleMechanism>, SetupError> {
    let elements = elements(parameters)?;
    if elements == 0 {
        return refuse_flexibility(parameters);
    }
    let material = [
        parameters.positive("youngs_modulus")?,
        parameters.positive("density")?,
    ];
    let rod = Rod {
        rotary_inertia: match parameters.choice("rotary_inertia")? {
            "consistent" => RotaryInertia::Consistent,
            _ => RotaryInertia::Frame,
        },
        reference: match parameters.choice("reference")? {
            "pinned" => Reference::Pinned,
            _ => Reference::Tangential,
        },
        modes: if parameters.has("modes") {
            let allowed = "it must be a whole number from 1 to 10000";
            Some(parameters.count("modes", allowed, 1)?)
        } else {
            None
        },
        material_damping: parameters.non_negative("material_damping")?,
        ..Rod::new(
            mechanism.lengths[1],
            elements,
            material,
            rectangle(parameters, mechanism, material[1])?.section(),
        )
    };
    Ok(Some(FlexibleMechanism {
        crank_length: mechanism.lengths[0],
        crank_mass: mechanism.masses[0],
        crank_inertia: mechanism.inertias[0],
        rod,
        slider_mass: mechanism.masses[2],
        slider_inertia: mechanism.inertias[2],
        gravity: mechanism.gravity,
        torque: mechanism.torque,
        notch: mechanism.notch,
    }))
}

/// Parameters of a flexible rod say nothing of a rigid one: a scene that gives them has forgotten `elements`.
fn refuse_flexibility<T>(parameters: &Parameters<'_>) -> Result<Option<T>, SetupError> {
    let names = ["modes", "reference", "rotary_inertia", "width", "depth"];
    match names.into_iter().find(|name| parameters.has(name)) {
        None => Ok(None),
        Some(name) => Err(refused(
            name,
            "the rod is rigid; give elements, 1 or more, to make it flexible",
        )),
    }
}

/// The rod's section: as given, or that of its mass and inertia.
fn rectangle(
    parameters: &Parameters<'_>,
    mechanism: &Mechanism,
    density: f64,
) -> Result<Rectangle, SetupError> {
    let (mass, length) = (mechanism.masses[1], mechanism.lengths[1]);
    let given = [parameters.has("width"), parameters.has("depth")];
    match given {
        [false, false] => Rectangle::of_inertia(mass, mechanism.inertias[1], length, density)
            .map_err(|error| refused("j2", error)),
        [true, true] => {
            let rectangle = Rectangle {
                width: parameters.positive("width")?,
                depth: parameters.positive("depth")?,
            };
            let own = density * length * rectangle.width * rectangle.depth;
            if (own - mass).abs() > 1e-3 * mass {
                let reason = format!(
                    "a rod of this section, length and density has {own:.6} kg, but m2 = {mass}; change one of them"
                );
                return Err(refused("width", reason));
            }
            Ok(rectangle)
        }
        [true, false] => Err(refused("width", "depth is missing: a section needs both")),
        [false, true] => Err(refused("depth", "width is missing: a section needs both")),
    }
}
