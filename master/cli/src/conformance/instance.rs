//! One instance, as its master drives it: counts its calls and keeps its time.

use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1::{self, Signal};
use linchpin_proto::weights::MAX_WEIGHTS;

use super::inputs::Inputs;
use super::subject::Subject;
use super::verdict::Stop;

/// What is wanted of the inside of a step, besides the outputs at its end.
#[derive(Debug, Clone, Copy, Default)]
pub struct Inside<'a> {
    /// Instants (s after the start) at which all outputs are wanted.
    pub instants: &'a [f64],
    /// Integrals of every output.
    pub integrals: usize,
}

impl Inside<'_> {
    /// How many lists of all outputs the answer has.
    fn lists(self) -> usize {
        1 + self.instants.len() + self.integrals
    }
}

/// A state that was kept: number of its snapshot and its time (s).
#[derive(Debug, Clone, Copy)]
pub struct Kept {
    /// Number of the snapshot.
    pub snapshot: u64,
    /// Time of the state.
    pub t: f64,
}

/// An instance of the subject. It ends with this value.
pub struct Instance<'a> {
    /// The calls of its worker.
    pub calls: &'a dyn Contract,
    /// The model.
    pub subject: &'a Subject,
    /// Its number.
    pub number: u64,
    /// Sequence number of the last call.
    pub sequence: u64,
    /// Time of the present state (s).
    pub t: f64,
    /// Whether its solver has told of unilateral contacts.
    pub has_contacts: bool,
}

impl<'a> Instance<'a> {
    /// Makes the instance that `request` asks for.
    ///
    /// # Errors
    /// What the worker answered.
    pub fn initialize(
        calls: &'a dyn Contract,
        subject: &'a Subject,
        request: &v1::InitializeRequest,
    ) -> Result<(Self, v1::InitializeReply), CallError> {
        let reply = calls.initialize(request)?;
        let own = Self {
            calls,
            subject,
            number: request.instance,
            sequence: request.sequence,
            t: request.t_start,
            has_contacts: false,
        };
        Ok((own, reply))
    }

    /// The next sequence number.
    pub fn next_number(&mut self) -> u64 {
        self.sequence += 1;
        self.sequence
    }

    /// A request for a step from the present state.
    pub fn step_request(
        &mut self,
        step: f64,
        signals: Vec<Signal>,
        inside: Inside<'_>,
    ) -> v1::StepRequest {
        v1::StepRequest {
            instance: self.number,
            sequence: self.next_number(),
            t: self.t,
            step,
            signals,
            outputs: v1::OutputSet::Coupling.into(),
            instants: inside.instants.to_vec(),
            integrals: inside.integrals.min(MAX_WEIGHTS) as u32,
            ..v1::StepRequest::default()
        }
    }

    /// All outputs at the end of a step over `step` s.
    pub fn step(&mut self, step: f64, inputs: &Inputs) -> Result<Vec<f64>, Stop> {
        self.step_inside(step, inputs, Inside::default())
    }

    /// All outputs at the end of a step, then what is wanted of its inside.
    pub fn step_inside(
        &mut self,
        step: f64,
        inputs: &Inputs,
        inside: Inside<'_>,
    ) -> Result<Vec<f64>, Stop> {
        let request = self.step_request(step, inputs.signals(step), inside);
        self.take(&request)
    }

    /// All outputs at the end of a step over the part between two shares of a longer one, which is `length` s long.
    pub fn step_part(
        &mut self,
        part: [f64; 2],
        length: f64,
        inputs: &Inputs,
    ) -> Result<Vec<f64>, Stop> {
        let step = (part[1] - part[0]) * length;
        let request = self.step_request(step, inputs.part(part, length), Inside::default());
        self.take(&request)
    }

    /// The outputs that answer a step.
    pub fn take(&mut self, request: &v1::StepRequest) -> Result<Vec<f64>, Stop> {
        let reply = self.calls.step(request)?;
        self.t = request.t + request.step;
        self.has_contacts |= reply.work.is_some_and(|work| work.contacts.is_some());
        let lists = 1 + request.instants.len() + request.integrals as usize;
        self.checked("Step", reply.outputs, lists)
    }

    /// Outputs after each of several perturbed steps from the present state, under signals that replace those of `inputs`.
    pub fn perturbed(
        &mut self,
        step: f64,
        inputs: &Inputs,
        perturbed: Vec<Signal>,
        inside: Inside<'_>,
    ) -> Result<Vec<Vec<f64>>, Stop> {
        let wanted = perturbed.len();
        let request = v1::PerturbedStepRequest {
            perturbed,
            ..self.perturbed_request(step, inputs, inside)
        };
        let reply = self.calls.perturbed_step(&request)?;
        self.rows("PerturbedStep", reply.outputs, wanted, inside.lists())
    }

    /// Derivatives of the outputs after a step from the present state, in each of several directions.
    pub fn derivatives(
        &mut self,
        step: f64,
        inputs: &Inputs,
        directions: Vec<Signal>,
    ) -> Result<Vec<Vec<f64>>, Stop> {
        let wanted = directions.len();
        let request = v1::PerturbedStepRequest {
            directions,
            ..self.perturbed_request(step, inputs, Inside::default())
        };
        let reply = self.calls.perturbed_step(&request)?;
        self.rows("PerturbedStep", reply.derivatives, wanted, 1)
    }

