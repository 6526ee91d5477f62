//! Mixed timestepping (S2 Sect. 2.3, Fig. 4): a step without impacts by a base scheme, corrected by impulses where a
//! contact closes in it.

mod collisions;
mod growth;
mod losses;
mod memory;

use self::growth::Growth;
use super::activity::closed_contacts;
use super::contact_log::ContactLog;
use super::impact::{self, AtJoints};
use super::matrix::add_scaled;
use super::mechanics::{Mechanics, Settings, StepError};
use super::schemes::{Outcome, Scheme, SchemeError, SchemeKind};
use super::start::{Contacts, accelerate};
use super::state::{Drive, State, Step};
use super::system::{MechanicalSystem, Side};

pub use self::collisions::{Collision, Collisions};

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
    /// Contacts that have closed in a step whose collisions were given, without one of theirs: they are open until they collide.
    pending: Vec<bool>,
    pending_next: Vec<bool>,
    /// Velocities before the impulses of the last correction.
    before_impact: Vec<f64>,
    /// Accelerations before the inputs jumped.
    before_jump: Vec<f64>,
    forces_before_jump: Vec<f64>,
    /// Whether the last step was corrected.
    was_corrected: bool,
    /// Power that friction takes at the start of the step (W).
    friction_power: f64,
    growth: Growth,
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
            pending: vec![false; contacts],
            pending_next: vec![false; contacts],
            before_impact: vec![0.0; q.len()],
            before_jump: vec![0.0; q.len()],
            forces_before_jump: vec![0.0; mechanics.rows()],
            was_corrected: false,
            friction_power: 0.0,
            growth: Growth::default(),
            mechanics,
        })
    }

    /// Accelerations at the start. With a consistent start, closed contacts that approach each other collide first.
    ///
    /// # Errors
    /// [`StepError`].
    pub fn start(&mut self, drive: Drive<'_>) -> Result<(), StepError> {
        self.start_with(drive, Collisions::Found(None))
    }

    /// The same with what collides there.
    ///
    /// # Errors
    /// [`StepError`].
    pub fn start_with(
        &mut self,
        drive: Drive<'_>,
        collisions: Collisions<'_>,
    ) -> Result<(), StepError> {
        self.find_closed();
        self.next.copy_from(&self.state);
        self.closed_next.copy_from_slice(&self.closed);
        let mut log = self.log;
        self.was_corrected = false;
        if !self.mechanics.settings.has_consistent_start {
            self.accelerate(drive, Contacts::Ignored)?;
        } else {
            if self.collides_at_start(&collisions) {
                self.correct(&mut log, drive, collisions)?;
            }
            self.accelerate(drive, Contacts::Acting)?;
            std::mem::swap(&mut self.pending, &mut self.pending_next);
        }
        self.friction_power = self.friction_power_of_next();
        self.log = log;
        std::mem::swap(&mut self.state, &mut self.next);
        Ok(())
    }

    /// One step of length `dt`. A step that fails leaves the state as it was.
    ///
    /// # Errors
    /// [`StepError`].
    pub fn step(&mut self, drive: Drive<'_>, dt: f64) -> Result<(), StepError> {
        self.step_with(drive, dt, Collisions::Found(None))
    }

    /// The same with what collides in it.
    ///
    /// # Errors
    /// [`StepError`].
    pub fn step_with(
        &mut self,
        drive: Drive<'_>,
        dt: f64,
        collisions: Collisions<'_>,
    ) -> Result<(), StepError> {
        let stepped = self.try_step(drive, dt, collisions);
        self.growth.note(&self.state.v);
        stepped.map_err(|error| self.growth.explain(error, &self.state.v))
    }

    fn try_step(
        &mut self,
        drive: Drive<'_>,
        dt: f64,
        collisions: Collisions<'_>,
    ) -> Result<(), StepError> {
        self.find_closed();
        if let Collisions::Repeated { active, .. } = collisions {
            self.closed.copy_from_slice(active);
        }
        let step = Step {
            drive,
            tau: self.state.tau,
            dt,
            active: &self.closed,
        };
        self.next.impulses.copy_from_slice(&self.state.impulses);
        self.next.tau = step.tau + dt;
        let jams = self.mechanics.counters.jams;
        let outcome =
            self.scheme
                .advance(&mut self.mechanics, step, &self.state, &mut self.next)?;
        // An impact without collision: what the scheme made of it is no acceleration.
        let has_jammed = self.mechanics.counters.jams > jams;

        self.mechanics.system.gaps(&self.next.q, &mut self.gaps);
        closed_contacts(self.mechanics.contacts(), &self.gaps, &mut self.closed_next);
        if self.mechanics.settings.holds_pressed_contacts {
            add_pressed(&self.mechanics, &self.next.forces, &mut self.closed_next);
        }
        let mut log = self.log;
        let mut friction_power = 0.0;
        self.was_corrected = false;
        match outcome {
            Outcome::Smooth => {
                friction_power = self.friction_power_of_next();
                log.friction_loss += 0.5 * dt * (self.friction_power + friction_power);
                let has_impact = self.collides(&collisions);
                if has_impact {
                    self.correct(&mut log, drive, collisions)?;
                }
                let restarts = self.mechanics.settings.restarts_after_impacts;
                if restarts && (has_impact || has_jammed) {
                    self.accelerate(drive, Contacts::Acting)?;
                    friction_power = self.friction_power_of_next();
                }
            }
            Outcome::Impulsive { has_impact: true } => {
                log.impact_loss += self.loss_by_impulses(dt);
                self.note_impact(&mut log, drive);
            }
            Outcome::Impulsive { has_impact: false } => {
                log.friction_loss += self.loss_by_impulses(dt);
            }
        }
        if !self.next.is_finite() {
            return Err(StepError::NotFinite);
        }
        let deepest = self
            .unilateral_gaps()
            .fold(0.0, |deepest, gap| f64::max(deepest, -gap));
        log.penetration = log.penetration.max(deepest);

        self.log = log;
        self.friction_power = friction_power;
        self.mechanics.counters.steps += 1;
        std::mem::swap(&mut self.pending, &mut self.pending_next);
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

    /// The inputs jump here, from those of one drive to those of another: accelerations and forces jump with them. What the scheme keeps of
    /// earlier accelerations beside that stays.
    ///
    /// # Errors
    /// [`StepError`].
    pub fn pass_jump(&mut self, before: Drive<'_>, behind: Drive<'_>) -> Result<(), StepError> {
        self.accelerations(before)?;
        self.before_jump.copy_from_slice(&self.next.a);
        self.forces_before_jump.copy_from_slice(&self.next.forces);
        self.accelerations(behind)?;
        let forces = &mut self.state.forces;
        add_scaled(-1.0, &self.forces_before_jump, forces);
        add_scaled(1.0, &self.next.forces, forces);
        for own in [&mut self.state.a, &mut self.state.auxiliary] {
            add_scaled(-1.0, &self.before_jump, own);
            add_scaled(1.0, &self.next.a, own);
        }
        self.friction_power = self.friction_power_of_next();
        Ok(())
    }

    /// Velocities before the impulses of the last step, if it had any that corrected it: then
    /// `M(q) (v^+ - v^-) = W(q) Lambda` holds for the velocities and impulses of the state.
    pub fn velocities_before_impact(&self) -> Option<&[f64]> {
        self.was_corrected.then_some(&self.before_impact)
    }

    /// The next interval of inputs starts here.
    pub fn begin_interval(&mut self) {
        self.state.tau = 0.0;
    }

    fn find_closed(&mut self) {
        self.mechanics.system.gaps(&self.state.q, &mut self.gaps);
        closed_contacts(self.mechanics.contacts(), &self.gaps, &mut self.closed);
        for (closed, pending) in self.closed.iter_mut().zip(&self.pending) {
            *closed &= !pending;
        }
        if self.mechanics.settings.holds_pressed_contacts {
            add_pressed(&self.mechanics, &self.state.forces, &mut self.closed);
        }
    }

    fn unilateral_gaps(&self) -> impl Iterator<Item = f64> {
        let contacts = self.mechanics.contacts().iter().zip(&self.gaps);
        contacts
            .filter(|(contact, _)| contact.side == Side::Unilateral)
            .map(|(_, &gap)| gap)
    }

    /// The impulsive correction of the velocities in `next`.
    fn correct(
        &mut self,
        log: &mut ContactLog,
        drive: Drive<'_>,
        collisions: Collisions<'_>,
    ) -> Result<(), StepError> {
        let at_joints = match collisions {
            Collisions::Found(Some(partners)) => AtJoints::Partners(partners),
            Collisions::Given(Some(given))
            | Collisions::Repeated {
                given: Some(given), ..
            } if !given.loads.is_empty() => AtJoints::Loads(given.loads),
            _ => AtJoints::Nothing,
        };
        let next = &mut self.next;
        let system = &self.mechanics.system;
        let before = system.energy(&next.q, &next.v);
        self.before_impact.copy_from_slice(&next.v);
        let (closed, impulses) = (&self.closed_next, &mut next.impulses);
        let work = impact::correct(
            &mut self.mechanics,
            closed,
            &next.q,
            &mut next.v,
            impulses,
            at_joints,
        )?;
        log.impact_loss += before + work - self.mechanics.system.energy(&next.q, &next.v);
        self.note_impact(log, drive);
        self.was_corrected = true;
        Ok(())
    }

    /// Accelerations and forces of `next`, whose closed contacts are `closed_next`.
    fn accelerate(&mut self, drive: Drive<'_>, contacts: Contacts) -> Result<(), StepError> {
        let closed = &mut self.closed;
        closed.copy_from_slice(&self.closed_next);
        accelerate(&mut self.mechanics, drive, contacts, closed, &mut self.next)
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
}

/// Contacts that press are closed as well.
fn add_pressed(mechanics: &Mechanics, forces: &[f64], closed: &mut [bool]) {
    for (index, closed) in closed.iter_mut().enumerate() {
        *closed |= forces[mechanics.first_row(index)] > 0.0;
    }
}
