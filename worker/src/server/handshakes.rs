//! Connections that become encrypted before anything is read from them.

use std::io;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::{Duration, Instant};

use linchpin_proto::certificates::as_seen_by_worker;
use linchpin_proto::contract::Owner;
use rustls::ServerConfig;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio::sync::mpsc::{Receiver, Sender, channel};
use tokio::task::JoinSet;
use tokio_rustls::TlsAcceptor;
use tokio_rustls::server::TlsStream;
use tokio_stream::wrappers::ReceiverStream;
use tokio_stream::{Stream, StreamExt};

use super::connection::Connection;

/// Longest time for a handshake. Whoever keeps silent holds a place until then.
const PATIENCE: Duration = Duration::from_secs(5);

/// Most handshakes at a time; connections beyond are closed at once.
const AT_A_TIME: usize = 256;

/// Pause between two lines of the log about connections that are refused.
const PAUSE: Duration = Duration::from_secs(1);

type Encrypted = Connection<TlsStream<TcpStream>>;

/// The connections of `incoming` whose handshake succeeds. The others are closed, which is logged.
pub(super) fn accept(
    incoming: impl Stream<Item = io::Result<TcpStream>> + Send + Unpin + 'static,
    config: Arc<ServerConfig>,
) -> impl Stream<Item = io::Result<Encrypted>> {
    let (accepted, connections) = channel(AT_A_TIME);
    tokio::spawn(accept_all(incoming, TlsAcceptor::from(config), accepted));
    ReceiverStream::from(connections as Receiver<io::Result<Encrypted>>)
}

async fn accept_all(
    mut incoming: impl Stream<Item = io::Result<TcpStream>> + Unpin,
    acceptor: TlsAcceptor,
    accepted: Sender<io::Result<Encrypted>>,
) {
    let mut handshakes = JoinSet::new();
    let mut log = Log::default();
    loop {
        let connection = tokio::select! {
            () = accepted.closed() => return,
            Some(done) = handshakes.join_next() => {
                match done {
                    // The receiver is gone only when the server ends.
                    Ok(Ok(connection)) => drop(accepted.send(Ok(connection)).await),
                    Ok(Err(refusal)) => log.tell(refusal),
                    Err(error) => tracing::error!(%error, "a handshake broke off"),
                }
                continue;
            }
            connection = incoming.next() => connection,
        };
        match connection {
            Some(Ok(connection)) if handshakes.len() < AT_A_TIME => {
                handshakes.spawn(shake_hands(connection, acceptor.clone()));
            }
            Some(Ok(connection)) => log.tell(Refusal {
                peer: connection.peer_addr().ok(),
                reason: Some(format!(
                    "{AT_A_TIME} others are not done with their handshake"
                )),
            }),
            Some(Err(error)) => drop(accepted.send(Err(error)).await),
            None => return,
        }
    }
}

/// A connection that is not accepted.
struct Refusal {
    peer: Option<SocketAddr>,
    /// Absent where the peer has left without a word, as those do that look whether a port is open.
    reason: Option<String>,
}

async fn shake_hands(connection: TcpStream, acceptor: TlsAcceptor) -> Result<Encrypted, Refusal> {
    let peer = connection.peer_addr().ok();
    let refused = |reason| Refusal { peer, reason };
    let handshake = acceptor.accept(connection).into_fallible();
    let handshake = match tokio::time::timeout(PATIENCE, handshake).await {
        Ok(Err((error, connection))) => {
            // A socket that is closed with bytes unread may take back what it has said, which is why.
            let _ = tokio::time::timeout(PAUSE, leave(connection)).await;
            Ok(Err(error))
        }
        Ok(Ok(encrypted)) => Ok(Ok(encrypted)),
        Err(late) => Err(late),
    };
    match handshake {
        Ok(Ok(encrypted)) => {
            let shown = encrypted.get_ref().1.peer_certificates();
            let owner = shown.and_then(|shown| shown.first());
            let owner = owner.map(|certificate| Owner::of_certificate(certificate));
            Ok(Connection::new(encrypted, owner))
        }
        Ok(Err(error)) => Err(refused(reason(&error))),
        Err(_) => Err(refused(Some(format!(
            "no handshake within {} s",
            PATIENCE.as_secs()
        )))),
    }
}

/// Says that nothing more will come, and waits until the peer has nothing more to say.
async fn leave(mut connection: TcpStream) -> io::Result<()> {
    connection.shutdown().await?;
    let mut rest = [0; 4096];
    while connection.read(&mut rest).await? > 0 {}
    Ok(())
}

fn reason(error: &io::Error) -> Option<String> {
    let inner = error.get_ref();
    match inner.and_then(|inner| inner.downcast_ref::<rustls::Error>()) {
        Some(error) => Some(as_seen_by_worker(error)),
        None if error.kind() == io::ErrorKind::UnexpectedEof => None,
        None => Some(error.to_string()),
    }
}

/// What is logged of refused connections: not more lines than somebody reads, however many there are.
#[derive(Default)]
struct Log {
    last: Option<Instant>,
    untold: usize,
}

impl Log {
    fn tell(&mut self, refusal: Refusal) {
        let peer = refusal
            .peer
            .map_or("somebody".to_owned(), |peer| peer.to_string());
        let Some(reason) = refusal.reason else {
            tracing::debug!(peer, "closed before the handshake");
            return;
        };
        if self.last.is_some_and(|last| last.elapsed() < PAUSE) {
            self.untold += 1;
            return;
        }
        self.last = Some(Instant::now());
        match std::mem::take(&mut self.untold) {
            0 => tracing::warn!("refused a connection from {peer}: {reason}"),
            more => {
                tracing::warn!(
                    "refused a connection from {peer}: {reason}; and {more} others before"
                );
            }
        }
    }
}
