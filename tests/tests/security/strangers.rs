//! What knocks at a worker with certificates and is none of its masters: refused, logged, and no harm to the others.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::time::{Duration, Instant};

use linchpin_tests::process::Workshop;
use rustls::pki_types::ServerName;
use rustls::{ClientConfig, ClientConnection, StreamOwned};

use crate::authority::{Authority, Own, client, write};
use crate::{Worker, certified};

/// A worker of an authority of our own, and a master that it serves.
struct House {
    workshop: Workshop,
    authority: Authority,
    worker: Worker,
}

impl House {
    fn new() -> Self {
        let workshop = Workshop::new();
        let authority = Authority::new();
        let folder = |name: &str, own: &Own| {
            let folder = workshop.path().join(name);
            write(&folder, &authority.pem(), own);
            folder
        };
        folder("master", &authority.master(1));
        let worker = folder("worker", &authority.worker(&["127.0.0.1"], 1));
        let worker = Worker::start(&worker);
        Self {
            workshop,
            authority,
            worker,
        }
    }

    fn knock(&self) -> TcpStream {
        let socket = TcpStream::connect(("127.0.0.1", self.worker.port())).unwrap();
        socket
            .set_read_timeout(Some(Duration::from_secs(20)))
            .unwrap();
        socket
    }

    /// What a client is told that shows this certificate.
    fn told(&self, own: Option<&Own>) -> String {
        told(self.knock(), client(&self.authority.pem(), own))
    }

    fn serves_its_master(&self) {
        let address = &self.worker.address;
        let ask = ["health", address, "--certificates", "master"];
        let health = self.workshop.run(&ask);
        assert_eq!(health.exits_with(0).stdout, "serving\n");
    }
}

/// Under TLS 1.3 a client is done before the server has looked at its certificate: it is told at its first read.
fn told(socket: TcpStream, config: Arc<ClientConfig>) -> String {
    let name = ServerName::try_from("127.0.0.1").unwrap();
    let connection = ClientConnection::new(config, name).unwrap();
    let mut stream = StreamOwned::new(connection, socket);
    let said = stream.write_all(b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n");
    let heard = said.and_then(|()| stream.read(&mut [0; 64]));
    heard.map_or_else(|error| error.to_string(), |bytes| format!("{bytes} bytes"))
}

#[test]
fn certificates_that_are_not_those_of_a_master() {
    let house = House::new();
    let stranger = Authority::new();
    for (own, alert, logged) in [
        (None, "CertificateRequired", "it shows no certificate"),
        (
            Some(house.authority.master(-1)),
            "CertificateExpired",
            "its certificate has expired 1.0 days ago",
        ),
        (
            // Another authority of the same name.
            Some(stranger.master(1)),
            "DecryptError",
            "its certificate is from another authority",
        ),
        (
            Some(house.authority.worker(&["127.0.0.1"], 1)),
            "UnsupportedCertificate",
            "its certificate is for the other end",
        ),
    ] {
        let told = house.told(own.as_ref());
        assert!(told.contains(alert), "{alert}: {told}");
        // Not more than a line a second is logged.
        std::thread::sleep(Duration::from_millis(1100));
        house.told(own.as_ref());
        house.worker.wait_for(logged);
        house.serves_its_master();
    }
}

#[test]
fn a_worker_may_ask_itself_for_its_health() {
    let workshop = certified();
    let own = workshop.path().join("certificates/workers/mass2");
    let worker = Worker::start(&own);
    let ask = |folder: &str| {
        let folder = workshop.path().join("certificates").join(folder);
        let folder = folder.display().to_string();
        workshop.run(&["health", &worker.address, "--certificates", &folder])
    };
    ask("workers/mass2").exits_with(0);
    ask("master").exits_with(0);
    ask("workers/mass1").fails(1, &[&worker.address, "it is not one for a master"]);
}

#[test]
fn what_does_not_speak_tls() {
    let house = House::new();
    let mut noise = [0_u8; 4096];
    let mut state = 7_u32;
    for byte in &mut noise {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        *byte = (state >> 24) as u8;
    }
    let handshake_without_end = [22, 3, 1, 64, 0, 1, 0, 63, 252];
    for bytes in [
        &b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"[..],
        b"GET / HTTP/1.1\r\n\r\n",
        &noise,
    ] {
        let mut socket = house.knock();
        socket.write_all(bytes).unwrap();
        let mut answer = Vec::new();
        // An alert, or a reset where it has sent more than the worker has read.
        let _ = socket.read_to_end(&mut answer);
        assert!(answer.is_empty() || answer[0] == 21, "{answer:?}");
        house.worker.wait_for("it does not speak TLS");
        house.serves_its_master();
    }
    let mut socket = house.knock();
    socket.write_all(&handshake_without_end).unwrap();
    house.serves_its_master();
    drop(socket);
    house.serves_its_master();
}

/// Whoever keeps silent is closed after a while, and meanwhile nobody waits for him.
#[test]
fn silence_holds_nobody_up() {
    let house = House::new();
    let mut silent: Vec<TcpStream> = (0..50).map(|_| house.knock()).collect();
    let began = Instant::now();
    house.serves_its_master();
    assert!(began.elapsed() < Duration::from_secs(3));
    assert_eq!(silent[0].read(&mut [0]).unwrap(), 0);
    house.worker.wait_for("no handshake within 5 s");
    house.serves_its_master();
}

/// A flood of strangers is not a flood of lines.
#[test]
fn the_log_stays_short() {
    let house = House::new();
    for _ in 0..200 {
        house.told(None);
    }
    house.serves_its_master();
    std::thread::sleep(Duration::from_millis(1100));
    house.told(None);
    house.worker.wait_for("others before");
    let lines = house.worker.log().lines().count();
    assert!(lines < 40, "{lines} lines");
}
