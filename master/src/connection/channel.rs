//! The way to a worker: a socket, encrypted or not, with HTTP/2 on it.

use std::io;
use std::sync::Arc;
use std::time::{Duration, Instant};

use hyper_util::rt::TokioIo;
use linchpin_proto::contract::CallError;
use linchpin_proto::token::{Showing, Token};
use rustls::ClientConfig;
use rustls::pki_types::ServerName;
use tokio::net::TcpStream;
use tokio::runtime::Runtime;
use tokio_rustls::TlsConnector;
use tonic::service::interceptor::InterceptedService;
use tonic::transport::{Channel, Endpoint, Error, Uri};
use tower::service_fn;

use super::address::{Access, Host, NoAccess, WorkerAddress};
use super::time_limits::TimeLimits;
use super::waiting::unless;
use super::witness::{Witness, Witnessed};
use crate::interrupt::Interrupt;

/// First pause between two attempts to reach a worker that is starting; doubled up to [`LONGEST_PAUSE`].
const FIRST_PAUSE: Duration = Duration::from_millis(2);
const LONGEST_PAUSE: Duration = Duration::from_millis(100);

/// A channel whose calls show a token, if there is one.
pub(super) type Authorized = InterceptedService<Channel, Showing>;

/// An open channel to a worker.
pub(super) struct Opened {
    pub channel: Authorized,
    /// What was seen on the way. That a worker refuses the certificate of its master shows only at the first call.
    pub witness: Witness,
}

/// An open channel to `address`; tries again until the time limit for starts is over.
pub(super) fn open(
    address: &str,
    limits: TimeLimits,
    access: &Access,
    runtime: &Runtime,
    interrupt: &Interrupt,
) -> Result<Opened, CallError> {
    let unreachable = |reason: String| CallError::Unreachable {
        address: address.into(),
        reason,
    };
    let way = Way::new(address, access)?;
    let endpoint = way
        .endpoint(address)
        .map_err(|error| unreachable(innermost(&error)))?;
    let endpoint = endpoint.tcp_nodelay(true).connect_timeout(limits.start);
    let reached = runtime.block_on(unless(interrupt, reach(&way, &endpoint, limits.start)))?;
    let witness = way.witness();
    match reached {
        Ok(channel) => Ok(Opened {
            channel: InterceptedService::new(channel, Showing(way.token(access))),
            witness,
        }),
        Err(error) => Err(witness.explain(address, unreachable(innermost(&error)))),
    }
}

/// How the connection to a worker is made.
enum Way {
    Socket,
    Plain(Host, Witness),
    Tls(Host, Witness, Arc<ClientConfig>, ServerName<'static>),
}

impl Way {
    fn new(address: &str, access: &Access) -> Result<Self, CallError> {
        let untrusted = |reason: String| CallError::Untrusted {
            address: address.into(),
            reason,
        };
        let Some(parsed) = WorkerAddress::parse(address) else {
            let reason = "it must be http://HOST:PORT, https://HOST:PORT or unix:/PATH";
            return Err(untrusted(reason.to_owned()));
        };
        parsed
            .check(access.tls.is_some(), access.plain_text)
            .map_err(|why| untrusted(refusal(why).to_owned()))?;
        Ok(match (parsed, &access.tls) {
            (WorkerAddress::Tls(host), Some(config)) => {
                let name = ServerName::try_from(host.name.clone())
                    .map_err(|error| untrusted(error.to_string()))?;
                Self::Tls(host, Witness::default(), Arc::clone(config), name)
            }
            (WorkerAddress::Plain(host) | WorkerAddress::Tls(host), _) => {
                Self::Plain(host, Witness::default())
            }
            (WorkerAddress::Unix, _) => Self::Socket,
        })
    }

    /// It is not shown where others may listen.
    fn token(&self, access: &Access) -> Option<Token> {
        match self {
            Self::Plain(host, _) if !host.is_loopback() => None,
            _ => access.token.clone(),
        }
    }

    fn witness(&self) -> Witness {
        match self {
            Self::Socket => Witness::default(),
            Self::Plain(_, witness) | Self::Tls(_, witness, ..) => witness.clone(),
        }
    }

    fn endpoint(&self, address: &str) -> Result<Endpoint, Error> {
        let Self::Tls(..) = self else {
            return Endpoint::from_shared(address.to_owned());
        };
        // Tonic's own encryption is not used: it does not say why a handshake has failed.
        let plain = address.replacen("https", "http", 1);
        let endpoint = Endpoint::from_shared(plain)?;
        let origin = address.parse::<Uri>();
        Ok(origin.map_or(endpoint.clone(), |origin| endpoint.origin(origin)))
    }

    async fn connect(&self, endpoint: &Endpoint) -> Result<Channel, Error> {
        match self {
            Self::Socket => endpoint.connect().await,
            Self::Plain(host, witness) => {
                let (host, witness) = (host.clone(), witness.clone());
                let connector = service_fn(move |_: Uri| {
                    let (host, witness) = (host.clone(), witness.clone());
                    async move {
                        Ok::<_, io::Error>(TokioIo::new(Witnessed::plain(
                            dial(&host).await?,
                            witness,
                        )))
                    }
                });
                endpoint.connect_with_connector(connector).await
            }
            Self::Tls(host, witness, config, name) => {
                let to = (
                    host.clone(),
                    witness.clone(),
                    Arc::clone(config),
                    name.clone(),
                );
                let connector = service_fn(move |_: Uri| {
                    let (host, witness, config, name) = to.clone();
                    async move {
                        let socket = dial(&host).await?;
                        let handshake = TlsConnector::from(config).connect(name, socket).await;
                        let encrypted = handshake.inspect_err(|error| witness.see(error))?;
                        Ok::<_, io::Error>(TokioIo::new(Witnessed::encrypted(encrypted, witness)))
                    }
                });
                endpoint.connect_with_connector(connector).await
            }
        }
    }
}

fn refusal(why: NoAccess) -> &'static str {
    match why {
        NoAccess::NoCertificates => {
            "it is reached by TLS, which takes certificates: make them with linchpin certificates, and give the folder of the \
             master with --certificates (in a scene: security.certificates)"
        }
        NoAccess::PlainText => {
            "plain text over a network is refused: write https:// and give --certificates (in a scene: security.certificates), \
             which linchpin certificates makes, or permit it with --plain-text (security.plain_text = true) where the network \
             keeps strangers away"
        }
    }
}

async fn dial(host: &Host) -> io::Result<TcpStream> {
    let socket = TcpStream::connect((host.name.as_str(), host.port)).await?;
    socket.set_nodelay(true)?;
    Ok(socket)
}

async fn reach(way: &Way, endpoint: &Endpoint, limit: Duration) -> Result<Channel, Error> {
    let give_up = Instant::now() + limit;
    let mut pause = FIRST_PAUSE;
    loop {
        match way.connect(endpoint).await {
            Ok(channel) => return Ok(channel),
            // What is not trusted now will not be trusted later.
            Err(error) if way.witness().has_seen() || Instant::now() + pause >= give_up => {
                return Err(error);
            }
            Err(_) => tokio::time::sleep(pause).await,
        }
        pause = (2 * pause).min(LONGEST_PAUSE);
    }
}

/// What went wrong at the bottom: the transport's own words for the top say only "transport error".
fn innermost(error: &dyn std::error::Error) -> String {
    let mut error = error;
    while let Some(source) = error.source() {
        error = source;
    }
    error.to_string()
}
