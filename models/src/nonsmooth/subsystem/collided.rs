//! What collides in the steps of a subsystem: found, given, or as in the step before.

use linchpin_proto::exchange::is_until;
use linchpin_worker::{Impact, Impacts, StepFailure};

use crate::nonsmooth::mixed::{Collision, Collisions, Integrator};
use crate::nonsmooth::partners::Partners;

/// Impacts of a macro step for which there is memory from the start.
const PREPARED: usize = 8;

/// Whose closing and colliding a step has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pace {
    /// Its own.
    Own,
    /// That of the step before.
    Repeated,
}

/// How the steps that follow treat impacts.
enum Treatment {
    Found(Option<Partners>),
    Given(Vec<Noted>),
}

/// An impact with its contacts as a mask.
#[derive(Debug, Clone, Default)]
struct Noted {
    /// Internal step at whose end it happened; none at the start of the run.
    part: Option<usize>,
    contacts: Vec<bool>,
    impact: Impact,
}

/// What collides.
pub struct Collided {
    /// Number of contacts.
    contacts: usize,
    /// Whether the scheme has impulses in its steps.
    is_impulsive: bool,
    treatment: Treatment,
    /// Whether a master has said how impacts are treated: then perturbed steps repeat them, which holds for small perturbations alone.
    is_coupled: bool,
    pace: Pace,
    /// The impacts of the last step that was not repeated.
    noted: Vec<Noted>,
    found: Vec<Impact>,
    /// Memory of those of earlier steps.
    spare: (Vec<Noted>, Vec<Impact>),
    /// The contacts that were active in it, internal step by internal step.
    active: Vec<bool>,
    /// Number of impacts so far in the present step.
    done: usize,
}

impl Collided {
    /// For that many contacts.
    pub fn new(contacts: usize, is_impulsive: bool) -> Self {
        let impact = || Impact {
            contacts: Vec::with_capacity(contacts),
            ..Impact::default()
        };
        let noted = || Noted {
            part: None,
            contacts: Vec::with_capacity(contacts),
            impact: impact(),
        };
        Self {
            contacts,
            is_impulsive,
            treatment: Treatment::Found(None),
            is_coupled: false,
            pace: Pace::Own,
            noted: Vec::with_capacity(PREPARED),
            found: Vec::with_capacity(PREPARED),
            spare: (
                (0..PREPARED).map(|_| noted()).collect(),
                (0..PREPARED).map(|_| impact()).collect(),
            ),
            active: Vec::new(),
            done: 0,
        }
    }

    /// The impacts of the last step that was not repeated.
    pub fn impacts(&self) -> &[Impact] {
        &self.found
    }

    /// Whether a master has said how impacts are treated.
    pub fn is_coupled(&self) -> bool {
        self.is_coupled
    }

    /// Goes on from a state of which a master had said so, or not; what was said here once stays.
    pub fn go_on(&mut self, is_coupled: bool) {
        self.is_coupled |= is_coupled;
    }

    /// Lets the steps that follow treat impacts so.
    pub fn treat(&mut self, impacts: &Impacts) -> Result<(), StepFailure> {
        self.treatment = match impacts {
            Impacts::Alone => Treatment::Found(None),
            _ if self.is_impulsive => {
                return Err(StepFailure::NotOffered {
                    what: "impacts that partners take part in with solver moreau, whose every step is one",
                });
            }
            Impacts::Coupled(interface) => Treatment::Found(Partners::new(interface.clone())),
            Impacts::Given(given) => {
                let noted = given.iter().map(|impact| self.note_given(impact));
                Treatment::Given(noted.collect::<Result<_, _>>()?)
            }
        };
        self.is_coupled = true;
        Ok(())
    }

    fn note_given(&self, impact: &Impact) -> Result<Noted, StepFailure> {
        let mut contacts = vec![false; self.contacts];
        for &number in &impact.contacts {
            match contacts.get_mut(number) {
                Some(contact) => *contact = true,
                None => {
                    let known = self.contacts;
                    let message = format!(
                        "an impact names contact {number}; the model has {known}, counted from 0"
                    );
                    return Err(StepFailure::Fatal { message });
                }
            }
        }
        Ok(Noted {
            part: None,
            contacts,
            impact: impact.clone(),
        })
    }

