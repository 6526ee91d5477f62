//! A mechanical system in motion behind the worker protocol.

use std::sync::Arc;

use linchpin_proto::polynomial::Polynomial;
use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{
    Cancel, Impact, Impacts, Inputs, Interval, Setup, Snapshot, StepFailure, Subsystem,
};

use super::collided::{Collided, Pace};
use super::face::{Face, Output};
use super::observed::{Motion, Observer, PointMotion};
use super::options::choose;
use crate::mechanics::fixed::parts;
use crate::nonsmooth::contact_log::ContactLog;
use crate::nonsmooth::mechanics::StepError;
use crate::nonsmooth::mixed::Integrator;
use crate::nonsmooth::schemes::SchemeKind;
use crate::nonsmooth::state::Drive;
use crate::nonsmooth::system::MechanicalSystem;

/// Numbers of a snapshot behind those of the integrator: whether it has started, whether impacts are coupled, and the last macro step.
const OWN_NUMBERS: usize = 5;

/// Inputs that differ by less than this share of their size have not jumped.
const ROUNDING: f64 = 1e-11;

/// One subsystem.
pub struct Run {
    observer: Box<dyn Observer>,
    integrator: Integrator,
    outputs: Vec<Output>,
    /// Longest internal step (s).
    step: f64,
    /// Whether the accelerations at the start are known: they depend on the first inputs.
    has_started: bool,
    /// What happened in the last macro step.
    last: Interlude,
    /// Normal impulses of each contact in it (N s).
    impulses: Vec<f64>,
    /// Inputs at an instant, as polynomials.
    held: Inputs,
    /// Values of the inputs at the end of the last step, and at the start of the present one.
    at_end: Vec<f64>,
    at_start: Vec<f64>,
    /// What collides in a step.
    collided: Collided,
    accelerations: Vec<f64>,
    /// Memory before a step, and of a snapshot.
    kept: Vec<f64>,
}

/// Impacts of one macro step.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Interlude {
    impacts: f64,
    /// Time of the first one, or of the end.
    time: f64,
    impulse: f64,
}

impl Run {
    /// A system from its start, with the solver of `setup`.
    ///
    /// # Errors
    /// [`SetupError`] if the solver, an option, or the two together are not allowed.
    pub fn new(
        system: Arc<dyn MechanicalSystem + Sync>,
        observer: Box<dyn Observer>,
        face: &Face,
        start: [&[f64]; 2],
        setup: &Setup,
    ) -> Result<Self, SetupError> {
        let choice = choose(setup)?;
        let outputs = face.outputs(system.contacts());
        let defaults: Vec<f64> = face
            .inputs
            .iter()
            .map(|input| input.default.unwrap_or(0.0))
            .collect();
        let integrator = Integrator::new(
            Box::new(system),
            defaults.len(),
            choice.scheme,
            choice.settings,
            start,
        );
        let integrator = integrator.map_err(|error| SetupError::Refused {
            field: format!("solver.{}", error.option()),
            reason: error.to_string(),
        })?;
        let contacts = integrator.mechanics.contacts().len();
        Ok(Self {
            outputs: outputs.into_iter().map(|(output, _)| output).collect(),
            accelerations: vec![0.0; integrator.state.q.len()],
            kept: vec![0.0; integrator.memory_len() + OWN_NUMBERS + contacts + defaults.len()],
            impulses: vec![0.0; contacts],
            held: Inputs::constant(&defaults),
            at_start: defaults.clone(),
            at_end: defaults.clone(),
            collided: Collided::new(contacts, choice.scheme == SchemeKind::Moreau),
            last: Interlude {
                impacts: 0.0,
                time: setup.t_start(),
                impulse: 0.0,
            },
            step: choice.step,
            has_started: false,
            observer,
            integrator,
        })
    }

