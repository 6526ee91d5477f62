//! Lists of outputs are answered in the order that was asked for.

use linchpin_proto::v1;

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// Coupling outputs, then recorded ones, each in the order of Initialize.
pub struct OutputLists;

impl Check for OutputLists {
    fn about(&self) -> About {
        About {
            name: "outputs",
            title: "outputs come in the order that Initialize asked for",
            equation: "OUTPUT_SET_ALL = coupling_outputs, then recorded_outputs",
            tolerance: "the same bits",
            look_at: "the lists coupling_outputs and recorded_outputs of Initialize, and StepRequest.outputs",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let names = &bench.subject.outputs;
        let inputs = bench.loaded(0);
        let expected = bench.at_start()?.step(bench.step(), &inputs)?;

        let (recorded, coupling) = names.split_at(names.len() / 2);
        let backwards = |names: &[String]| names.iter().rev().cloned().collect::<Vec<_>>();
        let request = v1::InitializeRequest {
            coupling_outputs: backwards(coupling),
            recorded_outputs: backwards(recorded),
            interior_outputs: Vec::new(),
            integrated_outputs: Vec::new(),
            ..bench.request()
        };
        let (mut instance, _) = bench.initialize(&request)?;
        let request = v1::StepRequest {
            outputs: v1::OutputSet::All.into(),
            ..instance.step_request(
                bench.step(),
                inputs.signals(bench.step()),
                Default::default(),
            )
        };
        let found = instance.take(&request)?;
        let names = backwards(names);
        let expected: Vec<f64> = expected.into_iter().rev().collect();
        let mut comparison = Comparison::default();
        comparison.same(&names, &found, &expected);
        verdict.judge(
            comparison,
            Grade::Fail,
            "the lists coupling_outputs and recorded_outputs, both backwards, are answered otherwise",
        );
        Ok(())
    }
}
