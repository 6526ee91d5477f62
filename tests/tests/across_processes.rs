//! The same scene in one process, in several, over sockets and over TCP: results.csv is equal byte by byte.

#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;

use linchpin_proto::v1::ProtocolVersion;
use linchpin_tests::process::{Peer, Running, Workshop};
use rustix::process::Signal;

/// One case for every method, index and degree that is stable, with a macro step that does not divide the time.
const SCENE: &str = r#"
[scene]
name = "masses"
t_end = 0.05

[coupling]
method = "baumgarte"
macro_step = 7e-4

[[subsystem]]
name = "mass1"
model = "oscillator"
parameters = { m = 1.3, c = 1.7e3, d = 10.3, x0 = 0.01, v0 = 97.0 }

[[subsystem]]
name = "mass2"
model = "oscillator"
parameters = { m = 2.1, c = 930.0, d = 4.7, x0 = 0.01, v0 = 97.0 }

[[joint]]
name = "link"
kind = "rigid-link"
a = "mass1"
b = "mass2"
"#;

const MACRO_STEPS: usize = 72;

const EXACT: &str = r#"{ kind = "exact" }"#;
const RADAU5: &str = r#"{ kind = "radau5" }"#;
const RK4: &str = r#"{ kind = "rk4", step = 1e-4 }"#;

/// Coupling settings, and the solver of all masses.
const CASES: [(&str, &str); 27] = [
    ("method=baumgarte index=1 degree=0", EXACT),
    ("method=baumgarte index=1 degree=1", EXACT),
    ("method=baumgarte index=1 degree=2", EXACT),
    ("method=baumgarte index=1 degree=3", EXACT),
    ("method=baumgarte index=2 degree=0", EXACT),
    ("method=baumgarte index=3 degree=0", EXACT),
    ("method=weighted index=1 degree=0", EXACT),
    ("method=weighted index=1 degree=1", EXACT),
    ("method=weighted index=1 degree=2", EXACT),
    ("method=weighted index=1 degree=3", EXACT),
    ("method=weighted index=2 degree=0", EXACT),
    ("method=explicit mu=10H", EXACT),
    ("method=penalty stiffness=3e4 damping=20 degree=1", EXACT),
    (
        "method=penalty order=gauss-seidel stiffness=3e4 damping=20 degree=1",
        EXACT,
    ),
    ("method=hermite", EXACT),
    ("method=hermite degree=4 moments=integrals", EXACT),
    ("method=hermite degree=3 moments=integrals", RADAU5),
    ("method=hermite degree=3 moments=integrals", RK4),
    ("method=baumgarte index=1 degree=0", RADAU5),
    ("method=baumgarte index=1 degree=3", RADAU5),
    ("method=baumgarte index=2 degree=0", RADAU5),
    ("method=baumgarte index=3 degree=0", RADAU5),
    ("method=weighted index=1 degree=2", RADAU5),
    ("method=explicit mu=10H", RADAU5),
    ("method=penalty stiffness=3e4 damping=20 degree=2", RADAU5),
    (
        "method=penalty order=gauss-seidel stiffness=3e4 damping=20 degree=0",
        RADAU5,
    ),
    ("method=weighted index=1 degree=1", RK4),
];

fn scene() -> String {
    let mut text = SCENE.to_owned();
    for (number, (settings, solver)) in CASES.iter().enumerate() {
        let coupling = settings.split(' ').map(|setting| {
            let (key, value) = setting.split_once('=').unwrap();
            let is_text = matches!(key, "method" | "mu" | "order" | "moments");
            let value = if is_text {
                format!("{value:?}")
            } else {
                value.to_owned()
            };
            format!("\"coupling.{key}\" = {value}, ")
        });
        text += &format!(
            "[[case]]\nname = \"{number}\"\nset = {{ {}\"subsystem.*.solver\" = {solver} }}\n",
            coupling.collect::<String>()
        );
    }
    text
}

/// Tables of results by case.
type Tables = BTreeMap<usize, String>;

/// Runs all cases; every subsystem must have taken `route`.
fn run(workshop: &Workshop, name: &str, route: &str, arguments: &[&str]) -> Tables {
    workshop.write("scene.toml", scene());
    let mut all = vec!["run", "scene.toml", "--out", name, "--no-plots", "--quiet"];
    all.extend(arguments);
    workshop.run(&all).succeeds();
    let read = |number: usize| {
        let run = workshop.read(&format!("{name}/{number}/run.json"));
        let run: serde_json::Value = serde_json::from_str(&run).unwrap();
        for subsystem in run["statistics"]["subsystems"].as_array().unwrap() {
            assert_eq!(subsystem["route"], route, "{name}");
        }
        (
            number,
            workshop.read(&format!("{name}/{number}/results.csv")),
        )
    };
    (0..CASES.len()).map(read).collect()
}

/// The tables of a run in one process, each told from the others.
fn in_process(workshop: &Workshop) -> Tables {
    let tables = run(workshop, "in-process", "in process", &["--in-process"]);
    for (number, table) in &tables {
        assert_eq!(
            table.lines().count(),
            1 + 1 + MACRO_STEPS,
            "{:?}",
            CASES[*number]
        );
        assert!(
            table.lines().last().unwrap().starts_with("0.05,"),
            "{:?}",
            CASES[*number]
        );
        let twin = tables
            .iter()
            .find(|(other, text)| *other != number && *text == table);
        assert!(
            twin.is_none(),
            "{:?} equals {:?}",
            CASES[*number],
            twin.map(|twin| CASES[*twin.0])
        );
    }
    tables
}

