//! The gRPC service around a worker: `linchpin.v1.Worker`, health, reflection.

mod address;
mod capacity;
mod connection;
mod handshakes;
mod sentry;
mod service;
mod solvers;

use std::fs::Permissions;
use std::future::Future;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use linchpin_proto::contract::Contract;
use linchpin_proto::token::{Demanding, Token};
use linchpin_proto::v1::{FILE_DESCRIPTOR_SET, worker_server::WorkerServer};
use rustls::ServerConfig;
use tokio::net::{TcpListener, UnixListener, UnixSocket};
use tokio_stream::StreamExt;
use tokio_stream::wrappers::UnixListenerStream;
use tonic::service::interceptor::InterceptedService;
use tonic::transport::server::{Router, TcpIncoming};

pub use address::{Address, AddressError};
pub use capacity::{Capacity, runtime};
use connection::Connection;
use service::Service;
use solvers::Solvers;

/// Time that calls under way have to finish after a shutdown. Then they are cancelled.
pub const GRACE: Duration = Duration::from_millis(500);

/// Time that cancelled calls have to end. Solvers that do not look whether they are cancelled are left alone after it.
const LAST_GRACE: Duration = Duration::from_millis(300);

/// Pause between two looks whether a cancelled call has ended.
const LOOK: Duration = Duration::from_millis(5);

/// Largest headers of a request in bytes. Those of the contract have some hundred.
const HEADERS: u32 = 16 << 10;

/// Streams that a caller has reset before they were accepted, above which its connection is closed: such floods cost the caller nothing.
const RESETS: usize = 20;

/// Pause between two looks for instances whose lease is over.
const TIDY: Duration = Duration::from_millis(500);

/// A TCP connection on which nothing moves is asked for a sign of life after this time, and as often after each other, until the
/// kernel of a machine that is gone has not answered so many times. A master that computes or is stopped is not asked.
const KEEPALIVE: Duration = Duration::from_secs(10);
const KEEPALIVE_RETRIES: u32 = 3;

/// Longest path of a Unix socket in bytes.
const LONGEST_PATH: usize = 107;

/// Connections that wait until they are accepted.
const BACKLOG: u32 = 1024;

/// Who may reach a worker.
#[derive(Debug, Clone)]
pub enum Reach {
    /// This machine in plain text: loopback addresses and Unix sockets.
    Local,
    /// Whoever can reach the address. Nothing is encrypted and nobody is asked who they are.
    Anyone,
    /// Masters with a certificate, by TLS: see `linchpin_proto::certificates`.
    Masters(Arc<ServerConfig>),
}

/// Why a worker cannot listen.
#[derive(Debug, thiserror::Error)]
pub enum ListenError {
    /// Somebody listens there already.
    #[error("{address} is in use; choose {}", another(.address))]
    InUse {
        /// The address.
        address: Address,
    },
    /// A file that is no socket has the path.
    #[error("{} is no socket, and it is not overwritten; choose another path", path.display())]
    NotASocket {
        /// The path.
        path: PathBuf,
    },
    /// The folder for the socket does not exist.
    #[error("there is no folder {}; make the folder, or choose another path", folder.display())]
    NoFolder {
        /// The folder.
        folder: PathBuf,
    },
    /// The path is longer than the system allows.
    #[error("{} has more than {LONGEST_PATH} bytes, the most for a socket; choose a shorter path", path.display())]
    PathTooLong {
        /// The path.
        path: PathBuf,
    },
    /// An address that other machines can reach was not permitted.
    #[error(
        "{address} can be reached from other machines, which plain text is not for: give --certificates FOLDER (linchpin \
         certificates makes it), listen on 127.0.0.1, or permit it with --plain-text where the network keeps strangers away"
    )]
    NotLocal {
        /// The address.
        address: Address,
    },
    /// Certificates for a Unix socket.
    #[error(
        "{address} takes no certificates: who may connect is decided by the permissions of the socket and its folder; leave \
         --certificates away, or listen on IP:PORT"
    )]
    NoTls {
        /// The address.
        address: Address,
    },
    /// The system refuses.
    #[error("cannot listen on {address}: {source}")]
    System {
        /// The address.
        address: Address,
        /// Its reason.
        source: std::io::Error,
    },
}

fn another(address: &Address) -> &'static str {
    match address {
        Address::Tcp(_) => "another port, or port 0 to let the system choose",
        Address::Unix(_) => "another path",
    }
}

