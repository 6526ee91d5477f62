//! A worker of a test behind a socket.

use std::sync::Arc;
use std::sync::mpsc::channel;

use linchpin_proto::contract::Contract;
use linchpin_tests::process::Workshop;
use linchpin_worker::server::{Address, Reach, Server};

/// Serves on a Unix socket in the workshop until the test process ends; the address.
pub fn serve(worker: Arc<dyn Contract>, workshop: &Workshop) -> String {
    let socket = Address::Unix(workshop.path().join("worker.sock"));
    let address = socket.to_string();
    let (listening, is_listening) = channel();
    std::thread::spawn(move || {
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(1)
            .enable_all()
            .build();
        runtime.unwrap().block_on(async {
            let server = Server::bind(worker, socket, Reach::Local).await.unwrap();
            listening.send(()).unwrap();
            server.serve(std::future::pending()).await.unwrap();
        });
    });
    is_listening.recv().unwrap();
    address
}