    fn advance(
        &mut self,
        interval: Interval,
        inputs: &Inputs,
        pace: Pace,
    ) -> Result<(), StepFailure> {
        let parts = parts(interval, self.step)?;
        let dt = interval.length / parts as f64;
        let drive = Drive {
            start: interval.start,
            inputs,
        };
        self.integrator.begin_interval();
        self.collided.begin(pace, parts as usize);
        let before = self.integrator.log;
        if !self.has_started {
            let (collided, integrator) = (&mut self.collided, &mut self.integrator);
            let started = integrator.start_with(drive, collided.at_start());
            started.map_err(|error| failed(interval.start, error))?;
            inputs.values_at(0.0, &mut self.at_end);
            self.has_started = true;
            if self.integrator.log.impacts > before.impacts {
                self.collided.note(0.0, None, &self.integrator);
            }
        }
        self.begin_inputs(drive)?;
        let mut first_impact = None;
        self.impulses.fill(0.0);
        let cancel = Cancel::current();
        for part in 0..parts {
            // Not added up, so that the last step ends where the interval does.
            self.integrator.state.tau = interval.length * (part as f64 / parts as f64);
            cancel.check(interval.start + self.integrator.state.tau)?;
            let end = interval.length * ((part + 1) as f64 / parts as f64);
            let impacts = self.integrator.log.impacts;
            let collisions = self.collided.in_step(part as usize, end);
            let stepped = self.integrator.step_with(drive, dt, collisions);
            let t = interval.start + self.integrator.state.tau;
            stepped.map_err(|error| failed(t, error))?;
            self.collided
                .keep_active(part as usize, self.integrator.active());
            if self.integrator.log.impacts > impacts {
                self.collided
                    .note(end, Some(part as usize), &self.integrator);
                first_impact.get_or_insert(t);
                for (place, impulse) in self.impulses.iter_mut().enumerate() {
                    let row = self.integrator.mechanics.first_row(place);
                    *impulse += self.integrator.state.impulses[row];
                }
            }
        }
        drive.inputs.values_at(interval.length, &mut self.at_end);
        let log = self.integrator.log;
        self.last = Interlude {
            impacts: (log.impacts - before.impacts) as f64,
            time: first_impact.unwrap_or(interval.end()),
            impulse: log.impulse - before.impulse,
        };
        Ok(())
    }

    /// Takes over the inputs at the start of a step, which may differ from those at the end of the last one.
    fn begin_inputs(&mut self, drive: Drive<'_>) -> Result<(), StepFailure> {
        drive.inputs.values_at(0.0, &mut self.at_start);
        let mut inputs = self.at_start.iter().zip(&self.at_end);
        if inputs.all(|(now, before)| (now - before).abs() <= ROUNDING * before.abs()) {
            return Ok(());
        }
        let at_end = std::mem::take(&mut self.at_end);
        self.hold(&at_end);
        self.at_end = at_end;
        let before = Drive {
            start: drive.start,
            inputs: &self.held,
        };
        let passed = self.integrator.pass_jump(before, drive);
        passed.map_err(|error| failed(drive.start, error))
    }

    /// A step that fails leaves the state as it was.
    fn try_advance(
        &mut self,
        interval: Interval,
        inputs: &Inputs,
        pace: Pace,
    ) -> Result<(), StepFailure> {
        self.keep();
        let advanced = self.advance(interval, inputs, pace);
        if advanced.is_err() {
            self.recall();
        }
        advanced
    }

    /// All numbers that later steps and outputs depend on.
    fn memory(&self, mut put: impl FnMut(&[f64])) {
        self.integrator.memory(&mut put);
        let Interlude {
            impacts,
            time,
            impulse,
        } = self.last;
        put(&[
            f64::from(u8::from(self.has_started)),
            f64::from(u8::from(self.collided.is_coupled())),
            impacts,
            time,
            impulse,
        ]);
        put(&self.impulses);
        put(&self.at_end);
    }

    /// Keeps what [`Run::recall`] goes back to.
    fn keep(&mut self) {
        let mut kept = std::mem::take(&mut self.kept);
        kept.clear();
        self.memory(|numbers| kept.extend_from_slice(numbers));
        self.kept = kept;
    }

    fn recall(&mut self) {
        let own = self.integrator.recall(&self.kept);
        if let &[
            has_started,
            is_coupled,
            impacts,
            time,
            impulse,
            ref rest @ ..,
        ] = own
        {
            let (impulses, at_end) = rest.split_at(self.impulses.len());
            self.has_started = has_started == 1.0;
            self.collided.go_on(is_coupled == 1.0);
            self.last = Interlude {
                impacts,
                time,
                impulse,
            };
            self.impulses.copy_from_slice(impulses);
            self.at_end.copy_from_slice(at_end);
        }
    }

    fn hold(&mut self, inputs: &[f64]) {
        for (place, &value) in inputs.iter().take(self.held.len()).enumerate() {
            self.held.replace(place, Polynomial::constant(value));
        }
    }

    /// Accelerations and forces at the start under the inputs that are held; the first step finds them anew under its
    /// own.
    fn show_start(&mut self, t: f64) -> Result<(), StepFailure> {
        let drive = Drive {
            start: t,
            inputs: &self.held,
        };
        let started = self.integrator.start(drive);
        started.map_err(|error| failed(t, error))
    }

