//! Wrong requests are refused, and the instance lives on.

mod wrong;

use linchpin_proto::contract::CallError;
use linchpin_proto::v1::Severity;

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::verdict::{Grade, Stop, Verdict};
use wrong::{at_no_time, wrong_instances, wrong_requests};

/// Wrong names, lengths, numbers and degrees.
pub struct Refusals;

impl Check for Refusals {
    fn about(&self) -> About {
        About {
            name: "refusals",
            title: "wrong requests are refused with a message, and the instance lives on",
            equation: "INVALID_ARGUMENT and its kin; the state stays, and the sequence number counts on",
            tolerance: "the same bits",
            look_at: "how requests are checked before anything is changed, and which status an exception becomes",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        for (what, request) in wrong_instances(bench) {
            let answer = bench.initialize(&request).map(|_| ());
            weigh(what, answer, Grade::Fail, verdict)?;
        }
        let at_no_time = bench.initialize(&at_no_time(bench)).map(|_| ());
        // Harmless where the model does not depend on time.
        weigh("Initialize at t = NaN", at_no_time, Grade::Warn, verdict)?;
        let names = &bench.subject.outputs;
        let step = bench.step();
        let inputs = bench.loaded(1);
        let mut instance = bench.in_motion()?;
        let start = instance.keep()?;
        let expected = instance.step(step, &inputs)?;
        instance.go_back(&start)?;
        let before = instance.evaluate(&bench.subject.defaults)?;
        for (what, call) in wrong_requests(bench) {
            let answer = call(&mut instance);
            let is_refused = answer.is_err();
            weigh(what, answer, Grade::Fail, verdict)?;
            if !is_refused {
                // Whatever it did, the next one starts from the same state.
                instance.go_back(&start)?;
            }
            let mut comparison = Comparison::default();
            comparison.same(names, &instance.evaluate(&bench.subject.defaults)?, &before);
            let text = format!("the state has changed after {what}");
            verdict.judge(comparison, Grade::Fail, text);
        }
        let mut comparison = Comparison::default();
        comparison.same(names, &instance.step(step, &inputs)?, &expected);
        verdict.judge(
            comparison,
            Grade::Fail,
            "a step behind refused requests ends otherwise",
        );
        Ok(())
    }
}

/// What an answer to a wrong request is worth; `accepted` if it is no refusal.
fn weigh(
    what: &str,
    answer: Result<(), CallError>,
    accepted: Grade,
    verdict: &mut Verdict,
) -> Result<(), Stop> {
    match answer {
        Ok(()) => verdict.find(accepted, format!("{what}: accepted")),
        Err(CallError::Failed(failure)) => {
            if failure.severity() != Severity::Misuse {
                let severity = failure.severity().as_str_name();
                let text = format!(
                    "{what}: refused as {severity} and not as a wrong request: {}",
                    failure.message
                );
                verdict.find(Grade::Warn, text);
            }
            if failure.message.trim().is_empty() {
                verdict.find(Grade::Warn, format!("{what}: refused without a message"));
            }
        }
        // A refusal with a status of its own.
        Err(CallError::NoInstance { .. }) => {}
        Err(error) => return Err(error.into()),
    }
    Ok(())
}
