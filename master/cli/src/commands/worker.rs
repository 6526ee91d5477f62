//! `linchpin worker`: serves the built-in models, or an FMU.

use std::io::{Read, Write};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use linchpin_fmu::Fmu;
use linchpin_models::models;
use linchpin_proto::certificates::Certificates;
use linchpin_proto::token::Token;
use linchpin_worker::Model;
use linchpin_worker::host::{Host, Limits};
use linchpin_worker::server::{self, Address, Capacity, Reach, Server};
use tokio::sync::oneshot;

use super::CommandError;
use crate::interrupt::Signals;

/// Serve the built-in models, or an FMU, over gRPC
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin worker --listen 127.0.0.1:50051
  linchpin worker --listen unix:/run/linchpin/mass1.sock
  linchpin worker --fmu engine.fmu --listen 127.0.0.1:50052
  linchpin worker --listen 0.0.0.0:50051 --certificates certificates/workers/mass1")]
pub struct Arguments {
    /// Where to listen: IP:PORT (port 0: the system chooses) or unix:/PATH
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1:0")]
    listen: Address,

    /// Serve this FMU for co-simulation (FMI 2.0 or 3.0) in place of the built-in models
    #[arg(long, value_name = "FILE")]
    fmu: Option<PathBuf>,

    /// Folder with ca.crt, tls.crt and tls.key (linchpin certificates makes it): only masters with a certificate are served, by TLS
    #[arg(long, value_name = "FOLDER", conflicts_with = "plain_text")]
    certificates: Option<PathBuf>,

    /// Permit an address that other machines can reach without certificates; nothing is encrypted, and anyone is served
    #[arg(long)]
    plain_text: bool,

    /// File with a secret that masters must show, for an address that other users of this machine can reach; only its user may read it
    #[arg(long, value_name = "FILE")]
    token: Option<PathBuf>,

    /// Threads that compute: so many instances at the same time. Others answer what needs no solver, such as health, also during long steps
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: u16,

    /// Most instances at a time
    #[arg(long, value_name = "N", default_value_t = Limits::default().instances as u32, value_parser = clap::value_parser!(u32).range(1..))]
    max_instances: u32,

    /// Most snapshots that an instance keeps
    #[arg(long, value_name = "N", default_value_t = Limits::default().snapshots as u32, value_parser = clap::value_parser!(u32).range(1..))]
    max_snapshots: u32,

    /// Most calls that wait while others compute; those beyond are refused
    #[arg(long, value_name = "N", default_value_t = Capacity::default().waiting as u32, value_parser = clap::value_parser!(u32).range(1..))]
    max_waiting: u32,

    /// Most calls and streams of one connection at a time; those beyond wait at the master
    #[arg(long, value_name = "N", default_value_t = Capacity::default().calls, value_parser = clap::value_parser!(u32).range(1..))]
    max_calls: u32,

    /// Largest message in MiB; the exchanges of a scene have less by far
    #[arg(long, value_name = "MIB", default_value_t = (Capacity::default().message >> 20) as u32, value_parser = clap::value_parser!(u32).range(1..=1024))]
    max_message: u32,

    /// Time in s after whose last call an instance gives way to another one when the worker is full
    #[arg(long, value_name = "S", default_value_t = Limits::default().idle.as_secs_f64(), value_parser = seconds)]
    idle: f64,

    /// Time in s that an instance waits for another call when the stream or the connections that held it have ended; then it ends
    #[arg(long, value_name = "S", default_value_t = Limits::default().lease.as_secs_f64(), value_parser = seconds)]
    lease: f64,

    /// End when the standard input is closed, as a master does that started this worker
    #[arg(long)]
    exit_with_stdin: bool,
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if (0.0..=1e6).contains(&seconds) => Ok(seconds),
        _ => Err("it must be a number of seconds from 0 to 1e6".into()),
    }
}

/// Serves until SIGTERM, Ctrl-C or, if asked, the end of the standard input.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let runtime = server::runtime(arguments.threads.into())?;
    let served = runtime.block_on(serve(arguments));
    // A solver that does not look whether it is cancelled ends with the process.
    runtime.shutdown_background();
    served
}

async fn serve(arguments: &Arguments) -> Result<(), CommandError> {
    let limits = Limits {
        instances: arguments.max_instances as usize,
        snapshots: arguments.max_snapshots as usize,
        idle: Duration::from_secs_f64(arguments.idle),
        lease: Duration::from_secs_f64(arguments.lease),
    };
    let models: Vec<Box<dyn Model>> = match &arguments.fmu {
        Some(path) => vec![Box::new(Fmu::load(path)?)],
        None => models(),
    };
    let host = Arc::new(Host::with_limits(models, limits));
    let reach = match &arguments.certificates {
        Some(folder) => Reach::Masters(Certificates::read(folder)?.for_worker()?),
        None if arguments.plain_text => Reach::Anyone,
        None => Reach::Local,
    };
    let token = arguments.token.as_deref().map(Token::read).transpose()?;
    let capacity = Capacity {
        threads: arguments.threads.into(),
        waiting: arguments.max_waiting as usize,
        message: (arguments.max_message as usize) << 20,
        calls: arguments.max_calls,
    };
    let server = Server::bind(host, arguments.listen.clone(), reach).await?;
    let mut server = server.with_capacity(capacity);
    if let Some(token) = token {
        server = server.demanding(token);
    }
    let mut signals = Signals::watch()?;
    let input_closed = arguments.exit_with_stdin.then(watch_input);
    announce(&server.url());
    let shutdown = async move {
        tokio::select! {
            _ = signals.next() => {}
            () = closed(input_closed) => {}
        }
    };
    Ok(server.serve(shutdown).await?)
}

/// Whoever started the worker may have closed its output; that is no reason to stop.
fn announce(address: &str) {
    let mut output = std::io::stdout();
    let _ = writeln!(output, "listening on {address}").and_then(|()| output.flush());
}

/// Waits on a thread of its own: a read of the standard input cannot be called off.
fn watch_input() -> oneshot::Receiver<()> {
    let (sender, receiver) = oneshot::channel();
    std::thread::spawn(move || {
        let mut buffer = [0; 64];
        let mut input = std::io::stdin();
        while matches!(input.read(&mut buffer), Ok(1..)) {}
        // Nobody waits any more if the worker is ending already.
        let _ = sender.send(());
    });
    receiver
}

async fn closed(input: Option<oneshot::Receiver<()>>) {
    match input {
        // An error means that the watching thread is gone, and the input with it.
        Some(receiver) => drop(receiver.await),
        None => std::future::pending().await,
    }
}
