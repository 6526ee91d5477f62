//! Macro steps of the two-mass oscillator.

use std::time::Duration;

use linchpin::certificates::Wanted;
use linchpin::connect::{Connector, Place};
use linchpin_master::CoSimulation;
use linchpin_master::scene::{Scene, parse};
use linchpin_master::setup::Options;
use linchpin_proto::v1;
use prost::Message;
use tempfile::TempDir;

use crate::process::Process;
use crate::report::Series;

const SCENE: &str = include_str!("../../../scenes/oscillator.toml");

/// Long enough for every block of every round.
const LONG: &str = "scene.t_end=1e5";

/// The messages of one macro step with one worker.
pub struct Messages {
    /// From the master.
    pub request: v1::ExchangeRequest,
    /// From the worker.
    pub reply: v1::ExchangeReply,
}

impl Messages {
    /// The request on the wire.
    pub fn request_bytes(&self) -> Vec<u8> {
        self.request.encode_to_vec()
    }

    /// The reply on the wire.
    pub fn reply_bytes(&self) -> Vec<u8> {
        self.reply.encode_to_vec()
    }
}

fn scene(overrides: &[&str]) -> Scene {
    // Columns in every step: the same work in every block.
    let overrides = [&["coupling.jacobian=every-step"], overrides].concat();
    let overrides: Vec<_> = overrides.iter().map(|text| text.parse().unwrap()).collect();
    parse(SCENE, "oscillator.toml", &overrides).unwrap()
}

struct Running {
    simulation: CoSimulation,
    // Kept: they end the workers.
    _connector: Connector,
    _workers: Vec<Process>,
}

impl Running {
    fn start(scene: &Scene, place: Place, workers: Vec<Process>) -> Self {
        let connector = Connector::new(place);
        let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
        let simulation = CoSimulation::start(scene, &mut connect, &Options::default()).unwrap();
        Self {
            simulation,
            _connector: connector,
            _workers: workers,
        }
    }

    fn series(mut self, name: &'static str) -> Series {
        Series::new(name, move || {
            // All of it is captured, also what is only kept alive.
            let running = &mut self;
            assert!(running.simulation.macro_step().unwrap());
        })
    }
}

/// A free port of this machine, free again when this returns.
pub fn free_port() -> u16 {
    std::net::TcpListener::bind("127.0.0.1:0")
        .unwrap()
        .local_addr()
        .unwrap()
        .port()
}

/// Two workers at ports of their own, and the settings of a scene that name them.
fn tcp_workers(scheme: &str, flags: &[&str]) -> ([Process; 2], [String; 2]) {
    let ports = [free_port(), free_port()];
    let workers = ports.map(|port| {
        let address = format!("127.0.0.1:{port}");
        let command = ["worker", "--exit-with-stdin", "--listen", &address];
        Process::start(&[&command[..], flags].concat())
    });
    let address = |number: usize| {
        let port = ports[number - 1];
        format!("subsystem.mass{number}.address={scheme}://127.0.0.1:{port}")
    };
    (workers, [1, 2].map(address))
}

/// A folder of certificates, which goes when the workers have read it.
fn certificates() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let wanted = Wanted {
        scene: "oscillator".into(),
        workers: [("mass1".into(), vec!["127.0.0.1".into()])].into(),
        lifetime: Duration::from_secs(86_400),
    };
    wanted.make(folder.path(), None).unwrap();
    folder
}

/// All ways of a macro step.
pub fn all() -> Vec<Series> {
    let plain = scene(&[LONG]);
    let unary = scene(&[LONG, "subsystem.*.calls=unary"]);
    let unprotected = scene(&[LONG, "run.recoveries=0"]);
    let (tcp_workers, addresses) = tcp_workers("http", &[]);
    let tcp = scene(&[LONG, &addresses[0], &addresses[1]]);
    let certificates = certificates();
    let folder = |name: &str| certificates.path().join(name).display().to_string();
    let flags = ["--certificates", &folder("workers/mass1")];
    let (tls_workers, addresses) = self::tcp_workers("https", &flags);
    let own = format!("security.certificates={}", folder("master"));
    let tls = scene(&[LONG, &own, &addresses[0], &addresses[1]]);
    vec![
        Running::start(&plain, Place::InProcess, Vec::new()).series("macro step, in process"),
        Running::start(&plain, Place::Processes, Vec::new())
            .series("macro step, 2 processes, stream, Unix sockets"),
        Running::start(&unprotected, Place::Processes, Vec::new())
            .series("the same without recovery"),
        Running::start(&tcp, Place::Processes, tcp_workers.into())
            .series("macro step, 2 processes, stream, TCP"),
        Running::start(&tls, Place::Processes, tls_workers.into())
            .series("macro step, 2 processes, stream, TCP with TLS"),
        Running::start(&unary, Place::Processes, Vec::new())
            .series("macro step, 2 processes, unary calls, Unix sockets"),
    ]
}

/// The messages that one macro step exchanges with one worker.
pub fn messages() -> Messages {
    let scene = scene(&[LONG]);
    let mut running = Running::start(&scene, Place::InProcess, Vec::new());
    for _ in 0..10 {
        running.simulation.macro_step().unwrap();
    }
    let (request, reply) = running.simulation.last_messages(0).unwrap();
    Messages {
        request: request.clone(),
        reply: reply.clone(),
    }
}
