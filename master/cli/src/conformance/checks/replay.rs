//! Back to a state, bit by bit.

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::instance::{Instance, Kept};
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// A restored state goes on as the kept one did.
pub struct Replay;

/// Shares of the macro step: steps of several lengths move whatever a solver remembers.
const LENGTHS: [f64; 4] = [1.0, 0.5, 1.0, 0.25];

impl Check for Replay {
    fn about(&self) -> About {
        About {
            name: "replay",
            title: "a restored state repeats its steps with the same bits",
            equation: "Snapshot, Step.., Restore, Step.. gives the outputs of the first steps again",
            tolerance: "the same bits",
            look_at: "whether a snapshot has the whole state: step sizes, warm starts, earlier values of multistep methods, random numbers, \
                      caches",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let names = &bench.subject.outputs;
        let mut instance = bench.in_motion()?;
        let first = instance.keep()?;
        let at_first = instance.evaluate(&bench.subject.defaults)?;
        let from_first = march(bench, &mut instance, 1)?;
        let second = instance.keep()?;
        let from_second = march(bench, &mut instance, 2)?;

        let mut compare = |text: &str, found: &[Vec<f64>], expected: &[Vec<f64>]| {
            let mut comparison = Comparison::default();
            for (found, expected) in found.iter().zip(expected) {
                comparison.same(names, found, expected);
            }
            verdict.judge(comparison, Grade::Fail, text);
        };
        instance.go_back(&first)?;
        let again = instance.evaluate(&bench.subject.defaults)?;
        compare(
            "the outputs right after Restore are not those of the Snapshot",
            &[again],
            &[at_first],
        );
        let again = march(bench, &mut instance, 1)?;
        compare(
            "steps after a Restore are not those after the Snapshot",
            &again,
            &from_first,
        );
        // Whatever the solver remembers is that of other steps now.
        march(bench, &mut instance, 3)?;
        let again = from(bench, &mut instance, &second, 2)?;
        compare(
            "a later snapshot is lost or changed by a Restore of an earlier one",
            &again,
            &from_second,
        );
        let again = from(bench, &mut instance, &first, 1)?;
        compare(
            "a second Restore of the same snapshot goes on otherwise",
            &again,
            &from_first,
        );

        instance.go_back(&second)?;
        let third = instance.keep_instead(Some(second))?;
        march(bench, &mut instance, 3)?;
        let again = from(bench, &mut instance, &third, 2)?;
        compare(
            "a snapshot that replaces another one is not the present state",
            &again,
            &from_second,
        );
        let again = from(bench, &mut instance, &first, 1)?;
        compare(
            "a snapshot is lost or changed when another one is replaced",
            &again,
            &from_first,
        );
        Ok(())
    }
}

fn from(
    bench: &Bench<'_>,
    instance: &mut Instance<'_>,
    kept: &Kept,
    number: usize,
) -> Result<Vec<Vec<f64>>, Stop> {
    instance.go_back(kept)?;
    march(bench, instance, number)
}

/// Outputs after each of several steps of unequal lengths; `number` tells their inputs from others.
pub(super) fn march(
    bench: &Bench<'_>,
    instance: &mut Instance<'_>,
    number: usize,
) -> Result<Vec<Vec<f64>>, Stop> {
    let one = |(place, share): (usize, f64)| {
        let inputs = match place {
            0 => bench.loaded(number),
            later => bench.at_turn(number * LENGTHS.len() + later),
        };
        instance.step(share * bench.step(), &inputs)
    };
    LENGTHS.into_iter().enumerate().map(one).collect()
}
