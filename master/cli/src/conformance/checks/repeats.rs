//! Sequence numbers: a repeated call is answered again and not carried out again.

use linchpin_proto::contract::CallError;
use linchpin_proto::v1::{self, Severity};

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::instance::{Inside, Instance};
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// Repeated, skipped and misused sequence numbers.
pub struct Repeats;

/// The minor version since which a repeated number with another content is misuse.
const CONTENT_COUNTS: u32 = 3;

impl Check for Repeats {
    fn about(&self) -> About {
        About {
            name: "repeats",
            title: "a repeated sequence number gets the first answer and steps no second time",
            equation: "Step(n), Step(n) = Step(n); anything but n and n + 1 is refused",
            tolerance: "the same bits",
            look_at: "the sequence number of each instance: keep the last request and its answer",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let names = &bench.subject.outputs;
        let step = bench.step();
        let inputs = bench.loaded(1);
        let mut instance = bench.in_motion()?;
        let start = instance.keep()?;
        let first = instance.step(step, &inputs)?;
        let second = instance.step(step, &inputs)?;
        instance.go_back(&start)?;

        let request = instance.step_request(step, inputs.signals(step), Inside::default());
        let mut comparison = Comparison::default();
        for _ in 0..2 {
            comparison.same(names, &instance.take(&request)?, &first);
        }
        verdict.judge(
            comparison,
            Grade::Fail,
            "a repeated Step is answered otherwise",
        );
        let other = with_other_content(bench, &request);
        self.refuse_other_content(bench, &instance, &other, verdict);
        for (what, sequence) in [
            ("a number that was skipped to", request.sequence + 2),
            ("a number from before the last", request.sequence - 1),
        ] {
            let request = v1::StepRequest {
                sequence,
                ..request.clone()
            };
            if instance.calls.step(&request).is_ok() {
                verdict.find(Grade::Fail, format!("{what} is accepted"));
            }
        }
        instance.t = request.t + step;
        let mut comparison = Comparison::default();
        comparison.same(names, &instance.step(step, &inputs)?, &second);
        let text = "the step behind repeated and refused ones starts from another state";
        verdict.judge(comparison, Grade::Fail, text);
        snapshots(&mut instance, verdict)
    }
}

impl Repeats {
    fn refuse_other_content(
        &self,
        bench: &Bench<'_>,
        instance: &Instance<'_>,
        request: &v1::StepRequest,
        verdict: &mut Verdict,
    ) {
        let is_old = bench.protocol.is_none_or(|own| own.minor < CONTENT_COUNTS);
        match instance.calls.step(request) {
            Err(CallError::Failed(failure)) if failure.severity() == Severity::Misuse => {}
            Err(error) => {
                let text = format!("a repeated number with another content is no misuse: {error}");
                verdict.find(Grade::Warn, text);
            }
            Ok(_) if is_old => verdict.note(
                "a repeated number with another content is answered; since contract 1.3 it is refused",
            ),
            Ok(_) => verdict.find(
                Grade::Fail,
                "a repeated number with another content is answered and not refused",
            ),
        }
    }
}

/// Other signals, and another length where the model has no inputs: its requests of one length are all the same.
fn with_other_content(bench: &Bench<'_>, request: &v1::StepRequest) -> v1::StepRequest {
    let is_driven = !request.signals.is_empty();
    v1::StepRequest {
        signals: bench.unloaded().signals(request.step),
        step: request.step * if is_driven { 1.0 } else { 0.5 },
        ..request.clone()
    }
}

/// The same of Snapshot and Restore.
fn snapshots(instance: &mut Instance<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
    let request = v1::SnapshotRequest {
        instance: instance.number,
        sequence: instance.next_number(),
        replaces: None,
    };
    let kept = instance.calls.snapshot(&request)?.snapshot;
    if instance.calls.snapshot(&request)?.snapshot != kept {
        verdict.find(Grade::Fail, "a repeated Snapshot has another number");
    }
    let request = v1::RestoreRequest {
        instance: instance.number,
        sequence: instance.next_number(),
        snapshot: kept,
    };
    instance.calls.restore(&request)?;
    instance.calls.restore(&request)?;
    Ok(())
}
