//! The size of the next step (Hairer & Wanner II, Sect. IV.8; Gustafsson 1994 for the predictive part).

const SAFETY: f64 = 0.9;
const MOST_GROWTH: f64 = 8.0;
const MOST_SHRINKING: f64 = 0.2;

/// A step keeps its size, and so its matrices, unless it may grow by more than this.
const WORTHWHILE_GROWTH: f64 = 1.2;

/// Proposes step sizes from estimated errors of order h^4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepControl {
    proposed: f64,
    accepted: Option<Accepted>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Accepted {
    step: f64,
    error: f64,
}

impl StepControl {
    /// Without any step yet.
    pub fn new() -> Self {
        Self {
            proposed: 0.0,
            accepted: None,
        }
    }

    /// The step size to go on with; 0 before the first step.
    pub fn proposed(&self) -> f64 {
        self.proposed
    }

    /// Goes on with this step size.
    pub fn propose(&mut self, step: f64) {
        self.proposed = step;
    }

    /// Begins an interval: inputs may jump, errors before and after are not comparable.
    pub fn restart(&mut self) {
        self.accepted = None;
    }

    /// The interval's rest in equal parts not longer than the proposed step: no short step is left for the end.
    pub fn fitting(&self, rest: f64) -> f64 {
        let parts = (rest / self.proposed).ceil();
        if parts > 1.0 { rest / parts } else { rest }
    }

    /// After a step with `error` <= 1 in units of what is allowed.
    pub fn accept(&mut self, step: f64, error: f64) {
        let error = error.max(1e-10);
        let mut growth = SAFETY * error.powf(-0.25);
        if let Some(before) = self.accepted {
            let predicted = growth * (step / before.step) * (before.error / error).powf(0.25);
            growth = growth.min(predicted);
        }
        self.accepted = Some(Accepted {
            step,
            error: error.max(1e-2),
        });
        let growth = growth.clamp(MOST_SHRINKING, MOST_GROWTH);
        let kept = if (1.0..WORTHWHILE_GROWTH).contains(&growth) {
            1.0
        } else {
            growth
        };
        // A step that was short because the interval ends says nothing against the longer one proposed.
        self.proposed = if growth >= 1.0 {
            self.proposed.max(kept * step)
        } else {
            kept * step
        };
    }

    /// After a step with `error` > 1.
    pub fn reject(&mut self, step: f64, error: f64) {
        self.proposed = step * (SAFETY * error.powf(-0.25)).clamp(MOST_SHRINKING, SAFETY);
    }

    /// After a step in which Newton's method diverged.
    pub fn halve(&mut self, step: f64) {
        self.proposed = 0.5 * step;
    }
}
