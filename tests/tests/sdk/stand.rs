//! A model whose marker depends on its parameters: a marker that does not move, and the impulse of what acts on it.

use std::collections::BTreeMap;

use linchpin_proto::v1::{self, value};
use linchpin_worker::setup::{SetupError, Values};
use linchpin_worker::{
    Inputs, Interval, JointLoad, Model, Setup, Snapshot, StepFailure, Subsystem,
};

/// The parameter `marker` is one of [`MARKERS`], `pose` its position. Outputs are the position, the load and the impulse
/// of the load since the start.
pub struct Stand;

/// Kind of marker, names of its position, names of its load.
type Kind = (
    &'static str,
    v1::MarkerKind,
    &'static [&'static str],
    &'static [&'static str],
);

const IN_PLANE: &[&str] = &["x", "y", "angle"];
const IN_SPACE: &[&str] = &["x", "y", "z", "qw", "qx", "qy", "qz"];
const PLANAR_LOAD: &[&str] = &["fx", "fy", "moment"];
const SPATIAL_LOAD: &[&str] = &["fx", "fy", "fz", "mx", "my", "mz"];

/// Whole markers, markers without orientation, markers that take no moment or nothing, and one that is no body's.
const MARKERS: [Kind; 9] = [
    ("planar", v1::MarkerKind::Planar, IN_PLANE, PLANAR_LOAD),
    (
        "planar-point",
        v1::MarkerKind::Planar,
        &["x", "y"],
        PLANAR_LOAD,
    ),
    (
        "planar-pushed",
        v1::MarkerKind::Planar,
        IN_PLANE,
        &["fx", "fy"],
    ),
    ("planar-watched", v1::MarkerKind::Planar, IN_PLANE, &[]),
    ("spatial", v1::MarkerKind::Spatial, IN_SPACE, SPATIAL_LOAD),
    (
        "spatial-point",
        v1::MarkerKind::Spatial,
        &["x", "y", "z"],
        SPATIAL_LOAD,
    ),
    (
        "spatial-pushed",
        v1::MarkerKind::Spatial,
        IN_SPACE,
        &["fx", "fy", "fz"],
    ),
    ("placeless", v1::MarkerKind::Planar, &[], PLANAR_LOAD),
    ("scalar", v1::MarkerKind::Scalar, &["x"], &["fx"]),
];

struct Standing {
    pose: Vec<f64>,
    loads: usize,
    impulse: Vec<f64>,
    joint_loads: Vec<JointLoad>,
}

fn kind(parameters: &Values) -> Result<&'static Kind, SetupError> {
    let name = parameters.one_of("marker", &MARKERS.map(|kind| kind.0))?;
    Ok(MARKERS.iter().find(|kind| kind.0 == name).unwrap())
}

fn variable(name: &str, default: Option<f64>) -> v1::Variable {
    v1::Variable {
        name: name.into(),
        default,
        ..Default::default()
    }
}

fn described(&(_, kind, position, load): &Kind) -> v1::Model {
    let names = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect();
    let outputs = position.iter().map(|&name| name.to_owned());
    let outputs = outputs.chain(load.iter().map(|name| format!("{name}_total")));
    let outputs = outputs.chain(load.iter().map(|name| format!("{name}_impulse")));
    v1::Model {
        inputs: load.iter().map(|name| variable(name, Some(0.0))).collect(),
        outputs: outputs.map(|name| variable(&name, None)).collect(),
        markers: vec![v1::Marker {
            name: "foot".into(),
            kind: kind.into(),
            position: names(position),
            load: names(load),
            ..v1::Marker::default()
        }],
        ..Stand.describe()
    }
}

impl Model for Stand {
    fn describe(&self) -> v1::Model {
        let parameter = |name: &str| v1::Parameter {
            name: name.into(),
            ..Default::default()
        };
        v1::Model {
            name: "stand".into(),
            parameters: vec![parameter("marker"), parameter("pose")],
            capabilities: Some(v1::Capabilities {
                joint_loads: true,
                ..Default::default()
            }),
            ..v1::Model::default()
        }
    }

    fn describe_with(
        &self,
        parameters: &BTreeMap<String, v1::Value>,
    ) -> Result<v1::Model, SetupError> {
        kind(&Values::parameters(parameters)).map(described)
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        let &(_, _, position, load) = kind(&setup.parameters())?;
        let pose = setup.numbers_parameter("pose")?.to_vec();
        if pose.len() != position.len() {
            return Err(SetupError::WrongType {
                field: "parameters.pose".into(),
                expected: "as many numbers as the marker's position has",
            });
        }
        Ok(Box::new(Standing {
            pose,
            loads: load.len(),
            impulse: vec![0.0; load.len()],
            joint_loads: setup.joint_loads().to_vec(),
        }))
    }
}

impl Standing {
    fn load(&self, inputs: &[f64]) -> Vec<f64> {
        let mut load = inputs[..self.loads].to_vec();
        for joint in &self.joint_loads {
            let own = joint.marker.pose(|output| self.pose[output]);
            joint.marker.add(&joint.wrench(&own, inputs), &mut load);
        }
        load
    }
}

impl Subsystem for Standing {
    /// Simpson's rule: exact for loads up to the third power of time.
    fn step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        let mut values = vec![0.0; inputs.len()];
        for (part, weight) in [(0.0, 1.0), (0.5, 4.0), (1.0, 1.0)] {
            inputs.values_at(part * interval.length, &mut values);
            let load = self.load(&values);
            for (impulse, load) in self.impulse.iter_mut().zip(load) {
                *impulse += weight * interval.length / 6.0 * load;
            }
        }
        Ok(())
    }

    fn outputs(
        &mut self,
        _t: f64,
        inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        let all = [&self.pose[..], &self.load(inputs), &self.impulse].concat();
        for (value, &output) in values.iter_mut().zip(wanted) {
            *value = all[output];
        }
        Ok(())
    }

    fn snapshot(&self, into: &mut Snapshot) {
        into.put(&self.impulse);
    }

    fn restore(&mut self, from: &Snapshot) -> Result<(), StepFailure> {
        from.get(&mut self.impulse)
    }
}

/// Parameters of a stand.
pub fn at_pose(marker: &str, pose: &[f64]) -> BTreeMap<String, v1::Value> {
    let value = |kind| v1::Value { kind: Some(kind) };
    let numbers = v1::NumberList {
        values: pose.to_vec(),
    };
    [
        ("marker".to_owned(), value(value::Kind::Text(marker.into()))),
        ("pose".to_owned(), value(value::Kind::Numbers(numbers))),
    ]
    .into()
}

/// A list of names.
pub fn named(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.into()).collect()
}
