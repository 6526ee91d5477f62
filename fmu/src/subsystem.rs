//! An instance of an FMU as a subsystem.

mod states;

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use linchpin_worker::{Inputs, Interval, Snapshot, StepFailure, Subsystem};

use crate::description::{Abilities, Description};
use crate::library::{CallFailure, Inside, Instance, Library, Start, State, Status};
use crate::pieces::Pieces;
use states::{Kept, States, locked};

/// How polynomial inputs reach the FMU.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// As pieces, with derivatives up to `order`; with 0 `substeps` as many of them as the degree needs.
    Pieces {
        /// Number of pieces, 0: by the degree.
        substeps: usize,
        /// Highest derivative that the FMU takes; 0: none.
        order: usize,
    },
    /// Inside a call, where the FMU asks.
    Inside {
        /// Number of calls for a macro step.
        substeps: usize,
    },
}

/// Degree of inputs for which an FMU with steps of one length is prepared: that of Hermite coupling.
const DEGREE_OF_ONE_LENGTH: usize = 2;

/// Largest difference between lengths that are the same, as a share.
const SAME_LENGTH: f64 = 1e-9;

/// A running instance.
pub struct Running {
    instance: Box<dyn Instance>,
    name: String,
    abilities: Abilities,
    way: Way,
    inputs: Vec<u32>,
    outputs: Vec<(String, u32)>,
    tolerance: Option<f64>,
    pieces: Option<Pieces>,
    /// Length of the steps of an FMU that takes no others.
    only_length: Option<f64>,
    values: Vec<f64>,
    wanted: Vec<u32>,
    derivatives: Derivatives,
    states: Arc<States>,
    calls: u64,
    _counted: Counted,
}

/// Memory of the derivatives of all inputs.
#[derive(Default)]
struct Derivatives {
    references: Vec<u32>,
    orders: Vec<i32>,
    values: Vec<f64>,
}

/// Counts an instance as long as it lives.
struct Counted(Arc<AtomicUsize>);