/// Serving ended early.
#[derive(Debug, thiserror::Error)]
#[error("the server on {address} stopped: {source}")]
pub struct ServeError {
    address: Address,
    source: Box<dyn std::error::Error + Send + Sync>,
}

/// A worker that listens.
pub struct Server {
    contract: Arc<dyn Contract>,
    listener: Listener,
    address: Address,
    reach: Reach,
    token: Demanding,
    capacity: Capacity,
}

enum Listener {
    Tcp(TcpListener),
    Unix(UnixListener),
}

impl Server {
    /// Starts to listen on `address`; calls are answered by `contract` once [`Server::serve`] runs.
    pub async fn bind(
        contract: Arc<dyn Contract>,
        address: Address,
        reach: Reach,
    ) -> Result<Self, ListenError> {
        match (&reach, &address) {
            (Reach::Local, _) if !address.is_local() => {
                return Err(ListenError::NotLocal { address });
            }
            (Reach::Masters(_), Address::Unix(_)) => return Err(ListenError::NoTls { address }),
            _ => {}
        }
        let fail = |source: std::io::Error| match source.kind() {
            std::io::ErrorKind::AddrInUse => ListenError::InUse {
                address: address.clone(),
            },
            _ => ListenError::System {
                address: address.clone(),
                source,
            },
        };
        let (listener, bound) = match &address {
            Address::Tcp(tcp) => {
                let listener = TcpListener::bind(tcp).await.map_err(fail)?;
                let bound = Address::Tcp(listener.local_addr().map_err(fail)?);
                (Listener::Tcp(listener), bound)
            }
            Address::Unix(path) => {
                check_path(path)?;
                address::clear_stale(path).map_err(fail)?;
                let listener = listen_privately(path).map_err(fail)?;
                (Listener::Unix(listener), address.clone())
            }
        };
        Ok(Self {
            contract,
            listener,
            address: bound,
            reach,
            token: Demanding::default(),
            capacity: Capacity::default(),
        })
    }

    /// Serves only masters that show this token. Health and reflection are open.
    #[must_use]
    pub fn demanding(self, token: Token) -> Self {
        Self {
            token: Demanding(Some(token)),
            ..self
        }
    }

    /// Does so much for its callers.
    #[must_use]
    pub fn with_capacity(self, capacity: Capacity) -> Self {
        Self { capacity, ..self }
    }

    /// Where it listens, with the port that the system chose.
    pub fn address(&self) -> &Address {
        &self.address
    }

    /// Its address as a master writes it in a scene.
    pub fn url(&self) -> String {
        match (&self.reach, &self.address) {
            (Reach::Masters(_), Address::Tcp(address)) => format!("https://{address}"),
            _ => self.address.to_string(),
        }
    }

    /// Answers calls until `shutdown` completes; calls under way may take [`GRACE`] to finish, and are cancelled then. A solver that
    /// does not look whether it is cancelled computes on when this returns: the process has to end.
    ///
    /// Best on a [`runtime`] of its own.
    pub async fn serve(self, shutdown: impl Future<Output = ()>) -> Result<(), ServeError> {
        let Capacity {
            threads,
            waiting,
            message,
            calls,
        } = self.capacity;
        let solvers = Solvers::new(threads, waiting).map_err(|source| ServeError {
            address: self.address.clone(),
            source: source.into(),
        })?;
        let solvers = Arc::new(solvers);
        let (health, health_service) = tonic_health::server::health_reporter();
        health.set_serving::<WorkerServer<Service>>().await;
        let service = Service::new(Arc::clone(&self.contract), Arc::clone(&solvers));
        let worker = WorkerServer::new(service)
            .max_decoding_message_size(message)
            .max_encoding_message_size(message);
        let router = tonic::transport::Server::builder()
            .max_concurrent_streams(Some(calls))
            .http2_max_header_list_size(Some(HEADERS))
            .http2_max_pending_accept_reset_streams(Some(RESETS))
            // None by HTTP/2: a master that computes or is stopped could not answer. TCP looks after machines that are gone.
            .http2_keepalive_interval(None)
            .add_service(health_service)
            .add_optional_service(reflection())
            .add_service(InterceptedService::new(worker, self.token));
        let (stop, stopped) = tokio::sync::oneshot::channel();
        let address = &self.address;
        let shutdown = async move {
            shutdown.await;
            // While it still listens the file is its own; later a successor may have put its own there.
            if let Address::Unix(path) = address {
                // A file that is gone already is what we want.
                let _ = std::fs::remove_file(path);
            }
            // Nobody listens if serving has ended by itself.
            let _ = stop.send(());
        };
        let served = tokio::select! {
            served = run(router, self.listener, self.reach, shutdown) => served,
            () = overdue(stopped, &solvers) => Ok(()),
            () = tidy(&*self.contract) => Ok(()),
        };
        served.map_err(|source| ServeError {
            address: self.address,
            source: source.into(),
        })
    }
}