#[track_caller]
fn assert_equal(tables: &Tables, expected: &Tables) {
    for (number, table) in tables {
        assert!(
            *table == expected[number],
            "{:?}:\n{table}\n{}",
            CASES[*number],
            expected[number]
        );
    }
    assert_eq!(tables.len(), expected.len());
}

/// A worker that a user started.
struct Worker {
    running: Running,
    address: String,
    _workshop: Workshop,
}

impl Worker {
    fn start(arguments: &[&str]) -> Self {
        let workshop = Workshop::new();
        let mut all = vec!["worker"];
        all.extend(arguments);
        let mut running = workshop.start(&all);
        let announced = |worker: &Running| {
            let said = worker.stdout();
            Some(
                said.strip_prefix("listening on ")?
                    .strip_suffix('\n')?
                    .to_owned(),
            )
        };
        running.wait_until("an address", |worker| announced(worker).is_some());
        let address = announced(&running).unwrap();
        Self {
            running,
            address,
            _workshop: workshop,
        }
    }

    fn serves(&self, subsystem: &str) -> String {
        format!("subsystem.{subsystem}.address={:?}", self.address)
    }

    fn end(self) {
        self.running.send(Signal::TERM);
        self.running.wait().succeeds();
    }
}

const TCP: [&str; 2] = ["--listen", "127.0.0.1:0"];

#[test]
fn one_thread_for_each_subsystem() {
    let workshop = Workshop::new();
    let threads = run(
        &workshop,
        "threads",
        "in process, own thread",
        &["--in-process", "--threads"],
    );
    assert_equal(&threads, &in_process(&workshop));
}

#[test]
fn worker_processes_on_unix_sockets() {
    let workshop = Workshop::new();
    let expected = in_process(&workshop);
    assert_equal(
        &run(&workshop, "default", "exchange stream", &[]),
        &expected,
    );
    let unary = ["--set", "subsystem.*.calls=unary"];
    assert_equal(&run(&workshop, "unary", "unary calls", &unary), &expected);
}

#[test]
fn unary_calls_in_one_process() {
    let workshop = Workshop::new();
    let unary = ["--in-process", "--set", "subsystem.*.calls=unary"];
    let unary = run(&workshop, "unary", "in process, unary calls", &unary);
    assert_equal(&unary, &in_process(&workshop));
}

/// The same workers serve all cases, one after the other, by exchange and by unary calls.
/// An exchange stream of the first protocol would pass over parts of a request.
#[test]
fn a_stream_that_lacks_parts_gives_way_to_unary_calls() {
    let workshop = Workshop::new();
    let first = ProtocolVersion { major: 1, minor: 0 };
    let peer = Peer::scripted(&workshop, |peer| peer.speaking(first));
    let setting = format!("subsystem.*.address={}", peer.address());
    let tables = run(&workshop, "older", "unary calls", &["--set", &setting]);
    assert_equal(&tables, &in_process(&workshop));
}

#[test]
fn workers_started_by_hand_on_tcp() {
    let workshop = Workshop::new();
    let expected = in_process(&workshop);
    let workers = [Worker::start(&TCP), Worker::start(&TCP)];
    let addresses = [workers[0].serves("mass1"), workers[1].serves("mass2")];
    assert!(
        addresses
            .iter()
            .all(|address| address.contains("http://127.0.0.1:")),
        "{addresses:?}"
    );
    let mut arguments = vec!["--set", &addresses[0], "--set", &addresses[1]];
    assert_equal(
        &run(&workshop, "tcp", "exchange stream", &arguments),
        &expected,
    );
    arguments.extend(["--set", "subsystem.*.calls=unary"]);
    assert_equal(
        &run(&workshop, "unary", "unary calls", &arguments),
        &expected,
    );
    for worker in workers {
        worker.end();
    }
}

#[test]
fn two_subsystems_in_one_worker() {
    let workshop = Workshop::new();
    let expected = in_process(&workshop);
    let folder = tempfile::tempdir().unwrap();
    let socket = format!("unix:{}", folder.path().join("worker.sock").display());
    for arguments in [
        &TCP[..],
        &["--listen", "127.0.0.1:0", "--threads", "3"],
        &["--listen", &socket],
    ] {
        let worker = Worker::start(arguments);
        let addresses = [worker.serves("mass1"), worker.serves("mass2")];
        let arguments = ["--set", &addresses[0], "--set", &addresses[1]];
        assert_equal(
            &run(&workshop, "together", "exchange stream", &arguments),
            &expected,
        );
        worker.end();
    }
}

/// One mass behind an exchange stream, the other behind unary calls on a thread of its own.
#[test]
fn subsystems_that_are_reached_differently() {
    let workshop = Workshop::new();
    let expected = in_process(&workshop);
    workshop.write("scene.toml", scene());
    let worker = Worker::start(&TCP);
    let [address, calls] = [
        worker.serves("mass2"),
        "subsystem.mass2.calls=unary".to_owned(),
    ];
    let arguments = [
        "run",
        "scene.toml",
        "--out",
        "mixed",
        "--no-plots",
        "--quiet",
        "--set",
        &address,
        "--set",
        &calls,
    ];
    workshop.run(&arguments).succeeds();
    for (number, table) in &expected {
        assert_eq!(
            &workshop.read(&format!("mixed/{number}/results.csv")),
            table,
            "{:?}",
            CASES[*number]
        );
    }
    worker.end();
}