    /// Begins a step of that many internal ones.
    pub fn begin(&mut self, pace: Pace, parts: usize) {
        let fits = self.active.len() == parts * self.contacts;
        self.pace = match pace {
            Pace::Repeated if fits && self.is_coupled => Pace::Repeated,
            _ => Pace::Own,
        };
        self.done = 0;
        if self.pace == Pace::Own {
            self.spare.0.append(&mut self.noted);
            self.spare.1.append(&mut self.found);
            self.active.clear();
            self.active.resize(parts * self.contacts, false);
        }
    }

    /// What collides at the start of the run.
    pub fn at_start(&mut self) -> Collisions<'_> {
        match (self.pace, &mut self.treatment) {
            (Pace::Repeated, _) => {
                let next = self.noted.get(self.done);
                Collisions::Given(
                    next.filter(|next| next.part.is_none())
                        .map(Noted::collision),
                )
            }
            (Pace::Own, Treatment::Found(partners)) => Collisions::Found(partners.as_mut()),
            (Pace::Own, Treatment::Given(given)) => {
                let next = given.get(self.done);
                let next = next.filter(|next| next.impact.at == 0.0);
                Collisions::Given(next.map(Noted::collision))
            }
        }
    }

    /// What collides in internal step number `part`, which ends at `end`, s after the start of the step.
    pub fn in_step(&mut self, part: usize, end: f64) -> Collisions<'_> {
        match (self.pace, &mut self.treatment) {
            (Pace::Repeated, _) => {
                let next = self.noted.get(self.done);
                Collisions::Repeated {
                    active: &self.active[part * self.contacts..][..self.contacts],
                    given: next
                        .filter(|next| next.part == Some(part))
                        .map(Noted::collision),
                }
            }
            (Pace::Own, Treatment::Found(partners)) => Collisions::Found(partners.as_mut()),
            (Pace::Own, Treatment::Given(given)) => {
                let next = given.get(self.done);
                let next = next.filter(|next| is_until(next.impact.at, end));
                Collisions::Given(next.map(Noted::collision))
            }
        }
    }

    /// Keeps which contacts were active in an internal step.
    pub fn keep_active(&mut self, part: usize, active: &[bool]) {
        if self.pace == Pace::Own {
            self.active[part * self.contacts..][..self.contacts].copy_from_slice(active);
        }
    }

    /// There was an impact `at` (s) after the start of the step: at the end of internal step number `part`, or at the start of the run.
    pub fn note(&mut self, at: f64, part: Option<usize>, integrator: &Integrator) {
        let done = self.done;
        self.done += 1;
        if self.pace == Pace::Repeated {
            return;
        }
        let mut noted = self.spare.0.pop().unwrap_or_default();
        noted.part = part;
        match &self.treatment {
            Treatment::Given(given) => {
                noted.contacts.clone_from(&given[done].contacts);
                noted.impact.take(&given[done].impact);
            }
            Treatment::Found(partners) => {
                let contacts = integrator.collided();
                noted.contacts.clear();
                noted.contacts.extend_from_slice(contacts);
                let impact = &mut noted.impact;
                impact.at = at;
                impact.contacts.clear();
                let numbers = (0..contacts.len()).filter(|&number| contacts[number]);
                impact.contacts.extend(numbers);
                impact.loads.clear();
                impact.multipliers.clear();
                if let Some(partners) = partners {
                    impact.loads.extend(partners.loads());
                    impact.multipliers.extend_from_slice(partners.impulses());
                }
            }
        }
        let mut found = self.spare.1.pop().unwrap_or_default();
        found.take(&noted.impact);
        self.found.push(found);
        self.noted.push(noted);
    }
}

impl Noted {
    fn collision(&self) -> Collision<'_> {
        Collision {
            contacts: &self.contacts,
            loads: &self.impact.loads,
        }
    }
}
