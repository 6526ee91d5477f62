//! What is kept of a worker, so that another one can take its place.

mod journal;

use std::hash::{BuildHasher, RandomState};

use linchpin_proto::contract::CallError;
use linchpin_proto::v1;

use crate::results::Recoveries;

pub(super) use journal::Journal;

/// What is done against the loss of a worker.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RecoverySettings {
    /// How often another worker may be made for one exchange; 0: a loss ends the run.
    pub attempts: usize,
    /// Macro steps between two exports of its state.
    pub export_every: u64,
}

/// What another worker needs to take the place of a lost one.
pub(super) struct Recovery {
    pub settings: RecoverySettings,
    /// Whether the worker's states can leave its process.
    pub exports: bool,
    /// How the instance was made.
    pub initialize: v1::InitializeRequest,
    /// The last state that was exported; `None`: that of the start.
    pub state: Option<v1::ExportedState>,
    /// The advances from there to the present macro point.
    pub journal: Journal,
    /// Why the request could not be sent.
    pub unsent: Option<CallError>,
    /// What the contacts of lost instances did.
    pub earlier: Option<v1::Contacts>,
    /// How often that was needed, and what it cost.
    pub done: Recoveries,
}

impl Recovery {
    pub fn new(settings: RecoverySettings) -> Self {
        Self {
            settings,
            exports: false,
            initialize: v1::InitializeRequest::default(),
            state: None,
            journal: Journal::default(),
            unsent: None,
            earlier: None,
            done: Recoveries::default(),
        }
    }

    /// Begins anew with an instance that `request` makes.
    pub fn begin(&mut self, request: &v1::InitializeRequest, exports: bool) {
        self.initialize.clone_from(request);
        self.exports = exports;
        self.state = None;
        self.journal.clear();
    }

    /// The work of a call, with what the contacts of lost instances did.
    pub fn whole(&self, work: v1::Work) -> v1::Work {
        let contacts = work.contacts.map(|own| match self.earlier {
            Some(earlier) => own.behind(earlier),
            None => own,
        });
        v1::Work { contacts, ..work }
    }
}

/// A number for an instance. The master chooses it; a random one does not meet those of other masters.
pub(super) fn random_number(name: &str) -> u64 {
    RandomState::new().hash_one(name)
}
