//! What a worker does while a solver computes for minutes: it answers, it lets go of callers that have gone away, and it ends.

#![allow(clippy::unwrap_used)]

use std::future::Future;
use std::time::{Duration, Instant};

use linchpin_proto::v1::worker_client::WorkerClient;
use linchpin_proto::v1::{self, value::Kind};
use linchpin_proto::version::PROTOCOL;
use linchpin_tests::process::{Running, Workshop, wait_until};
use rustix::process::Signal;
use tokio::runtime::Runtime;
use tokio_stream::StreamExt;
use tokio_stream::wrappers::UnboundedReceiverStream;
use tonic::transport::{Channel, Endpoint};

const INSTANCE: u64 = 0x10f6;

/// Long enough for another thread to take over, short against the step.
const MOMENT: Duration = Duration::from_millis(300);

/// Longest time until a short call is answered beside a long one.
const SOON: Duration = Duration::from_secs(1);

/// A worker process with one thread for solvers.
struct House {
    workshop: Workshop,
    worker: Running,
    address: String,
    runtime: Runtime,
}

impl House {
    fn new() -> Self {
        let workshop = Workshop::new();
        let address = format!("unix:{}", workshop.path().join("worker.sock").display());
        let mut worker = workshop.start(&["worker", "--listen", &address, "--lease", "0.1"]);
        worker.wait_until("the worker listens", |own| {
            own.stdout().contains("listening")
        });
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(1)
            .enable_all()
            .build();
        Self {
            workshop,
            worker,
            address,
            runtime: runtime.unwrap(),
        }
    }

    fn connect(&self) -> WorkerClient<Channel> {
        let endpoint = Endpoint::from_shared(self.address.clone()).unwrap();
        WorkerClient::new(self.runtime.block_on(endpoint.connect()).unwrap())
    }

    fn instances(&self) -> Vec<v1::InstanceState> {
        let mut client = self.connect();
        let request = v1::ListInstancesRequest::default();
        let listed = self
            .runtime
            .block_on(within(client.list_instances(request)));
        listed.unwrap().into_inner().instances
    }

    /// Waits until the instance is not computing.
    fn wait_until_idle(&self) {
        let began = Instant::now();
        wait_until("the step ends", || {
            self.instances().iter().all(|own| own.idle > 0.0)
        });
        assert!(began.elapsed() < 3 * SOON, "{:?}", began.elapsed());
    }
}

/// The answer to a call that must not wait for the long one.
async fn within<T>(call: impl Future<Output = T>) -> T {
    let answer = tokio::time::timeout(SOON, call).await;
    answer.expect("no answer beside a long step")
}

fn initialize() -> v1::InitializeRequest {
    let value = |number| v1::Value {
        kind: Some(Kind::Number(number)),
    };
    let parameters = [("m", 1.7), ("inertia", 0.31), ("length", 1.3)];
    v1::InitializeRequest {
        instance: INSTANCE,
        protocol: Some(PROTOCOL),
        model: "pendulum".into(),
        parameters: parameters
            .map(|(name, number)| (name.to_owned(), value(number)))
            .into(),
        inputs: vec!["tip_fx".into()],
        coupling_outputs: vec!["angle".into(), "rate".into()],
        solver: Some(v1::Solver {
            kind: "rk4".into(),
            options: [("step".to_owned(), value(1e-6))].into(),
        }),
        ..Default::default()
    }
}

fn signal() -> v1::Signal {
    v1::Signal {
        input: 0,
        nodes: vec![0.0],
        values: vec![1.0],
    }
}

/// Some thousand internal steps.
fn step(sequence: u64) -> v1::StepRequest {
    v1::StepRequest {
        instance: INSTANCE,
        sequence,
        step: 0.0017,
        signals: vec![signal()],
        ..Default::default()
    }
}

/// Ten million internal steps a hundred times: minutes.
fn long_look(sequence: u64) -> v1::PerturbedStepRequest {
    v1::PerturbedStepRequest {
        instance: INSTANCE,
        sequence,
        step: 9.7,
        signals: vec![signal()],
        perturbed: vec![signal(); 100],
        ..Default::default()
    }
}

