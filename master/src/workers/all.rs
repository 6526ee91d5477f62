//! All workers of a run.

use super::samples::Samples;
use super::subsystem::{Ahead, Subsystem};
use super::views::{Looked, Now, Sampled};

/// All workers of a run.
pub struct Workers {
    /// Subsystems in the order of the scene.
    pub(crate) subsystems: Vec<Subsystem>,
    /// Present if results are wanted at fixed times.
    pub(crate) samples: Option<Samples>,
    /// Room for one value of every coupling variable.
    pub(super) memory: Vec<f64>,
}

impl Workers {
    /// Those of `subsystems`, coupled by that many `variables`.
    pub(crate) fn new(
        subsystems: Vec<Subsystem>,
        samples: Option<Samples>,
        variables: usize,
    ) -> Self {
        Self {
            subsystems,
            samples,
            memory: vec![0.0; variables],
        }
    }

    /// Ends all workers at once: one that hangs takes its time to end, and many do not take many times that.
    fn end(&mut self) {
        let subsystems = std::mem::take(&mut self.subsystems);
        let (others, here): (Vec<_>, Vec<_>) =
            subsystems.into_iter().partition(Subsystem::is_elsewhere);
        drop(here);
        std::thread::scope(|scope| {
            for subsystem in others {
                // Without a thread it ends here: the closure is dropped, and the subsystem with it.
                let _ = std::thread::Builder::new().spawn_scoped(scope, move || drop(subsystem));
            }
        });
    }

    /// Coupling outputs at the present macro point.
    pub(crate) fn now(&self) -> Now<'_> {
        Now(&self.subsystems)
    }

    /// The answers to the last look-ahead.
    pub(crate) fn looked(&self, ahead: Ahead) -> Looked<'_> {
        Looked {
            subsystems: &self.subsystems,
            ahead,
        }
    }

    /// Outputs at sample number `place` inside the last macro step.
    pub(crate) fn sampled(&self, place: usize) -> Sampled<'_> {
        Sampled {
            subsystems: &self.subsystems,
            place,
        }
    }
}

impl Drop for Workers {
    fn drop(&mut self) {
        self.end();
    }
}
