//! The model as it describes itself.

use std::collections::BTreeMap;

use linchpin_proto::v1::{self, Capabilities, MarkerKind};

use super::ConformanceError;
use super::inputs::HIGHEST_DEGREE;

/// A model with the places of its variables.
#[derive(Debug, Clone, PartialEq)]
pub struct Subject {
    /// Name of the model.
    pub name: String,
    /// Names of the inputs.
    pub inputs: Vec<String>,
    /// What each input is where nobody drives it; 0 for those that must be driven.
    pub defaults: Vec<f64>,
    /// Whether an input may be left alone.
    pub has_default: Vec<bool>,
    /// Names of the outputs.
    pub outputs: Vec<String>,
    /// Their units.
    pub units: Vec<String>,
    /// Number of the group of each output: those of one group have one size.
    pub groups: Vec<usize>,
    /// The markers.
    pub markers: Vec<Marker>,
    /// What the worker offers for this model.
    pub capabilities: Capabilities,
}

/// A marker: places of outputs and inputs, components in the order of the contract.
#[derive(Debug, Clone, PartialEq)]
pub struct Marker {
    /// Its name.
    pub name: String,
    /// Scalar, planar or spatial.
    pub kind: MarkerKind,
    /// Outputs: `x`, or `x, y, angle`, or `x, y, z, qw, qx, qy, qz`.
    pub position: Vec<usize>,
    /// Outputs: their rates; in space `v` and the angular velocity in inertial axes.
    pub velocity: Vec<usize>,
    /// Outputs: the rates of these.
    pub acceleration: Vec<usize>,
    /// Inputs: force, then moment about the point, in inertial axes.
    pub load: Vec<usize>,
}

/// Translation or rotation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Motion {
    /// m, N.
    Translation,
    /// rad, N m.
    Rotation,
}

impl Marker {
    /// How many components are translations; those behind them are rotations.
    pub fn translations(&self) -> usize {
        match self.kind {
            MarkerKind::Planar => 2,
            MarkerKind::Spatial => 3,
            MarkerKind::Scalar | MarkerKind::Unspecified => 1,
        }
    }

    /// What a component of the velocity, the acceleration or the load is.
    pub fn motion(&self, component: usize) -> Motion {
        match component < self.translations() {
            true => Motion::Translation,
            false => Motion::Rotation,
        }
    }

    /// The outputs of its unit quaternion `w, x, y, z`, if it has one.
    pub fn quaternion(&self) -> Option<[usize; 4]> {
        if self.kind != MarkerKind::Spatial {
            return None;
        }
        self.position.get(3..)?.try_into().ok()
    }
}

impl Subject {
    /// Reads a description.
    ///
    /// # Errors
    /// [`ConformanceError::UnknownVariable`] if a marker names what is not there.
    pub fn new(model: &v1::Model) -> Result<Self, ConformanceError> {
        let names = |variables: &[v1::Variable]| -> Vec<String> {
            variables.iter().map(|own| own.name.clone()).collect()
        };
        let (inputs, outputs) = (names(&model.inputs), names(&model.outputs));
        let units: Vec<String> = model.outputs.iter().map(|own| own.unit.clone()).collect();
        let markers = model
            .markers
            .iter()
            .map(|marker| places(marker, &inputs, &outputs))
            .collect::<Result<Vec<_>, _>>()?;
        let defaults = model.inputs.iter().map(|own| own.default);
        Ok(Self {
            name: model.name.clone(),
            groups: groups(&outputs, &units, &markers),
            has_default: defaults.clone().map(|own| own.is_some()).collect(),
            defaults: defaults.map(|own| own.unwrap_or(0.0)).collect(),
            inputs,
            outputs,
            units,
            markers,
            capabilities: model.capabilities.unwrap_or_default(),
        })
    }

    /// Highest degree of the kit's input polynomials that the model takes.
    pub fn highest_degree(&self) -> usize {
        let most = self.capabilities.max_input_degree;
        most.map_or(HIGHEST_DEGREE, |most| HIGHEST_DEGREE.min(most as usize))
    }

    /// The largest of the values in the group of each output.
    pub fn sizes_of_groups(&self, values: &[f64]) -> Vec<f64> {
        let mut largest = vec![0.0_f64; self.groups.len()];
        for (&group, value) in self.groups.iter().zip(values) {
            largest[group] = largest[group].max(value.abs());
        }
        self.groups.iter().map(|&group| largest[group]).collect()
    }
}

fn places(
    marker: &v1::Marker,
    inputs: &[String],
    outputs: &[String],
) -> Result<Marker, ConformanceError> {
    let find = |what: &'static str, known: &[String], names: &[String]| {
        let place = |name: &String| {
            let place = known.iter().position(|own| own == name);
            place.ok_or_else(|| ConformanceError::UnknownVariable {
                marker: marker.name.clone(),
                what,
                name: name.clone(),
            })
        };
        names.iter().map(place).collect::<Result<Vec<_>, _>>()
    };
    Ok(Marker {
        name: marker.name.clone(),
        kind: marker.kind(),
        position: find("output", outputs, &marker.position)?,
        velocity: find("output", outputs, &marker.velocity)?,
        acceleration: find("output", outputs, &marker.acceleration)?,
        load: find("input", inputs, &marker.load)?,
    })
}

/// Outputs of markers are grouped by what they are, others by their unit; an output without a unit stands alone.
fn groups(outputs: &[String], units: &[String], markers: &[Marker]) -> Vec<usize> {
    let mut keys: Vec<String> = outputs
        .iter()
        .zip(units)
        .map(|(name, unit)| match unit.as_str() {
            "" | "1" => format!("output {name}"),
            unit => format!("unit {unit}"),
        })
        .collect();
    for marker in markers {
        let lists = [
            ("position", &marker.position),
            ("velocity", &marker.velocity),
            ("acceleration", &marker.acceleration),
        ];
        for (what, list) in lists {
            for (component, &output) in list.iter().enumerate() {
                keys[output] = format!("{what} {:?}", marker.motion(component));
            }
        }
    }
    let mut numbers = BTreeMap::new();
    for key in &keys {
        let next = numbers.len();
        numbers.entry(key).or_insert(next);
    }
    keys.iter().map(|key| numbers[key]).collect()
}
