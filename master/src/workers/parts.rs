//! All workers with what they are coupled by, and the next requests to all of them.

use super::samples::Samples;
use super::subsystem::{Ahead, Subsystem};
use crate::layout::Layout;
use crate::results::Cause;
use crate::time::MacroStep;

/// What the coupling methods work on.
pub struct Parts {
    /// Subsystems in the order of the scene.
    pub(crate) subsystems: Vec<Subsystem>,
    /// Joints tied to inputs and outputs.
    pub(crate) layout: Layout,
    /// Present if results are wanted at fixed times.
    pub(crate) samples: Option<Samples>,
}

impl Parts {
    /// Makes every subsystem's next request advance over `step`; the signals are filled in by the method.
    pub(crate) fn prepare_advance(&mut self, step: MacroStep) {
        for (number, subsystem) in self.subsystems.iter_mut().enumerate() {
            let advance = subsystem.advance_to_fill();
            advance.t = step.start;
            advance.step = step.length;
            let inputs = self.layout.inputs_of(number).len();
            advance.signals.resize_with(inputs, Default::default);
        }
        self.request_samples(step);
    }

    /// Makes every subsystem's next request look ahead from `t` over `length`, which may be 0; subsystems whose outputs nobody
    /// reads have nothing to tell. The signals are filled in by the method.
    pub(crate) fn prepare_prediction(&mut self, t: f64, length: f64) {
        self.prepare_look(Ahead::Step, t, length);
        for subsystem in &mut self.subsystems {
            subsystem.looks_ahead_for = Cause::Predictor;
        }
    }

    /// Makes every subsystem's next request evaluate its outputs at `t`, beside a prediction.
    pub(crate) fn prepare_evaluation(&mut self, t: f64) {
        self.prepare_look(Ahead::Now, t, 0.0);
    }

    fn prepare_look(&mut self, ahead: Ahead, t: f64, length: f64) {
        for (number, subsystem) in self.subsystems.iter_mut().enumerate() {
            if !subsystem.is_read() {
                continue;
            }
            let look = subsystem.look(ahead);
            look.t = t;
            look.step = length;
            let inputs = self.layout.inputs_of(number).len();
            look.signals.resize_with(inputs, Default::default);
        }
    }

    /// Makes no subsystem evaluate its outputs beside a prediction.
    pub(crate) fn forgo_evaluation(&mut self) {
        for subsystem in &mut self.subsystems {
            subsystem.request.evaluate = None;
        }
    }

    /// Makes every subsystem's next request look ahead over `step` once more, and do nothing else.
    pub(crate) fn prepare_pass(&mut self, step: MacroStep) {
        self.forgo_advance();
        self.prepare_prediction(step.start, step.length);
        for subsystem in &mut self.subsystems {
            subsystem.looks_ahead_for = Cause::Pass;
        }
    }

    /// Makes no subsystem advance.
    pub(crate) fn forgo_advance(&mut self) {
        for subsystem in &mut self.subsystems {
            subsystem.forgo_advance();
        }
    }

    /// Makes no subsystem look ahead.
    pub(crate) fn forgo_prediction(&mut self) {
        self.forgo_evaluation();
        for subsystem in &mut self.subsystems {
            subsystem.request.predict = None;
        }
    }

    /// Lets every advance that was prepared over `step` bring the samples inside it.
    fn request_samples(&mut self, step: MacroStep) {
        let Some(samples) = &mut self.samples else {
            return;
        };
        samples.find(step);
        for subsystem in &mut self.subsystems {
            if let Some(advance) = &mut subsystem.request.advance {
                advance.samples.clear();
                advance.samples.extend_from_slice(samples.offsets());
            }
        }
    }
}
