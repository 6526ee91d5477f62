//! Mixed timestepping (S2 Sect. 2.3, Fig. 4): a step without impacts by a base scheme, corrected by impulses where a contact
//! closes in it.

use super::activity::{closed_contacts, closes_anew};
use super::impact;
use super::matrix::dot;
use super::mechanics::{Mechanics, Settings, StepError};
use super::schemes::{Outcome, Scheme, SchemeError, SchemeKind};
use super::start::{Contacts, accelerate};
use super::state::{Drive, State, Step};
use super::system::{MechanicalSystem, Side};

/// What contacts did since the start of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactLog {
    /// Impacts: steps that were corrected.
    pub impacts: u64,
    /// Time of the first one (s); `None` before.
    pub first_impact: Option<f64>,
    /// Sum of all normal impulses (N s).
    pub impulse: f64,
    /// Energy that impacts took (J).
    pub impact_loss: f64,
    /// Energy that friction took between impacts (J), by the trapezoidal rule.
    pub friction_loss: f64,
    /// Deepest penetration, `-g_N` (m).
    pub penetration: f64,
}

impl ContactLog {
    /// Numbers of a log.
    pub const NUMBERS: usize = 6;

    /// As plain numbers; no first impact is not a number.
    fn numbers(&self) -> [f64; Self::NUMBERS] {
        [
            self.impacts as f64,
            self.first_impact.unwrap_or(f64::NAN),
            self.impulse,
            self.impact_loss,
            self.friction_loss,
            self.penetration,
        ]
    }

    fn take(&mut self, numbers: &[f64]) {
        let &[
            impacts,
            first,
            impulse,
            impact_loss,
            friction_loss,
            penetration,
        ] = numbers
        else {
            return;
        };
        *self = Self {
            impacts: impacts as u64,
            first_impact: Some(first).filter(|first| !first.is_nan()),
            impulse,
            impact_loss,
            friction_loss,
            penetration,
        };
    }
}

/// A system with a scheme in motion.
pub struct Integrator {
    /// The system and what was done.
    pub mechanics: Mechanics,
    /// Its state.
    pub state: State,
    /// What its contacts did.
    pub log: ContactLog,
    scheme: Box<dyn Scheme>,
    next: State,
    gaps: Vec<f64>,
    closed: Vec<bool>,
    closed_next: Vec<bool>,
    /// Power that friction takes at the start of the step (W).
    friction_power: f64,
}

impl Integrator {
    /// A system at its start. Call [`Integrator::start`] before the first step.
    ///
    /// # Errors
    /// [`SchemeError`].
    pub fn new(
        system: Box<dyn MechanicalSystem>,
        inputs: usize,
        scheme: SchemeKind,
        settings: Settings,
        [q, v]: [&[f64]; 2],
    ) -> Result<Self, SchemeError> {
        let mechanics = Mechanics::new(system, inputs, settings);
        let contacts = mechanics.contacts().len();
        let mut state = State::new(mechanics.order(), mechanics.rows());
        state.q.copy_from_slice(q);
        state.v.copy_from_slice(v);
        Ok(Self {
            scheme: scheme.build(&mechanics)?,
            next: state.clone(),
            state,
            log: ContactLog::default(),
            gaps: vec![0.0; contacts],
            closed: vec![false; contacts],
            closed_next: vec![false; contacts],
            friction_power: 0.0,
            mechanics,
        })
    }

    /// Accelerations at the start.
    ///
    /// # Errors
    /// [`StepError`].
    pub fn start(&mut self, drive: Drive<'_>) -> Result<(), StepError> {
        let contacts = if self.mechanics.settings.has_consistent_start {
            Contacts::Acting
        } else {
            Contacts::Ignored
        };
        self.find_closed();
        self.closed_next.copy_from_slice(&self.closed);
        // Forces of an earlier call must not decide where the contact solver begins.
        self.state.forces.fill(0.0);
        let closed = &mut self.closed_next;
        accelerate(
            &mut self.mechanics,
            drive,
            contacts,
            closed,
            &mut self.state,
        )
    }

    /// One step of length `dt`. A step that fails leaves the state as it was.
    ///
    /// # Errors
    /// [`StepError`].
    pub fn step(&mut self, drive: Drive<'_>, dt: f64) -> Result<(), StepError> {
        self.find_closed();
        let step = Step {
            drive,
            tau: self.state.tau,
            dt,
            active: &self.closed,
        };
        self.next.impulses.copy_from_slice(&self.state.impulses);
        self.next.tau = step.tau + dt;
        let outcome =
            self.scheme
                .advance(&mut self.mechanics, step, &self.state, &mut self.next)?;

        self.mechanics.system.gaps(&self.next.q, &mut self.gaps);
        closed_contacts(self.mechanics.contacts(), &self.gaps, &mut self.closed_next);
        let mut log = self.log;
        self.account_for_friction(&mut log, dt);
        match outcome {
            Outcome::Smooth if closes_anew(&self.closed, &self.closed_next) => {
                self.correct(&mut log, drive)?;
            }
            Outcome::Impulsive { has_impact: true } => self.note_impact(&mut log, drive),
            Outcome::Smooth | Outcome::Impulsive { .. } => {}
        }
        if !self.next.is_finite() {
            return Err(StepError::NotFinite);
        }
        let deepest = self
            .unilateral_gaps()
            .fold(0.0, |deepest, gap| f64::max(deepest, -gap));
        log.penetration = log.penetration.max(deepest);

        self.log = log;
        self.mechanics.counters.steps += 1;
        std::mem::swap(&mut self.state, &mut self.next);
        Ok(())
    }

