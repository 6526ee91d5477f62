//! Which contacts collide in a step: those that close in it, or those that are given.

use super::Integrator;
use crate::nonsmooth::activity::closes_anew;
use crate::nonsmooth::impact::{self, AtJoints};
use crate::nonsmooth::mechanics::StepError;
use crate::nonsmooth::partners::Partners;
use crate::nonsmooth::start::{Contacts, relative_velocity};
use crate::nonsmooth::state::Drive;
use crate::nonsmooth::system::Side;

/// Contacts that collide at the end of a step.
#[derive(Debug, Clone, Copy)]
pub struct Collision<'a> {
    /// Whether each contact takes part.
    pub contacts: &'a [bool],
    /// Impulses of loads, one for each input; none at all if empty.
    pub loads: &'a [f64],
}

/// What collides in a step.
#[derive(Debug)]
pub enum Collisions<'a> {
    /// Contacts that close, together with all that are closed; partners may take part.
    Found(Option<&'a mut Partners>),
    /// What is given. Contacts that close besides stay open until a step finds them.
    Given(Option<Collision<'a>>),
    /// As in an earlier step from nearly the same state.
    Repeated {
        /// Contacts that were active in it, by [`Integrator::active`].
        active: &'a [bool],
        /// What collided in it.
        given: Option<Collision<'a>>,
    },
}

impl<'a> Collisions<'a> {
    /// What is given, unless collisions are found.
    fn given(&self) -> Option<Option<Collision<'a>>> {
        match self {
            Self::Found(_) => None,
            Self::Given(given) | Self::Repeated { given, .. } => Some(*given),
        }
    }
}

impl Integrator {
    /// The contacts that were active in the last step.
    pub fn active(&self) -> &[bool] {
        &self.closed
    }

    /// The contacts that took part in the last step's impact, and are closed behind it.
    pub fn collided(&self) -> &[bool] {
        &self.closed_next
    }

    /// Lets the velocities jump by the impulses of loads, one for each input, and of the constraints. Contacts that can open take no part.
    ///
    /// # Errors
    /// [`StepError`].
    pub fn take_impulse(&mut self, drive: Drive<'_>, loads: &[f64]) -> Result<(), StepError> {
        let sides = self.mechanics.contacts().iter().map(|contact| contact.side);
        for (closed, side) in self.closed_next.iter_mut().zip(sides) {
            *closed = side == Side::Bilateral;
        }
        self.next.copy_from(&self.state);
        let (closed, next) = (&self.closed_next, &mut self.next);
        let at_joints = AtJoints::Loads(loads);
        let (q, impulses) = (&next.q, &mut next.impulses);
        impact::correct(
            &mut self.mechanics,
            closed,
            q,
            &mut next.v,
            impulses,
            at_joints,
        )?;
        self.accelerate(drive, Contacts::Acting)?;
        self.friction_power = self.friction_power_of_next();
        std::mem::swap(&mut self.state, &mut self.next);
        Ok(())
    }

    /// Whether anything collides at the end of a step. Then `closed_next` are the contacts that take part, otherwise those that are closed.
    pub(super) fn collides(&mut self, collisions: &Collisions<'_>) -> bool {
        self.pending_next.fill(false);
        let Some(given) = collisions.given() else {
            return closes_anew(&self.closed, &self.closed_next);
        };
        for (index, contact) in self.mechanics.contacts().iter().enumerate() {
            if contact.side == Side::Bilateral {
                continue;
            }
            let closes = self.closed_next[index] && !self.closed[index];
            let takes_part = given.is_some_and(|given| given.contacts[index]);
            self.pending_next[index] = closes && !takes_part;
            self.closed_next[index] = match given {
                Some(_) => takes_part,
                None => self.closed_next[index] && !closes,
            };
        }
        given.is_some()
    }

    /// The same at the start, where contacts collide that are closed and approach each other.
    pub(super) fn collides_at_start(&mut self, collisions: &Collisions<'_>) -> bool {
        self.pending_next.fill(false);
        self.mechanics.direct(&self.next.q, &self.closed_next);
        let mut approaches = false;
        for (index, contact) in self.mechanics.contacts().iter().enumerate() {
            let row = self.mechanics.first_row(index);
            if contact.side == Side::Unilateral && self.closed_next[index] {
                self.pending_next[index] =
                    relative_velocity(&self.mechanics, row, &self.next.v) < 0.0;
                approaches |= self.pending_next[index];
            }
        }
        match collisions.given() {
            None => {
                self.pending_next.fill(false);
                approaches
            }
            Some(None) => {
                for (closed, pending) in self.closed_next.iter_mut().zip(&self.pending_next) {
                    *closed &= !pending;
                }
                false
            }
            Some(Some(given)) => {
                self.pending_next.fill(false);
                self.closed_next.copy_from_slice(given.contacts);
                true
            }
        }
    }
}
