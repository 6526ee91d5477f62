//! Instances do not influence one another.

use linchpin_proto::v1::{Advance, ExchangeReply, ExchangeRequest};

use super::exchange::turn;
use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::inputs::Inputs;
use crate::conformance::instance::Instance;
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// Instances side by side, on one connection, one stream and several.
pub struct Parallel;

/// Steps of every instance.
const STEPS: usize = 3;

impl Check for Parallel {
    fn about(&self) -> About {
        About {
            name: "parallel",
            title: "instances side by side move as they do alone",
            equation: "Step(A), Step(B), Step(A).. = Step(A), Step(A).. of an instance of its own",
            tolerance: "the same bits",
            look_at: "variables that several instances share (globals, caches, one solver object), and whether a stream serves one instance only",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let names = &bench.subject.outputs;
        let mut alone = Vec::new();
        for kind in 0..2 {
            let mut instance = bench.in_motion()?;
            let steps =
                (0..STEPS).map(|number| instance.step(bench.step(), &inputs(bench, kind, number)));
            alone.push(steps.collect::<Result<Vec<_>, _>>()?);
        }

        let mut pair = [bench.in_motion()?, bench.in_motion()?];
        let mut comparison = Comparison::default();
        for number in 0..STEPS {
            for (kind, instance) in pair.iter_mut().enumerate() {
                let found = instance.step(bench.step(), &inputs(bench, kind, number))?;
                comparison.same(names, &found, &alone[kind][number]);
            }
        }
        let text = "two instances that take turns move otherwise than each alone";
        verdict.judge(comparison, Grade::Fail, text);
        let [first, mut second] = pair;
        let kept = second.keep()?;
        let expected = second.step(bench.step(), &bench.loaded(0))?;
        drop(first);
        second.go_back(&kept)?;
        let mut comparison = Comparison::default();
        comparison.same(
            names,
            &second.step(bench.step(), &bench.loaded(0))?,
            &expected,
        );
        verdict.judge(
            comparison,
            Grade::Fail,
            "the end of one instance changes another one",
        );

        if !bench.subject.capabilities.exchange {
            verdict.note("without streams: the model serves no exchange");
            return Ok(());
        }
        let text = "two instances on one exchange stream move otherwise than each alone";
        verdict.judge(on_one_stream(bench, &alone)?, Grade::Fail, text);
        let text = "two instances on streams of their own, asked at the same time, move otherwise than each alone";
        verdict.judge(on_two_streams(bench, &alone)?, Grade::Fail, text);
        Ok(())
    }
}

/// Inputs of a step, which tell the instances apart.
fn inputs(bench: &Bench<'_>, kind: usize, number: usize) -> Inputs {
    match kind {
        0 => bench.loaded(1),
        _ => bench.at_turn(number),
    }
}

fn on_one_stream(bench: &Bench<'_>, alone: &[Vec<Vec<f64>>]) -> Result<Comparison, Stop> {
    let mut pair = [bench.in_motion()?, bench.in_motion()?];
    let mut stream = bench.connect()?;
    let mut comparison = Comparison::default();
    for number in 0..STEPS {
        for (kind, instance) in pair.iter_mut().enumerate() {
            let reply = turn(&mut *stream, &advance(bench, instance, kind, number))?;
            compare(
                bench,
                instance,
                reply,
                &alone[kind][number],
                &mut comparison,
            )?;
        }
    }
    Ok(comparison)
}

fn on_two_streams(bench: &Bench<'_>, alone: &[Vec<Vec<f64>>]) -> Result<Comparison, Stop> {
    let mut pair = [bench.in_motion()?, bench.in_motion()?];
    let mut streams = [bench.connect()?, bench.connect()?];
    let mut comparison = Comparison::default();
    for number in 0..STEPS {
        for (kind, (instance, stream)) in pair.iter_mut().zip(&mut streams).enumerate() {
            stream.post(&advance(bench, instance, kind, number))?;
        }
        for (kind, (instance, stream)) in pair.iter().zip(&mut streams).enumerate() {
            let mut reply = ExchangeReply::default();
            stream.collect(&mut reply)?;
            compare(
                bench,
                instance,
                reply,
                &alone[kind][number],
                &mut comparison,
            )?;
        }
    }
    Ok(comparison)
}

fn advance(
    bench: &Bench<'_>,
    instance: &mut Instance<'_>,
    kind: usize,
    number: usize,
) -> ExchangeRequest {
    let step = bench.step();
    let t = instance.t;
    instance.t += step;
    ExchangeRequest {
        instance: instance.number,
        sequence: instance.next(),
        advance: Some(Advance {
            t,
            step,
            signals: inputs(bench, kind, number).signals(step),
            ..Advance::default()
        }),
        ..ExchangeRequest::default()
    }
}

fn compare(
    bench: &Bench<'_>,
    instance: &Instance<'_>,
    reply: ExchangeReply,
    expected: &[f64],
    comparison: &mut Comparison,
) -> Result<(), Stop> {
    let found = instance.checked("Exchange", reply.advanced, 1)?;
    comparison.same(&bench.subject.outputs, &found, expected);
    Ok(())
}
