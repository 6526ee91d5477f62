//! An advance that a worker cannot take at once.

use linchpin_proto::v1;

use super::subsystem::Subsystem;
use crate::error::RunError;
use crate::time::MacroStep;

/// The shortest substep is this part of the step.
const MOST_SUBSTEPS: u32 = 64;

/// Advances a subsystem in halves of the step, in quarters where it cannot take these, and so on, under the inputs of the whole step: other
/// workers have taken it already, so it cannot be shorter for this one. The request was refused before, so the worker stands where it stood.
pub(super) fn advance_in_substeps(
    subsystem: &mut Subsystem,
    step: MacroStep,
) -> Result<(), RunError> {
    let whole = subsystem.request.advance.take().unwrap_or_default();
    let evaluate = subsystem.request.evaluate.take();
    let at = |substep: u32| step.length * f64::from(substep) / f64::from(MOST_SUBSTEPS);
    let (mut done, mut size) = (0, MOST_SUBSTEPS / 2);
    let mut samples = Vec::new();
    while done < MOST_SUBSTEPS {
        let end = done + size;
        subsystem.request.advance = Some(substep_of(&whole, at(done), at(end)));
        subsystem.request.evaluate = evaluate.clone().filter(|_| end == MOST_SUBSTEPS);
        subsystem.post(step)?;
        match subsystem.collect(step) {
            Ok(()) => {
                samples.append(&mut subsystem.reply.samples);
                done = end;
                // Substeps end where those of their size do.
                while done.is_multiple_of(2 * size) && 2 * size < MOST_SUBSTEPS {
                    size *= 2;
                }
            }
            Err(error) if is_refusal(&error) && size > 1 => size /= 2,
            Err(error) => return Err(error),
        }
    }
    subsystem.reply.samples = samples;
    subsystem.request.advance = Some(whole);
    subsystem.request.evaluate = evaluate;
    Ok(())
}

/// Whether the worker has refused to step and stands where it stood.
pub(super) fn is_refusal(error: &RunError) -> bool {
    matches!(error, RunError::Worker { source, .. } if source.is_recoverable())
}

/// The part of an advance from `start` to `end`, in s after its beginning.
fn substep_of(whole: &v1::Advance, start: f64, end: f64) -> v1::Advance {
    let signals = whole.signals.iter().map(|signal| v1::Signal {
        nodes: signal.nodes.iter().map(|node| node - start).collect(),
        ..signal.clone()
    });
    let inside = |sample: &&f64| **sample > start && **sample <= end;
    let samples = whole.samples.iter().filter(inside);
    v1::Advance {
        t: whole.t + start,
        step: end - start,
        signals: signals.collect(),
        samples: samples.map(|sample| sample - start).collect(),
        impacts: whole
            .impacts
            .as_ref()
            .map(|all| impacts_of(all, start, end)),
        ..v1::Advance::default()
    }
}

/// The impacts from `start`, which belong to the part before unless it is the first, to `end`.
fn impacts_of(all: &v1::Impacts, start: f64, end: f64) -> v1::Impacts {
    let inside = |impact: &&v1::Impact| {
        (impact.at > start || start == 0.0 && impact.at == 0.0) && impact.at <= end
    };
    let impacts = all.impacts.iter().filter(inside).map(|impact| v1::Impact {
        at: impact.at - start,
        ..impact.clone()
    });
    v1::Impacts {
        impacts: impacts.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use linchpin_proto::polynomial::Polynomial;

    #[test]
    fn a_substep_has_the_inputs_and_the_samples_of_its_part() {
        let whole = v1::Advance {
            instants: vec![0.1],
            integrals: 2,
            t: 3.0,
            step: 0.8,
            signals: vec![v1::Signal {
                input: 7,
                nodes: vec![0.8, 0.0, -0.5],
                values: vec![1.0, -2.0, 4.0],
            }],
            samples: vec![0.1, 0.2, 0.35, 0.7],
        };
        let substep = substep_of(&whole, 0.2, 0.4);
        assert_eq!(
            (substep.t, substep.step, substep.signals[0].input),
            (3.2, 0.2, 7)
        );
        assert!(substep.samples.len() == 1 && (substep.samples[0] - 0.15).abs() < 1e-15);
        let [own, all] =
            [&substep, &whole].map(|one| Polynomial::from_signal(&one.signals[0]).unwrap());
        for tau in [0.0, 0.07, 0.2] {
            assert!((own.value(tau) - all.value(0.2 + tau)).abs() < 1e-13);
        }
    }
}