impl Drop for Counted {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

impl Running {
    /// Makes an instance and brings it to its start; `inputs` and `outputs` in the order of the model.
    ///
    /// # Errors
    /// What the FMU says, or that it takes one instance only.
    pub(crate) fn start(
        library: &Arc<Library>,
        instances: &Arc<AtomicUsize>,
        description: &Description,
        (start, way): (&Start<'_>, Way),
        (inputs, outputs): (Vec<u32>, Vec<(String, u32)>),
    ) -> Result<Self, String> {
        let counted = Counted(Arc::clone(instances));
        let others = instances.fetch_add(1, Ordering::Relaxed);
        if others > 0 && description.abilities.once_per_process {
            return Err(
                "there is an instance in this worker already, and canBeInstantiatedOnlyOncePerProcess is true; give every \
                 subsystem a worker of its own, which `fmu = ...` in a scene does"
                    .to_owned(),
            );
        }
        let instance = library
            .start(start)
            .map_err(|failure| failure.to_string())?;
        Ok(Self {
            instance,
            name: description.name.clone(),
            abilities: description.abilities,
            way,
            values: vec![0.0; inputs.len()],
            inputs,
            outputs,
            tolerance: start.tolerance,
            pieces: None,
            only_length: None,
            wanted: Vec::new(),
            derivatives: Derivatives::default(),
            states: Arc::default(),
            calls: 0,
            _counted: counted,
        })
    }

    fn pieces_for(&mut self, inputs: &Inputs, substeps: usize, order: usize) -> Option<&Pieces> {
        let degrees = (0..self.inputs.len()).map(|input| inputs.polynomial(input).degree());
        let degree = match self.abilities.varies_steps {
            true => degrees.max().unwrap_or_default(),
            false => DEGREE_OF_ONE_LENGTH,
        };
        let count = match substeps {
            0 if degree <= order => 1,
            // Methods with inputs of degree k have at most order 2k + 1, and as many moments as this keep it.
            0 => (2 * degree).div_ceil(order + 1),
            count => count,
        };
        if !self
            .pieces
            .as_ref()
            .is_some_and(|own| own.are(count, order))
        {
            self.pieces = Pieces::new(count, order);
        }
        self.pieces.as_ref()
    }

    fn step_in_pieces(
        &mut self,
        interval: Interval,
        inputs: &Inputs,
        (substeps, order): (usize, usize),
    ) -> Result<(), StepFailure> {
        let Some(pieces) = self.pieces_for(inputs, substeps, order).cloned() else {
            return Err(StepFailure::Fatal {
                message: format!("{substeps} sub-steps are too many"),
            });
        };
        for number in 0..pieces.count() {
            for (input, value) in self.values.iter_mut().enumerate() {
                let polynomial = inputs.polynomial(input);
                *value = pieces.derivative(polynomial, interval.length, number, 0);
            }
            let part = part_of(interval, number, pieces.count());
            self.set(interval.start)?;
            if order > 0 && !self.inputs.is_empty() {
                self.set_derivatives(&pieces, interval, inputs, number)?;
            }
            self.call(part, None)?;
        }
        Ok(())
    }

    fn set_derivatives(
        &mut self,
        pieces: &Pieces,
        interval: Interval,
        inputs: &Inputs,
        number: usize,
    ) -> Result<(), StepFailure> {
        let own = &mut self.derivatives;
        own.references.clear();
        own.orders.clear();
        own.values.clear();
        for (input, &reference) in self.inputs.iter().enumerate() {
            let polynomial = inputs.polynomial(input);
            for order in 1..=pieces.degree() {
                own.references.push(reference);
                own.orders.push(i32::try_from(order).unwrap_or(i32::MAX));
                let value = pieces.derivative(polynomial, interval.length, number, order);
                own.values.push(value);
            }
        }
        let set = self
            .instance
            .set_derivatives(&own.references, &own.orders, &own.values);
        set.map_err(|failure| self.failed(&failure, interval.start))
    }

    fn step_inside(
        &mut self,
        interval: Interval,
        inputs: &Inputs,
        substeps: usize,
    ) -> Result<(), StepFailure> {
        for number in 0..substeps {
            let [start, length] = part_of(interval, number, substeps);
            inputs.values_at(start - interval.start, &mut self.values);
            self.set(start)?;
            let inside = Inside {
                inputs,
                start: interval.start,
            };
            self.call([start, length], Some(inside))?;
        }
        Ok(())
    }

    /// Sets `values`.
    fn set(&self, t: f64) -> Result<(), StepFailure> {
        if self.inputs.is_empty() {
            return Ok(());
        }
        let set = self.instance.set(&self.inputs, &self.values);
        set.map_err(|failure| self.failed(&failure, t))
    }

    fn call(
        &mut self,
        [start, length]: [f64; 2],
        inside: Option<Inside<'_>>,
    ) -> Result<(), StepFailure> {
        self.check_length(length)?;
        self.calls += 1;
        let done = { &self.instance }.step([start, length], self.abilities.keeps_states, inside);
        done.map_err(|failure| self.failed(&failure, start))
    }

    fn check_length(&mut self, length: f64) -> Result<(), StepFailure> {
        if self.abilities.varies_steps {
            return Ok(());
        }
        let only = *self.only_length.get_or_insert(length);
        if (length - only).abs() <= SAME_LENGTH * only {
            return Ok(());
        }
        Err(StepFailure::Fatal {
            message: format!(
                "FMU \"{}\" takes steps of one length only, since canHandleVariableCommunicationStepSize is not true: the first had {only} \
                 s, this one has {length} s; use macro steps of one length that divide the time span, coupling.degree of at most 2, no \
                 output.interval, and as many substeps always",
                self.name
            ),
        })
    }

    fn failed(&self, failure: &CallFailure, t: f64) -> StepFailure {
        let message = format!("FMU \"{}\": {failure}", self.name);
        match failure.status {
            Status::Discard => StepFailure::Recoverable { t, message },
            // A state from before can be set, and a smaller step may help.
            Status::Error if self.abilities.keeps_states => StepFailure::Recoverable { t, message },
            _ => StepFailure::Fatal {
                message: format!("{message}, at t = {t} s"),
            },
        }
    }

    fn fatal(&self, failure: &CallFailure) -> StepFailure {
        StepFailure::Fatal {
            message: format!("FMU \"{}\": {failure}", self.name),
        }
    }

    fn keep(&self) -> Result<State, CallFailure> {
        let unneeded = locked(&self.states.unneeded).pop();
        let state = self.instance.keep(unneeded)?;
        self.note(state, unneeded);
        Ok(state)
    }

    /// Remembers what has to be freed at the end; an FMU may give another state than the one whose memory it was offered.
    fn note(&self, state: State, in_place_of: Option<State>) {
        let mut made = locked(&self.states.made);
        made.retain(|own| Some(*own) != in_place_of);
        made.push(state);
    }
}

/// Start and length of one of `count` equal parts.
fn part_of(interval: Interval, number: usize, count: usize) -> [f64; 2] {
    let at = |number: usize| match number == count {
        true => interval.end(),
        false => interval.start + interval.length * number as f64 / count as f64,
    };
    [at(number), interval.length / count as f64]
}

impl Subsystem for Running {
    fn step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        match self.way {
            Way::Pieces { substeps, order } => {
                self.step_in_pieces(interval, inputs, (substeps, order))
            }
            Way::Inside { substeps } => self.step_inside(interval, inputs, substeps),
        }
    }

