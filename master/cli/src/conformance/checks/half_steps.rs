//! A step equals its two halves.

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::measured::{COARSE_SHARE, HALVES_SHARE, halves, resolves_longer};
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// A step under polynomials equals two half steps under the same ones.
pub struct HalfSteps;

impl Check for HalfSteps {
    fn about(&self) -> About {
        About {
            name: "half-steps",
            title: "a step under inputs of degree 1 to 3 equals its two halves",
            equation: "Step(H, u(t)) = Step(H/2, u(t)), then Step(H/2, u(H/2 + t))",
            tolerance: "0.02 of the response to the inputs, and 4 times the solver's tolerance; a warning up to 0.15, and where the difference falls \
                        over a step 16 times as long",
            look_at: "whether inputs are evaluated at every internal step, at the time since the start of the macro step; the solver's \
                      internal step against H",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let highest = bench.subject.highest_degree();
        if highest == 0 || bench.subject.inputs.is_empty() {
            return Err(Stop::not_applicable(
                "the model has no inputs that are not constant over a step",
            ));
        }
        for &step in bench.steps() {
            let mut instance = bench.in_motion()?;
            let start = instance.keep()?;
            for degree in 1..=highest {
                let inputs = bench.loaded(degree);
                let comparison = halves(bench, (&mut instance, &start), step, &inputs)?;
                let place = format!("over {step} s under inputs of degree {degree}");
                if comparison.compared == 0 {
                    verdict.note(format!(
                        "{place} the response is below the solver's tolerance"
                    ));
                }
                let is_coarse = comparison.ratio() * HALVES_SHARE <= COARSE_SHARE;
                if comparison.holds() {
                    verdict.judge(comparison, Grade::Pass, place);
                } else if is_coarse
                    || resolves_longer(bench, (&mut instance, &start), step, &inputs, &comparison)
                {
                    let text = format!(
                        "differs {place}: few internal steps of a solver of low order fall into the macro step"
                    );
                    verdict.judge(comparison, Grade::Warn, text);
                } else {
                    verdict.judge(
                        comparison,
                        bench.grade_of_motion(),
                        format!("differs {place}"),
                    );
                }
            }
        }
        Ok(())
    }
}
