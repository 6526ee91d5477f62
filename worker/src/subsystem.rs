//! What a solver author implements.

use std::collections::BTreeMap;

use linchpin_proto::v1;

use crate::{Impact, Impacts, Inputs, Setup, Snapshot, setup::SetupError};

/// One macro step of a subsystem: from `start` (s) over `length` (s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Time at which the step starts.
    pub start: f64,
    /// Its length, positive.
    pub length: f64,
}

impl Interval {
    /// Time at which the step ends.
    pub fn end(&self) -> f64 {
        self.start + self.length
    }
}

/// Why a subsystem could not step, evaluate or go back.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepFailure {
    /// The solver failed at time `t`; a smaller macro step may help.
    #[error("{message} at t = {t} s", t = linchpin_proto::readable::time(*t))]
    Recoverable {
        /// Where the solver stopped.
        t: f64,
        /// What went wrong.
        message: String,
    },
    /// Nobody waits for the step any more: see [`Cancel`](crate::Cancel).
    #[error("the step was cancelled at t = {t} s", t = linchpin_proto::readable::time(*t))]
    Cancelled {
        /// Where the solver stopped.
        t: f64,
    },
    /// This subsystem cannot do what its capabilities do not say.
    #[error("this model does not offer {what}")]
    NotOffered {
        /// What was asked for.
        what: &'static str,
    },
    /// The solver cannot go on.
    #[error("{message}")]
    Fatal {
        /// What went wrong.
        message: String,
    },
}

const INTEGRALS: &str = "integrals of outputs";

/// A solver run: one subsystem with its state.
///
/// All inputs are given for every call, in the order of the model's description; an input that the scene does not
/// drive is the constant of its default. Behind them come the joint inputs of the request, in its order: what the
/// joint loads of [`Setup::joint_loads`] read. There are none unless the model's capabilities say `joint_loads`.
pub trait Subsystem: Send {
    /// Integrates over `interval` under `inputs` (polynomials of the time since `interval.start`).
    ///
    /// A step that takes long looks at [`Cancel::current`](crate::Cancel::current) in every internal step.
    fn step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure>;

    /// Writes the outputs numbered `wanted` (order of the description) at time `t` to `values`, under the input
    /// values `inputs` at that time: what depends directly on an input (an acceleration) uses these.
    /// Only what is wanted may be computed.
    fn outputs(
        &mut self,
        t: f64,
        inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure>;

    /// Writes the whole state to `into`, which is empty.
    fn snapshot(&self, into: &mut Snapshot);

    /// Goes back, bit by bit, to the state that [`Subsystem::snapshot`] wrote.
    fn restore(&mut self, from: &Snapshot) -> Result<(), StepFailure>;

    /// The bytes of a state that [`Subsystem::snapshot`] wrote; [`Subsystem::restore`] goes back to a snapshot that has these bytes alone. Only
    /// who keeps handles in snapshots, and whose capabilities say `exportable_snapshot`, needs to write this.
    fn export(&mut self, from: &Snapshot) -> Result<Vec<u8>, StepFailure> {
        Ok(from.bytes().to_vec())
    }

    /// Steps once more over the interval of the last [`Subsystem::step`], with one input a little different, from where that step
    /// started or, behind an instant at which a step is cut, from a state a little different; it has been restored. The difference of the two results becomes a column of the
    /// coupling Jacobian, so a solver with step-size control should repeat the internal steps of that last call
    /// here (internal numerical differentiation). Solvers without control need nothing: the default steps.
    fn perturbed_step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        self.step(interval, inputs)
    }

    /// Writes the derivatives `d/de`, at `e = 0`, of the outputs numbered `wanted` at the end of a step over `interval`
    /// from the present state, under the inputs `inputs + e direction`, to `values`. With `interval.length = 0` it is the
    /// direct feed-through: the derivative of the outputs of the present state. The state that this leaves behind does not
    /// matter; the internal steps that [`Subsystem::perturbed_step`] repeats are kept if they are those of this step.
    ///
    /// Where it is given, the model's capabilities say `directional_derivatives`; the default refuses.
    fn derivative(
        &mut self,
        _interval: Interval,
        _inputs: &Inputs,
        _direction: &Inputs,
        _wanted: &[usize],
        _values: &mut [f64],
    ) -> Result<(), StepFailure> {
        Err(StepFailure::NotOffered {
            what: "directional derivatives",
        })
    }

