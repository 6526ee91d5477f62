//! Instances end some time after what held them.

use std::sync::Arc;
use std::time::{Duration, Instant};

use linchpin_proto::contract::Contract;
use linchpin_proto::v1::{self, ListInstancesRequest};
use linchpin_worker::host::Limits;

use crate::driver::{Driver, constant, number, tank};
use crate::peer::{Remote, Served, grpc, host_with};

/// Short, so that tests need not wait long; looked at only when something must have ended.
const LEASE: Duration = Duration::from_millis(300);

/// Longest time that is waited for the end of an instance: a busy machine is slow.
const PATIENCE: Duration = Duration::from_secs(20);

fn limits() -> Limits {
    Limits {
        lease: LEASE,
        ..Limits::default()
    }
}

/// Waits until so many instances are there.
#[track_caller]
fn wait_for(host: &linchpin_worker::Host, instances: usize) {
    let give_up = Instant::now() + PATIENCE;
    while host.instances() != instances {
        assert!(Instant::now() < give_up, "{} instances", host.instances());
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn what_a_connection_held_ends_after_it() {
    let host = host_with(limits());
    let served = Served::start(host.clone());
    let mine = Arc::new(grpc(&served.address));
    let lease = mine.initialize(&tank(5)).unwrap().lease;
    assert_eq!(lease, Some(LEASE.as_secs_f64()));
    let other = Driver::initialize(Arc::new(grpc(&served.address)), &tank(6));
    assert_eq!(host.instances(), 2);
    drop(other);
    wait_for(&host, 1);
    // Held for longer than the lease without a call.
    std::thread::sleep(3 * LEASE);
    let listed = mine.list_instances(&ListInstancesRequest {}).unwrap();
    let [own] = &listed.instances[..] else {
        panic!("{listed:?}")
    };
    assert_eq!((own.instance, &own.model[..], own.held), (5, "tank", true));
    assert!(own.idle >= 3.0 * LEASE.as_secs_f64() && own.age >= own.idle);
    assert_eq!(own.expires, None);
}

#[test]
fn what_a_stream_held_ends_after_it() {
    let host = host_with(limits());
    let served = Served::start(host.clone());
    let remote = Arc::new(Remote::connect(&served.address));
    let mut driver = Driver::initialize(remote.clone(), &tank(5));
    driver.exchange(None, None).unwrap();
    std::thread::sleep(3 * LEASE);
    driver.exchange(None, None).unwrap();
    remote.close_stream();
    // The connection of Initialize is still open, and so is that of the stream.
    wait_for(&host, 0);
}

#[test]
fn a_call_in_time_goes_on_with_the_instance() {
    let host = host_with(Limits {
        lease: PATIENCE,
        ..Limits::default()
    });
    let served = Served::start(host.clone());
    let mut driver = Driver::initialize(Arc::new(grpc(&served.address)), &tank(5));
    driver.step(0.0, 0.5, vec![constant(0, 1.0)]).unwrap();
    let before = driver.level();
    // As after a lost connection.
    driver.calls = Arc::new(grpc(&served.address));
    let give_up = Instant::now() + PATIENCE;
    let state = || {
        host.list_instances(&ListInstancesRequest {})
            .unwrap()
            .instances[0]
            .clone()
    };
    while state().held {
        assert!(Instant::now() < give_up);
        std::thread::sleep(Duration::from_millis(10));
    }
    assert!(
        state()
            .expires
            .is_some_and(|left| left <= PATIENCE.as_secs_f64())
    );
    assert_eq!(driver.level(), before);
    assert!(state().held);
}

#[test]
fn a_call_under_way_is_waited_for() {
    let host = host_with(limits());
    let served = Served::start(host.clone());
    let mut slow = tank(5);
    slow.parameters.insert("pause".into(), number(1.5));
    let mut driver = Driver::initialize(Arc::new(grpc(&served.address)), &slow);
    let step = std::thread::spawn(move || driver.step(0.0, 0.5, vec![constant(0, 1.0)]));
    // The answer arrives although it takes longer than the lease.
    step.join().unwrap().unwrap();
    wait_for(&host, 0);
}

/// They do not know that they would have to come back in time.
#[test]
fn instances_of_older_masters_stay() {
    let host = host_with(limits());
    let served = Served::start(host.clone());
    let older = v1::InitializeRequest {
        protocol: Some(v1::ProtocolVersion { major: 1, minor: 2 }),
        ..tank(5)
    };
    let calls = grpc(&served.address);
    assert_eq!(calls.initialize(&older).unwrap().lease, None);
    drop(calls);
    std::thread::sleep(5 * LEASE);
    assert_eq!(host.instances(), 1);
    let calls = grpc(&served.address);
    let listed = calls.list_instances(&ListInstancesRequest {}).unwrap();
    assert!(!listed.instances[0].held && listed.instances[0].expires.is_none());
}

#[test]
fn without_a_server_nothing_ends_by_itself() {
    let host = host_with(limits());
    Driver::initialize(host.clone(), &tank(5));
    std::thread::sleep(2 * LEASE);
    host.tidy();
    assert_eq!(host.instances(), 1);
}

/// A full worker is free again as soon as the leases of masters that are gone are over.
#[test]
fn a_full_worker_is_free_again() {
    let host = host_with(Limits {
        instances: 2,
        ..limits()
    });
    let served = Served::start(host.clone());
    for round in 0..3 {
        let calls = Arc::new(grpc(&served.address));
        for instance in [2 * round, 2 * round + 1] {
            calls.initialize(&tank(instance)).unwrap();
        }
        drop(calls);
        wait_for(&host, 0);
    }
}
