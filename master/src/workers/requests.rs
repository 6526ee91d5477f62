//! What the next requests to all workers ask for.

use super::all::Workers;
use super::look::Look;
use super::subsystem::Ahead;
use crate::layout::{Layout, Over};
use crate::results::Cause;
use crate::signal::Curves;
use crate::system::Perturbation;
use crate::time::MacroStep;

impl Workers {
    /// Makes every subsystem's next request advance over `step` with these curves.
    pub(crate) fn request_advance(
        &mut self,
        layout: &Layout,
        step: MacroStep,
        curves: &dyn Curves,
    ) {
        self.find_samples(step);
        for number in 0..self.subsystems.len() {
            self.request_advance_of(layout, number, step, curves);
        }
    }

    /// Finds the samples inside `step`, for all advances over it.
    pub(crate) fn find_samples(&mut self, step: MacroStep) {
        if let Some(samples) = &mut self.samples {
            samples.find(step);
        }
    }

    /// Makes the next request to one subsystem advance over `step` with these curves; its samples have been found.
    pub(crate) fn request_advance_of(
        &mut self,
        layout: &Layout,
        number: usize,
        step: MacroStep,
        curves: &dyn Curves,
    ) {
        let subsystem = &mut self.subsystems[number];
        let inputs = layout.inputs_of(number);
        let impacts = subsystem.impacts.clone();
        let advance = subsystem.advance_to_fill();
        advance.impacts = impacts;
        advance.t = step.start;
        advance.step = step.length;
        advance.signals.resize_with(inputs.len(), Default::default);
        advance.instants.clear();
        let inside = &layout.inside;
        advance
            .instants
            .extend(instants(inside.instants_of(number), step.length));
        advance.integrals = inside.integrals_of(number) as u32;
        advance.samples.clear();
        if let Some(samples) = &self.samples {
            advance.samples.extend_from_slice(samples.offsets());
        }
        let mut over = Over {
            curves,
            memory: &mut self.memory,
        };
        for input in inputs {
            input.signal(&mut over, subsystem.advance_signal(input.place));
        }
    }

    /// Makes every subsystem's next request look ahead; subsystems whose outputs nobody reads have nothing to tell. Perturbed inputs come
    /// subsystem by subsystem, as the inputs of the layout do.
    pub(crate) fn request_look(&mut self, layout: &Layout, look: Look<'_>) {
        let mut rest = look.perturbed;
        for (number, subsystem) in self.subsystems.iter_mut().enumerate() {
            if look.ahead == Ahead::Step {
                subsystem.looks_ahead_for = look.cause;
                if look.cause == Cause::Predictor {
                    subsystem.forget_impacts();
                }
            }
            let impacts = match (look.ahead, look.cause) {
                (Ahead::Step, Cause::Pass) => subsystem.impacts.clone(),
                _ => None,
            };
            if !subsystem.is_read() {
                continue;
            }
            let is_own = |one: &Perturbation| layout.inputs[one.input].subsystem == number;
            let own = rest.partition_point(is_own);
            let (perturbed, others) = rest.split_at(own);
            rest = others;
            let inputs = layout.inputs_of(number);
            let directions = perturbed
                .iter()
                .filter(|one| one.increment.is_none())
                .count();
            let request = subsystem.look(look.ahead);
            (request.impacts, request.interface) = (impacts, None);
            request.t = look.t;
            request.step = look.length;
            request.signals.resize_with(inputs.len(), Default::default);
            request.instants.clear();
            request.integrals = 0;
            // Over no length there is nothing inside.
            if look.length > 0.0 {
                let inside = &layout.inside;
                request
                    .instants
                    .extend(instants(inside.instants_of(number), look.length));
                request.integrals = inside.integrals_of(number) as u32;
            }
            let steps = perturbed.len() - directions;
            request.perturbed.resize_with(steps, Default::default);
            request.directions.resize_with(directions, Default::default);
            let mut over = Over {
                curves: look.curves,
                memory: &mut self.memory,
            };
            for input in inputs {
                input.signal(&mut over, subsystem.look_signal(look.ahead, input.place));
            }
            over.curves = look.raised;
            for one in perturbed {
                let input = &layout.inputs[one.input];
                match one.increment {
                    Some(increment) => {
                        let signal = subsystem.perturbed_signal(look.ahead, one.place, input.place);
                        input.raised_signal(&mut over, &one.shape, increment, signal);
                    }
                    None => {
                        let signal = subsystem.direction_signal(look.ahead, one.place, input.place);
                        input.direction(&mut over, &one.shape, signal);
                    }
                }
            }
        }
    }

    /// Makes no subsystem advance.
    pub(crate) fn forgo_advance(&mut self) {
        for subsystem in &mut self.subsystems {
            subsystem.forgo_advance();
        }
    }

    /// Makes no subsystem look ahead.
    pub(crate) fn forgo_look(&mut self, ahead: Ahead) {
        for subsystem in &mut self.subsystems {
            match ahead {
                Ahead::Step => subsystem.request.predict = None,
                Ahead::Now => subsystem.request.evaluate = None,
            }
        }
    }
}

/// The instants at which a step of this length is cut.
fn instants(shares: &[f64], length: f64) -> impl Iterator<Item = f64> {
    shares.iter().map(move |share| share * length)
}
