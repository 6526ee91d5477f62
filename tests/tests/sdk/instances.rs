//! Many instances behind one worker.

use std::time::Duration;

use linchpin_proto::contract::Contract;
use linchpin_proto::v1::{self, Severity};
use linchpin_worker::host::Limits;

use crate::both_ways;
use crate::driver::{Driver, assert_misuse, constant, failure, number, oscillator, tank, through};
use crate::peer::{Serve, grpc, host, host_with};
use crate::tank::START;

both_ways!(
    a_full_worker_refuses_until_an_instance_ends,
    an_idle_instance_gives_way,
    two_masters_do_not_disturb_each_other,
    a_panic_fails_its_own_instance_only,
    terminate_ends_an_instance_once_and_again,
);

fn a_full_worker_refuses_until_an_instance_ends(serve: Serve) {
    let peer = serve(host_with(Limits {
        instances: 2,
        ..Limits::default()
    }));
    for instance in [5, 6] {
        Driver::initialize(peer.calls(), &tank(instance));
    }
    let refused = failure(peer.calls().initialize(&tank(7))).unwrap_err();
    assert_eq!(refused.severity(), Severity::Fatal);
    assert!(refused.message.contains("full: 2 instances"), "{refused:?}");
    peer.calls()
        .terminate(&v1::TerminateRequest { instance: 5 })
        .unwrap();
    Driver::initialize(peer.calls(), &tank(7));
}

fn an_idle_instance_gives_way(serve: Serve) {
    let idle = Duration::from_millis(300);
    let host = host_with(Limits {
        instances: 2,
        idle,
        ..Limits::default()
    });
    let peer = serve(host.clone());
    let abandoned = Driver::initialize(peer.calls(), &tank(5));
    let mut used = Driver::initialize(peer.calls(), &tank(6));
    std::thread::sleep(idle);
    used.step(0.0, 0.5, vec![constant(0, 0.0)]).unwrap();
    Driver::initialize(peer.calls(), &tank(7));
    assert_eq!(host.instances(), 2);
    assert_misuse(abandoned.evaluate(vec![], &["level"]), "instance", &["0x5"]);
    used.level();
}

/// A step may take longer than an instance may be idle.
#[test]
fn an_instance_that_computes_is_not_idle() {
    let idle = Duration::from_millis(300);
    let host = host_with(Limits {
        instances: 1,
        idle,
        ..Limits::default()
    });
    let mut slow = tank(5);
    slow.parameters.insert("pause".into(), number(0.8));
    let mut driver = Driver::initialize(host.clone(), &slow);
    let step = std::thread::spawn(move || {
        driver.step(0.0, 0.5, vec![constant(0, 0.0)]).unwrap();
        driver
    });
    std::thread::sleep(idle + idle / 2);
    failure(host.initialize(&tank(6))).unwrap_err();
    let driver = step.join().unwrap();
    failure(host.initialize(&tank(6))).unwrap_err();
    driver.level();
}

fn march(driver: &mut Driver, first: usize, steps: usize) -> Vec<Vec<f64>> {
    let one = |i: usize| {
        let force = through(0, &[(1e-3, i as f64), (0.0, 3.7 * driver.instance as f64)]);
        driver.step(i as f64 * 1e-3, 1e-3, vec![force]).unwrap()
    };
    (first..first + steps).map(one).collect()
}

fn two_masters_do_not_disturb_each_other(serve: Serve) {
    let peer = serve(host());
    let alone = [5, 6].map(|instance| {
        let own = serve(host());
        march(
            &mut Driver::initialize(own.calls(), &oscillator(instance, "radau5")),
            0,
            12,
        )
    });
    let mut masters =
        [5, 6].map(|instance| Driver::initialize(peer.calls(), &oscillator(instance, "radau5")));
    let mut together = [vec![], vec![]];
    for (first, steps) in [(0, 1), (1, 4), (5, 2), (7, 5)] {
        for (driver, rows) in masters.iter_mut().zip(&mut together) {
            rows.extend(march(driver, first, steps));
        }
    }
    assert_eq!(together, alone);
}

/// Two masters with connections of their own, at the same time.
#[test]
fn two_connections_do_not_disturb_each_other() {
    let served = crate::peer::Served::start(host());
    let alone = |instance| {
        march(
            &mut Driver::initialize(host(), &oscillator(instance, "radau5")),
            0,
            200,
        )
    };
    std::thread::scope(|scope| {
        for instance in [5, 6] {
            let calls = std::sync::Arc::new(grpc(&served.address));
            scope.spawn(move || {
                let mut driver = Driver::initialize(calls, &oscillator(instance, "radau5"));
                assert_eq!(march(&mut driver, 0, 200), alone(instance));
            });
        }
    });
}

fn a_panic_fails_its_own_instance_only(serve: Serve) {
    let peer = serve(host());
    let mut broken = Driver::initialize(peer.calls(), &tank(5));
    let mut other = Driver::initialize(peer.calls(), &tank(6));
    let failure = broken.step(0.0, 1.0, vec![constant(0, -9.0)]).unwrap_err();
    assert_eq!(failure.severity(), Severity::Fatal);
    assert!(
        failure.message.contains("panicked: the tank is empty"),
        "{failure:?}"
    );
    let later = broken.evaluate(vec![], &["level"]).unwrap_err();
    assert!(later.message.contains("earlier call"), "{later:?}");
    assert_eq!(
        other
            .step(0.0, 0.5, vec![constant(0, 1.0), constant(1, 0.0)])
            .unwrap()[0],
        START + 0.5
    );
    peer.calls()
        .terminate(&v1::TerminateRequest { instance: 5 })
        .unwrap();
    Driver::initialize(peer.calls(), &tank(5)).level();
}

fn terminate_ends_an_instance_once_and_again(serve: Serve) {
    let host = host();
    let peer = serve(host.clone());
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    for _ in 0..2 {
        peer.calls()
            .terminate(&v1::TerminateRequest { instance: 5 })
            .unwrap();
        assert_eq!(host.instances(), 0);
    }
    assert_misuse(
        driver.step(0.0, 0.5, vec![constant(0, 1.0)]),
        "instance",
        &["0x5"],
    );
    assert_misuse(driver.exchange(None, None), "instance", &["0x5"]);
}