    fn outputs(
        &mut self,
        t: f64,
        inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        let count = self.values.len().min(inputs.len());
        self.values[..count].copy_from_slice(&inputs[..count]);
        self.set(t)?;
        self.wanted.clear();
        self.wanted
            .extend(wanted.iter().map(|&own| self.outputs[own].1));
        if self.wanted.is_empty() {
            return Ok(());
        }
        let read = self.instance.get(&self.wanted, values);
        read.map_err(|failure| self.failed(&failure, t))?;
        match values.iter().position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(place) => Err(StepFailure::Recoverable {
                t,
                message: format!(
                    "FMU \"{}\": the output \"{}\" is {}",
                    self.name, self.outputs[wanted[place]].0, values[place]
                ),
            }),
        }
    }

    fn snapshot(&self, into: &mut Snapshot) {
        if !self.abilities.keeps_states {
            return;
        }
        let kept = match self.keep() {
            Ok(state) => Kept::State(state, Arc::clone(&self.states)),
            Err(failure) => Kept::Failed(failure),
        };
        into.put_handle(Arc::new(kept));
    }

    fn restore(&mut self, from: &Snapshot) -> Result<(), StepFailure> {
        if !self.abilities.keeps_states {
            return Err(StepFailure::Fatal {
                message: format!(
                    "FMU \"{}\" cannot go back to a state before: it cannot set one, its modelDescription.xml says so",
                    self.name
                ),
            });
        }
        let state = match from.handle::<Kept>() {
            Some(Kept::State(state, states)) if Arc::ptr_eq(states, &self.states) => *state,
            Some(Kept::Failed(failure)) => return Err(self.fatal(failure)),
            Some(Kept::State(..)) => {
                return Err(StepFailure::Fatal {
                    message: "this state is one of another instance".to_owned(),
                });
            }
            None => {
                let state = { &self.instance }.deserialize(from.bytes());
                let state = state.map_err(|failure| self.fatal(&failure))?;
                let back = self.instance.go_back(state);
                self.instance.free(state);
                return back.map_err(|failure| self.fatal(&failure));
            }
        };
        let back = self.instance.go_back(state);
        back.map_err(|failure| self.fatal(&failure))
    }

    fn export(&mut self, from: &Snapshot) -> Result<Vec<u8>, StepFailure> {
        let written = match from.handle::<Kept>() {
            Some(Kept::State(state, _)) => self.instance.serialize(*state),
            Some(Kept::Failed(failure)) => Err(failure.clone()),
            None => Ok(from.bytes().to_vec()),
        };
        written.map_err(|failure| self.fatal(&failure))
    }

    fn internal_steps(&self) -> u64 {
        self.calls
    }

    fn tolerance(&self) -> Option<f64> {
        self.tolerance
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        for state in locked(&self.states.made).drain(..) {
            self.instance.free(state);
        }
        locked(&self.states.unneeded).clear();
    }
}
