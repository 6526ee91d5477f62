//! The fused macro step.

use std::sync::Arc;

use linchpin_master::connection::UnaryTurns;
use linchpin_proto::v1;
use linchpin_tests::scripted::Scripted;

use crate::all_ways;
use crate::driver::{Driver, assert_misuse, constant, oscillator, tank, through};
use crate::peer::{Serve, host};
use crate::tank::{LEAK, START};

all_ways!(
    exchanges_equal_unary_turns_bit_by_bit,
    a_failure_while_looking_ahead_leaves_the_committed_state,
    a_prediction_of_zero_length_evaluates,
    parts_that_are_not_asked_for_are_absent,
    a_wrong_part_is_named,
);

const STEP: f64 = 1.7e-3;

fn force(end: f64) -> Vec<v1::Signal> {
    vec![
        through(0, &[(STEP, end), (0.0, -17.9), (-STEP, 230.7)]),
        constant(1, 0.01),
    ]
}

/// What a master sends: a first look ahead, steps, a step that is taken once more, a look without a step.
fn turns() -> Vec<(Option<v1::Advance>, Option<v1::Predict>)> {
    let advance = |i: f64, end| {
        let (t, step) = (i * STEP, STEP);
        Some(v1::Advance {
            t,
            step,
            signals: force(end),
            ..v1::Advance::default()
        })
    };
    let predict = |i: f64, step: f64, end: f64| {
        let perturbed = vec![force(end + 0.1).swap_remove(0), constant(1, 0.011)];
        Some(v1::Predict {
            t: i * STEP,
            step,
            signals: force(end),
            perturbed,
            ..v1::Predict::default()
        })
    };
    vec![
        (None, predict(0.0, STEP, 3.0)),
        (advance(0.0, 4.0), predict(1.0, STEP, 5.0)),
        (None, predict(1.0, 0.5 * STEP, 5.5)),
        (advance(1.0, 6.0), predict(2.0, 0.0, 6.0)),
        (advance(2.0, 7.0), None),
        (advance(3.0, 8.0), predict(4.0, STEP, 9.0)),
    ]
}

fn exchanges_equal_unary_turns_bit_by_bit(serve: Serve) {
    for solver in ["exact", "radau5", "rk4"] {
        let peer = serve(host());
        let mut fused = Driver::initialize(peer.calls(), &oscillator(5, solver));
        let unary = Arc::new(UnaryTurns::new(Scripted::new(peer.calls())));
        let mut unary = Driver::initialize(unary, &oscillator(6, solver));
        for (advance, predict) in turns() {
            let mut answers = [&mut fused, &mut unary]
                .map(|driver| driver.exchange(advance.clone(), predict.clone()).unwrap());
            for answer in &mut answers {
                answer.work.as_mut().unwrap().nanoseconds = 0;
                answer.instance = None;
            }
            assert_eq!(answers[0], answers[1], "{solver} {predict:?}");
        }
    }
}

fn a_failure_while_looking_ahead_leaves_the_committed_state(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let inflow = |value| vec![constant(0, value), constant(1, 0.0)];
    let advance = |t| v1::Advance {
        t,
        step: 0.5,
        signals: inflow(1.0),
        ..v1::Advance::default()
    };
    let predict = |signals, perturbed| v1::Predict {
        t: 0.5,
        step: 0.5,
        signals,
        perturbed,
        ..v1::Predict::default()
    };
    driver.exchange(Some(advance(0.0)), None).unwrap();
    for (signals, perturbed) in [(inflow(100.0), vec![]), (inflow(1.0), inflow(100.0))] {
        let look = predict(signals, perturbed);
        let failure = driver.exchange(Some(advance(0.5)), Some(look)).unwrap_err();
        assert!(failure.message.contains("overflows"), "{failure:?}");
        assert_eq!((failure.t, failure.step), (Some(1.0), Some(0.5)));
        assert_eq!(driver.level(), START + 0.5);
    }
    let reply = driver.exchange(Some(advance(0.5)), None).unwrap();
    assert_eq!(reply.advanced.unwrap().values[0], START + 1.0);
}

fn a_prediction_of_zero_length_evaluates(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let signals = vec![through(0, &[(0.5, 9.0), (0.0, 1.25)])];
    let predict = v1::Predict {
        t: 0.0,
        step: 0.0,
        signals: signals.clone(),
        perturbed: vec![through(1, &[(0.5, 9.0), (0.0, 0.75)])],
        ..v1::Predict::default()
    };
    let reply = driver.exchange(None, Some(predict)).unwrap();
    let evaluated = driver.evaluate(signals, &["level", "rate"]).unwrap();
    assert_eq!(evaluated, [START, 1.25 - LEAK]);
    assert_eq!(reply.predicted.unwrap().values, evaluated);
    assert_eq!(reply.perturbed[0].values, [START, 0.5]);
    assert_eq!(reply.work.unwrap().integrations, 0);
}

fn parts_that_are_not_asked_for_are_absent(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &oscillator(5, "exact"));
    let mut turns = turns();
    let (advance, predict) = turns.swap_remove(1);

    let reply = driver.exchange(advance, predict.clone()).unwrap();
    let lengths = |reply: &v1::ExchangeReply| {
        let length = |outputs: &Option<v1::Outputs>| outputs.as_ref().map(|o| o.values.len());
        (
            length(&reply.advanced),
            length(&reply.predicted),
            reply.perturbed.len(),
        )
    };
    assert_eq!(lengths(&reply), (Some(3), Some(2), 2));
    assert_eq!(reply.sequence, driver.sequence);
    assert_eq!(reply.work.unwrap().integrations, 4);
    assert_eq!(
        lengths(&driver.exchange(None, predict).unwrap()),
        (None, Some(2), 2)
    );
    assert_eq!(
        lengths(&driver.exchange(None, None).unwrap()),
        (None, None, 0)
    );
}

fn a_wrong_part_is_named(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    for (t, step) in [
        (0.0, 0.0),
        (0.0, -0.5),
        (f64::NAN, 0.5),
        (0.0, f64::INFINITY),
    ] {
        let signals = vec![constant(0, 1.0)];
        let advance = v1::Advance {
            t,
            step,
            signals,
            ..v1::Advance::default()
        };
        assert_misuse(
            driver.exchange(Some(advance), None),
            "step",
            &[&t.to_string(), &step.to_string()],
        );
    }
    for (t, step) in [(f64::NAN, 0.0), (0.0, -0.5), (0.0, f64::NAN)] {
        let predict = v1::Predict {
            t,
            step,
            signals: vec![constant(0, 1.0)],
            perturbed: vec![],
            ..v1::Predict::default()
        };
        assert_misuse(
            driver.exchange(None, Some(predict)),
            "step",
            &[&t.to_string(), &step.to_string()],
        );
    }
    assert_eq!(driver.level(), START);
}