/// Refuses paths for which the system has only cryptic words.
fn check_path(path: &Path) -> Result<(), ListenError> {
    if path.as_os_str().len() > LONGEST_PATH {
        let path = path.to_owned();
        return Err(ListenError::PathTooLong { path });
    }
    let folder = path.parent().filter(|folder| !folder.is_dir());
    if let Some(folder) = folder {
        let folder = folder.to_owned();
        return Err(ListenError::NoFolder { folder });
    }
    match address::is_socket(path) {
        Some(false) => {
            let path = path.to_owned();
            Err(ListenError::NotASocket { path })
        }
        _ => Ok(()),
    }
}

/// Listens on a socket of the own user alone, whatever the umask: nobody can connect before its permissions are set.
fn listen_privately(path: &Path) -> std::io::Result<UnixListener> {
    let socket = UnixSocket::new_stream()?;
    socket.bind(path)?;
    std::fs::set_permissions(path, Permissions::from_mode(0o600))?;
    socket.listen(BACKLOG)
}

/// Lets the contract end instances whose lease is over; never completes.
async fn tidy(contract: &dyn Contract) {
    loop {
        tokio::time::sleep(TIDY).await;
        contract.tidy();
    }
}

/// Completes when the calls under way have had their time since the shutdown. An exchange stream that its master
/// keeps open would otherwise keep the worker alive.
async fn overdue(stopped: tokio::sync::oneshot::Receiver<()>, solvers: &Solvers) {
    if stopped.await.is_err() {
        return std::future::pending().await;
    }
    tokio::time::sleep(GRACE).await;
    solvers.end();
    let give_up = Instant::now() + LAST_GRACE;
    while solvers.are_busy() && Instant::now() < give_up {
        tokio::time::sleep(LOOK).await;
    }
}

async fn run(
    router: Router,
    listener: Listener,
    reach: Reach,
    shutdown: impl Future<Output = ()>,
) -> Result<(), tonic::transport::Error> {
    match listener {
        Listener::Tcp(listener) => {
            // Without TCP_NODELAY a small answer waits for up to 40 ms.
            let incoming = TcpIncoming::from(listener)
                .with_nodelay(Some(true))
                .with_keepalive(Some(KEEPALIVE))
                .with_keepalive_interval(Some(KEEPALIVE))
                .with_keepalive_retries(Some(KEEPALIVE_RETRIES));
            if let Reach::Masters(config) = reach {
                let incoming = handshakes::accept(incoming, config);
                let served = router.serve_with_incoming_shutdown(incoming, shutdown);
                return served.await;
            }
            let incoming = incoming.map(plain);
            router
                .serve_with_incoming_shutdown(incoming, shutdown)
                .await
        }
        Listener::Unix(listener) => {
            let incoming = UnixListenerStream::new(listener);
            let incoming = incoming.map(plain);
            router
                .serve_with_incoming_shutdown(incoming, shutdown)
                .await
        }
    }
}

/// A connection on which nobody says who they are.
fn plain<C>(connection: std::io::Result<C>) -> std::io::Result<Connection<C>> {
    connection.map(|bytes| Connection::new(bytes, None))
}

/// Reflection is a convenience: the worker serves without it should the descriptors not be readable.
fn reflection() -> Option<
    tonic_reflection::server::v1::ServerReflectionServer<
        impl tonic_reflection::server::v1::ServerReflection,
    >,
> {
    tonic_reflection::server::Builder::configure()
        .register_encoded_file_descriptor_set(FILE_DESCRIPTOR_SET)
        .register_encoded_file_descriptor_set(tonic_health::pb::FILE_DESCRIPTOR_SET)
        .build_v1()
        .inspect_err(|error| tracing::warn!(%error, "no reflection"))
        .ok()
}
