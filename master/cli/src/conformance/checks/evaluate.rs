//! An evaluation is a step of length zero.

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// Share of the size of an output by which Evaluate may differ from the Step before: both compute it from the same state.
const SHARE: f64 = 1e-9;

/// Evaluate tells what Step told, and changes nothing.
pub struct Evaluate;

impl Check for Evaluate {
    fn about(&self) -> About {
        About {
            name: "evaluate",
            title: "Evaluate agrees with the end of Step and changes nothing",
            equation: "Evaluate(T + H, u(T + H)) = outputs of Step from T to T + H",
            tolerance: "1e-9 of the size of an output, which both compute from one state; states: the same bits",
            look_at: "whether outputs are computed at the end of the step and under the input values there, and whether Evaluate writes to \
                      the state",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let names = &bench.subject.outputs;
        let inputs = bench.loaded(3);
        let mut instance = bench.in_motion()?;
        let stepped = instance.step(bench.step(), &inputs)?;
        let end = instance.keep()?;
        let evaluated = instance.evaluate(&inputs.values(1.0))?;
        let sizes = bench.subject.sizes_of_groups(&stepped);
        let mut comparison = Comparison::default();
        for (output, name) in names.iter().enumerate() {
            let allowed = SHARE * sizes[output] + bench.rounding(output, &[sizes[output]]);
            comparison.near(name, evaluated[output], stepped[output], allowed);
        }
        verdict.judge(
            comparison,
            bench.grade_of_motion(),
            "Evaluate tells another state than the Step before it",
        );

        let next = bench.loaded(1);
        instance.go_back(&end)?;
        let expected = instance.step(bench.step(), &next)?;
        instance.go_back(&end)?;
        instance.evaluate(&next.values(0.5))?;
        let again = instance.evaluate(&inputs.values(1.0))?;
        let found = instance.step(bench.step(), &next)?;
        let mut comparison = Comparison::default();
        comparison.same(names, &again, &evaluated);
        comparison.same(names, &found, &expected);
        verdict.judge(
            comparison,
            Grade::Fail,
            "an Evaluate under other inputs changes what is told afterwards",
        );
        Ok(())
    }
}