    /// Accelerations under the inputs that are held, which are constant, so that the time since the start of an
    /// interval does not matter to them.
    fn accelerate(&mut self, t: f64) -> Result<(), StepFailure> {
        let drive = Drive {
            start: t - self.integrator.state.tau,
            inputs: &self.held,
        };
        let found = self.integrator.accelerations(drive);
        let found = found.map_err(|error| failed(t, error))?;
        self.accelerations.copy_from_slice(found);
        Ok(())
    }

    fn marker(&self, marker: usize) -> PointMotion {
        let state = &self.integrator.state;
        self.observer.marker(
            marker,
            Motion {
                q: &state.q,
                v: &state.v,
                a: &self.accelerations,
            },
        )
    }

    fn read(
        &mut self,
        t: f64,
        needs_accelerations: bool,
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        if needs_accelerations {
            self.accelerate(t)?;
        }
        for (value, &number) in values.iter_mut().zip(wanted) {
            let output = self.outputs.get(number).copied();
            let output = output.ok_or_else(|| StepFailure::Fatal {
                message: format!("the model has no output number {number}"),
            })?;
            *value = self.value(output);
        }
        Ok(())
    }

    fn value(&mut self, output: Output) -> f64 {
        let log: ContactLog = self.integrator.log;
        let state = &self.integrator.state;
        match output {
            Output::Position(place) => state.q[place],
            Output::Velocity(place) => state.v[place],
            Output::Marker {
                marker,
                level,
                component,
            } => self.marker(marker)[level][component],
            Output::Own(output) => {
                let motion = Motion {
                    q: &state.q,
                    v: &state.v,
                    a: &state.a,
                };
                self.observer.own_output(output, motion)
            }
            Output::Gap(place) => self.integrator.gaps()[place],
            Output::Force(row) => state.forces[row],
            Output::ContactImpulse(place) => self.impulses[place],
            Output::Energy => self.integrator.energy(),
            Output::Impacts => self.last.impacts,
            Output::ImpactTime => self.last.time,
            Output::Impulse => self.last.impulse,
            Output::ImpactLoss => log.impact_loss,
            Output::FrictionLoss => log.friction_loss,
        }
    }
}

fn failed(t: f64, error: StepError) -> StepFailure {
    StepFailure::Recoverable {
        t,
        message: error.to_string(),
    }
}

impl Subsystem for Run {
    fn step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        self.try_advance(interval, inputs, Pace::Own)
    }

    /// Closes and collides as the last step did: what another pattern of contacts makes of a perturbation is no derivative.
    fn perturbed_step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        self.try_advance(interval, inputs, Pace::Repeated)
    }

    fn impulse(&mut self, t: f64, inputs: &[f64], impulses: &[f64]) -> Result<(), StepFailure> {
        self.hold(inputs);
        let drive = Drive {
            start: t - self.integrator.state.tau,
            inputs: &self.held,
        };
        let jumped = self.integrator.take_impulse(drive, impulses);
        jumped.map_err(|error| failed(t, error))
    }

    fn treat_impacts(&mut self, impacts: &Impacts) -> Result<(), StepFailure> {
        self.collided.treat(impacts)
    }

    fn impacts(&self) -> &[Impact] {
        self.collided.impacts()
    }

    fn outputs(
        &mut self,
        t: f64,
        inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        let is_acceleration = |&number: &usize| {
            matches!(
                self.outputs.get(number),
                Some(Output::Marker { level: 2, .. })
            )
        };
        let needs_accelerations = wanted.iter().any(is_acceleration);
        self.hold(inputs);
        if self.has_started {
            return self.read(t, needs_accelerations, wanted, values);
        }
        self.keep();
        let read = self
            .show_start(t)
            .and_then(|()| self.read(t, needs_accelerations, wanted, values));
        self.recall();
        read
    }

    fn snapshot(&self, into: &mut Snapshot) {
        self.memory(|numbers| into.put(numbers));
    }

    fn restore(&mut self, from: &Snapshot) -> Result<(), StepFailure> {
        from.get(&mut self.kept)?;
        self.recall();
        Ok(())
    }

    fn internal_steps(&self) -> u64 {
        self.integrator.mechanics.counters.steps
    }

    fn contacts(&self) -> Option<v1::Contacts> {
        let mechanics = &self.integrator.mechanics;
        if mechanics.contacts().is_empty() {
            return None;
        }
        let (log, counters) = (self.integrator.log, mechanics.counters);
        let [_, robust @ ..] = counters.contact_problems;
        Some(v1::Contacts {
            impacts: log.impacts,
            first_impact: log.first_impact,
            impulse: log.impulse,
            penetration: log.penetration,
            residual: counters.largest_residual,
            problems: counters.contact_problems.iter().sum(),
            robust: robust.iter().sum(),
            ambiguous: counters.ambiguous,
            jams: counters.jams,
        })
    }
}
