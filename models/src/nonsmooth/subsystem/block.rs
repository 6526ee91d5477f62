//! The model `block`: a rigid rectangular block on a plane of any slope, with friction and impacts of its corners. It
//! slides, sticks, topples and rocks.
//!
//! * [`parameters`]: what a scene gives; [`pose`]: the start; [`picture`]: outputs and markers.

mod parameters;
mod picture;
mod pose;

use std::sync::Arc;

use linchpin_worker::Setup;
use linchpin_worker::setup::SetupError;

use super::keys::Parameters;
use super::model::{NonsmoothModel, Seen, Started, started};
use crate::nonsmooth::system::MechanicalSystem;
use crate::nonsmooth::systems::body_on_planes::{BodyOnPlanes, Plane, corners_of};
use parameters::{KEYS, body, half_sizes, law, slope};
use picture::{Picture, face};
use pose::Pose;

/// A block on a plane.
pub const BLOCK: NonsmoothModel = NonsmoothModel {
    name: "block",
    what: "Rectangular rigid block on a plane of any slope; its corners impact and rub",
    keys: KEYS,
    seen,
    start,
};

fn seen(parameters: &Parameters<'_>) -> Seen {
    Ok((face(), system(parameters)?.contacts().to_vec()))
}

fn start(parameters: &Parameters<'_>, setup: &Setup) -> Started {
    let half = half_sizes(parameters)?;
    let slope = slope(parameters)?;
    let pose = Pose::of(parameters)?;
    let [q, v] = pose.start(half, slope);
    let picture = Picture {
        slope,
        corners: corners_of(half),
        plane_ends: parameters::plane_ends(parameters, pose.way, half)?,
    };
    let system = Arc::new(system(parameters)?);
    started(system, picture, &face(), [&q, &v], setup)
}

/// All corners can touch the plane.
fn system(parameters: &Parameters<'_>) -> Result<BodyOnPlanes, SetupError> {
    let half = half_sizes(parameters)?;
    Ok(BodyOnPlanes::on_plane(
        body(parameters, half)?,
        &corners_of(half),
        Plane::rising(slope(parameters)?),
        law(parameters)?,
    ))
}
