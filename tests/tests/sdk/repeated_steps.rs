//! Perturbed steps repeat the internal steps of the step that they are compared with, and of no other.

use linchpin_proto::v1;

use crate::all_ways;
use crate::driver::{Driver, constant, tank};
use crate::peer::{Serve, host};

all_ways!(
    in_an_exchange_they_repeat_the_prediction,
    after_a_restore_they_repeat_the_step_before_it,
    what_a_failed_step_left_behind_is_not_repeated,
);

fn instance() -> v1::InitializeRequest {
    v1::InitializeRequest {
        coupling_outputs: vec!["repeated".into()],
        ..tank(5)
    }
}

fn inflow(value: f64) -> Vec<v1::Signal> {
    vec![constant(0, value)]
}

/// Whether each of two perturbed steps from 0 over `step` repeated internal steps.
fn repeated(driver: &mut Driver, step: f64) -> [f64; 2] {
    let perturbed = vec![constant(0, 1.1), constant(1, 0.1)];
    let request = driver.perturbed_request(step, inflow(1.0), perturbed);
    let reply = driver.calls.perturbed_step(&request).unwrap();
    [0, 1].map(|place: usize| reply.outputs[place].values[0])
}

fn in_an_exchange_they_repeat_the_prediction(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &instance());
    let advance = v1::Advance {
        t: 0.0,
        step: 0.5,
        signals: inflow(1.0),
        ..v1::Advance::default()
    };
    let predict = v1::Predict {
        t: 0.5,
        step: 0.5,
        signals: inflow(1.0),
        perturbed: inflow(1.1),
        ..v1::Predict::default()
    };
    for advance in [Some(advance), None] {
        let reply = driver.exchange(advance, Some(predict.clone())).unwrap();
        assert_eq!(reply.predicted.unwrap().values, [0.0]);
        assert_eq!(reply.perturbed[0].values, [1.0]);
    }
}

fn after_a_restore_they_repeat_the_step_before_it(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &instance());
    let start = driver.snapshot(None).unwrap();
    driver.step(0.0, 0.5, inflow(1.0)).unwrap();
    driver.restore(start).unwrap();
    assert_eq!(repeated(&mut driver, 0.5), [1.0, 1.0]);
    // Over another interval the first one finds its own steps.
    assert_eq!(repeated(&mut driver, 0.25), [0.0, 1.0]);

    driver.step(0.0, 0.5, inflow(1.0)).unwrap();
    assert_eq!(repeated(&mut driver, 0.5), [0.0, 1.0]);
}

fn what_a_failed_step_left_behind_is_not_repeated(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &instance());
    driver.step(0.0, 0.5, inflow(100.0)).unwrap_err();
    assert_eq!(repeated(&mut driver, 0.5), [0.0, 1.0]);
}