    /// Lets every step, perturbed step and derivative over a step that follows integrate the outputs numbered `outputs` as well, with
    /// the first `weights` weights `L_0, L_1, ..` of [`weights`](linchpin_proto::weights); with none nothing is integrated any more.
    /// [`Subsystem::integrals`] then tells the integrals. They begin at 0 with every step and belong to no state.
    ///
    /// Where they are given, the model's capabilities say `output_integrals`; the default refuses.
    fn integrate_outputs(
        &mut self,
        _outputs: &[usize],
        _weights: usize,
    ) -> Result<(), StepFailure> {
        Err(StepFailure::NotOffered { what: INTEGRALS })
    }

    /// Writes the integrals over the last [`Subsystem::step`] or [`Subsystem::perturbed_step`] to `values`: `integral of y L_0 ds` of all
    /// outputs that [`Subsystem::integrate_outputs`] named, over the share `s` of the step, then those with `L_1`, and so on. After
    /// [`Subsystem::derivative`] they are the derivatives of these integrals.
    fn integrals(&self, _values: &mut [f64]) -> Result<(), StepFailure> {
        Err(StepFailure::NotOffered { what: INTEGRALS })
    }

    /// Lets the velocities of the present state jump as under impulses of loads: by what `impulses`, added to the input values `inputs` at
    /// time `t`, add to the accelerations. There is one for each input, 0 for those that are no loads. Positions stay, joints and
    /// constraints of the subsystem keep their velocities, and contacts that could open are none of its business.
    ///
    /// Where it is given, the model's capabilities say `impulses`; the default refuses.
    fn impulse(&mut self, _t: f64, _inputs: &[f64], _impulses: &[f64]) -> Result<(), StepFailure> {
        Err(StepFailure::NotOffered {
            what: "impulses of loads",
        })
    }

    /// Lets the steps that follow treat impacts in this way; before the first call it is [`Impacts::Alone`]. It belongs to no state.
    /// [`Subsystem::perturbed_step`] has the impacts of the step that it repeats, under the same impulses of loads.
    ///
    /// Where it is given, the model's capabilities say `impacts`; the default refuses.
    fn treat_impacts(&mut self, _impacts: &Impacts) -> Result<(), StepFailure> {
        Err(StepFailure::NotOffered {
            what: "impacts that partners take part in",
        })
    }

    /// The impacts of the last [`Subsystem::step`], in the order of their instants.
    fn impacts(&self) -> &[Impact] {
        &[]
    }

    /// Internal solver steps since the start, for the statistics.
    fn internal_steps(&self) -> u64 {
        0
    }

    /// What its contacts did from the start to the present state, for the statistics; `None` for a solver without contacts.
    fn contacts(&self) -> Option<v1::Contacts> {
        None
    }

    /// Error tolerance of the solver in units of its outputs; `None` if it is exact up to rounding.
    fn tolerance(&self) -> Option<f64> {
        None
    }
}

/// A kind of subsystem that can be instantiated.
pub trait Model: Send + Sync {
    /// Name, inputs, outputs, parameters, markers, solvers, states.
    /// The SDK fills in which capabilities it provides itself.
    fn describe(&self) -> v1::Model;

    /// The description of a model whose inputs, outputs or markers depend on its parameters, here with those of a scene.
    ///
    /// # Errors
    /// [`SetupError`] if a parameter that the description depends on is missing or out of its range.
    fn describe_with(
        &self,
        _parameters: &BTreeMap<String, v1::Value>,
    ) -> Result<v1::Model, SetupError> {
        Ok(self.describe())
    }

    /// Builds the subsystem in its initial state. Parameters that the description does not list, or that it needs
    /// and `setup` does not have, are refused before this is called.
    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError>;
}
