//! Addresses that `linchpin worker` cannot listen on.

use std::net::TcpListener;
use std::os::unix::net::UnixListener;

use linchpin_tests::process::{Running, Workshop};
use rustix::process::Signal;

fn listen(address: &str) -> [&str; 3] {
    ["worker", "--listen", address]
}

/// A worker that listens at the address it prints.
fn listening(workshop: &Workshop, address: &str) -> Running {
    let mut worker = workshop.start(&listen(address));
    worker.wait_until("an address", |worker| {
        worker.stdout().contains("listening on ")
    });
    worker
}

#[test]
fn a_port_in_use() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap().to_string();
    Workshop::new()
        .run(&listen(&address))
        .fails(1, &[&address, "in use", "port 0"]);
}

#[test]
fn an_address_that_others_can_reach() {
    let workshop = Workshop::new();
    for address in ["0.0.0.0:0", "[::]:0"] {
        workshop
            .run(&listen(address))
            .fails(1, &[address, "other machines", "--plain-text"]);
    }
}

#[test]
fn text_that_is_no_address() {
    let workshop = Workshop::new();
    for address in [
        "localhost:50051",
        "http://127.0.0.1:0",
        "unix:relative.sock",
        "127.0.0.1",
    ] {
        workshop
            .run(&listen(address))
            .fails(2, &[address, "127.0.0.1:50051", "unix:/PATH"]);
    }
}

#[test]
fn paths_that_can_hold_no_socket() {
    let workshop = Workshop::new();
    let path = |name: &str| format!("unix:{}", workshop.path().join(name).display());
    workshop
        .run(&listen(&path("missing/worker.sock")))
        .fails(1, &["missing", "make the folder"]);
    workshop.write("notes.txt", "keep me");
    workshop
        .run(&listen(&path("notes.txt")))
        .fails(1, &["notes.txt", "is no socket", "another path"]);
    assert_eq!(workshop.read("notes.txt"), "keep me");
    let long = "x".repeat(120);
    workshop
        .run(&listen(&path(&long)))
        .fails(1, &[&long, "107 bytes", "shorter path"]);
}

#[test]
fn a_stale_socket_is_taken_over_and_a_living_one_is_not() {
    let workshop = Workshop::new();
    let path = workshop.path().join("worker.sock");
    drop(UnixListener::bind(&path).unwrap());
    assert!(path.exists(), "a listener that is gone leaves its file");
    let address = format!("unix:{}", path.display());
    let first = listening(&workshop, &address);
    let elsewhere = Workshop::new();
    elsewhere
        .run(&listen(&address))
        .fails(1, &[&address, "in use", "another path"]);
    first.send(Signal::TERM);
    first.wait().succeeds();
    assert!(!path.exists(), "a worker that ends takes its socket along");
}

#[test]
fn a_worker_ends_with_whoever_started_it_if_asked() {
    let workshop = Workshop::new();
    workshop.run(&["worker", "--exit-with-stdin"]).succeeds();
}

#[test]
fn a_worker_that_may_have_no_instance() {
    let workshop = Workshop::new();
    let outcome = workshop.run(&["worker", "--exit-with-stdin", "--max-instances", "0"]);
    outcome.fails(2, &["--max-instances", "1.."]);
}
