//! Responses of earlier macro steps that stay in use.

use std::ops::Range;

use nalgebra::UnitQuaternion;

use super::axes::{attitudes_of, turn};
use super::lengths::Between;
use super::measured::{Kind, Measured};
use super::settings::{MOST_SUPPORTS, SETTINGS};
use crate::joint::Level;
use crate::layout::Layout;
use crate::signal::Nodes;
use crate::system::Outputs;

/// The responses as they were measured over look-aheads of several lengths, and the attitudes that the bodies had then.
///
/// What is measured belongs to a macro step that may yet be rejected; only [`Kept::settle`] makes it one of those that stay.
#[derive(Debug, Clone, PartialEq)]
pub struct Kept {
    /// Those that stay, the last used first.
    settled: Vec<Measured>,
    /// Whether responses stay in use after their macro step.
    pub stay: bool,
    /// Those of the present macro step, if `is_pending`.
    pending: Measured,
    is_pending: bool,
    /// Found between those of other lengths.
    between: Between,
    /// To what the responses in use belong, and to what those of the macro step before did.
    kind: Kind,
    last: Kind,
    /// Attitudes at the last look-ahead.
    attitudes: Vec<UnitQuaternion<f64>>,
    /// Whether responses of this kind are taken from `between`.
    is_between: bool,
}

impl Kept {
    /// For the frames and outputs of `layout`, of which those on `levels` count, in a mechanism of `size` m; responses `stay` in use after
    /// their macro step, or not.
    pub fn new(layout: &Layout, levels: &'static [Level], stay: bool, size: f64) -> Self {
        Self {
            settled: Vec::with_capacity(if stay { SETTINGS.most_kinds } else { 0 }),
            stay,
            pending: Measured::default(),
            attitudes: Vec::new(),
            is_pending: false,
            between: Between::new(layout, levels, size),
            kind: Kind::default(),
            last: Kind::default(),
            is_between: false,
        }
    }

    /// Those that stay, and to what those of the last macro step belong.
    pub fn state(&self) -> (Vec<Measured>, Kind) {
        (self.settled.clone(), self.last.clone())
    }

    /// Goes on from these.
    pub fn resume(&mut self, settled: Vec<Measured>, last: Kind) {
        self.settled.clear();
        self.settled.extend(settled);
        self.last = last;
        (self.is_pending, self.is_between) = (false, false);
    }

    /// Looks for the responses that are `needed` over this length with these past nodes: measured ones, or such between those of other
    /// lengths. Gives the share of them that may be wrong because of the length; `None` if there are none.
    pub fn prepare(
        &mut self,
        layout: &Layout,
        (length, nodes): (f64, Nodes<'_>),
        (of_input, needed): (&[Range<usize>], &[bool]),
    ) -> Option<f64> {
        let fits = |one: &&Measured| one.kind.has_nodes(nodes) && one.has(needed);
        let mut fitting = self.settled.iter().filter(fits);
        self.is_between = false;
        if fitting.any(|one| one.kind.length == length) {
            return Some(0.0);
        }
        let away = |one: &Measured| (one.kind.length / length).ln().abs();
        let mut supports: [Option<&Measured>; MOST_SUPPORTS] = [None; MOST_SUPPORTS];
        for one in self.settled.iter().filter(fits) {
            let mut next = Some(one);
            for place in &mut supports {
                let is_nearer = match (*place, next) {
                    (Some(there), Some(own)) => away(own) < away(there),
                    (None, own) => own.is_some(),
                    (Some(_), None) => false,
                };
                if is_nearer {
                    std::mem::swap(place, &mut next);
                }
            }
        }
        let found = self.between.find(layout, length, supports, of_input);
        self.is_between = found.is_some();
        found
    }

    /// Begins with the first look-ahead over a macro step, or over a repeated one: what was measured for a step that is not taken is
    /// dropped. Gives whether the macro step before was of this kind.
    pub fn begin(&mut self, length: f64, nodes: Nodes<'_>) -> bool {
        self.is_pending = false;
        self.kind.set(length, nodes);
        self.last == self.kind
    }

    /// The macro step is done: its responses stay.
    pub fn settle(&mut self) {
        self.last.set(self.kind.length, self.kind.nodes());
        if !self.stay {
            self.is_pending = false;
            return;
        }
        let place = self.settled.iter().position(|one| one.kind == self.kind);
        if std::mem::take(&mut self.is_pending) {
            let place = place.unwrap_or_else(|| {
                if self.settled.len() < SETTINGS.most_kinds {
                    self.settled.push(self.pending.clone());
                }
                self.settled.len() - 1
            });
            std::mem::swap(&mut self.settled[place], &mut self.pending);
            self.settled[..=place].rotate_right(1);
        } else if let Some(place) = place {
            self.settled[..=place].rotate_right(1);
        }
    }

    /// Takes responses that were measured at these coupling outputs.
    pub fn keep(&mut self, layout: &Layout, outputs: &dyn Outputs, responses: &[Vec<f64>]) {
        let pending = &mut self.pending;
        pending.kind.set(self.kind.length, self.kind.nodes());
        pending.responses.resize_with(responses.len(), Vec::new);
        for (measured, response) in pending.responses.iter_mut().zip(responses) {
            measured.clone_from(response);
        }
        attitudes_of(layout, outputs, &mut pending.attitudes);
        self.is_pending = true;
    }

    /// Writes the responses of the kind in use, turned to the attitudes of these coupling outputs; `of_input` are those of each input. Gives
    /// whether there are any.
    pub fn carry(
        &mut self,
        layout: &Layout,
        outputs: &dyn Outputs,
        of_input: &[Range<usize>],
        responses: &mut [Vec<f64>],
    ) -> bool {
        let measured = match (self.is_pending, self.is_between) {
            (true, _) => Some(&self.pending),
            (false, true) => Some(self.between.found()),
            (false, false) => self.settled.iter().find(|one| one.kind == self.kind),
        };
        let Some(measured) = measured else {
            return false;
        };
        for (response, measured) in responses.iter_mut().zip(&measured.responses) {
            response.clone_from(measured);
        }
        attitudes_of(layout, outputs, &mut self.attitudes);
        let attitudes = [&measured.attitudes[..], &self.attitudes];
        turn(layout, attitudes, of_input, responses);
        true
    }
}
