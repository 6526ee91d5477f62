//! `linchpin health`: what a health check learns of a worker, of a frozen one, and of what is none.

#![allow(clippy::unwrap_used)]

use std::net::TcpListener;

use linchpin_tests::process::{Outcome, Workshop};
use rustix::process::Signal;
use tokio_stream::wrappers::TcpListenerStream;
use tonic_health::server::{HealthReporter, health_reporter};

/// The command with a short time for the answer.
fn health(workshop: &Workshop, address: &str) -> Outcome {
    workshop.run(&["health", address, "--timeout", "0.6"])
}

#[test]
fn a_worker_serves_until_it_freezes_or_ends() {
    let workshop = Workshop::new();
    let address = format!("unix:{}", workshop.path().join("own.sock").display());
    // In a folder of its own, for its output.
    let elsewhere = Workshop::new();
    let worker = elsewhere.start(&["worker", "--listen", &address]);
    // It waits for a worker that is starting.
    let outcome = workshop.run(&["health", &address]);
    assert_eq!(outcome.exits_with(0).stdout, "serving\n");

    worker.send(Signal::STOP);
    health(&workshop, &address)
        .exits_with(1)
        .says(&["no answer within 0.6 s"]);

    worker.send(Signal::CONT);
    health(&workshop, &address).exits_with(0);
    worker.send(Signal::TERM);
    worker.wait().exits_with(0);
    health(&workshop, &address)
        .exits_with(1)
        .says(&["is the worker running"]);
}

/// Asks a server that has the health service and nothing else.
fn health_of(workshop: &Workshop, prepare: impl AsyncFnOnce(&HealthReporter)) -> Outcome {
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(1)
        .enable_all()
        .build()
        .unwrap();
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    listener.set_nonblocking(true).unwrap();
    let address = format!("http://{}", listener.local_addr().unwrap());
    runtime.block_on(async {
        let (reporter, service) = health_reporter();
        prepare(&reporter).await;
        let incoming = TcpListenerStream::new(tokio::net::TcpListener::from_std(listener).unwrap());
        let server = tonic::transport::Server::builder().add_service(service);
        tokio::spawn(server.serve_with_incoming(incoming));
    });
    health(workshop, &address)
}

#[test]
fn what_answers_but_does_not_serve_is_not_healthy() {
    use tonic_health::ServingStatus;
    let workshop = Workshop::new();
    let outcome = health_of(&workshop, async |_| {});
    outcome
        .exits_with(1)
        .says(&["it serves no linchpin.v1.Worker: SERVICE_UNKNOWN"]);

    let outcome = health_of(&workshop, async |reporter| {
        let contract = "linchpin.v1.Worker";
        reporter
            .set_service_status(contract, ServingStatus::NotServing)
            .await;
    });
    let said = &outcome.exits_with(1).stderr;
    assert!(
        said.contains("it serves no linchpin.v1.Worker: NOT_SERVING"),
        "{said}"
    );
}

#[test]
fn other_servers_are_told_from_workers() {
    let workshop = Workshop::new();
    // It takes connections and says nothing.
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = format!("http://{}", listener.local_addr().unwrap());
    health(&workshop, &address)
        .exits_with(1)
        .says(&["is it a worker of the contract"]);

    let outcome = workshop.run(&["health", "localhost:50051"]);
    outcome.exits_with(2);
}
