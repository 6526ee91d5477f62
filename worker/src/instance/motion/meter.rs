//! What a call costs.

use std::time::Instant;

use linchpin_proto::v1;

use super::Motion;

/// Counts what one call costs.
pub(in crate::instance) struct Meter {
    started: Instant,
    integrations: u64,
    derivatives: u64,
    steps: u64,
    contacts: Option<v1::Contacts>,
}

impl Meter {
    pub(in crate::instance) fn start(motion: &Motion) -> Self {
        Self {
            started: Instant::now(),
            integrations: motion.integrations,
            derivatives: motion.derivatives,
            steps: motion.subsystem.internal_steps(),
            contacts: None,
        }
    }

    /// The state is the one that will be committed.
    pub(in crate::instance) fn look_at_contacts(&mut self, motion: &Motion) {
        self.contacts = motion.subsystem.contacts();
    }

    pub(in crate::instance) fn stop(self, motion: &Motion) -> v1::Work {
        v1::Work {
            integrations: motion.integrations - self.integrations,
            derivatives: motion.derivatives - self.derivatives,
            steps: motion.subsystem.internal_steps() - self.steps,
            nanoseconds: u64::try_from(self.started.elapsed().as_nanos()).unwrap_or(u64::MAX),
            contacts: self.contacts,
        }
    }
}
