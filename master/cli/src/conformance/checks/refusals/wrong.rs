//! The wrong requests.

use linchpin_proto::contract::CallError;
use linchpin_proto::polynomial::MAX_NODES;
use linchpin_proto::v1::value::Kind;
use linchpin_proto::v1::{self, Signal};

use crate::conformance::bench::Bench;
use crate::conformance::instance::{Inside, Instance};

/// A name that no model has.
const UNKNOWN: &str = "no-such-name";

/// Requests that make no instance.
pub fn wrong_instances(bench: &Bench<'_>) -> Vec<(&'static str, v1::InitializeRequest)> {
    let base = || bench.request();
    let unknown = || UNKNOWN.to_owned();
    let mut with_parameter = base();
    let value = v1::Value {
        kind: Some(Kind::Number(1.0)),
    };
    with_parameter.parameters.insert(unknown(), value);
    let mut with_input = base();
    with_input.inputs.push(unknown());
    let mut with_output = base();
    with_output.coupling_outputs.push(unknown());
    vec![
        (
            "Initialize with an unknown model",
            v1::InitializeRequest {
                model: unknown(),
                ..base()
            },
        ),
        ("Initialize with an unknown parameter", with_parameter),
        ("Initialize with an unknown input", with_input),
        ("Initialize with an unknown output", with_output),
    ]
}

/// A request for an instance that begins at no time.
pub fn at_no_time(bench: &Bench<'_>) -> v1::InitializeRequest {
    v1::InitializeRequest {
        t_start: f64::NAN,
        ..bench.request()
    }
}

type Call<'b> = Box<dyn Fn(&mut Instance<'_>) -> Result<(), CallError> + 'b>;

/// Requests to an instance that must be refused.
pub fn wrong_requests<'b>(bench: &'b Bench<'_>) -> Vec<(&'static str, Call<'b>)> {
    let mut calls: Vec<(&'static str, Call<'b>)> = Vec::new();
    for (what, length) in [
        ("a Step of length 0", 0.0),
        ("a Step of negative length", -bench.step()),
        ("a Step of length NaN", f64::NAN),
    ] {
        calls.push((what, stepping(move |request| request.step = length, bench)));
    }
    calls.push((
        "a Step with a signal for an input that is not there",
        stepping(
            |request| {
                let input = u32::MAX;
                request.signals.push(Signal {
                    input,
                    nodes: vec![0.0],
                    values: vec![0.0],
                });
            },
            bench,
        ),
    ));
    calls.push((
        "a Restore of a snapshot that is not there",
        Box::new(|instance| {
            let request = v1::RestoreRequest {
                instance: instance.number,
                sequence: instance.next_number(),
                snapshot: u64::MAX,
            };
            instance.calls.restore(&request).map(|_| ())
        }),
    ));
    calls.push((
        "an Evaluate of an unknown output",
        Box::new(evaluate_unknown),
    ));
    calls.push((
        "a Step of an instance that is not there",
        Box::new(move |instance| {
            let mut request = instance.step_request(
                bench.step(),
                bench.unloaded().signals(bench.step()),
                Inside::default(),
            );
            // Not carried out, so the number counts for the next call.
            instance.sequence -= 1;
            request.instance = !request.instance;
            instance.calls.step(&request).map(|_| ())
        }),
    ));
    if !bench.sizes.is_empty() {
        calls.extend(wrong_signals(bench));
    }
    calls
}

fn wrong_signals<'b>(bench: &'b Bench<'_>) -> Vec<(&'static str, Call<'b>)> {
    let step = bench.step();
    let most = bench.subject.capabilities.max_input_degree;
    let nodes = most.map_or(MAX_NODES, |most| most as usize + 1) + 1;
    let too_many: Vec<f64> = (0..nodes).map(|node| node as f64 * step).collect();
    let value = bench.subject.defaults[0];
    let signals = [
        (
            "a Step with more values than nodes",
            vec![0.0],
            vec![value; 2],
        ),
        ("a Step with a signal without nodes", vec![], vec![]),
        ("a Step with the value NaN", vec![0.0], vec![f64::NAN]),
        (
            "a Step with two equal nodes",
            vec![0.0, 0.0],
            vec![value; 2],
        ),
        (
            "a Step with a degree beyond max_input_degree",
            too_many.clone(),
            vec![value; too_many.len()],
        ),
    ];
    let call = |(what, nodes, values): (&'static str, Vec<f64>, Vec<f64>)| {
        let change = move |request: &mut v1::StepRequest| {
            if let Some(first) = request.signals.first_mut() {
                (first.nodes, first.values) = (nodes.clone(), values.clone());
            }
        };
        (what, stepping(change, bench))
    };
    signals.into_iter().map(call).collect()
}

/// A Step that is changed into a wrong one.
fn stepping<'b>(change: impl Fn(&mut v1::StepRequest) + 'b, bench: &'b Bench<'_>) -> Call<'b> {
    Box::new(move |instance| {
        let signals = bench.unloaded().signals(bench.step());
        let mut request = instance.step_request(bench.step(), signals, Inside::default());
        change(&mut request);
        instance.calls.step(&request).map(|_| ())
    })
}

fn evaluate_unknown(instance: &mut Instance<'_>) -> Result<(), CallError> {
    let request = v1::EvaluateRequest {
        instance: instance.number,
        t: instance.t,
        outputs: vec![UNKNOWN.to_owned()],
        ..v1::EvaluateRequest::default()
    };
    instance.calls.evaluate(&request).map(|_| ())
}
