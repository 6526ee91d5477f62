//! Snapshots: back to a state, bit by bit.

use linchpin_proto::v1::{self, Severity};
use linchpin_worker::host::Limits;

use crate::both_ways;
use crate::driver::{Driver, assert_misuse, constant, oscillator, tank, through};
use crate::in_python;
use crate::peer::{Serve, host, host_with};
use crate::tank::START;

both_ways!(
    a_restored_state_replays_bit_by_bit,
    as_many_as_the_limit_allows_and_a_replaced_one_is_gone,
    what_was_looked_ahead_is_not_kept,
    an_exchange_goes_on_from_a_restored_state,
);

in_python!(
    a_restored_state_replays_bit_by_bit,
    what_was_looked_ahead_is_not_kept,
    an_exchange_goes_on_from_a_restored_state,
);

const STEP: f64 = 1.7e-3;

fn march(driver: &mut Driver, steps: usize) -> Vec<Vec<u64>> {
    let one = |i: usize| {
        let t = i as f64 * STEP;
        let force = through(0, &[(STEP, 41.3 + t), (0.0, -17.9), (-STEP, 3.1)]);
        let reached = driver.step(t, STEP, vec![force]).unwrap();
        reached.into_iter().map(f64::to_bits).collect()
    };
    (0..steps).map(one).collect()
}

fn a_restored_state_replays_bit_by_bit(serve: Serve) {
    for solver in ["exact", "radau5", "rk4"] {
        let peer = serve(host());
        let mut driver = Driver::initialize(peer.calls(), &oscillator(5, solver));
        march(&mut driver, 3);
        let snapshot = driver.snapshot(None).unwrap();
        let first = march(&mut driver, 7);
        for _ in 0..2 {
            driver.restore(snapshot).unwrap();
            assert_eq!(march(&mut driver, 7), first, "{solver}");
        }
    }
}

fn as_many_as_the_limit_allows_and_a_replaced_one_is_gone(serve: Serve) {
    let limits = Limits {
        snapshots: 3,
        ..Limits::default()
    };
    let peer = serve(host_with(limits));
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let kept = [(); 3].map(|()| driver.snapshot(None).unwrap());
    let refused = driver.snapshot(None).unwrap_err();
    assert_eq!(refused.severity(), Severity::Fatal);
    assert!(
        refused.message.contains('3') && refused.message.contains("replaces"),
        "{refused:?}"
    );

    driver
        .step(0.0, 0.5, vec![constant(0, 1.0), constant(1, 0.0)])
        .unwrap();
    let newer = driver.snapshot(Some(kept[1])).unwrap();
    assert!(!kept.contains(&newer));
    assert_misuse(
        driver.restore(kept[1]),
        "snapshot",
        &[&kept[1].to_string(), &newer.to_string(), "replaced"],
    );
    assert_eq!(driver.level(), START + 0.5);
    driver.restore(kept[2]).unwrap();
    assert_eq!(driver.level(), START);
    driver.restore(newer).unwrap();
    assert_eq!(driver.level(), START + 0.5);
}

/// The solver stands at the end of a perturbed look ahead; the instance does not.
fn what_was_looked_ahead_is_not_kept(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let inflow = |value| vec![constant(0, value), constant(1, 0.0)];
    let advance = v1::Advance {
        t: 0.0,
        step: 0.5,
        signals: inflow(1.0),
        ..v1::Advance::default()
    };
    let predict = v1::Predict {
        t: 0.5,
        step: 0.25,
        signals: inflow(2.0),
        perturbed: inflow(3.0),
        ..v1::Predict::default()
    };
    driver
        .exchange(Some(advance), Some(predict.clone()))
        .unwrap();
    assert_eq!(driver.level(), START + 0.5);
    let snapshot = driver.snapshot(None).unwrap();
    driver.exchange(None, Some(predict)).unwrap();
    assert_eq!(
        driver.step(0.5, 0.25, inflow(1.0)).unwrap()[0],
        START + 0.75
    );
    driver.restore(snapshot).unwrap();
    assert_eq!(driver.level(), START + 0.5);
}

fn an_exchange_goes_on_from_a_restored_state(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let snapshot = driver.snapshot(None).unwrap();
    let half_full = || v1::Advance {
        t: 0.0,
        step: 0.5,
        signals: vec![constant(0, 1.0), constant(1, 0.0)],
        ..v1::Advance::default()
    };
    let level = |reply: v1::ExchangeReply| reply.advanced.unwrap().values[0];
    assert_eq!(
        level(driver.exchange(Some(half_full()), None).unwrap()),
        START + 0.5
    );
    driver.restore(snapshot).unwrap();
    assert_eq!(
        level(driver.exchange(Some(half_full()), None).unwrap()),
        START + 0.5
    );
    driver.step(0.5, 0.5, half_full().signals).unwrap();
    assert_eq!(
        level(driver.exchange(Some(half_full()), None).unwrap()),
        START + 1.5
    );
}
