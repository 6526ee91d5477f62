//! The model `slider-crank`: crank, rod and slider in a notch with clearance.

use std::collections::BTreeMap;

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Model, Setup, Subsystem};

use super::face::{Coordinate, Face, FaceMarker};
use super::keys::{Key, Parameters, number, text};
use super::model::{describe, started};
use super::observed::{Motion, Observed, PointMotion};
use super::shown::SliderPicture;
use crate::mechanics::describe::{input, output};
use crate::nonsmooth::systems::notch::{CornerLaw, Notch};
use crate::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism, RigidSliderCrank};

/// The slider-crank mechanism of Flores, Leine & Glocker, rigid or with a flexible rod.
#[derive(Debug, Clone, Copy, Default)]
pub struct SliderCrank;

const GUIDES: &[&str] = &["clearance", "bilateral", "free"];

/// Defaults are those of S2 Table 1.
const KEYS: &[Key] = &[
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
        GUIDES,
        "\"clearance\" (the default): corners and walls; \"bilateral\": y = 0 and angle 0 without clearance; \"free\": no notch",
    ),
    number(
        "magnification",
        "1",
        1.0,
        "markers that are for pictures show clearance, height and angle of the slider so many times larger, 1 or greater",
    ),
    number("theta1_0", "rad", 0.0, "angle of the crank at the start"),
    number("theta2_0", "rad", 0.0, "angle of the rod at the start"),
    number("theta3_0", "rad", 0.0, "angle of the slider at the start"),
    number("omega1_0", "rad/s", 0.0, "rate of the crank at the start"),
    number("omega2_0", "rad/s", 0.0, "rate of the rod at the start"),
    number("omega3_0", "rad/s", 0.0, "rate of the slider at the start"),
];

/// Number of the marker at the centre of the slider.
const SLIDER: usize = 2;

impl Model for SliderCrank {
    fn describe(&self) -> v1::Model {
        // The defaults are in their ranges.
        self.describe_with(&BTreeMap::new()).unwrap_or_default()
    }

    fn describe_with(
        &self,
        parameters: &BTreeMap<String, v1::Value>,
    ) -> Result<v1::Model, SetupError> {
        let parameters = Parameters::new(KEYS, parameters)?;
        let system = rigid(&parameters)?;
        Ok(describe(
            "slider-crank",
            "Slider-crank mechanism; the slider impacts and rubs in its notch",
            &parameters,
            &system,
            &face(&parameters)?,
        ))
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        let parameters = Parameters::new(KEYS, setup.all_parameters())?;
        let q = numbers(&parameters, ["theta1_0", "theta2_0", "theta3_0"])?;
        let v = numbers(&parameters, ["omega1_0", "omega2_0", "omega3_0"])?;
        started(rigid(&parameters)?, &face(&parameters)?, [&q, &v], setup)
    }
}

fn numbers<const N: usize>(
    parameters: &Parameters<'_>,
    names: [&str; N],
) -> Result<[f64; N], SetupError> {
    let mut numbers = [0.0; N];
    for (number, name) in numbers.iter_mut().zip(names) {
        *number = parameters.number(name)?;
    }
    Ok(numbers)
}

fn mechanism(parameters: &Parameters<'_>) -> Result<Mechanism, SetupError> {
    let positive = |name| parameters.positive(name);
    Ok(Mechanism {
        lengths: [positive("l1")?, positive("l2")?],
        masses: [positive("m1")?, positive("m2")?, positive("m3")?],
        inertias: [positive("j1")?, positive("j2")?, positive("j3")?],
        gravity: parameters.number("gravity")?,
        torque: parameters.number("constant_torque")?,
        notch: Notch {
            half_length: positive("a")?,
            half_height: positive("b")?,
            clearance: parameters.non_negative("c")?,
        },
    })
}

