//! The model `ground`: what does not move, as the end of a joint.
//!
//! It has a marker of each kind in the origin of the inertial axes, along them. Loads do nothing to it.

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Inputs, Interval, Model, Setup, Snapshot, StepFailure, Subsystem};

use crate::mechanics::describe::{input, output};
use crate::mechanics::markers::{PLANAR, SPATIAL};
use crate::mechanics::solvers::capabilities;

/// The name of the model, and of the subsystem that a joint to the ground implies.
pub const GROUND: &str = "ground";

const SCALAR: [&str; 4] = ["point_x", "point_v", "point_a", "point_f"];
const PLANE: &str = "plane";
const SPACE: &str = "space";

/// The output that is 1: the real part of a quaternion without rotation.
const REAL_PART: &str = "space_qw";

/// The ground.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ground;

/// Its outputs never change.
struct Standing {
    values: Vec<f64>,
    integrated: Vec<usize>,
}

impl Model for Ground {
    fn describe(&self) -> v1::Model {
        let [x, v, a, f] = SCALAR;
        let scalar = [
            output(x, "m", "marker \"point\": position"),
            output(v, "m/s", "marker \"point\": velocity"),
            output(a, "m/s^2", "marker \"point\": acceleration"),
        ];
        let point = v1::Marker {
            name: "point".to_owned(),
            kind: v1::MarkerKind::Scalar.into(),
            position: vec![x.to_owned()],
            velocity: vec![v.to_owned()],
            acceleration: vec![a.to_owned()],
            load: vec![f.to_owned()],
        };
        let load = std::iter::once(input(f, "N", "marker \"point\": force"));
        let loads = load.chain(PLANAR.loads(PLANE)).chain(SPATIAL.loads(SPACE));
        let outputs = scalar.into_iter();
        let outputs = outputs
            .chain(PLANAR.outputs(PLANE))
            .chain(SPATIAL.outputs(SPACE));
        v1::Model {
            name: GROUND.to_owned(),
            description: "What does not move: a marker of each kind in the origin of the inertial axes; joints to \
                          `ground` have it without a [[subsystem]]"
                .to_owned(),
            inputs: loads.collect(),
            outputs: outputs.collect(),
            markers: vec![point, PLANAR.marker(PLANE), SPATIAL.marker(SPACE)],
            capabilities: Some(capabilities()),
            ..v1::Model::default()
        }
    }

    fn initialize(&self, _: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        let outputs = self.describe().outputs;
        let value = |output: &v1::Variable| f64::from(u8::from(output.name == REAL_PART));
        Ok(Box::new(Standing {
            values: outputs.iter().map(value).collect(),
            integrated: Vec::new(),
        }))
    }
}

impl Subsystem for Standing {
    fn step(&mut self, _: Interval, _: &Inputs) -> Result<(), StepFailure> {
        Ok(())
    }

    fn outputs(
        &mut self,
        _t: f64,
        _inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        for (value, &output) in values.iter_mut().zip(wanted) {
            *value = self.values[output];
        }
        Ok(())
    }

    fn impulse(&mut self, _t: f64, _inputs: &[f64], _impulses: &[f64]) -> Result<(), StepFailure> {
        Ok(())
    }

    fn snapshot(&self, _into: &mut Snapshot) {}

    fn restore(&mut self, _from: &Snapshot) -> Result<(), StepFailure> {
        Ok(())
    }

    fn derivative(
        &mut self,
        _interval: Interval,
        _inputs: &Inputs,
        _direction: &Inputs,
        _wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        values.fill(0.0);
        Ok(())
    }

    fn integrate_outputs(&mut self, outputs: &[usize], _weights: usize) -> Result<(), StepFailure> {
        self.integrated = outputs.to_vec();
        Ok(())
    }

    /// The first weight is 1, and the means of the others are 0.
    fn integrals(&self, values: &mut [f64]) -> Result<(), StepFailure> {
        values.fill(0.0);
        for (value, &output) in values.iter_mut().zip(&self.integrated) {
            *value = self.values[output];
        }
        Ok(())
    }
}
