//! Relations that hold in the limit of short steps.

use crate::conformance::compare::Comparison;
use crate::conformance::verdict::Stop;

/// Share of the size of a quantity by which a relation that holds in the limit may be missed at the step where it is missed
/// least.
pub const LIMIT_SHARE: f64 = 1e-3;

/// By how much a step is shortened from one attempt to the next, and how many there are: the last one has a length of
/// `H / 4^8`, so that motions of 65536 times the frequency `1/H` are resolved.
const SHORTER: f64 = 0.25;
const ATTEMPTS: i32 = 9;

/// Largest share of a quantity's size that tolerance and rounding may have; above it nothing can be told.
const HIDDEN: f64 = 0.1;

/// By how much a value may be off that has this size, where `floor` is what the solver's tolerance and rounding may do; `None`
/// if they hide the value.
pub fn allowed(share: f64, size: f64, floor: f64) -> Option<f64> {
    (size > 0.0 && floor <= HIDDEN * size).then(|| share * size + floor)
}

/// Shortens the step from `step` (s) until the comparison over it holds. Otherwise the one that comes closest, and the step
/// (s) that it belongs to. A step that is so short that values hide in rounding is not looked at.
pub fn in_the_limit(
    step: f64,
    mut compare: impl FnMut(f64) -> Result<Comparison, Stop>,
) -> Result<(f64, Comparison), Stop> {
    let first = compare(step)?;
    let values = first.compared;
    let mut closest = (step, first);
    for attempt in 1..ATTEMPTS {
        if closest.1.holds() {
            break;
        }
        let shorter = step * SHORTER.powi(attempt);
        let comparison = compare(shorter)?;
        if comparison.compared < values {
            break;
        }
        if comparison.ratio() < closest.1.ratio() {
            closest = (shorter, comparison);
        }
    }
    Ok(closest)
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
