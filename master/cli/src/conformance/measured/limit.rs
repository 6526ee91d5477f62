//! Relations that hold in the limit of short steps.

use crate::conformance::compare::Comparison;
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// Share of the size of a quantity by which a relation that holds in the limit may be missed at the step where it is missed
/// least.
pub const LIMIT_SHARE: f64 = 1e-3;

/// By how much a step is shortened from one attempt to the next, and how many there are: the last one has a length of
/// `H / 4^8`, so that motions of 65536 times the frequency `1/H` are resolved.
const SHORTER: f64 = 0.25;
const ATTEMPTS: i32 = 9;

/// Factor by which a difference falls from one attempt to the next, at least, where it goes to zero.
const FALLS: f64 = 0.5;

/// Largest share of a quantity's size that tolerance and rounding may have; above it nothing can be told.
const HIDDEN: f64 = 0.1;

/// By how much a value may be off that has this size, where `floor` is what the solver's tolerance and rounding may do; `None`
/// if they hide the value.
pub fn allowed(share: f64, size: f64, floor: f64) -> Option<f64> {
    (size > 0.0 && floor <= HIDDEN * size).then_some(share * size + floor)
}

/// What a relation comes to where steps become short.
#[derive(Debug, Clone)]
pub struct Limit {
    /// The step (s), or whatever else was made small, at which the comparison comes closest.
    pub step: f64,
    /// The comparison there.
    pub comparison: Comparison,
    /// Whether it still came closer when shorter steps hid it in tolerance and rounding.
    pub is_hidden: bool,
}

impl Limit {
    /// Takes note of it; if it does not hold, that is a finding of this grade, unless it cannot be told.
    pub fn judge(self, verdict: &mut Verdict, grade: Grade, text: &str) {
        if self.comparison.compared == 0 {
            verdict.note(format!(
                "{text}: cannot be told, the solver's tolerance is larger than what changes"
            ));
        } else if self.is_hidden {
            verdict.note(format!("{text}: cannot be told, the solver's tolerance hides what steps that are shorter do"));
        } else {
            let text = format!("{text}, also over {:.1e} s", self.step);
            verdict.judge(self.comparison, grade, text);
        }
    }
}

/// Shortens the step from `step` (s) until the comparison over it holds; otherwise the one that comes closest. A step that is so short
/// that values hide in tolerance or rounding is not looked at.
pub fn in_the_limit(
    step: f64,
    mut compare: impl FnMut(f64) -> Result<Comparison, Stop>,
) -> Result<Limit, Stop> {
    let first = compare(step)?;
    let values = first.compared;
    let mut last = first.ratio();
    let mut limit = Limit {
        step,
        comparison: first,
        is_hidden: false,
    };
    let mut falls = false;
    for attempt in 1..ATTEMPTS {
        if limit.comparison.holds() {
            break;
        }
        let shorter = step * SHORTER.powi(attempt);
        let comparison = compare(shorter)?;
        if comparison.compared < values {
            limit.is_hidden = falls;
            break;
        }
        let ratio = comparison.ratio();
        falls = ratio <= FALLS * last;
        last = ratio;
        if ratio < limit.comparison.ratio() {
            (limit.step, limit.comparison) = (shorter, comparison);
        }
    }
    Ok(limit)
}

/// The comparison that comes closest over steps of 4 and 16 times `step` (s), for solvers of low order that take enough internal
/// steps only then. `None` if the model takes no such step, or its values hide in the solver's tolerance.
pub fn over_longer(
    step: f64,
    mut compare: impl FnMut(f64) -> Result<Comparison, Stop>,
) -> Option<Comparison> {
    [4.0 * step, 16.0 * step]
        .into_iter()
        .filter_map(|longer| compare(longer).ok())
        .filter(|comparison| comparison.compared > 0)
        .min_by(|a, b| a.ratio().total_cmp(&b.ratio()))
}
