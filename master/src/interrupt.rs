//! Stopping a run from outside.

use std::sync::Arc;

use tokio::sync::watch;

/// A request to stop. Copies share it, so one that is kept outside stops the run that has another.
#[derive(Debug, Clone, Default)]
pub struct Interrupt {
    requested: Arc<watch::Sender<bool>>,
}

impl Interrupt {
    /// Asks every holder of a copy to stop, for good.
    pub fn request(&self) {
        self.requested.send_replace(true);
    }

    /// Whether somebody asked.
    pub fn is_requested(&self) -> bool {
        *self.requested.borrow()
    }

    /// Completes when somebody asks.
    pub async fn requested(&self) {
        let mut requests = self.requested.subscribe();
        // The sender lives as long as `self`, so waiting does not fail.
        let _ = requests.wait_for(|requested| *requested).await;
    }
}
