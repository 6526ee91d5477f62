//! Sequence numbers: a lost answer never steps twice.

use linchpin_proto::v1;

use crate::all_ways;
use crate::driver::{
    Driver, FIRST, assert_misuse, constant, exchange, failure, tank, through, values,
};
use crate::peer::{Serve, host};
use crate::tank::START;

all_ways!(
    a_repeated_call_gets_its_first_answer_and_changes_nothing,
    only_the_last_and_the_next_number_are_taken,
    a_call_that_failed_fails_again_and_its_number_is_used_up,
    a_number_belongs_to_one_call,
    a_number_belongs_to_one_content,
    replies_say_which_request_they_answer,
    initialize_may_be_repeated_until_the_next_call,
);

const STEP: f64 = 0.3;

fn ramp() -> Vec<v1::Signal> {
    vec![through(0, &[(STEP, 1.9), (0.0, 0.7)]), constant(1, 0.1)]
}

/// What the ramp adds to the level in one step.
const RISE: f64 = (0.5 * (1.9 + 0.7) - 0.1) * STEP;

fn assert_level(driver: &Driver, expected: f64) {
    let level = driver.level();
    assert!((level - expected).abs() < 1e-15, "{level} {expected}");
}

/// The work of the second answer is that of the first to the nanosecond: nothing was computed again.
fn a_repeated_call_gets_its_first_answer_and_changes_nothing(serve: Serve) {
    let peer = serve(host());
    let calls = peer.calls();
    let mut driver = Driver::initialize(peer.calls(), &tank(5));

    let step = driver.step_request(0.0, STEP, ramp());
    let first = calls.step(&step).unwrap();
    assert_eq!(calls.step(&step).unwrap(), first);
    assert_level(&driver, START + RISE);

    let perturbed = driver.perturbed_request(STEP, ramp(), vec![constant(0, 0.9); 2]);
    let first = calls.perturbed_step(&perturbed).unwrap();
    assert_eq!(first.work.unwrap().integrations, 2);
    assert_eq!(calls.perturbed_step(&perturbed).unwrap(), first);
    assert_level(&driver, START + RISE);

    let snapshot = driver.snapshot_request(None);
    let first = calls.snapshot(&snapshot).unwrap();
    assert_eq!(calls.snapshot(&snapshot).unwrap(), first);
    driver.step(STEP, STEP, ramp()).unwrap();
    let restore = driver.restore_request(first.snapshot);
    calls.restore(&restore).unwrap();
    calls.restore(&restore).unwrap();
    assert_level(&driver, START + RISE);

    let request = driver.exchange_request(
        Some(v1::Advance {
            t: STEP,
            step: STEP,
            signals: ramp(),
            ..v1::Advance::default()
        }),
        Some(v1::Predict {
            t: 2.0 * STEP,
            step: STEP,
            signals: ramp(),
            perturbed: ramp(),
            ..v1::Predict::default()
        }),
    );
    let first = exchange(&*calls, &request).unwrap();
    assert_eq!(exchange(&*calls, &request).unwrap(), first);
    assert_level(&driver, START + 2.0 * RISE);
}

fn only_the_last_and_the_next_number_are_taken(serve: Serve) {
    let peer = serve(host());
    let calls = peer.calls();
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    driver.step(0.0, STEP, ramp()).unwrap();
    let last = driver.sequence;
    for wrong in [last - 1, last + 2, 0, u64::MAX] {
        driver.sequence = wrong.wrapping_sub(1);
        let step = driver.step_request(0.0, STEP, ramp());
        let perturbed = v1::PerturbedStepRequest {
            sequence: wrong,
            instance: 5,
            ..Default::default()
        };
        let snapshot = v1::SnapshotRequest {
            sequence: wrong,
            instance: 5,
            replaces: None,
        };
        let restore = v1::RestoreRequest {
            sequence: wrong,
            instance: 5,
            snapshot: 1,
        };
        let turn = v1::ExchangeRequest {
            sequence: wrong,
            instance: 5,
            ..Default::default()
        };
        let words = [
            &*wrong.to_string(),
            &last.to_string(),
            &(last + 1).to_string(),
        ];
        assert_misuse(failure(calls.step(&step)), "sequence", &words);
        assert_misuse(
            failure(calls.perturbed_step(&perturbed)),
            "sequence",
            &words,
        );
        assert_misuse(failure(calls.snapshot(&snapshot)), "sequence", &words);
        assert_misuse(failure(calls.restore(&restore)), "sequence", &words);
        assert_misuse(exchange(&*calls, &turn), "sequence", &words);
    }
    driver.sequence = last;
    driver.step(STEP, STEP, ramp()).unwrap();
    assert_level(&driver, START + 2.0 * RISE);
}

