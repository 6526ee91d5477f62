//! The equidistant macro-time grid and its steps.

use serde::{Deserialize, Serialize};

/// The points `T_0 < T_1 < ... < T_n` with `T_0 = t_start` and `T_n = t_end` exactly.
///
/// All steps have the length `H`, except at the end where `H` does not divide the time span: a remainder of at least
/// `H/2` is one shorter step; a smaller one is shared with the step before it, so that the last two steps have the
/// length `(H + remainder) / 2`. No step is longer than `H` or shorter than `H/2`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MacroGrid {
    t_start: f64,
    t_end: f64,
    macro_step: f64,
    full_steps: usize,
    last_steps: usize,
    last_step: f64,
}

/// One macro step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MacroStep {
    /// `T_N` in s.
    pub start: f64,
    /// `T_{N+1} - T_N` in s.
    pub length: f64,
    /// `T_{N+1}` in s.
    pub end: f64,
}

/// The step before the first one: for messages about the start.
pub(crate) fn at_start(t: f64) -> MacroStep {
    MacroStep {
        start: t,
        length: 0.0,
        end: t,
    }
}

/// A remainder below this share of `H` is rounding: `H` divides the time span.
pub(crate) const ROUNDING: f64 = 1e-9;

impl MacroGrid {
    /// The grid from `t_start` to `t_end` with steps `macro_step`.
    ///
    /// The scene has checked `0 < macro_step <= t_end - t_start`.
    pub fn new(t_start: f64, t_end: f64, macro_step: f64) -> Self {
        let steps = (t_end - t_start) / macro_step;
        let mut grid = Self {
            t_start,
            t_end,
            macro_step,
            full_steps: steps.round() as usize,
            last_steps: 0,
            last_step: 0.0,
        };
        if (steps - steps.round()).abs() > ROUNDING * steps.max(1.0) {
            let remainder = steps - steps.floor();
            grid.full_steps = steps.floor() as usize;
            grid.last_steps = 1;
            if remainder < 0.5 && grid.full_steps > 0 {
                grid.full_steps -= 1;
                grid.last_steps = 2;
            }
            let full = grid.full_steps as f64 * macro_step;
            grid.last_step = (t_end - t_start - full) / grid.last_steps as f64;
        }
        grid
    }

    /// `H` in s.
    pub(super) fn macro_step(&self) -> f64 {
        self.macro_step
    }

    /// Number of macro steps.
    pub fn len(&self) -> usize {
        self.full_steps + self.last_steps
    }

    /// Whether there is no step at all.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// `T_N`; `t_end` for any `N` beyond the last point.
    pub fn point(&self, n: usize) -> f64 {
        if n >= self.len() {
            self.t_end
        } else if n <= self.full_steps {
            self.t_start + n as f64 * self.macro_step
        } else {
            self.t_end - (self.len() - n) as f64 * self.last_step
        }
    }

    /// Macro step from `T_N` to `T_{N+1}`; `None` after the last. Equal steps have lengths with equal bits.
    pub fn step(&self, n: usize) -> Option<MacroStep> {
        let length = match n {
            n if n < self.full_steps => self.macro_step,
            n if n < self.len() => self.last_step,
            _ => return None,
        };
        Some(MacroStep {
            start: self.point(n),
            length,
            end: self.point(n + 1),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_million_steps_end_exactly() {
        let grid = MacroGrid::new(0.0, 1.0, 1e-6);
        assert_eq!(grid.len(), 1_000_000);
        assert_eq!(grid.point(1_000_000).to_bits(), 1f64.to_bits());
        assert!((grid.point(333_333) - 0.333333).abs() < 1e-15);
    }

    #[test]
    fn a_step_that_does_not_divide_the_span_is_shortened_at_the_end() {
        let lengths = |t_end, h| {
            let grid = MacroGrid::new(0.0, t_end, h);
            (0..grid.len())
                .map(|n| grid.step(n).unwrap().length)
                .collect::<Vec<_>>()
        };
        assert_eq!(lengths(1.75, 0.5), [0.5, 0.5, 0.5, 0.25]);
        assert_eq!(lengths(1.125, 0.5), [0.5, 0.3125, 0.3125]);
        assert_eq!(lengths(0.5, 0.5), [0.5]);
    }

    proptest! {
        #[test]
        fn any_grid_is_gapless(start in -10f64..10.0, span in 1e-3f64..10.0, share in 1e-4f64..1.0) {
            let (end, h) = (start + span, span * share);
            let grid = MacroGrid::new(start, end, h);
            prop_assert_eq!(grid.point(0), start);
            prop_assert_eq!(grid.point(grid.len()), end);
            for n in 0..grid.len() {
                let step = grid.step(n).unwrap();
                prop_assert!((step.end - step.start - step.length).abs() < 1e-12 * start.abs().max(end.abs()).max(1.0));
                prop_assert!(step.length <= h * (1.0 + 1e-6) && step.length > 0.49 * h);
            }
            prop_assert_eq!(grid.step(grid.len()), None);
        }
    }
}