    fn perturbed_request(
        &mut self,
        step: f64,
        inputs: &Inputs,
        inside: Inside<'_>,
    ) -> v1::PerturbedStepRequest {
        v1::PerturbedStepRequest {
            instance: self.number,
            sequence: self.next_number(),
            t: self.t,
            step,
            signals: inputs.signals(step),
            instants: inside.instants.to_vec(),
            integrals: inside.integrals.min(MAX_WEIGHTS) as u32,
            ..v1::PerturbedStepRequest::default()
        }
    }

    /// All outputs of the present state under these values of the inputs.
    pub fn evaluate(&self, values: &[f64]) -> Result<Vec<f64>, Stop> {
        self.evaluate_under(Inputs::constant(values).signals(0.0))
    }

    /// All outputs of the present state under these signals.
    pub fn evaluate_under(&self, signals: Vec<Signal>) -> Result<Vec<f64>, Stop> {
        let request = v1::EvaluateRequest {
            instance: self.number,
            t: self.t,
            signals,
            outputs: self.subject.outputs.clone(),
            directions: Vec::new(),
        };
        let reply = self.calls.evaluate(&request)?;
        self.checked("Evaluate", reply.outputs, 1)
    }

    /// Derivatives of the outputs of the present state with respect to each input.
    pub fn feedthrough(&self, values: &[f64]) -> Result<Vec<Vec<f64>>, Stop> {
        let unit = |input: usize| Signal {
            input: input as u32,
            nodes: vec![0.0],
            values: vec![1.0],
        };
        let request = v1::EvaluateRequest {
            instance: self.number,
            t: self.t,
            signals: Inputs::constant(values).signals(0.0),
            outputs: self.subject.outputs.clone(),
            directions: (0..values.len()).map(unit).collect(),
        };
        let reply = self.calls.evaluate(&request)?;
        self.rows("Evaluate", reply.derivatives, values.len(), 1)
    }

    /// Keeps the present state.
    pub fn keep(&mut self) -> Result<Kept, Stop> {
        self.keep_instead(None)
    }

    /// Keeps the present state in the place of an older one.
    pub fn keep_instead(&mut self, replaced: Option<Kept>) -> Result<Kept, Stop> {
        let request = v1::SnapshotRequest {
            instance: self.number,
            sequence: self.next_number(),
            replaces: replaced.map(|kept| kept.snapshot),
        };
        let snapshot = self.calls.snapshot(&request)?.snapshot;
        Ok(Kept {
            snapshot,
            t: self.t,
        })
    }

    /// Goes back to a kept state.
    pub fn go_back(&mut self, kept: &Kept) -> Result<(), Stop> {
        let request = v1::RestoreRequest {
            instance: self.number,
            sequence: self.next_number(),
            snapshot: kept.snapshot,
        };
        self.calls.restore(&request)?;
        self.t = kept.t;
        Ok(())
    }

    /// The present state as bytes.
    pub fn export(&self) -> Result<v1::ExportedState, Stop> {
        let request = v1::ExportStateRequest {
            instance: self.number,
        };
        let state = self.calls.export_state(&request)?.state;
        state.ok_or_else(|| Stop::Answer("ExportState answered no state".to_owned()))
    }

    /// Goes to a state that another instance has exported, at time `t` (s).
    pub fn import(&mut self, state: &v1::ExportedState, t: f64) -> Result<(), Stop> {
        let request = v1::ImportStateRequest {
            instance: self.number,
            sequence: self.next_number(),
            state: Some(state.clone()),
        };
        self.calls.import_state(&request)?;
        self.t = t;
        Ok(())
    }

    /// Values of an answer, which are as many lists of all outputs as were asked for, and finite.
    pub fn checked(
        &self,
        call: &str,
        outputs: Option<v1::Outputs>,
        lists: usize,
    ) -> Result<Vec<f64>, Stop> {
        let values = outputs.unwrap_or_default().values;
        let names = &self.subject.outputs;
        let wanted = names.len() * lists;
        if values.len() != wanted {
            return Err(Stop::Answer(format!(
                "{call} answered {} values where {wanted} were asked for",
                values.len()
            )));
        }
        match values.iter().position(|value| !value.is_finite()) {
            Some(place) => Err(Stop::Answer(format!(
                "{call} answered {} for output \"{}\"",
                values[place],
                names[place % names.len()]
            ))),
            None => Ok(values),
        }
    }

    fn rows(
        &self,
        call: &str,
        rows: Vec<v1::Outputs>,
        wanted: usize,
        lists: usize,
    ) -> Result<Vec<Vec<f64>>, Stop> {
        if rows.len() != wanted {
            return Err(Stop::Answer(format!(
                "{call} answered {} lists of outputs where {wanted} were asked for",
                rows.len()
            )));
        }
        let checked = |row| self.checked(call, Some(row), lists);
        rows.into_iter().map(checked).collect()
    }
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        let request = v1::TerminateRequest {
            instance: self.number,
        };
        // An instance that the worker lost has ended as well.
        let _ = self.calls.terminate(&request);
    }
}