/// The tank overflows after it has changed its level: the worker must go back by itself.
fn a_call_that_failed_fails_again_and_its_number_is_used_up(serve: Serve) {
    let peer = serve(host());
    let calls = peer.calls();
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let flood = vec![constant(0, 100.0)];

    let step = driver.step_request(0.0, STEP, flood.clone());
    let first = failure(calls.step(&step)).unwrap_err();
    assert!(
        first.message.contains("overflows") && first.t == Some(STEP),
        "{first:?}"
    );
    assert_eq!(failure(calls.step(&step)).unwrap_err(), first);
    let corrected = v1::StepRequest {
        signals: ramp(),
        ..step
    };
    assert_misuse(
        failure(calls.step(&corrected)),
        "sequence",
        &["Step", "another content", &corrected.sequence.to_string()],
    );
    assert_level(&driver, START);

    let perturbed = driver.perturbed_request(STEP, ramp(), flood.clone());
    let first = failure(calls.perturbed_step(&perturbed)).unwrap_err();
    assert_eq!(
        failure(calls.perturbed_step(&perturbed)).unwrap_err(),
        first
    );
    assert_level(&driver, START);

    let restore = driver.restore_request(99);
    let first = failure(calls.restore(&restore)).unwrap_err();
    assert_eq!(failure(calls.restore(&restore)).unwrap_err(), first);

    let advance = v1::Advance {
        t: 0.0,
        step: STEP,
        signals: flood,
        ..v1::Advance::default()
    };
    let turn = driver.exchange_request(Some(advance), None);
    let first = exchange(&*calls, &turn).unwrap_err();
    assert_eq!(exchange(&*calls, &turn).unwrap_err(), first);
    assert_level(&driver, START);

    let level = driver.step(0.0, STEP, ramp()).unwrap()[0];
    assert!((level - START - RISE).abs() < 1e-15, "{level}");
}

/// The same number with another content is misuse, and the first request still gets its answer.
fn a_number_belongs_to_one_content(serve: Serve) {
    let peer = serve(host());
    let calls = peer.calls();
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let words = ["another content"];

    let step = driver.step_request(0.0, STEP, ramp());
    let first = calls.step(&step).unwrap();
    let mut others = vec![step.clone(); 4];
    others[0].t = f64::from_bits(1);
    others[1].step = STEP * (1.0 + f64::EPSILON);
    others[2].signals[0].values[1] = -0.0;
    others[3].outputs = v1::OutputSet::All.into();
    for other in &others {
        assert_misuse(failure(calls.step(other)), "sequence", &words);
    }
    assert_eq!(calls.step(&step).unwrap(), first);
    assert_level(&driver, START + RISE);

    let snapshot = driver.snapshot_request(None);
    let kept = calls.snapshot(&snapshot).unwrap();
    let other = v1::SnapshotRequest {
        replaces: Some(kept.snapshot),
        ..snapshot
    };
    assert_misuse(failure(calls.snapshot(&other)), "sequence", &words);
    let restore = driver.restore_request(kept.snapshot);
    calls.restore(&restore).unwrap();
    let other = v1::RestoreRequest {
        snapshot: kept.snapshot + 1,
        ..restore
    };
    assert_misuse(failure(calls.restore(&other)), "sequence", &words);

    let perturbed = driver.perturbed_request(STEP, ramp(), ramp());
    let first = calls.perturbed_step(&perturbed).unwrap();
    let other = v1::PerturbedStepRequest {
        perturbed: Vec::new(),
        ..perturbed.clone()
    };
    assert_misuse(failure(calls.perturbed_step(&other)), "sequence", &words);
    assert_eq!(calls.perturbed_step(&perturbed).unwrap(), first);

    let predict = v1::Predict {
        t: STEP,
        step: STEP,
        signals: ramp(),
        ..v1::Predict::default()
    };
    let turn = driver.exchange_request(None, Some(predict));
    let first = exchange(&*calls, &turn).unwrap();
    let changes: [fn(&mut v1::ExchangeRequest); 2] =
        [|own| own.go_back = true, |own| own.predict = None];
    for change in changes {
        let mut other = turn.clone();
        change(&mut other);
        assert_misuse(exchange(&*calls, &other), "sequence", &words);
    }
    assert_eq!(exchange(&*calls, &turn).unwrap(), first);
    assert_level(&driver, START + RISE);
}