fn guide(parameters: &Parameters<'_>) -> Result<Guide, SetupError> {
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

fn rigid(parameters: &Parameters<'_>) -> Result<RigidSliderCrank, SetupError> {
    Ok(RigidSliderCrank::new(
        mechanism(parameters)?,
        guide(parameters)?,
    ))
}

fn face(parameters: &Parameters<'_>) -> Result<Face, SetupError> {
    let contacts: &[&str] = match guide(parameters)? {
        Guide::Clearance(_) => &["corner1", "corner2", "corner3", "corner4"],
        Guide::Bilateral { .. } => &["across", "turn"],
        Guide::Free => &[],
    };
    let mut markers = vec![
        FaceMarker::moving("crank", &["crank_fx", "crank_fy", "torque"]),
        FaceMarker::moving("pin", &[]),
        FaceMarker::moving("slider", &[]),
    ];
    markers.extend(picture_markers(parameters)?);
    Ok(Face {
        coordinates: vec![
            Coordinate::angle("theta1", "omega1", "angle of the crank from the x axis"),
            Coordinate::angle("theta2", "omega2", "angle of the rod from the x axis"),
            Coordinate::angle("theta3", "omega3", "angle of the slider"),
        ],
        contacts: contacts.iter().map(|&name| name.to_owned()).collect(),
        inputs: vec![
            input(
                "torque",
                "N m",
                "torque on the crank, beside the constant one",
            ),
            input(
                "crank_fx",
                "N",
                "force at the bearing of the crank in x, which the ground takes",
            ),
            input(
                "crank_fy",
                "N",
                "force at the bearing of the crank in y, which the ground takes",
            ),
        ],
        own: vec![output(
            "slider_vertical",
            "1",
            "height of the slider's centre as a share of the clearance",
        )],
        markers,
    })
}

fn picture_markers(parameters: &Parameters<'_>) -> Result<Vec<FaceMarker>, SetupError> {
    let Mechanism { lengths, notch, .. } = mechanism(parameters)?;
    let ([l1, l2], ahead) = (lengths, 2.0 * notch.half_length);
    let at_least_1 = |value: f64| value >= 1.0;
    let picture = SliderPicture {
        notch,
        centre: SLIDER,
        magnification: parameters.number_in(
            "magnification",
            "it must be 1 or greater",
            at_least_1,
        )?,
        walls: [l2 - l1 - ahead, l1 + l2 + ahead],
    };
    let mut markers: Vec<FaceMarker> = picture.slider().collect();
    match guide(parameters)? {
        Guide::Clearance(_) => {
            markers.extend(picture.walls(notch.clearance));
            markers.extend(picture.corners());
        }
        Guide::Bilateral { .. } => markers.extend(picture.walls(0.0)),
        Guide::Free => {}
    }
    Ok(markers)
}

impl Observed for RigidSliderCrank {
    fn own_output(&self, _output: usize, motion: Motion<'_>) -> f64 {
        let clearance = self.mechanism().notch.clearance;
        let [_, y] = self.slider(motion.q);
        if clearance > 0.0 { y / clearance } else { y }
    }

    fn marker(&self, marker: usize, motion: Motion<'_>) -> PointMotion {
        let [l1, l2] = self.mechanism().lengths;
        let turn = |place: usize| [motion.q[place], motion.v[place], motion.a[place]];
        let still = [[0.0; 3]; 3];
        match marker {
            0 => with_angle(still, turn(0)),
            1 => with_angle(along(still, l1, turn(0)), turn(1)),
            SLIDER => with_angle(along(along(still, l1, turn(0)), l2, turn(1)), turn(2)),
            _ => still,
        }
    }
}

/// The motion of a point at `length` in the direction of an angle from another point.
fn along(from: PointMotion, length: f64, [angle, rate, acceleration]: [f64; 3]) -> PointMotion {
    let (sin, cos) = angle.sin_cos();
    let [mut position, mut velocity, mut second] = from;
    position[0] += length * cos;
    position[1] += length * sin;
    velocity[0] -= length * sin * rate;
    velocity[1] += length * cos * rate;
    second[0] -= length * (sin * acceleration + cos * rate * rate);
    second[1] += length * (cos * acceleration - sin * rate * rate);
    [position, velocity, second]
}

fn with_angle(mut motion: PointMotion, turn: [f64; 3]) -> PointMotion {
    for (level, turn) in motion.iter_mut().zip(turn) {
        level[2] = turn;
    }
    motion
}
