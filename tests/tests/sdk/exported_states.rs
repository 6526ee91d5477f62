//! States that leave their process: another instance goes on from them bit by bit.

use linchpin_proto::contract::CallError;
use linchpin_proto::v1;

use crate::all_ways;
use crate::driver::{Driver, assert_misuse, failure, oscillator, tank, through};
use crate::peer::{Serve, host};

all_ways!(
    another_instance_in_another_worker_goes_on_bit_by_bit,
    what_was_looked_ahead_is_not_exported,
    a_damaged_or_foreign_state_is_refused_and_nothing_changes,
    a_repeated_import_gets_its_answer_again,
    a_model_that_does_not_say_so_exports_nothing,
    an_instance_that_is_not_there_is_told_as_such,
);

const STEP: f64 = 1.7e-3;

fn ramp(t: f64) -> Vec<v1::Signal> {
    vec![through(0, &[(STEP, 41.3 + t), (0.0, -17.9), (-STEP, 3.1)])]
}

fn march(driver: &mut Driver, from: usize, steps: usize) -> Vec<Vec<u64>> {
    let one = |i: usize| {
        let t = i as f64 * STEP;
        let reached = driver.step(t, STEP, ramp(t)).unwrap();
        reached.into_iter().map(f64::to_bits).collect()
    };
    (from..from + steps).map(one).collect()
}

fn export(driver: &Driver) -> Result<v1::ExportedState, v1::Failure> {
    let request = v1::ExportStateRequest {
        instance: driver.instance,
    };
    failure(driver.calls.export_state(&request)).map(|reply| reply.state.unwrap())
}

fn import_request(driver: &mut Driver, state: v1::ExportedState) -> v1::ImportStateRequest {
    v1::ImportStateRequest {
        instance: driver.instance,
        sequence: driver.next(),
        state: Some(state),
    }
}

fn import(driver: &mut Driver, state: v1::ExportedState) -> Result<(), v1::Failure> {
    let request = import_request(driver, state);
    failure(driver.calls.import_state(&request)).map(drop)
}

fn another_instance_in_another_worker_goes_on_bit_by_bit(serve: Serve) {
    for solver in ["exact", "radau5", "rk4"] {
        let (peer, other) = (serve(host()), serve(host()));
        let mut driver = Driver::initialize(peer.calls(), &oscillator(5, solver));
        march(&mut driver, 0, 3);
        let state = export(&driver).unwrap();
        assert_eq!(state.model, "oscillator");
        let rest = march(&mut driver, 3, 7);
        let mut second = Driver::initialize(other.calls(), &oscillator(8, solver));
        march(&mut second, 0, 1);
        import(&mut second, state).unwrap();
        assert_eq!(march(&mut second, 3, 7), rest, "{solver}");
    }
}

fn what_was_looked_ahead_is_not_exported(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &oscillator(5, "radau5"));
    march(&mut driver, 0, 2);
    let before = export(&driver).unwrap();
    let predict = v1::Predict {
        t: 2.0 * STEP,
        step: STEP,
        signals: ramp(0.0),
        perturbed: ramp(1.0),
        ..v1::Predict::default()
    };
    driver.exchange(None, Some(predict)).unwrap();
    assert_eq!(export(&driver).unwrap(), before);
}

fn a_damaged_or_foreign_state_is_refused_and_nothing_changes(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &oscillator(5, "exact"));
    march(&mut driver, 0, 2);
    let state = export(&driver).unwrap();
    let mut undisturbed = Driver::initialize(peer.calls(), &oscillator(6, "exact"));
    march(&mut undisturbed, 0, 2);

    let mut damaged = state.clone();
    damaged.state[3] ^= 4;
    assert_misuse(
        import(&mut driver, damaged),
        "state",
        &["damaged", "checksum"],
    );
    let foreign = v1::ExportedState {
        model: "pendulum".into(),
        ..state.clone()
    };
    assert_misuse(
        import(&mut driver, foreign),
        "state",
        &["pendulum", "oscillator"],
    );
    let newer = v1::ExportedState {
        writer: "other 7".into(),
        ..state.clone()
    };
    assert_misuse(import(&mut driver, newer), "state", &["other 7"]);
    let short = v1::ExportedState::sealed("oscillator", &state.writer, state.state[..8].into());
    let failed = import(&mut driver, short).unwrap_err();
    assert!(failed.message.contains("8 bytes"), "{failed:?}");
    let request = v1::ImportStateRequest {
        instance: driver.instance,
        sequence: driver.next(),
        state: None,
    };
    let absent = failure(driver.calls.import_state(&request));
    assert_misuse(absent, "state", &["ExportState"]);
    assert_eq!(march(&mut driver, 2, 3), march(&mut undisturbed, 2, 3));
}

fn a_repeated_import_gets_its_answer_again(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &oscillator(5, "exact"));
    let state = export(&driver).unwrap();
    march(&mut driver, 0, 2);
    let request = import_request(&mut driver, state.clone());
    let first = driver.calls.import_state(&request).unwrap();
    assert_eq!(first.sequence, Some(request.sequence));
    assert_eq!(driver.calls.import_state(&request).unwrap(), first);
    let other = v1::ImportStateRequest {
        state: None,
        ..request
    };
    let refused = failure(driver.calls.import_state(&other));
    assert_misuse(refused, "sequence", &["another content"]);
    assert_eq!(export(&driver).unwrap(), state);
}

fn a_model_that_does_not_say_so_exports_nothing(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    assert_misuse(export(&driver), "state", &["tank", "exportable_snapshot"]);
    let state = v1::ExportedState::sealed("tank", "linchpin 0", vec![0; 8]);
    assert_misuse(
        import(&mut driver, state),
        "state",
        &["exportable_snapshot"],
    );
}

fn an_instance_that_is_not_there_is_told_as_such(serve: Serve) {
    let peer = serve(host());
    let request = v1::ExportStateRequest { instance: 0x2a };
    let error = peer.calls().export_state(&request).unwrap_err();
    assert!(error.is_loss(), "{error:?}");
    let CallError::NoInstance { message } = error else {
        panic!("{error:?}")
    };
    assert!(message.contains("no instance 0x2a"), "{message}");
}
