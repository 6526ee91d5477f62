//! Workers that cannot be reached or started.

use std::net::TcpListener;
use std::time::Duration;

use linchpin_proto::v1::ProtocolVersion;
use linchpin_tests::process::Peer;

use crate::{exists, run, served_by, workshop};

const IMPATIENT: [&str; 4] = [
    "--set",
    "run.start_timeout=0.3",
    "--set",
    "run.deadline=0.3",
];

#[test]
fn an_address_where_nobody_answers() {
    let workshop = served_by("address = \"http://127.0.0.1:9\"");
    let outcome = workshop.run(&run(&IMPATIENT));
    outcome.fails(
        1,
        &[
            "mass1",
            "http://127.0.0.1:9",
            "refused",
            "is the worker running",
        ],
    );
    outcome.takes_less_than(Duration::from_secs(3));
    assert!(!exists(&workshop, "out/results.csv"));
}

#[test]
fn an_address_where_something_else_keeps_silent() {
    let silent = TcpListener::bind("127.0.0.1:0").unwrap();
    let workshop = served_by(&format!(
        "address = \"http://{}\"",
        silent.local_addr().unwrap()
    ));
    let outcome = workshop.run(&run(&IMPATIENT));
    outcome
        .fails(1, &["mass1", "within 0.3 s", "linchpin.v1"])
        .takes_less_than(Duration::from_secs(3));
}

#[test]
fn an_address_where_something_else_answers() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let workshop = served_by(&format!(
        "address = \"http://{}\"",
        listener.local_addr().unwrap()
    ));
    std::thread::spawn(move || {
        use std::io::Write;
        for stream in listener.incoming() {
            // Who is asked for a scene closes the connection early.
            let _ = stream
                .unwrap()
                .write_all(b"HTTP/1.1 400 Bad Request\r\n\r\n");
        }
    });
    let outcome = workshop.run(&run(&IMPATIENT));
    outcome
        .fails(1, &["mass1", "linchpin.v1"])
        .takes_less_than(Duration::from_secs(3));
}

#[test]
fn a_command_that_never_listens() {
    let workshop = served_by(
        "command = [\"sh\", \"-c\", \"echo reading the mesh >&2; sleep 1000; true\", \"{address}\"]",
    );
    let outcome = workshop.run(&run(&IMPATIENT));
    let words = [
        "mass1",
        "0.3 s",
        "--listen",
        "run.start_timeout",
        "reading the mesh",
    ];
    outcome
        .fails(1, &words)
        .takes_less_than(Duration::from_secs(3));
}

#[test]
fn a_command_that_does_not_exist() {
    let workshop = served_by("command = [\"no-such-worker\", \"--fast\"]");
    workshop.run(&run(&[])).fails(
        1,
        &["mass1", "`no-such-worker --fast`", "No such file", "PATH"],
    );
}

#[test]
fn a_command_that_is_not_executable() {
    let workshop = served_by("command = [\"./scene.toml\"]");
    workshop
        .run(&run(&[]))
        .fails(1, &["mass1", "`./scene.toml`", "denied"]);
}

#[test]
fn a_command_that_ends_at_once() {
    let workshop =
        served_by("command = [\"sh\", \"-c\", \"echo the licence has expired >&2; exit 3\"]");
    let outcome = workshop.run(&run(&[]));
    outcome.fails(1, &["mass1", "exit status: 3", "the licence has expired"]);
    outcome.takes_less_than(Duration::from_secs(3));
}

#[test]
fn a_worker_of_another_protocol() {
    let workshop = workshop(&[]);
    let other = ProtocolVersion { major: 2, minor: 0 };
    let peer = Peer::scripted(&workshop, |peer| peer.speaking(other));
    let address = peer.address();
    let setting = format!("subsystem.mass2.address={address}");
    workshop
        .run(&run(&["--set", &setting]))
        .fails(1, &["mass2", "speaks linchpin 1.4", "speaks 2.0"]);
    let described = workshop.run(&["describe", address]);
    described
        .fails(1, &[address, "speaks linchpin 1.4", "speaks 2.0"])
        .prints(&["protocol linchpin 2.0"]);
}

#[test]
fn socket_paths_that_are_too_long() {
    let name = "m".repeat(110);
    let workshop = workshop(&[
        ("\"mass1\"", &format!("\"{name}\"")),
        ("\"mass1\"", &format!("\"{name}\"")),
    ]);
    workshop
        .run(&run(&[]))
        .fails(1, &[&name, "107 bytes", "shorter name", "TMPDIR"]);
}

#[test]
fn no_place_for_sockets() {
    let workshop = workshop(&[]);
    let mut command = workshop.command(&run(&[]));
    command.env("TMPDIR", workshop.path().join("missing"));
    workshop
        .start_command(command)
        .wait()
        .fails(1, &["mass1", "missing", "TMPDIR"]);
}