fn replies_say_which_request_they_answer(serve: Serve) {
    let peer = serve(host());
    let calls = peer.calls();
    let made = calls.initialize(&tank(5)).unwrap();
    assert_eq!((made.instance, made.sequence), (Some(5), Some(FIRST)));
    let mut driver = Driver {
        calls: peer.calls(),
        instance: 5,
        sequence: FIRST,
    };
    let step = driver.step_request(0.0, STEP, ramp());
    let reply = calls.step(&step).unwrap();
    assert_eq!((reply.instance, reply.sequence), (Some(5), Some(FIRST + 1)));
    let reply = calls.snapshot(&driver.snapshot_request(None)).unwrap();
    assert_eq!((reply.instance, reply.sequence), (Some(5), Some(FIRST + 2)));
    let reply = calls
        .restore(&driver.restore_request(reply.snapshot))
        .unwrap();
    assert_eq!((reply.instance, reply.sequence), (Some(5), Some(FIRST + 3)));
    let perturbed = driver.perturbed_request(STEP, ramp(), ramp());
    let reply = calls.perturbed_step(&perturbed).unwrap();
    assert_eq!((reply.instance, reply.sequence), (Some(5), Some(FIRST + 4)));
    let reply = driver.exchange(None, None).unwrap();
    assert_eq!((reply.instance, reply.sequence), (Some(5), FIRST + 5));
    let evaluate = v1::EvaluateRequest {
        instance: 5,
        signals: ramp(),
        ..v1::EvaluateRequest::default()
    };
    assert_eq!(calls.evaluate(&evaluate).unwrap().instance, Some(5));
    let ended = calls.terminate(&v1::TerminateRequest { instance: 5 });
    assert_eq!(ended.unwrap().instance, Some(5));
}

fn a_number_belongs_to_one_call(serve: Serve) {
    let peer = serve(host());
    let calls = peer.calls();
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let snapshot = v1::SnapshotRequest {
        instance: 5,
        sequence: FIRST,
        replaces: None,
    };
    assert_misuse(
        failure(calls.snapshot(&snapshot)),
        "sequence",
        &["Snapshot", "Initialize"],
    );
    driver
        .step(0.0, STEP, vec![constant(0, 100.0)])
        .unwrap_err();
    let turn = v1::ExchangeRequest {
        instance: 5,
        sequence: driver.sequence,
        ..Default::default()
    };
    assert_misuse(exchange(&*calls, &turn), "sequence", &["Exchange", "Step"]);
    driver.exchange(None, None).unwrap();
    driver.sequence -= 1;
    assert_misuse(
        driver.step(0.0, STEP, ramp()),
        "sequence",
        &["Step", "Exchange"],
    );
    assert_level(&driver, START);
}

fn initialize_may_be_repeated_until_the_next_call(serve: Serve) {
    let peer = serve(host());
    let calls = peer.calls();
    let request = v1::InitializeRequest {
        t_start: 0.25,
        ..crate::driver::oscillator(5, "radau5")
    };
    let first = calls.initialize(&request).unwrap();
    assert!(first.tolerance.is_some());
    assert_eq!(calls.initialize(&request).unwrap(), first);
    let other = v1::InitializeRequest {
        t_start: 0.5,
        ..request.clone()
    };
    assert_misuse(
        failure(calls.initialize(&other)),
        "instance",
        &["0x5", "exists"],
    );
    let mut driver = Driver {
        calls: peer.calls(),
        instance: 5,
        sequence: FIRST,
    };
    let after = values(
        calls
            .step(&driver.step_request(0.25, 1e-3, vec![]))
            .unwrap()
            .outputs,
    );
    assert_misuse(
        failure(calls.initialize(&request)),
        "instance",
        &["0x5", "exists"],
    );
    assert_eq!(driver.evaluate(vec![], &["x", "v"]).unwrap(), after);
}
