//! What the parts of an exchange must keep to, whoever carries them out.

use crate::readable::number;
use crate::v1::{Advance, Failure, Impacts, Interface, Predict};
use crate::weights::MAX_WEIGHTS;

/// The samples of an advance are ascending instants inside its step.
///
/// # Errors
/// [`Failure`] of severity misuse that names the first sample which is not.
pub fn check_samples(advance: &Advance) -> Result<(), Failure> {
    check_inside(
        ["advance.samples", "sample"],
        &advance.samples,
        advance.step,
    )
}

/// The instants at which a step is cut are ascending and inside it.
///
/// # Errors
/// [`Failure`] of severity misuse that names the first instant which is not.
pub fn check_instants(instants: &[f64], step: f64) -> Result<(), Failure> {
    check_inside(["instants", "instant"], instants, step)
}

/// No more integrals of each output are asked for than there are weights.
///
/// # Errors
/// [`Failure`] of severity misuse that names both numbers.
pub fn check_integrals(integrals: u32) -> Result<usize, Failure> {
    match usize::try_from(integrals) {
        Ok(number) if number <= MAX_WEIGHTS => Ok(number),
        _ => Err(Failure::misuse(
            "integrals",
            format!(
                "{integrals} integrals of each output are asked for; there are weights for {MAX_WEIGHTS} at most"
            ),
        )),
    }
}

fn check_inside([field, what]: [&str; 2], offsets: &[f64], step: f64) -> Result<(), Failure> {
    let mut earliest = 0.0;
    for (place, &offset) in offsets.iter().enumerate() {
        if !(offset > earliest && offset < step) {
            return Err(Failure::misuse(
                field,
                format!(
                    "{what} {place} is {} s after the start of the step; it must be after {} s and before the end of the step \
                     at {} s",
                    number(offset),
                    number(earliest),
                    number(step)
                ),
            ));
        }
        earliest = offset;
    }
    Ok(())
}

/// Impacts are ascending instants of a step, its ends included, with an impulse for each of the `signals` or for none.
///
/// # Errors
/// [`Failure`] of severity misuse that names the first impact which is not so.
pub fn check_impacts(impacts: &Impacts, step: f64, signals: usize) -> Result<(), Failure> {
    let mut earliest = 0.0;
    for (place, impact) in impacts.impacts.iter().enumerate() {
        if !(impact.at >= earliest && impact.at <= step) {
            return Err(Failure::misuse(
                "impacts",
                format!(
                    "impact {place} is {} s after the start of the step; it must be from {} s on and to the end of the step at {} s",
                    number(impact.at),
                    number(earliest),
                    number(step)
                ),
            ));
        }
        earliest = impact.at;
        let loads = impact.loads.len();
        if loads != 0 && loads != signals {
            return Err(Failure::misuse(
                "impacts",
                format!(
                    "impact {place} has {loads} loads; it must have one for each of the {signals} signals, or none"
                ),
            ));
        }
        if let Some(load) = impact.loads.iter().find(|load| !load.is_finite()) {
            let message = format!("impact {place} has the impulse {load}; it must be finite");
            return Err(Failure::misuse("impacts", message));
        }
    }
    Ok(())
}

/// Whether an impact `at` (s) after the start of a step happens in the part of it that is `length` (s) long. Where a part ends at an impact but
/// for rounding, the impact belongs to it.
pub fn is_until(at: f64, length: f64) -> bool {
    const ROUNDING: f64 = 1e-9;
    at <= length * (1.0 + ROUNDING)
}

/// An interface has as many numbers as its rows and the `signals` ask for, all finite.
///
/// # Errors
/// [`Failure`] of severity misuse that names both numbers.
pub fn check_interface(interface: &Interface, signals: usize) -> Result<(), Failure> {
    let rows = interface.rows as usize;
    let lists = [
        ("directions", &interface.directions, rows * signals),
        ("mobility", &interface.mobility, rows * rows),
    ];
    for (name, own, right) in lists {
        if own.len() != right || !own.iter().all(|number| number.is_finite()) {
            return Err(Failure::misuse(
                "interface",
                format!(
                    "interface.{name} has {} numbers; with {rows} rows and {signals} signals it must have {right}, all finite",
                    own.len()
                ),
            ));
        }
    }
    Ok(())
}

/// An evaluation beside a prediction is a look ahead of zero length.
///
/// # Errors
/// [`Failure`] of severity misuse if it is not.
pub fn check_evaluation(evaluate: &Predict) -> Result<(), Failure> {
    if evaluate.t.is_finite() && evaluate.step == 0.0 {
        return Ok(());
    }
    Err(Failure::misuse(
        "evaluate.step",
        format!(
            "an evaluation at t = {} s over {} s: t must be finite, the length 0; a step is a prediction",
            evaluate.t, evaluate.step
        ),
    ))
}

/// The refusal of a request to go back where no advance can be taken back.
pub fn nothing_to_take_back() -> Failure {
    Failure::misuse(
        "go_back",
        "the committed state is not the end of an advance, so there is nothing to take back: one advance can be, not two; \
         further back there are Snapshot and Restore",
    )
}

/// The refusal of a sequence number that came before with another content.
pub fn other_content(call: &str, sequence: u64) -> Failure {
    Failure::misuse(
        "sequence",
        format!(
            "sequence number {sequence} came before, for a {call} with another content; only the same request gets its answer \
             again, another one takes the next number"
        ),
    )
}
