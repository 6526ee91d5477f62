//! What the models tell a master about themselves.

use std::collections::{BTreeMap, BTreeSet};

use linchpin_proto::v1;

use super::dimension::Dimension;
use super::error::CompositionError;
use super::outputs;
use super::schema::Key;
use super::system::System;
use crate::mechanics::describe::needed;
use crate::mechanics::solvers;

impl Dimension {
    /// Name of the model.
    pub fn model_name(self) -> &'static str {
        match self {
            Self::Plane => "planar-multibody",
            Self::Space => "spatial-multibody",
        }
    }

    fn model_description(self) -> &'static str {
        match self {
            Self::Plane => {
                "Bodies in the plane with joints, springs, dampers and prescribed motions, as the tables body, marker, joint, spring, torsion-spring and motion of its parameters say; NAME is a name of your choice. Joint kinds: revolute, prismatic, inline, weld"
            }
            Self::Space => {
                "Bodies in space with joints, springs, dampers and prescribed motions, as the tables body, marker, joint, spring, torsion-spring and motion of its parameters say; NAME is a name of your choice. Joint kinds: revolute, prismatic, inline, weld, spherical, universal"
            }
        }
    }
}

/// The model without a composition: which tables and keys there are.
pub fn schema(dimension: Dimension) -> v1::Model {
    let parameter = |key: &Key| needed(&key.dotted(None), key.unit, key.description);
    v1::Model {
        name: dimension.model_name().to_owned(),
        description: dimension.model_description().to_owned(),
        parameters: dimension.keys().map(parameter).collect(),
        solvers: solvers::descriptions(),
        capabilities: Some(solvers::capabilities()),
        ..v1::Model::default()
    }
}

/// The model with a composition: its markers and variables, and the parameters that the scene gives.
///
/// # Errors
/// [`CompositionError::SameVariable`] if two variables would have one name.
pub fn model(
    system: &System,
    parameters: &BTreeMap<String, v1::Value>,
) -> Result<v1::Model, CompositionError> {
    let form = system.dimension.form();
    let inputs = system.markers.iter().flat_map(|marker| {
        let place = format!("parameters.marker.{}", marker.name);
        form.loads(&marker.name)
            .map(move |variable| (place.clone(), variable))
    });
    let outputs = outputs::variables(system);
    let markers = system.markers.iter();
    Ok(v1::Model {
        inputs: distinct(inputs.collect())?,
        outputs: distinct(outputs)?,
        markers: markers.map(|marker| form.marker(&marker.name)).collect(),
        parameters: given(system.dimension, parameters),
        ..schema(system.dimension)
    })
}

fn distinct(variables: Vec<(String, v1::Variable)>) -> Result<Vec<v1::Variable>, CompositionError> {
    let mut names = BTreeSet::new();
    for (place, variable) in &variables {
        if !names.insert(variable.name.as_str()) {
            return Err(CompositionError::SameVariable {
                field: place.clone(),
                variable: variable.name.clone(),
            });
        }
    }
    Ok(variables
        .into_iter()
        .map(|(_, variable)| variable)
        .collect())
}

/// The parameters of a scene; all of them are known keys.
fn given(dimension: Dimension, parameters: &BTreeMap<String, v1::Value>) -> Vec<v1::Parameter> {
    let names = parameters.keys();
    let described = names.filter_map(|dotted| {
        let mut parts = dotted.split('.');
        let (first, last) = (parts.next()?, dotted.rsplit('.').next()?);
        let table = parts.next().map_or("", |_| first);
        let key = { dimension.keys() }.find(|key| key.table == table && key.name == last)?;
        Some(needed(dotted, key.unit, key.description))
    });
    described.collect()
}