fn long_exchange(sequence: u64) -> v1::ExchangeRequest {
    let look = long_look(sequence);
    v1::ExchangeRequest {
        instance: INSTANCE,
        sequence,
        predict: Some(v1::Predict {
            step: look.step,
            signals: look.signals,
            perturbed: look.perturbed,
            ..Default::default()
        }),
        ..Default::default()
    }
}

/// Values of a step from the start, on an instance of a worker that has done nothing else.
fn undisturbed() -> Vec<u64> {
    let house = House::new();
    let mut client = house.connect();
    house.runtime.block_on(async {
        client.initialize(initialize()).await.unwrap();
        values(client.step(step(1)).await.unwrap().into_inner())
    })
}

fn values(reply: v1::StepReply) -> Vec<u64> {
    let outputs = reply.outputs.unwrap();
    outputs.values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn others_are_answered_beside_a_long_step() {
    let house = House::new();
    let (mut busy, mut other) = (house.connect(), house.connect());
    house.runtime.block_on(async {
        busy.initialize(initialize()).await.unwrap();
        let mut same = busy.clone();
        let long = tokio::spawn(async move { busy.perturbed_step(long_look(1)).await });
        tokio::time::sleep(MOMENT).await;
        for client in [&mut same, &mut other] {
            let reply = within(client.describe(v1::DescribeRequest::default())).await;
            assert!(!reply.unwrap().into_inner().models.is_empty());
            let listed = within(client.list_instances(v1::ListInstancesRequest::default())).await;
            assert_eq!(listed.unwrap().into_inner().instances[0].idle, 0.0);
        }
        assert!(!long.is_finished());
    });
    house
        .workshop
        .run(&["health", &house.address, "--timeout", "1"])
        .exits_with(0);
}

/// With the connection open, so that only the call itself tells that nobody waits.
#[test]
fn a_call_that_is_dropped_leaves_the_instance_as_it_was() {
    let house = House::new();
    let mut client = house.connect();
    house.runtime.block_on(async {
        client.initialize(initialize()).await.unwrap();
        let late = tokio::time::timeout(MOMENT, client.perturbed_step(long_look(1))).await;
        assert!(late.is_err(), "the step is not long");
    });
    house.wait_until_idle();
    // The number of the call that was cancelled is free, and the state is that of the start, bit by bit.
    let answer = house.runtime.block_on(client.step(step(1)));
    assert_eq!(values(answer.unwrap().into_inner()), undisturbed());
    // Also behind a short one.
    house.runtime.block_on(async {
        let late = tokio::time::timeout(MOMENT, client.perturbed_step(long_look(2))).await;
        assert!(late.is_err(), "the step is not long");
    });
    house.wait_until_idle();
}

/// The deadline travels with the call.
#[test]
fn a_deadline_that_passes_cancels_the_call() {
    let house = House::new();
    let mut client = house.connect();
    house.runtime.block_on(async {
        client.initialize(initialize()).await.unwrap();
        let mut request = tonic::Request::new(long_look(1));
        request.set_timeout(MOMENT);
        client.perturbed_step(request).await.unwrap_err();
    });
    house.wait_until_idle();
}

/// Of a stream that has sent all it wanted to say, as of one that is open.
#[test]
fn a_stream_that_ends_cancels_its_turn() {
    for is_open in [true, false] {
        let house = House::new();
        let mut client = house.connect();
        house.runtime.block_on(async {
            client.initialize(initialize()).await.unwrap();
            let (sender, requests) = tokio::sync::mpsc::unbounded_channel();
            sender.send(long_exchange(1)).unwrap();
            // Kept until the whole stream is dropped, or dropped before.
            let sender = is_open.then_some(sender);
            let stream = tokio::time::timeout(MOMENT, async {
                let _sender = sender;
                let requests = UnboundedReceiverStream::new(requests);
                let replies = client.exchange(requests).await.unwrap();
                replies.into_inner().message().await
            });
            assert!(stream.await.is_err(), "the step is not long");
        });
        wait_until("the instance is gone", || house.instances().is_empty());
    }
}

#[test]
fn a_connection_that_ends_frees_the_instance() {
    let house = House::new();
    let mut client = house.connect();
    house
        .runtime
        .block_on(client.initialize(initialize()))
        .unwrap();
    let long = house
        .runtime
        .spawn(async move { client.perturbed_step(long_look(1)).await });
    std::thread::sleep(MOMENT);
    long.abort();
    let began = Instant::now();
    wait_until("the instance is gone", || house.instances().is_empty());
    assert!(began.elapsed() < 3 * SOON, "{:?}", began.elapsed());
}

#[test]
fn an_instance_that_is_ended_stops_computing() {
    let house = House::new();
    let (mut busy, mut other) = (house.connect(), house.connect());
    house.runtime.block_on(async {
        busy.initialize(initialize()).await.unwrap();
        let long = tokio::spawn(async move { busy.perturbed_step(long_look(1)).await });
        tokio::time::sleep(MOMENT).await;
        let instance = INSTANCE;
        within(other.terminate(v1::TerminateRequest { instance }))
            .await
            .unwrap();
        let ended = within(long).await.unwrap().unwrap_err();
        assert_eq!(ended.code(), tonic::Code::NotFound, "{ended}");
        // The thread is free again.
        within(other.initialize(initialize())).await.unwrap();
    });
}

#[test]
fn a_worker_ends_in_a_long_step() {
    for is_stream in [false, true] {
        let house = House::new();
        let mut client = house.connect();
        house
            .runtime
            .block_on(client.initialize(initialize()))
            .unwrap();
        let long = house.runtime.spawn(async move {
            match is_stream {
                false => client.perturbed_step(long_look(1)).await.map(drop),
                true => {
                    let requests = tokio_stream::iter([long_exchange(1)]);
                    let requests = requests.chain(tokio_stream::pending());
                    let replies = client.exchange(requests).await?;
                    replies.into_inner().message().await.map(drop)
                }
            }
        });
        std::thread::sleep(MOMENT);
        let began = Instant::now();
        house.worker.send(Signal::TERM);
        house.worker.wait().exits_with(0);
        assert!(began.elapsed() < 2 * SOON, "{:?}", began.elapsed());
        let told = house.runtime.block_on(within(long)).unwrap();
        assert_eq!(told.unwrap_err().code(), tonic::Code::Unavailable);
    }
}

/// The median time of a short step, in seconds.
fn pace(house: &House, client: &mut WorkerClient<Channel>, first: u64, count: u64) -> f64 {
    let mut times: Vec<f64> = (first..first + count)
        .map(|sequence| {
            let began = Instant::now();
            house.runtime.block_on(client.step(step(sequence))).unwrap();
            began.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Who floods has a thread of his own, which shares the processors with the worker.
#[test]
fn a_flood_of_descriptions_does_not_stop_others() {
    let house = House::new();
    let flooding = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(1)
        .enable_all()
        .build()
        .unwrap();
    let endpoint = Endpoint::from_shared(house.address.clone()).unwrap();
    let flood = WorkerClient::new(flooding.block_on(endpoint.connect()).unwrap());
    let mut own = house.connect();
    house
        .runtime
        .block_on(own.initialize(initialize()))
        .unwrap();
    let alone = pace(&house, &mut own, 1, 50);
    let floods: Vec<_> = (0..100)
        .map(|_| {
            let mut flood = flood.clone();
            flooding.spawn(async move {
                loop {
                    // Refusals are as welcome.
                    let _ = flood.describe(v1::DescribeRequest::default()).await;
                }
            })
        })
        .collect();
    std::thread::sleep(MOMENT);
    let beside = pace(&house, &mut own, 51, 50);
    floods.iter().for_each(tokio::task::JoinHandle::abort);
    flooding.shutdown_background();
    println!("alone {alone:.6} s, beside a flood {beside:.6} s");
    assert!(
        beside < 4.0 * alone,
        "{alone} s alone, {beside} s beside a flood"
    );
}
