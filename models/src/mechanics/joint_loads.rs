//! Joint loads on a model: evaluated at the pose that its markers have in the state at hand.

use std::cell::RefCell;

use linchpin_worker::joint_load::{JointLoad, LoadedMarker};
use linchpin_worker::{Inputs, Setup};

use super::equation::{EquationOfMotion, Vector};

/// All joint loads on one subsystem.
#[derive(Debug, Default)]
pub struct JointLoads {
    markers: Vec<LoadsAtMarker>,
    /// Input values at one instant, those of the joint loads included: memory that is used again.
    values: RefCell<Vec<f64>>,
}

#[derive(Debug)]
struct LoadsAtMarker {
    marker: LoadedMarker,
    loads: Vec<JointLoad>,
}

impl JointLoads {
    /// Those of a setup.
    pub fn of(setup: &Setup) -> Self {
        let mut own = Self::default();
        for load in setup.joint_loads() {
            match own.markers.iter_mut().find(|at| at.marker == load.marker) {
                Some(at) => at.loads.push(load.clone()),
                None => own.markers.push(LoadsAtMarker {
                    marker: load.marker.clone(),
                    loads: vec![load.clone()],
                }),
            }
        }
        own
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.markers.is_empty()
    }

    /// The inputs of the equation `tau` (s) after the start of a step, joint loads at `state` included.
    pub fn inputs_at<E: EquationOfMotion>(
        &self,
        equation: &E,
        state: &E::State,
        inputs: &Inputs,
        tau: f64,
    ) -> E::Inputs {
        if self.is_empty() {
            let mut own = E::Inputs::ZERO;
            inputs.values_at(tau, own.as_mut());
            return own;
        }
        let mut values = self.values.borrow_mut();
        values.resize(inputs.len(), 0.0);
        inputs.values_at(tau, &mut values);
        self.inputs(equation, state, &values)
    }

    /// The inputs of the equation under the input values of a subsystem, joint loads at `state` included.
    pub fn inputs<E: EquationOfMotion>(
        &self,
        equation: &E,
        state: &E::State,
        values: &[f64],
    ) -> E::Inputs {
        let mut without = E::Inputs::ZERO;
        for (own, value) in without.as_mut().iter_mut().zip(values) {
            *own = *value;
        }
        let mut inputs = without;
        for LoadsAtMarker { marker, loads } in &self.markers {
            // The places are those of the description; an output that is not there spoils the step, which is told.
            let output = |place| equation.output(state, &without, place).unwrap_or(f64::NAN);
            let own = marker.pose(output);
            for load in loads {
                marker.add(&load.wrench(&own, values), inputs.as_mut());
            }
        }
        inputs
    }
}
