//! A worker inside the test process.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::channel;

use linchpin_models::models;
use linchpin_proto::contract::Contract;
use linchpin_worker::Host;
use linchpin_worker::server::{Address, Reach, Server};
use tokio::sync::oneshot;

use super::Workshop;
use crate::scripted::Scripted;

/// Serves a contract on a Unix socket until it is dropped.
pub struct Peer {
    address: String,
    stop: Option<oneshot::Sender<()>>,
}

impl Peer {
    /// The built-in models behind a script.
    pub fn scripted(workshop: &Workshop, script: impl FnOnce(Scripted) -> Scripted) -> Self {
        let contract = Arc::new(script(Scripted::new(Arc::new(Host::new(models())))));
        Self::serve(workshop, contract)
    }

    /// Serves `contract`.
    pub fn serve(workshop: &Workshop, contract: Arc<dyn Contract>) -> Self {
        // One that ends late keeps its address.
        static SERVED: AtomicUsize = AtomicUsize::new(0);
        let number = SERVED.fetch_add(1, Ordering::Relaxed);
        let address = Address::Unix(workshop.path().join(format!("peer{number}.sock")));
        let (stop, stopped) = oneshot::channel();
        let (listening, is_listening) = channel();
        // Not waited for at the end: a peer that plays a hanging worker ends late.
        std::thread::spawn(move || {
            let runtime = tokio::runtime::Builder::new_current_thread()
                .enable_all()
                .build();
            runtime.unwrap().block_on(async move {
                let server = Server::bind(contract, address, Reach::Local).await.unwrap();
                listening.send(server.address().to_string()).unwrap();
                let shutdown = async { drop(stopped.await) };
                server.serve(shutdown).await.unwrap();
            });
        });
        Self {
            address: is_listening.recv().unwrap(),
            stop: Some(stop),
        }
    }

    /// Its address, as in a scene.
    pub fn address(&self) -> &str {
        &self.address
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        if let Some(stop) = self.stop.take() {
            // It may have ended by itself.
            let _ = stop.send(());
        }
    }
}
