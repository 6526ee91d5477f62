//! Something moves, and inputs move something.

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::instance::{Instance, Kept};
use crate::conformance::measured::LONGER;
use crate::conformance::subject::Marker;
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// Outputs change in time, and under inputs.
pub struct Response;

impl Check for Response {
    fn about(&self) -> About {
        About {
            name: "response",
            title: "outputs change in time and under inputs",
            equation: "y(t) is not constant, and not the same for all u",
            tolerance: "any change counts",
            look_at: "whether Step integrates, reads its signals, and answers with the outputs of the new state",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let subject = &bench.subject;
        if subject.outputs.is_empty() {
            return Err(Stop::not_applicable("the model has no outputs"));
        }
        let begun = bench.at_start()?.step(bench.step(), &bench.prelude(0))?;
        let mut instance = bench.in_motion()?;
        let start = instance.keep()?;
        let moved = instance.step(bench.step(), &bench.loaded(0))?;
        if moved == begun && is_held(bench, &moved) {
            verdict.note("nothing moves, and markers tell no velocities: held by the ground?");
            return Ok(());
        }
        if moved == begun {
            verdict.find(Grade::Fail, "no output has changed over the whole prelude");
        }
        let mut idle = Vec::new();
        for (input, name) in subject.inputs.iter().enumerate() {
            if !moves_something(bench, &mut instance, &start, input)? {
                idle.push(name.as_str());
            }
        }
        if !idle.is_empty() && idle.len() == subject.inputs.len() {
            verdict.find(Grade::Fail, "no input changes any output");
        } else if !idle.is_empty() {
            verdict.note(format!(
                "inputs that change no output here: {}",
                idle.join(", ")
            ));
        }
        Ok(())
    }
}

/// Whether markers are somewhere and at rest, as those of a ground are.
fn is_held(bench: &Bench<'_>, values: &[f64]) -> bool {
    let markers = &bench.subject.markers;
    let mut rates = markers
        .iter()
        .flat_map(|own| own.velocity.iter().chain(&own.acceleration));
    let is_somewhere = |own: &Marker| own.position.iter().any(|&place| values[place] != 0.0);
    markers.iter().any(is_somewhere) && rates.all(|&place| values[place] == 0.0)
}

/// Whether a step ends otherwise, now or some steps later, if an input is changed.
fn moves_something(
    bench: &Bench<'_>,
    instance: &mut Instance<'_>,
    start: &Kept,
    input: usize,
) -> Result<bool, Stop> {
    for step in [bench.step(), LONGER * bench.step()] {
        let mut ends = Vec::new();
        for inputs in [
            bench.unloaded(),
            bench.unloaded().plus(input, bench.sizes[input], 0),
        ] {
            instance.go_back(start)?;
            match instance.step(step, &inputs) {
                Ok(end) => ends.push(end),
                // A long step may be more than the model takes.
                Err(stop) if step == bench.step() => return Err(stop),
                Err(_) => return Ok(false),
            }
        }
        if ends[0] != ends[1] {
            return Ok(true);
        }
    }
    Ok(false)
}