    /// Kinetic and potential energy (J).
    pub fn energy(&self) -> f64 {
        self.mechanics.system.energy(&self.state.q, &self.state.v)
    }

    /// Gaps at the present state.
    pub fn gaps(&mut self) -> &[f64] {
        self.mechanics.system.gaps(&self.state.q, &mut self.gaps);
        &self.gaps
    }

    /// Accelerations at the present state under `drive`, contacts included; the state stays as it is.
    ///
    /// # Errors
    /// [`StepError`].
    pub fn accelerations(&mut self, drive: Drive<'_>) -> Result<&[f64], StepError> {
        self.find_closed();
        self.next.copy_from(&self.state);
        let (mechanics, closed) = (&mut self.mechanics, &mut self.closed);
        accelerate(mechanics, drive, Contacts::Acting, closed, &mut self.next)?;
        Ok(&self.next.a)
    }

    /// Hands out all numbers that later steps depend on, in an order that [`Integrator::recall`] takes them back.
    pub fn memory(&self, mut put: impl FnMut(&[f64])) {
        for part in self.state.parts() {
            put(part);
        }
        put(&self.log.numbers());
        put(&[self.friction_power]);
    }

    /// Takes back the numbers of [`Integrator::memory`]; returns what is behind them.
    pub fn recall<'a>(&mut self, mut numbers: &'a [f64]) -> &'a [f64] {
        let mut take = |count: usize| {
            let (taken, rest) = numbers.split_at(count.min(numbers.len()));
            numbers = rest;
            taken
        };
        for part in self.state.parts_mut() {
            let taken = take(part.len());
            part[..taken.len()].copy_from_slice(taken);
        }
        self.log.take(take(ContactLog::NUMBERS));
        if let [power] = take(1) {
            self.friction_power = *power;
        }
        self.state.tau = 0.0;
        numbers
    }

    /// How many numbers [`Integrator::memory`] hands out.
    pub fn memory_len(&self) -> usize {
        let state: usize = self.state.parts().iter().map(|part| part.len()).sum();
        state + ContactLog::NUMBERS + 1
    }

    /// The next interval of inputs starts here.
    pub fn begin_interval(&mut self) {
        self.state.tau = 0.0;
    }

    fn find_closed(&mut self) {
        self.mechanics.system.gaps(&self.state.q, &mut self.gaps);
        closed_contacts(self.mechanics.contacts(), &self.gaps, &mut self.closed);
    }

    fn unilateral_gaps(&self) -> impl Iterator<Item = f64> {
        let contacts = self.mechanics.contacts().iter().zip(&self.gaps);
        contacts
            .filter(|(contact, _)| contact.side == Side::Unilateral)
            .map(|(_, &gap)| gap)
    }

    /// The impulsive correction of the velocities in `next`.
    fn correct(&mut self, log: &mut ContactLog, drive: Drive<'_>) -> Result<(), StepError> {
        let next = &mut self.next;
        let system = &self.mechanics.system;
        let before = system.energy(&next.q, &next.v);
        let (closed, impulses) = (&self.closed_next, &mut next.impulses);
        impact::correct(&mut self.mechanics, closed, &next.q, &mut next.v, impulses)?;
        log.impact_loss += before - self.mechanics.system.energy(&next.q, &next.v);
        self.note_impact(log, drive);
        if self.mechanics.settings.restarts_after_impacts {
            let closed = &mut self.closed;
            closed.copy_from_slice(&self.closed_next);
            accelerate(
                &mut self.mechanics,
                drive,
                Contacts::Acting,
                closed,
                &mut self.next,
            )?;
        }
        Ok(())
    }

    fn note_impact(&self, log: &mut ContactLog, drive: Drive<'_>) {
        log.impacts += 1;
        log.first_impact.get_or_insert(drive.start + self.next.tau);
        for (index, contact) in self.mechanics.contacts().iter().enumerate() {
            if contact.side == Side::Unilateral {
                log.impulse += self.next.impulses[self.mechanics.first_row(index)];
            }
        }
    }

    fn account_for_friction(&mut self, log: &mut ContactLog, dt: f64) {
        let power = self.friction_power_of_next();
        log.friction_loss += 0.5 * dt * (self.friction_power + power);
        self.friction_power = power;
    }

    /// `-sum lambda_T g_T'` at the end of the step.
    fn friction_power_of_next(&mut self) -> f64 {
        let next = &self.next;
        let n = next.v.len();
        let mut power = 0.0;
        let has_friction = self
            .mechanics
            .contacts()
            .iter()
            .any(|contact| contact.tangents > 0);
        if !has_friction || next.forces.iter().all(|&force| force == 0.0) {
            return 0.0;
        }
        self.mechanics.direct(&next.q, &[true]);
        for (index, contact) in self.mechanics.contacts().iter().enumerate() {
            let first = self.mechanics.first_row(index);
            for row in first + 1..first + contact.rows() {
                let direction = &self.mechanics.directions[row * n..][..n];
                power -= next.forces[row] * dot(direction, &next.v);
            }
        }
        power
    }
}
