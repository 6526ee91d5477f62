//! Perturbed steps are steps of their own, and change nothing.

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::instance::Inside;
use crate::conformance::measured::allowed;
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// PerturbedStep answers the ends of separate steps.
pub struct PerturbedSteps;

/// Share of the response by which both may differ besides the solver's tolerance: a solver that repeats the internal steps of the
/// step before has other ones than a step of its own.
const SHARE: f64 = 1e-3;

/// Instant inside a step, as a share of it.
const INSTANT: f64 = 0.4;

impl Check for PerturbedSteps {
    fn about(&self) -> About {
        About {
            name: "perturbed-steps",
            title: "PerturbedStep answers separate steps with one input changed, and changes nothing",
            equation: "PerturbedStep(u, u_j) = Step(u with u_j in the place of input j)",
            tolerance: "1e-3 of the response to the change, and 4 times the solver's tolerance; states: the same bits",
            look_at: "whether every perturbed step starts from the present state, replaces one signal only, and whether the state is put back \
                      behind the last one",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let subject = &bench.subject;
        let (count, step) = (subject.inputs.len(), bench.step());
        if count == 0 {
            return Err(Stop::not_applicable("the model has no inputs"));
        }
        let instants = [INSTANT * step];
        let inside = Inside {
            instants: if subject.capabilities.interior_outputs {
                &instants
            } else {
                &[]
            },
            integrals: if subject.capabilities.output_integrals {
                2
            } else {
                0
            },
        };
        let highest = subject.highest_degree();
        let inputs = bench.loaded(highest);
        let mut instance = bench.in_motion()?;
        let start = instance.keep()?;
        let before = instance.evaluate(&inputs.values(0.0))?;
        let base = instance.step_inside(step, &inputs, inside)?;

        for power in [0, highest] {
            let changed = |input: usize| inputs.clone().plus(input, bench.sizes[input], power);
            instance.go_back(&start)?;
            let signals = (0..count).map(|input| changed(input).signal(input, [0.0, 1.0], step));
            let rows = instance.perturbed(step, &inputs, signals.collect(), inside)?;
            let after = instance.evaluate(&inputs.values(0.0))?;
            let end = instance.step_inside(step, &inputs, inside)?;
            let mut comparison = Comparison::default();
            comparison.same(&subject.outputs, &after, &before);
            comparison.same(&subject.outputs, &end, &base);
            let text = "PerturbedStep changes what is told, or stepped, afterwards";
            verdict.judge(comparison, Grade::Fail, text);

            let mut comparison = Comparison::default();
            for (input, row) in rows.iter().enumerate() {
                instance.go_back(&start)?;
                let own = instance.step_inside(step, &changed(input), inside)?;
                let response: Vec<f64> = own.iter().zip(&base).map(|(a, b)| a - b).collect();
                let lists = response.chunks(subject.outputs.len());
                let sizes = lists.flat_map(|list| subject.sizes_of_groups(list));
                for (place, size) in sizes.enumerate() {
                    let output = place % subject.outputs.len();
                    let floor = bench.floor(output, &[own[place], base[place]]);
                    // Where nothing answers the change, the perturbed step must not either.
                    let allowed = allowed(SHARE, size, floor).unwrap_or(SHARE * size + floor);
                    let name = &subject.outputs[output];
                    let name =
                        format!("{name} with {} changed by s^{power}", subject.inputs[input]);
                    comparison.near(name, row[place], own[place], allowed);
                }
            }
            verdict.judge(
                comparison,
                Grade::Fail,
                "perturbed steps are not steps of their own",
            );
        }
        Ok(())
    }
}
