//! What a master says of a worker that it does not trust, or that does not trust it.

use std::net::TcpListener;
use std::time::Duration;

use linchpin_tests::process::{Outcome, Workshop};
use rustls::{ServerConnection, StreamOwned};

use crate::authority::{Authority, Own, server, write};
use crate::{Worker, certified};

/// A server that shows a certificate to whoever comes.
fn showing(own: &Own) -> String {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = format!("https://{}", listener.local_addr().unwrap());
    let config = server(own);
    std::thread::spawn(move || {
        for socket in listener.incoming().flatten() {
            let connection = ServerConnection::new(config.clone()).unwrap();
            let mut stream = StreamOwned::new(connection, socket);
            // It fails, which the other end tells.
            let _ = stream.conn.complete_io(&mut stream.sock);
        }
    });
    address
}

fn ask(workshop: &Workshop, address: &str, certificates: &str) -> Outcome {
    workshop.run(&["describe", address, "--certificates", certificates])
}

/// Told at once: what is not trusted now will not be trusted in some seconds.
#[track_caller]
fn refuses(outcome: &Outcome, address: &str, words: &[&str]) {
    outcome
        .fails(1, &[&[address], words].concat())
        .takes_less_than(Duration::from_secs(3));
}

#[test]
fn certificates_of_workers_that_are_not_good() {
    let workshop = Workshop::new();
    let (authority, stranger) = (Authority::new(), Authority::new());
    let master = authority.master(1);
    write(&workshop.path().join("master"), &authority.pem(), &master);
    for (own, words) in [
        (
            authority.worker(&["127.0.0.1"], -2),
            &["has expired 2.0 days ago", "make new ones"][..],
        ),
        (
            stranger.worker(&["127.0.0.1"], 1),
            &["from another authority than ca.crt"],
        ),
        (
            authority.worker(&["node7", "10.0.0.7"], 1),
            &["not for the name 127.0.0.1", "node7", "10.0.0.7"],
        ),
        (authority.master(1), &["is for the other end"]),
    ] {
        let address = showing(&own);
        refuses(&ask(&workshop, &address, "master"), &address, words);
    }
}

#[test]
fn a_worker_that_refuses_its_master_says_why() {
    let workshop = certified();
    let worker = Worker::start(&workshop.path().join("certificates/workers/mass1"));
    // A master of another set that trusts the worker all the same.
    let stranger = Authority::new();
    let own = workshop.read("certificates/master/ca.crt") + &stranger.pem();
    let folder = workshop.path().join("stranger");
    write(&folder, &own, &stranger.master(1));
    for command in ["describe", "instances", "health", "conformance"] {
        let arguments = [command, &worker.address, "--certificates", "stranger"];
        let outcome = workshop.run(&arguments);
        refuses(
            &outcome,
            &worker.address,
            &[
                "refuses the certificate of this master",
                "another authority",
            ],
        );
    }
    ask(&workshop, &worker.address, "certificates/master").exits_with(0);
}

#[test]
fn one_end_speaks_tls_and_the_other_does_not() {
    let workshop = certified();
    let plain = Worker::start_with(&[]);
    let address = plain.address.replace("http:", "https:");
    let outcome = ask(&workshop, &address, "certificates/master");
    refuses(&outcome, &address, &["it speaks plain text", "http://"]);
    ask(&workshop, &plain.address, "certificates/master").exits_with(0);

    let encrypted = Worker::start(&workshop.path().join("certificates/workers/mass1"));
    let address = encrypted.address.replace("https:", "http:");
    for command in ["describe", "health", "instances"] {
        let outcome = workshop.run(&[command, &address]);
        refuses(&outcome, &address, &["it speaks TLS", "https://"]);
    }
    encrypted.wait_for("it does not speak TLS");
    let nobody = workshop.run(&["describe", &encrypted.address]);
    refuses(
        &nobody,
        &encrypted.address,
        &["takes certificates", "--certificates"],
    );
}

/// Both ends look at what they will show before anybody refuses it.
#[test]
fn own_certificates_that_nobody_would_accept() {
    let workshop = Workshop::new();
    let (authority, stranger) = (Authority::new(), Authority::new());
    let folder = |name: &str| workshop.path().join(name);
    let listen = ["worker", "--exit-with-stdin", "--certificates"];
    let worker = |name: &str| workshop.run(&[&listen[..], &[name]].concat());
    let master = |name: &str| ask(&workshop, "https://127.0.0.1:9", name);

    write(
        &folder("expired"),
        &authority.pem(),
        &authority.worker(&["h"], -1),
    );
    worker("expired").fails(
        1,
        &["expired/tls.crt", "has expired", "linchpin certificates"],
    );
    write(
        &folder("strange"),
        &authority.pem(),
        &stranger.worker(&["h"], 1),
    );
    worker("strange").fails(1, &["another authority"]);
    write(&folder("other"), &authority.pem(), &authority.master(1));
    worker("other").fails(1, &["a worker", "for the other end"]);
    write(&folder("late"), &authority.pem(), &authority.master(-1));
    master("late").fails(1, &["late/tls.crt", "a master", "has expired"]);
    let mixed = Own {
        key: stranger.master(1).key,
        ..authority.master(1)
    };
    write(&folder("mixed"), &authority.pem(), &mixed);
    master("mixed").fails(1, &["mixed/tls.crt"]);

    write(&folder("gone"), &authority.pem(), &authority.master(1));
    std::fs::remove_file(folder("gone/tls.key")).unwrap();
    master("gone").fails(1, &["gone/tls.key", "ca.crt, tls.crt and tls.key"]);
    write(&folder("text"), "no certificate", &authority.master(1));
    master("text").fails(1, &["text/ca.crt", "no certificate in it", "PEM"]);
    std::fs::write(folder("text/ca.crt"), authority.pem()).unwrap();
    std::fs::write(folder("text/tls.key"), "no key").unwrap();
    master("text").fails(1, &["text/tls.key", "no key in it"]);
}
