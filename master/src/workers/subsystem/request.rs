//! The next request to a worker, in memory that is kept from step to step.

use linchpin_proto::v1;

use super::{Ahead, Subsystem};

impl Subsystem {
    /// The advance of the next request.
    pub(crate) fn advance_to_fill(&mut self) -> &mut v1::Advance {
        let idle = &mut self.idle_advance;
        let advance = &mut self.request.advance;
        advance.get_or_insert_with(|| idle.take().unwrap_or_default())
    }

    /// Lets the next request be without an advance.
    pub(crate) fn forgo_advance(&mut self) {
        if let Some(advance) = self.request.advance.take() {
            self.idle_advance = Some(advance);
        }
    }

    /// Another macro step begins: of its impacts nothing is known, and where the subsystem finds them, it is given none to begin with.
    pub(crate) fn forget_impacts(&mut self) {
        self.impacts = self.couples_impacts.then(v1::Impacts::default);
    }

    /// The signal of driven input `place` in the advance that was prepared.
    pub(crate) fn advance_signal(&mut self, place: usize) -> &mut v1::Signal {
        let advance = self.request.advance.get_or_insert_default();
        signal_of(&mut advance.signals, place, place)
    }

    /// A look-ahead that was prepared.
    pub(crate) fn look(&mut self, ahead: Ahead) -> &mut v1::Predict {
        let look = match ahead {
            Ahead::Step => &mut self.request.predict,
            Ahead::Now => &mut self.request.evaluate,
        };
        look.get_or_insert_default()
    }

    /// The signal of driven input `place` in a look-ahead that was prepared.
    pub(crate) fn look_signal(&mut self, ahead: Ahead, place: usize) -> &mut v1::Signal {
        signal_of(&mut self.look(ahead).signals, place, place)
    }

    /// Perturbed signal number `perturbed` in a look-ahead that was prepared, which replaces that of input `place`.
    pub(crate) fn perturbed_signal(
        &mut self,
        ahead: Ahead,
        perturbed: usize,
        place: usize,
    ) -> &mut v1::Signal {
        signal_of(&mut self.look(ahead).perturbed, perturbed, place)
    }

    /// Direction number `direction` in a look-ahead that was prepared, of input `place`.
    pub(crate) fn direction_signal(
        &mut self,
        ahead: Ahead,
        direction: usize,
        place: usize,
    ) -> &mut v1::Signal {
        signal_of(&mut self.look(ahead).directions, direction, place)
    }
}

fn signal_of(signals: &mut [v1::Signal], number: usize, input: usize) -> &mut v1::Signal {
    let signal = &mut signals[number];
    signal.input = input as u32;
    signal
}
