//! What the server adds: health, reflection, limits, shutdown.

use std::time::{Duration, Instant};

use linchpin_master::connection::new_runtime;
use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1::worker_client::WorkerClient;
use linchpin_proto::v1::{self, Severity};
use linchpin_worker::server::{Capacity, GRACE};
use tokio_stream::StreamExt;
use tonic::transport::{Channel, Endpoint};
use tonic_health::pb::health_check_response::ServingStatus;
use tonic_health::pb::{HealthCheckRequest, health_client::HealthClient};
use tonic_reflection::pb::v1 as reflection;

use crate::driver::{Driver, constant, tank, through};
use crate::peer::{Remote, Served, grpc, host};

async fn channel(served: &Served) -> Channel {
    let endpoint = Endpoint::from_shared(served.address.clone()).unwrap();
    endpoint.connect().await.unwrap()
}

#[test]
fn health_says_serving() {
    let served = Served::start(host());
    let ask = async |service: &str| {
        let request = HealthCheckRequest {
            service: service.into(),
        };
        let mut client = HealthClient::new(channel(&served).await);
        client
            .check(request)
            .await
            .map(|reply| reply.into_inner().status())
    };
    new_runtime().unwrap().block_on(async {
        assert_eq!(
            ask("linchpin.v1.Worker").await.unwrap(),
            ServingStatus::Serving
        );
        assert_eq!(ask("").await.unwrap(), ServingStatus::Serving);
        assert_eq!(
            ask("linchpin.v9.Worker").await.unwrap_err().code(),
            tonic::Code::NotFound
        );
    });
}

#[test]
fn reflection_lists_the_contract() {
    use reflection::server_reflection_request::MessageRequest;
    use reflection::server_reflection_response::MessageResponse;
    let served = Served::start(host());
    let request = reflection::ServerReflectionRequest {
        host: String::new(),
        message_request: Some(MessageRequest::ListServices(String::new())),
    };
    let answer = new_runtime().unwrap().block_on(async {
        let mut client = reflection::server_reflection_client::ServerReflectionClient::new(
            channel(&served).await,
        );
        let requests = tokio_stream::once(request);
        let mut replies = client
            .server_reflection_info(requests)
            .await
            .unwrap()
            .into_inner();
        replies
            .next()
            .await
            .unwrap()
            .unwrap()
            .message_response
            .unwrap()
    });
    let MessageResponse::ListServicesResponse(list) = answer else {
        panic!("{answer:?}")
    };
    let names: Vec<&str> = list
        .service
        .iter()
        .map(|service| service.name.as_str())
        .collect();
    for expected in ["linchpin.v1.Worker", "grpc.health.v1.Health"] {
        assert!(names.contains(&expected), "{names:?}");
    }
}

/// A model name of the size of the limit makes the message just too large.
#[test]
fn a_message_above_the_limit_is_refused_and_the_worker_lives() {
    let served = Served::start(host());
    let large = |length| v1::InitializeRequest {
        model: "o".repeat(length),
        ..tank(5)
    };
    let ask = |request: v1::InitializeRequest| {
        new_runtime().unwrap().block_on(async {
            let mut client = WorkerClient::new(channel(&served).await);
            client.initialize(request).await.unwrap_err()
        })
    };
    let refused = ask(large(Capacity::default().message));
    assert_eq!(refused.code(), tonic::Code::OutOfRange, "{refused}");
    assert!(
        refused
            .message()
            .contains(&Capacity::default().message.to_string()),
        "{refused}"
    );
    let understood = ask(large(Capacity::default().message / 2));
    assert_eq!(understood.code(), tonic::Code::InvalidArgument);
    grpc(&served.address).initialize(&tank(5)).unwrap();
}

/// The master keeps its stream open: the server waits for the grace time and not longer.
#[test]
fn shutdown_does_not_wait_for_an_open_stream() {
    let mut served = Served::start(host());
    let remote = std::sync::Arc::new(Remote::connect(&served.address));
    let mut driver = Driver::initialize(remote, &tank(5));
    driver.exchange(None, None).unwrap();
    let socket = served.address.trim_start_matches("unix:").to_owned();
    let started = Instant::now();
    served.stop();
    served.wait();
    assert!(
        started.elapsed() < GRACE + Duration::from_secs(3),
        "{:?}",
        started.elapsed()
    );
    assert!(!std::path::Path::new(&socket).exists());
    let request = driver.exchange_request(None, None);
    let error = driver
        .calls
        .exchange(&request, &mut v1::ExchangeReply::default())
        .unwrap_err();
    assert!(matches!(error, CallError::Lost { .. }), "{error:?}");
}

/// As when a worker is restarted while the old one still waits for its master.
#[test]
fn a_worker_that_ends_leaves_the_socket_of_its_successor() {
    let mut served = Served::start(host());
    let remote = std::sync::Arc::new(Remote::connect(&served.address));
    let mut driver = Driver::initialize(remote, &tank(5));
    driver.exchange(None, None).unwrap();
    served.stop();
    let successor = served.successor(host());
    served.wait();
    grpc(&successor.address).initialize(&tank(5)).unwrap();
}

#[test]
fn shutdown_lets_a_call_under_way_finish() {
    let mut served = Served::start(host());
    let mut slow = tank(5);
    slow.parameters
        .insert("pause".into(), crate::driver::number(0.3));
    let calls = std::sync::Arc::new(grpc(&served.address));
    let mut driver = Driver::initialize(calls, &slow);
    let step = std::thread::spawn(move || driver.step(0.0, 0.5, vec![constant(0, 1.0)]));
    std::thread::sleep(Duration::from_millis(100));
    served.stop();
    served.wait();
    step.join().unwrap().unwrap();
}

/// The stream that carried a wrong request carries the next one as well.
#[test]
fn a_refused_exchange_leaves_the_stream_open() {
    let served = Served::start(host());
    let mut driver = Driver::initialize(
        std::sync::Arc::new(Remote::connect(&served.address)),
        &tank(5),
    );
    let predict = |signal| v1::Predict {
        step: 0.5,
        signals: vec![signal],
        ..v1::Predict::default()
    };
    for _ in 0..3 {
        let refused = driver
            .exchange(None, Some(predict(through(0, &[]))))
            .unwrap_err();
        assert_eq!(refused.severity(), Severity::Misuse);
        driver
            .exchange(None, Some(predict(constant(0, 1.0))))
            .unwrap();
    }
}
