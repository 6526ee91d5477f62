//! Where an instance stands, and the snapshots that its master goes back to.

use linchpin_proto::exchange::nothing_to_take_back;
use linchpin_proto::v1::{Failure, InitializeRequest};

/// One instance as unary calls drive it.
#[derive(Default)]
pub struct Place {
    /// Number of the instance.
    pub instance: u64,
    /// Names of the coupling outputs.
    pub coupling_outputs: Vec<String>,
    /// Snapshot of the state that the instance has; `None` at the end of a step that is not kept.
    pub stands_at: Option<u64>,
    sequence: u64,
    committed: Option<u64>,
    /// Of the state that the last advance started from, while that can be taken back.
    previous: Option<u64>,
    /// Of the end of the advance that is under way.
    advanced: Option<u64>,
    /// Not needed any more: the next snapshots replace them.
    spare: Vec<u64>,
}

impl Place {
    /// Behind Initialize.
    pub fn at_start(request: &InitializeRequest) -> Self {
        Self {
            instance: request.instance,
            coupling_outputs: request.coupling_outputs.clone(),
            sequence: request.sequence,
            ..Self::default()
        }
    }

    /// The instance has a state of which no snapshot was taken; the snapshots of others can go.
    pub fn forget_states(&mut self) {
        self.spare.extend(self.committed.take());
        self.spare.extend(self.previous.take());
        self.stands_at = None;
    }

    /// The sequence number of the next call.
    pub fn next(&mut self) -> u64 {
        self.sequence += 1;
        self.sequence
    }

    /// Snapshot of the committed state; `None` before the first exchange.
    pub fn committed(&self) -> Option<u64> {
        self.committed
    }

    /// Takes the snapshot of the start.
    pub fn start_at(&mut self, snapshot: u64) {
        self.committed = Some(snapshot);
    }

    /// Snapshot of the state that the last advance started from.
    pub fn previous(&self) -> Result<u64, Failure> {
        self.previous.ok_or_else(nothing_to_take_back)
    }

    /// A snapshot that can go.
    pub fn replaceable(&mut self) -> Option<u64> {
        self.spare.pop()
    }

    /// Takes the snapshot of the end of an advance, which is tentative until [`Place::settle`].
    pub fn reach(&mut self, snapshot: u64) {
        self.advanced = Some(snapshot);
    }

    /// The exchange succeeded: the last advance was taken back, if so told, and the new one, if any, counts.
    pub fn settle(&mut self, went_back: bool) {
        if went_back {
            self.spare.extend(self.committed);
            self.committed = self.previous.take();
        }
        if let Some(advanced) = self.advanced.take() {
            self.spare.extend(self.previous);
            self.previous = self.committed.replace(advanced);
        }
    }

    /// The exchange failed: nothing has changed.
    pub fn discard(&mut self) {
        self.spare.extend(self.advanced.take());
    }
}
