//! The fused exchange is made of the unary calls.

use linchpin_master::connection::Connection;
use linchpin_proto::v1::{self, Advance, ExchangeReply, ExchangeRequest, Predict};
use linchpin_proto::version::knows_whole_exchange;

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::inputs::Inputs;
use crate::conformance::instance::Instance;
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// Advance, evaluation, look-ahead, samples and the way back of an exchange.
pub struct Exchange;

/// Where a sample of the advance is, as a share of the step.
const SAMPLE: f64 = 0.4;

impl Check for Exchange {
    fn about(&self) -> About {
        About {
            name: "exchange",
            title: "an Exchange equals Step, Evaluate, Step and PerturbedStep, and can be taken back",
            equation: "advance = Step; evaluate = Evaluate; predict = Step and Restore; perturbed = PerturbedStep; go_back = Restore",
            tolerance: "the same bits; samples and evaluations 4 times the solver's tolerance and rounding",
            look_at: "whether look-aheads leave the committed state alone, the order of the parts, and that unary calls and exchanges share one \
                      state",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        if !bench.subject.capabilities.exchange {
            return Err(Stop::not_applicable("the model serves no exchange"));
        }
        let is_whole = knows_whole_exchange(bench.protocol.as_ref());
        if !is_whole {
            verdict.note("contract 1.0: without go_back, evaluate and samples; a master uses unary calls instead");
        }
        let expected = Expected::by_unary_calls(bench)?;
        let mut stream = bench.connect()?;
        let mut instance = bench.in_motion()?;
        let request = request(bench, &mut instance, is_whole);
        let reply = turn(&mut *stream, &request)?;
        compare(bench, &instance, &reply, &expected, verdict)?;
        let repeated = turn(&mut *stream, &request)?;
        let mut comparison = Comparison::default();
        same(
            bench,
            &mut comparison,
            &instance,
            (repeated.advanced, &expected.advanced),
        )?;
        same(
            bench,
            &mut comparison,
            &instance,
            (repeated.predicted, &expected.predicted),
        )?;
        verdict.judge(
            comparison,
            Grade::Fail,
            "a repeated exchange is answered otherwise",
        );

        if is_whole {
            let again = ExchangeRequest {
                sequence: instance.next_number(),
                go_back: true,
                ..request.clone()
            };
            let reply = turn(&mut *stream, &again)?;
            let mut comparison = Comparison::default();
            same(
                bench,
                &mut comparison,
                &instance,
                (reply.advanced, &expected.advanced),
            )?;
            same(
                bench,
                &mut comparison,
                &instance,
                (reply.predicted, &expected.predicted),
            )?;
            let text = "an advance that was taken back and repeated ends otherwise";
            verdict.judge(comparison, Grade::Fail, text);
        }
        // The committed state is the end of the advance, for unary calls as well.
        instance.t += bench.step();
        let mut comparison = Comparison::default();
        let found = instance.step(bench.step(), &second(bench))?;
        comparison.same(&bench.subject.outputs, &found, &expected.predicted);
        let text = "a Step behind exchanges does not start from the end of the advance";
        verdict.judge(comparison, Grade::Fail, text);
        Ok(())
    }
}

/// Inputs of the advance.
fn first(bench: &Bench<'_>) -> Inputs {
    bench.loaded(2)
}

/// Inputs of the look-ahead.
fn second(bench: &Bench<'_>) -> Inputs {
    bench.loaded(1)
}

/// Those with each input changed.
fn changed(bench: &Bench<'_>) -> Vec<v1::Signal> {
    let changed = |input: usize| second(bench).plus(input, bench.sizes[input], 0);
    (0..bench.sizes.len())
        .map(|input| changed(input).signal(input, [0.0, 1.0], bench.step()))
        .collect()
}

/// What the parts of the exchange must answer.
struct Expected {
    advanced: Vec<f64>,
    sample: Vec<f64>,
    evaluated: Vec<f64>,
    predicted: Vec<f64>,
    perturbed: Vec<Vec<f64>>,
}

impl Expected {
    fn by_unary_calls(bench: &Bench<'_>) -> Result<Self, Stop> {
        let step = bench.step();
        let mut instance = bench.in_motion()?;
        let start = instance.keep()?;
        let sample = instance.step_part([0.0, SAMPLE], step, &first(bench))?;
        instance.go_back(&start)?;
        let advanced = instance.step(step, &first(bench))?;
        let end = instance.keep()?;
        let evaluated = instance.evaluate(&bench.subject.defaults)?;
        let predicted = instance.step(step, &second(bench))?;
        instance.go_back(&end)?;
        let perturbed =
            instance.perturbed(step, &second(bench), changed(bench), Default::default())?;
        Ok(Self {
            advanced,
            sample,
            evaluated,
            predicted,
            perturbed,
        })
    }
}

fn request(bench: &Bench<'_>, instance: &mut Instance<'_>, is_whole: bool) -> ExchangeRequest {
    let step = bench.step();
    let (t, end) = (instance.t, instance.t + step);
    let evaluate = Predict {
        t: end,
        step: 0.0,
        signals: bench.unloaded().signals(0.0),
        ..Predict::default()
    };
    ExchangeRequest {
        instance: instance.number,
        sequence: instance.next_number(),
        advance: Some(Advance {
            t,
            step,
            signals: first(bench).signals(step),
            samples: if is_whole {
                vec![SAMPLE * step]
            } else {
                Vec::new()
            },
            ..Advance::default()
        }),
        evaluate: is_whole.then_some(evaluate),
        predict: Some(Predict {
            t: end,
            step,
            signals: second(bench).signals(step),
            perturbed: changed(bench),
            ..Predict::default()
        }),
        go_back: false,
    }
}

/// One turn of a stream.
pub fn turn(stream: &mut dyn Connection, request: &ExchangeRequest) -> Result<ExchangeReply, Stop> {
    let mut reply = ExchangeReply::default();
    stream.post(request)?;
    stream.collect(&mut reply)?;
    Ok(reply)
}

fn compare(
    bench: &Bench<'_>,
    instance: &Instance<'_>,
    reply: &ExchangeReply,
    expected: &Expected,
    verdict: &mut Verdict,
) -> Result<(), Stop> {
    let mut comparison = Comparison::default();
    same(
        bench,
        &mut comparison,
        instance,
        (reply.advanced.clone(), &expected.advanced),
    )?;
    verdict.judge(
        comparison,
        Grade::Fail,
        "the advance ends otherwise than Step",
    );
    let mut comparison = Comparison::default();
    same(
        bench,
        &mut comparison,
        instance,
        (reply.predicted.clone(), &expected.predicted),
    )?;
    verdict.judge(
        comparison,
        Grade::Fail,
        "the look-ahead ends otherwise than a Step from the end of the advance",
    );
    if reply.perturbed.len() != expected.perturbed.len() {
        let text = format!(
            "{} perturbed look-aheads where {} were asked for",
            reply.perturbed.len(),
            expected.perturbed.len()
        );
        verdict.find(Grade::Fail, text);
    }
    let mut comparison = Comparison::default();
    for (found, expected) in reply.perturbed.iter().zip(&expected.perturbed) {
        same(
            bench,
            &mut comparison,
            instance,
            (Some(found.clone()), expected),
        )?;
    }
    verdict.judge(
        comparison,
        Grade::Fail,
        "perturbed look-aheads end otherwise than PerturbedStep",
    );

    let mut comparison = Comparison::default();
    let samples = reply
        .samples
        .first()
        .map(|sample| (sample, &expected.sample));
    let evaluated = reply
        .evaluated
        .as_ref()
        .map(|own| (own, &expected.evaluated));
    for (found, expected) in samples.into_iter().chain(evaluated) {
        let found = instance.checked("Exchange", Some(found.clone()), 1)?;
        let sizes = bench.subject.sizes_of_groups(expected);
        for (place, name) in bench.subject.outputs.iter().enumerate() {
            let allowed = bench.floor(place, &[sizes[place]]);
            comparison.near(name, found[place], expected[place], allowed);
        }
    }
    verdict.judge(
        comparison,
        bench.grade_of_motion(),
        "samples or evaluations are those of other states",
    );
    Ok(())
}

/// Compares a part of the reply, bit by bit.
fn same(
    bench: &Bench<'_>,
    comparison: &mut Comparison,
    instance: &Instance<'_>,
    (found, expected): (Option<v1::Outputs>, &[f64]),
) -> Result<(), Stop> {
    let found = instance.checked("Exchange", found, 1)?;
    comparison.same(&bench.subject.outputs, &found, expected);
    Ok(())
}
