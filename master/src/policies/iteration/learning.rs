//! What an advance tells of the corrections of its step.

use super::state::{curvature, rate};
use super::{IterationControl, Missed};

impl IterationControl {
    /// After the step: an advance shows what was missed without a pass.
    pub fn learn(&mut self, missed: Missed) {
        let of_last = rate(missed.by_last, self.state.last.of_usual);
        self.state.note_curved(of_last, &self.settings);
        let is_noise = self.listen(missed);
        match self.state.are_fresh {
            // What new columns leave says nothing of how they serve in later steps.
            true => {
                self.state.fresh_rate = Some(of_last);
                self.state.curvature = curvature(of_last, self.state.last);
                (self.state.rate, self.state.left_by_first) = (None, None);
            }
            false => self.note_missed(missed, is_noise),
        }
    }

    fn note_missed(&mut self, missed: Missed, is_noise: bool) {
        let state = &mut self.state;
        let of_first = rate(missed.by_first, state.first);
        let of_last = rate(missed.by_last, state.last.of_usual);
        if state.passes.count == 0 {
            state.left_by_first = Some(of_last);
        }
        let tells_rate = state.passes.count > 0 && !is_noise;
        state.rate = Some(if tells_rate {
            of_first.max(of_last)
        } else {
            of_first
        });
    }

    /// A pass leaves a share of what it has changed; where it leaves most of it and the columns do not explain that, no further pass
    /// would take it away. Gives whether that is so.
    fn listen(&mut self, missed: Missed) -> bool {
        let (settings, state) = (&self.settings, &mut self.state);
        let left = missed.by_last;
        let expected = state.rate.unwrap_or_default() * state.last.of_usual;
        let useless = settings.useless * state.last.of_usual;
        let is_noise =
            state.passes.count > 0 && left > (settings.above_noise * expected).max(useless);
        state.noise = match is_noise {
            true => state.noise.max(left),
            false => settings.fading * state.noise,
        };
        is_noise
    }
}
