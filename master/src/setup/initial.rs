//! Coupling variables at the first macro point, as the subsystems show them.

use nalgebra::UnitQuaternion;

use crate::error::RunError;
use crate::layout::{Border, Coupled, Layout, What};
use crate::scene::Scene;
use crate::signal::attitude::unit_quaternion;
use crate::system::Response;
use crate::workers::Workers;

/// Coupling variables with which the run starts.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct InitialState {
    /// Multipliers, then exchanged variables.
    pub(super) variables: Vec<f64>,
    /// Attitudes to which rotation vectors are relative.
    pub(super) attitudes: Vec<UnitQuaternion<f64>>,
    /// The response to each driven input, where it is known.
    pub(super) responses: Vec<Option<Response>>,
    /// Conditions of the joints that follow from others.
    pub(super) border: Border,
}

impl InitialState {
    /// No load at the start, and no motion of partners.
    pub(super) fn at_rest(variables: usize) -> Self {
        Self {
            variables: vec![0.0; variables],
            attitudes: Vec::new(),
            responses: Vec::new(),
            border: Border::default(),
        }
    }

    /// Exchanged variables as the subsystems show them under these multipliers, 0 if none are given, and under the start values of connected
    /// signals, and the outputs. Positions and velocities do not depend on inputs; connected signals may, and are settled later.
    pub(super) fn read(
        scene: &Scene,
        coupled: &Coupled<'_>,
        layout: &Layout,
        workers: &Workers,
        multipliers: Option<&[f64]>,
    ) -> Result<(Self, Vec<Vec<f64>>), RunError> {
        let mut state = Self {
            variables: vec![0.0; layout.variables()],
            attitudes: vec![UnitQuaternion::identity(); layout.attitudes().count()],
            responses: Vec::new(),
            border: Border::default(),
        };
        if let Some(multipliers) = multipliers {
            state.variables[..multipliers.len()].copy_from_slice(multipliers);
        }
        for connection in coupled.connections {
            state.variables[layout.variable_of(connection)] = connection.start.unwrap_or(0.0);
        }
        let outputs = evaluate_all(layout, workers, scene.t_start, &state)
            .map_err(|error| refuse_start(scene, error))?;
        state.take(coupled, layout, &outputs);
        Ok((state, outputs))
    }

    /// Takes over what the outputs show, but for signals that have a start value.
    fn take(&mut self, coupled: &Coupled<'_>, layout: &Layout, outputs: &[Vec<f64>]) {
        let started = coupled.connections.iter().filter(|one| one.start.is_some());
        let started: Vec<usize> = started.map(|one| layout.variable_of(one)).collect();
        let exchanged = layout.exchanged.iter();
        for exchanged in exchanged.filter(|one| !started.contains(&one.first)) {
            let own = &outputs[exchanged.subsystem];
            match exchanged.what {
                What::Output(place) => self.variables[exchanged.first] = own[place],
                What::Attitude { places, attitude } => {
                    self.attitudes[attitude] = unit_quaternion(places.map(|place| own[place]));
                }
            }
        }
    }

    /// Reads the outputs of all subsystems at `t` under these variables.
    pub(super) fn read_outputs(
        &self,
        t: f64,
        layout: &Layout,
        workers: &mut Workers,
    ) -> Result<(), RunError> {
        for number in 0..workers.subsystems.len() {
            let inputs = layout.input_values(number, &self.variables, &self.attitudes);
            let subsystem = &mut workers.subsystems[number];
            subsystem.outputs = subsystem.evaluate(t, &inputs, &subsystem.output_names)?;
        }
        Ok(())
    }
}

/// Outputs that `layout` reads of all subsystems under the variables of `state`.
pub(super) fn evaluate_all(
    layout: &Layout,
    workers: &Workers,
    t: f64,
    state: &InitialState,
) -> Result<Vec<Vec<f64>>, RunError> {
    let evaluate = |number: usize| {
        let inputs = layout.input_values(number, &state.variables, &state.attitudes);
        workers.subsystems[number].evaluate(t, &inputs, &layout.outputs[number])
    };
    (0..workers.subsystems.len()).map(evaluate).collect()
}

/// What a worker refuses while the signals are searched is said with where the search begins.
pub(super) fn refuse_start(scene: &Scene, error: RunError) -> RunError {
    match error {
        RunError::Worker { .. } | RunError::NotFinite { .. } if !scene.connections.is_empty() => {
            RunError::SignalsAtStart(Box::new(error))
        }
        error => error,
    }
}
