//! Results at fixed times, whatever the macro steps are.

use crate::time::MacroStep;

/// A sample this close to a macro point, as a share of the interval, is that point.
const ROUNDING: f64 = 1e-9;

/// The times `t_start + k interval`, of which workers are asked for those inside a macro step: each is the end of a shorter
/// integration under the same inputs, so the macro steps stay as they are, bit by bit.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples {
    t_start: f64,
    interval: f64,
    /// Offsets of the samples inside the last step that was prepared.
    offsets: Vec<f64>,
    /// Number of the first of them.
    first: u64,
}

impl Samples {
    /// One sample for each `interval` (s) from `t_start` on.
    pub fn new(t_start: f64, interval: f64) -> Self {
        Self {
            t_start,
            interval,
            offsets: Vec::new(),
            first: 1,
        }
    }

    /// Finds the samples inside `step`.
    pub(super) fn find(&mut self, step: MacroStep) {
        self.offsets.clear();
        self.first = self.after(step.start);
        let end = step.end - ROUNDING * self.interval;
        let (t_start, interval) = (self.t_start, self.interval);
        let inside = (self.first..).map(|number| time(t_start, interval, number));
        let offsets = inside.take_while(|&t| t < end).map(|t| t - step.start);
        self.offsets.extend(offsets);
    }

    /// Offsets from the start of the step.
    pub(crate) fn offsets(&self) -> &[f64] {
        &self.offsets
    }

    /// Number and time in s of a sample inside the step.
    pub(crate) fn inside(&self, place: usize) -> (u64, f64) {
        let number = self.first + place as u64;
        (number, time(self.t_start, self.interval, number))
    }

    /// Number of the sample at `t`, if one is there.
    pub(crate) fn at(&self, t: f64) -> Option<u64> {
        let number = ((t - self.t_start) / self.interval).round();
        let number = number as u64;
        let distance = (time(self.t_start, self.interval, number) - t).abs();
        (distance <= ROUNDING * self.interval).then_some(number)
    }

    /// Number of the first sample after `t`, with one that is at `t` left out.
    fn after(&self, t: f64) -> u64 {
        (((t - self.t_start) / self.interval + ROUNDING).floor() as u64) + 1
    }
}

fn time(t_start: f64, interval: f64, number: u64) -> f64 {
    t_start + number as f64 * interval
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(start: f64, end: f64) -> MacroStep {
        MacroStep {
            start,
            length: end - start,
            end,
        }
    }

    #[test]
    fn every_sample_is_in_one_step_or_at_a_macro_point() {
        let mut samples = Samples::new(0.3, 0.1);
        let points = [0.3, 0.37, 0.4, 0.72, 0.8 + 1e-13, 1.3];
        let mut found = vec![0];
        for pair in points.windows(2) {
            samples.find(step(pair[0], pair[1]));
            for place in 0..samples.offsets().len() {
                let (number, t) = samples.inside(place);
                assert!((t - pair[0] - samples.offsets()[place]).abs() < 1e-15);
                found.push(number);
            }
            found.extend(samples.at(pair[1]));
        }
        assert_eq!(found, (0..=10).collect::<Vec<_>>());
    }
}
