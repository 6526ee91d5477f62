//! States that leave their instance, and their process.

use linchpin_proto::contract::Contract;
use linchpin_proto::v1::{self, ExportedState};

use super::replay::march;
use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::instance::Instance;
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// An exported state goes on elsewhere as it does here.
pub struct ExportedStates;

impl Check for ExportedStates {
    fn about(&self) -> About {
        About {
            name: "exported-states",
            title: "an exported state goes on with the same bits in another instance and another process",
            equation: "ExportState(A), ImportState(B), Evaluate, Step.. of B = Evaluate, Step.. of A",
            tolerance: "the same bits",
            look_at: "what decides about a step and is not in the bytes: variables of the program, open files, handles and caches of a \
                      library; and whether ImportState refuses bytes that do not fit their checksum",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        if !bench.subject.capabilities.exportable_snapshot {
            let reason = "the states of the model stay in their process: its capabilities do not say exportable_snapshot";
            return Err(Stop::not_applicable(reason));
        }
        let mut instance = bench.in_motion()?;
        let kept = instance.keep()?;
        let expected = onward(bench, &mut instance)?;
        instance.go_back(&kept)?;
        let state = instance.export()?;
        let text = "steps after ExportState are not those without it";
        verdict.judge(
            compare(bench, &onward(bench, &mut instance)?, &expected),
            Grade::Fail,
            text,
        );
        let exported = Exported {
            state: &state,
            t: kept.t,
            expected: &expected,
        };
        let text = "an instance at its start goes on otherwise from an imported state";
        exported.goes_on(bench, bench.at_start()?, text, verdict)?;
        let mut elsewhere = bench.in_motion()?;
        // Whatever the solver remembers is that of other steps.
        march(bench, &mut elsewhere, 3)?;
        let text = "an instance that has moved goes on otherwise from an imported state";
        exported.goes_on(bench, elsewhere, text, verdict)?;
        refuse_wrong_states(&mut instance, &state, verdict);
        in_another_process(bench, &exported, verdict)
    }
}

/// A state that has left, its time, and what comes after it.
struct Exported<'a> {
    state: &'a ExportedState,
    t: f64,
    expected: &'a [Vec<f64>],
}

impl Exported<'_> {
    /// Lets an instance go on from the state.
    fn goes_on(
        &self,
        bench: &Bench<'_>,
        mut instance: Instance<'_>,
        text: &str,
        verdict: &mut Verdict,
    ) -> Result<(), Stop> {
        instance.import(self.state, self.t)?;
        let found = onward(bench, &mut instance)?;
        verdict.judge(compare(bench, &found, self.expected), Grade::Fail, text);
        Ok(())
    }
}

/// Outputs of the present state, then after each of several steps.
fn onward(bench: &Bench<'_>, instance: &mut Instance<'_>) -> Result<Vec<Vec<f64>>, Stop> {
    let mut told = vec![instance.evaluate(&bench.subject.defaults)?];
    told.extend(march(bench, instance, 1)?);
    Ok(told)
}

fn compare(bench: &Bench<'_>, found: &[Vec<f64>], expected: &[Vec<f64>]) -> Comparison {
    let mut comparison = Comparison::default();
    for (found, expected) in found.iter().zip(expected) {
        comparison.same(&bench.subject.outputs, found, expected);
    }
    comparison
}

/// Bytes that were changed on the way, and the state of another model.
fn refuse_wrong_states(instance: &mut Instance<'_>, state: &ExportedState, verdict: &mut Verdict) {
    let mut damaged = state.clone();
    match damaged.state.last_mut() {
        Some(byte) => *byte ^= 1,
        None => damaged.state.push(0),
    }
    let other = ExportedState {
        model: format!("{}?", state.model),
        ..state.clone()
    };
    for (what, wrong) in [
        ("a state whose bytes do not fit their checksum", damaged),
        ("a state of another model", other),
    ] {
        let request = v1::ImportStateRequest {
            instance: instance.number,
            sequence: instance.next_number(),
            state: Some(wrong),
        };
        if instance.calls.import_state(&request).is_ok() {
            verdict.find(Grade::Fail, format!("{what} is imported and not refused"));
        }
    }
}

/// The same where the kit can start the worker once more.
fn in_another_process(
    bench: &Bench<'_>,
    exported: &Exported<'_>,
    verdict: &mut Verdict,
) -> Result<(), Stop> {
    let Some(another) = bench.another_process()? else {
        verdict.note("not in another process: the worker was not started by its command");
        return Ok(());
    };
    let connection = another.connect()?;
    let calls: &dyn Contract = connection.contract();
    let (instance, _) = Instance::initialize(calls, &bench.subject, &bench.request())?;
    let text = "another process goes on otherwise from an imported state";
    exported.goes_on(bench, instance, text, verdict)
}
