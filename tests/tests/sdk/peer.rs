//! A worker as its master reaches it.

use std::os::unix::net::UnixStream;
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::Duration;

use linchpin_master::Interrupt;
use linchpin_master::connection::{
    Access, Connection, ExchangeStream, Grpc, TimeLimits, new_runtime,
};
use linchpin_models::models;
use linchpin_proto::contract::{CallError, Contract};
use linchpin_proto::v1;
use linchpin_tests::python::{Program, in_repository};
use linchpin_worker::Host;
use linchpin_worker::host::Limits;
use linchpin_worker::server::{Address, Reach, Server};
use tempfile::TempDir;
use tokio::sync::oneshot;

use crate::stand::Stand;
use crate::tank::Tank;

/// How a test reaches its worker.
pub type Serve = fn(Arc<dyn Contract>) -> Peer;

/// The built-in models, the stand and the tank, with the default limits.
pub fn host() -> Arc<Host> {
    host_with(Limits::default())
}

/// The built-in models, the stand and the tank.
pub fn host_with(limits: Limits) -> Arc<Host> {
    let mut all = models();
    all.push(Box::new(Stand));
    all.push(Box::new(Tank));
    Arc::new(Host::with_limits(all, limits))
}

/// A worker, and what it lives in.
pub struct Peer {
    calls: Arc<dyn Contract>,
    _lives_in: Home,
}

/// What a worker lives in, which ends with the peer.
enum Home {
    Process,
    Server { _server: Served },
    Python { _program: Program, _folder: TempDir },
}

impl Peer {
    pub fn in_process(contract: Arc<dyn Contract>) -> Self {
        Self {
            calls: contract,
            _lives_in: Home::Process,
        }
    }

    pub fn over_grpc(contract: Arc<dyn Contract>) -> Self {
        let server = Served::start(contract);
        Self {
            calls: Arc::new(Remote::connect(&server.address)),
            _lives_in: Home::Server { _server: server },
        }
    }

    /// A worker of the Python SDK in the place of the one that is given; it has an oscillator, a tank and a stand.
    pub fn in_python(_: Arc<dyn Contract>) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let models = in_repository("worker/python/tests/models.py");
        let package = in_repository("worker/python/src");
        let program = Program::start(&models, &package, &folder.path().join("worker.sock"));
        Self {
            calls: Arc::new(Remote::connect(program.address())),
            _lives_in: Home::Python {
                _program: program,
                _folder: folder,
            },
        }
    }

    /// The worker as it is reached.
    pub fn calls(&self) -> Arc<dyn Contract> {
        Arc::clone(&self.calls)
    }
}

/// A server on a Unix socket that runs on a thread of its own. Dropping it shuts it down.
pub struct Served {
    pub address: String,
    stop: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<()>>,
    folder: Arc<TempDir>,
}

impl Served {
    pub fn start(contract: Arc<dyn Contract>) -> Self {
        Self::start_in(Arc::new(tempfile::tempdir().unwrap()), contract)
    }

    /// A server at the same address, as soon as this one has given it up after [`Served::stop`].
    pub fn successor(&self, contract: Arc<dyn Contract>) -> Self {
        let socket = self.address.trim_start_matches("unix:");
        while UnixStream::connect(socket).is_ok() {
            std::thread::sleep(Duration::from_millis(1));
        }
        Self::start_in(Arc::clone(&self.folder), contract)
    }

    fn start_in(folder: Arc<TempDir>, contract: Arc<dyn Contract>) -> Self {
        let socket = Address::Unix(folder.path().join("worker.sock"));
        let address = socket.to_string();
        let (stop, stopped) = oneshot::channel();
        let (listening, listens) = std::sync::mpsc::channel();
        let thread = std::thread::spawn(move || {
            let runtime = new_runtime().unwrap();
            runtime.block_on(async {
                let server = Server::bind(contract, socket, Reach::Local).await.unwrap();
                listening.send(()).unwrap();
                let shutdown = async move { drop(stopped.await) };
                server.serve(shutdown).await.unwrap();
            });
        });
        listens.recv().unwrap();
        Self {
            address,
            stop: Some(stop),
            thread: Some(thread),
            folder,
        }
    }

    /// Asks the server to stop, without waiting for that.
    pub fn stop(&mut self) {
        drop(self.stop.take());
    }

    /// Waits until the server has ended after [`Served::stop`].
    pub fn wait(&mut self) {
        if let Some(thread) = self.thread.take() {
            thread.join().unwrap();
        }
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.stop();
        self.wait();
    }
}

/// A worker behind gRPC: unary calls, and exchanges over one stream.
pub struct Remote {
    grpc: Grpc,
    stream: Mutex<Option<ExchangeStream>>,
}

impl Remote {
    pub fn connect(address: &str) -> Self {
        Self {
            grpc: grpc(address),
            stream: Mutex::new(Some(ExchangeStream::new(grpc(address)))),
        }
    }

    /// Ends the exchange stream with its connection, and no other call.
    pub fn close_stream(&self) {
        drop(self.stream.lock().unwrap().take());
    }
}

/// A client of its own for the unary calls.
pub fn grpc(address: &str) -> Grpc {
    let limits = TimeLimits {
        start: Duration::from_secs(5),
        answer: Duration::from_secs(10),
    };
    Grpc::connect(
        address,
        limits,
        &Access::default(),
        new_runtime().unwrap(),
        Interrupt::default(),
    )
    .unwrap()
}

impl Contract for Remote {
    fn describe(&self, request: &v1::DescribeRequest) -> Result<v1::DescribeReply, CallError> {
        self.grpc.describe(request)
    }

    fn initialize(
        &self,
        request: &v1::InitializeRequest,
    ) -> Result<v1::InitializeReply, CallError> {
        self.grpc.initialize(request)
    }

    fn snapshot(&self, request: &v1::SnapshotRequest) -> Result<v1::SnapshotReply, CallError> {
        self.grpc.snapshot(request)
    }

    fn restore(&self, request: &v1::RestoreRequest) -> Result<v1::RestoreReply, CallError> {
        self.grpc.restore(request)
    }

    fn export_state(
        &self,
        request: &v1::ExportStateRequest,
    ) -> Result<v1::ExportStateReply, CallError> {
        self.grpc.export_state(request)
    }

    fn import_state(
        &self,
        request: &v1::ImportStateRequest,
    ) -> Result<v1::ImportStateReply, CallError> {
        self.grpc.import_state(request)
    }

    fn step(&self, request: &v1::StepRequest) -> Result<v1::StepReply, CallError> {
        self.grpc.step(request)
    }

    fn perturbed_step(
        &self,
        request: &v1::PerturbedStepRequest,
    ) -> Result<v1::PerturbedStepReply, CallError> {
        self.grpc.perturbed_step(request)
    }

    fn evaluate(&self, request: &v1::EvaluateRequest) -> Result<v1::EvaluateReply, CallError> {
        self.grpc.evaluate(request)
    }

    fn terminate(&self, request: &v1::TerminateRequest) -> Result<v1::TerminateReply, CallError> {
        self.grpc.terminate(request)
    }

    fn list_instances(
        &self,
        request: &v1::ListInstancesRequest,
    ) -> Result<v1::ListInstancesReply, CallError> {
        self.grpc.list_instances(request)
    }

    fn exchange(
        &self,
        request: &v1::ExchangeRequest,
        reply: &mut v1::ExchangeReply,
    ) -> Result<(), CallError> {
        let mut stream = self.stream.lock().unwrap();
        let stream = stream.as_mut().unwrap();
        stream.post(request)?;
        stream.collect(reply)
    }
}
