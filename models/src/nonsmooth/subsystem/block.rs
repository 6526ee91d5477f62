//! The model `block`: a rigid rectangular block on a plane of any slope, with friction and impacts of its corners. It
//! slides, sticks, topples and rocks.
//!
//! * [`parameters`]: what a scene gives; [`pose`]: the start; [`picture`]: outputs and markers.

mod parameters;
mod picture;
mod pose;

use std::collections::BTreeMap;
use std::sync::Arc;

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Model, Setup, Subsystem};

use super::keys::Parameters;
use super::model::{describe, started};
use crate::nonsmooth::system::MechanicalSystem;
use crate::nonsmooth::systems::body_on_planes::{BodyOnPlanes, Plane, corners_of};
use parameters::{KEYS, body, half_sizes, law, slope};
use picture::{Picture, face};
use pose::Pose;

const NAME: &str = "block";
const WHAT: &str = "Rectangular rigid block on a plane of any slope; its corners impact and rub";

/// A block on a plane.
#[derive(Debug, Clone, Copy, Default)]
pub struct Block;

impl Model for Block {
    fn describe(&self) -> v1::Model {
        // The defaults are in their ranges.
        self.describe_with(&BTreeMap::new()).unwrap_or_default()
    }

    fn describe_with(
        &self,
        parameters: &BTreeMap<String, v1::Value>,
    ) -> Result<v1::Model, SetupError> {
        let parameters = Parameters::new(KEYS, parameters)?;
        let system = system(&parameters)?;
        Ok(describe(
            NAME,
            WHAT,
            &parameters,
            system.contacts(),
            &face(),
        ))
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        let parameters = Parameters::new(KEYS, setup.all_parameters())?;
        let half = half_sizes(&parameters)?;
        let slope = slope(&parameters)?;
        let pose = Pose::of(&parameters)?;
        let [q, v] = pose.start(half, slope);
        let picture = Picture {
            slope,
            corners: corners_of(half),
            plane_ends: parameters::plane_ends(&parameters, pose.way, half)?,
        };
        let system = Arc::new(system(&parameters)?);
        started(system, picture, &face(), [&q, &v], setup)
    }
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
