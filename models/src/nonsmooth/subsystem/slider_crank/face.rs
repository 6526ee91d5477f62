//! What a master sees of the mechanism.

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;

use super::parameters::{elements, guide};
use super::picture::drawn;
use crate::mechanics::describe::{input, output};
use crate::nonsmooth::subsystem::face::{Coordinate, Face, FaceContact, FaceMarker};
use crate::nonsmooth::subsystem::keys::Parameters;
use crate::nonsmooth::systems::rigid_slider_crank::Guide;

/// Markers with rates: crank, pin, slider.
pub const MOVING: usize = 3;

/// Names, units and numbers of everything.
pub fn face(parameters: &Parameters<'_>) -> Result<Face, SetupError> {
    let guide = guide(parameters)?;
    let elements = elements(parameters)?;
    let moving = |name: &str, load: &[&str]| FaceMarker {
        name: name.to_owned(),
        load: load.iter().map(|&name| name.to_owned()).collect(),
        has_rates: true,
    };
    let mut markers = vec![
        moving("crank", &["crank_fx", "crank_fy", "torque"]),
        moving("pin", &[]),
        moving("slider", &[]),
    ];
    markers.extend(
        drawn(guide, elements)
            .into_iter()
            .map(|(name, _)| FaceMarker::drawn(&name)),
    );
    Ok(Face {
        coordinates: vec![
            Coordinate::angle("theta1", "omega1", "angle of the crank from the x axis"),
            Coordinate::angle(
                "theta2",
                "omega2",
                "angle of the rod's frame from the x axis",
            ),
            Coordinate::angle("theta3", "omega3", "angle of the slider"),
        ],
        contacts: contacts(guide),
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
        own: own(elements),
        markers,
    })
}

/// The contacts of a guide.
pub fn contacts(guide: Guide) -> Vec<FaceContact> {
    match guide {
        Guide::Clearance(_) => {
            let corner = |number| FaceContact::at_point(&format!("corner{number}"));
            (1..=4).map(corner).collect()
        }
        Guide::Bilateral { .. } => {
            vec![
                FaceContact::at_point("across"),
                FaceContact::of_angle("turn"),
            ]
        }
        Guide::Free => Vec::new(),
    }
}

/// The height of the slider as an output.
pub fn slider_share() -> v1::Variable {
    let what = "height of the slider's centre as a share of the clearance; in m without clearance";
    output("slider_share", "1", what)
}

fn own(elements: usize) -> Vec<v1::Variable> {
    let mut own = vec![slider_share()];
    if elements > 0 {
        own.extend([
            output(
                "tip_along",
                "m",
                "displacement of the rod's end in its frame, along",
            ),
            output(
                "tip_across",
                "m",
                "displacement of the rod's end in its frame, across",
            ),
            output(
                "root_moment",
                "N m",
                "bending moment at the root of the rod",
            ),
        ]);
    }
    own
}
