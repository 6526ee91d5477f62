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
        let alone = each_alone(bench)?;
        let text = "two instances that take turns move otherwise than each alone";
        verdict.judge(taking_turns(bench, &alone)?, Grade::Fail, text);
        let text = "the end of one instance changes another one";
        verdict.judge(beside_an_end(bench)?, Grade::Fail, text);
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

/// Outputs after each step, of one instance and of the other.
type Ends = Vec<[Vec<f64>; 2]>;

/// Both instances one after the other.
fn each_alone(bench: &Bench<'_>) -> Result<Ends, Stop> {
    let mut ends = vec![[Vec::new(), Vec::new()]; STEPS];
    for kind in 0..2 {
        let mut instance = bench.in_motion()?;
        for (number, pair) in ends.iter_mut().enumerate() {
            pair[kind] = instance.step(bench.step(), &inputs(bench, kind, number))?;
        }
    }
    Ok(ends)
}

/// Both instances side by side.
fn taking_turns(bench: &Bench<'_>, alone: &Ends) -> Result<Comparison, Stop> {
    let mut pair = [bench.in_motion()?, bench.in_motion()?];
    let mut comparison = Comparison::default();
    for (number, ends) in alone.iter().enumerate() {
        for (kind, (instance, expected)) in pair.iter_mut().zip(ends).enumerate() {
            let found = instance.step(bench.step(), &inputs(bench, kind, number))?;
            comparison.same(&bench.subject.outputs, &found, expected);
        }
    }
    Ok(comparison)
}

/// One instance before and after another one ends.
fn beside_an_end(bench: &Bench<'_>) -> Result<Comparison, Stop> {
    let (other, mut instance) = (bench.in_motion()?, bench.in_motion()?);
    let kept = instance.keep()?;
    let expected = instance.step(bench.step(), &bench.loaded(0))?;
    drop(other);
    instance.go_back(&kept)?;
    let found = instance.step(bench.step(), &bench.loaded(0))?;
    let mut comparison = Comparison::default();
    comparison.same(&bench.subject.outputs, &found, &expected);
    Ok(comparison)
}

/// Inputs of a step, which tell the instances apart.
fn inputs(bench: &Bench<'_>, kind: usize, number: usize) -> Inputs {
    match kind {
        0 => bench.loaded(1),
        _ => bench.at_turn(number),
    }
}

fn on_one_stream(bench: &Bench<'_>, alone: &Ends) -> Result<Comparison, Stop> {
    let mut pair = [bench.in_motion()?, bench.in_motion()?];
    let mut stream = bench.connect()?;
    let mut comparison = Comparison::default();
    for (number, ends) in alone.iter().enumerate() {
        for (kind, (instance, expected)) in pair.iter_mut().zip(ends).enumerate() {
            let reply = turn(&mut *stream, &advance(bench, instance, kind, number))?;
            compare(bench, instance, reply, expected, &mut comparison)?;
        }
    }
    Ok(comparison)
}

fn on_two_streams(bench: &Bench<'_>, alone: &Ends) -> Result<Comparison, Stop> {
    let mut pair = [bench.in_motion()?, bench.in_motion()?];
    let mut streams = [bench.connect()?, bench.connect()?];
    let mut comparison = Comparison::default();
    for (number, ends) in alone.iter().enumerate() {
        for (kind, (instance, stream)) in pair.iter_mut().zip(&mut streams).enumerate() {
            stream.post(&advance(bench, instance, kind, number))?;
        }
        for ((instance, stream), expected) in pair.iter().zip(&mut streams).zip(ends) {
            let mut reply = ExchangeReply::default();
            stream.collect(&mut reply)?;
            compare(bench, instance, reply, expected, &mut comparison)?;
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
        sequence: instance.next_number(),
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
