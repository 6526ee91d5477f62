//! Replies as a fault has them.

use linchpin_proto::v1::{ExchangeReply, StepRequest};

use super::protocol::Fault;

/// Spoils the answer to a step: `count` outputs at its end, then integrals and interior outputs. `last` is the answer to the step
/// before.
pub fn wrong_step(
    fault: Fault,
    request: &StepRequest,
    (count, last): (usize, &[f64]),
    values: &mut Vec<f64>,
) {
    let weights = request.integrals as usize;
    let integrals = count..count * (1 + weights);
    let interior = integrals.end..values.len();
    match fault {
        Fault::ForgetsAnOutput => drop(values.pop()),
        Fault::IntegralsTimesStep => values[integrals]
            .iter_mut()
            .for_each(|own| *own *= request.step),
        Fault::IntegralsNotFromZero if last.len() == values.len() => {
            for place in integrals {
                values[place] += last[place];
            }
        }
        Fault::IntegralsWrongWeight if weights > 1 => {
            values[2 * count..3 * count]
                .iter_mut()
                .for_each(|own| *own = -*own);
        }
        Fault::InteriorInterpolated if last.len() >= count => {
            let ends = values[..count].to_vec();
            let shares = request.instants.iter().map(|own| own / request.step);
            for (share, list) in shares.zip(values[interior].chunks_mut(count)) {
                for (place, own) in list.iter_mut().enumerate() {
                    *own = last[place] + share * (ends[place] - last[place]);
                }
            }
        }
        Fault::InteriorByOutput if !request.instants.is_empty() => {
            let right = values[interior.clone()].to_vec();
            let instants = request.instants.len();
            for (place, own) in values[interior].iter_mut().enumerate() {
                *own = right[place % instants * count + place / instants];
            }
        }
        _ => {}
    }
}

/// Spoils the answer to an exchange.
pub fn wrong_exchange(fault: Fault, reply: &mut ExchangeReply) {
    match fault {
        Fault::PerturbedMissing => drop(reply.perturbed.pop()),
        Fault::EvaluatesLater if reply.evaluated.is_some() => {
            reply.evaluated = reply.predicted.clone()
        }
        Fault::SamplesAtTheEnd => {
            let advanced = reply.advanced.clone().unwrap_or_default();
            reply
                .samples
                .iter_mut()
                .for_each(|own| *own = advanced.clone());
        }
        _ => {}
    }
}
