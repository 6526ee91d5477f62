//! The models `planar-multibody` and `spatial-multibody`: a system of bodies with joints of its own inside one subsystem.
//!
//! The scene composes it in nested tables of its parameters, and only what it names is built:
//!
//! * `schema`, `entries`: the tables and keys, and how they are read;
//! * `body`, `joint`, `spring`, `torsion`, `motion`, `marker`: what can be composed; `system`: the whole;
//! * `dimension`, `kinematics`: motion of bodies, in the plane and in space;
//! * `condition`, `constraints`, `consistency`: what joints and motions demand, reactions, checks of the start;
//! * `absolute`: an index-1 DAE with projection; `tree`, `edge`, `minimal`: coordinates of the joints;
//! * `formulation`, `run`: either of them as a subsystem; `outputs`, `description`: what a master sees.

mod absolute;
mod body;
mod condition;
mod consistency;
mod constraints;
mod description;
mod dimension;
mod edge;
mod entries;
mod error;
mod formulation;
mod joint;
mod kinematics;
mod marker;
mod minimal;
mod motion;
mod outputs;
mod run;
mod schema;
mod spring;
mod system;
mod torsion;
mod tree;

use std::collections::BTreeMap;

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Model, Setup, Subsystem};

use absolute::Absolute;
use dimension::Dimension;
use formulation::Formulation;
use minimal::Minimal;
use run::Run;
use system::{Coordinates, System};

/// Bodies in the plane with joints of their own.
#[derive(Debug, Clone, Copy, Default)]
pub struct PlanarMultibody;

/// Bodies in space with joints of their own.
#[derive(Debug, Clone, Copy, Default)]
pub struct SpatialMultibody;

impl Model for PlanarMultibody {
    fn describe(&self) -> v1::Model {
        description::schema(Dimension::Plane)
    }

    fn describe_with(
        &self,
        parameters: &BTreeMap<String, v1::Value>,
    ) -> Result<v1::Model, SetupError> {
        describe(Dimension::Plane, parameters)
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        initialize(Dimension::Plane, setup)
    }
}

impl Model for SpatialMultibody {
    fn describe(&self) -> v1::Model {
        description::schema(Dimension::Space)
    }

    fn describe_with(
        &self,
        parameters: &BTreeMap<String, v1::Value>,
    ) -> Result<v1::Model, SetupError> {
        describe(Dimension::Space, parameters)
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        initialize(Dimension::Space, setup)
    }
}

/// What is described does not depend on the time of the start.
fn describe(
    dimension: Dimension,
    parameters: &BTreeMap<String, v1::Value>,
) -> Result<v1::Model, SetupError> {
    let system = System::read(dimension, parameters, 0.0)?;
    Ok(description::model(&system, parameters)?)
}

fn initialize(dimension: Dimension, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
    let system = System::read(dimension, setup.all_parameters(), setup.t_start())?;
    let system = system.with_joint_loads(setup.joint_loads());
    consistency::check(&system)?;
    let formulation: Box<dyn Formulation> = match system.coordinates {
        Coordinates::Absolute => Box::new(Absolute::new(system)),
        Coordinates::Minimal => Box::new(Minimal::new(system)?),
    };
    Ok(Box::new(Run::new(formulation, setup)?))
}
