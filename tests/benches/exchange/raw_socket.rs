//! As many bytes over raw sockets: what the system itself takes.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::os::unix::net::{UnixListener, UnixStream};
use std::time::Duration;

use crate::macro_steps::{Messages, free_port};
use crate::process::Process;
use crate::report::Series;

trait Socket: Read + Write {}
impl<S: Read + Write> Socket for S {}

/// Answers every `request` bytes with `reply` bytes until the other side closes.
pub fn serve(address: &str, request: usize, reply: usize) {
    let mut socket: Box<dyn Socket> = match address.strip_prefix("unix:") {
        Some(path) => Box::new(UnixListener::bind(path).unwrap().accept().unwrap().0),
        None => {
            let stream = TcpListener::bind(address).unwrap().accept().unwrap().0;
            stream.set_nodelay(true).unwrap();
            Box::new(stream)
        }
    };
    let (mut question, answer) = (vec![0; request], vec![0; reply]);
    while socket.read_exact(&mut question).is_ok() {
        socket.write_all(&answer).unwrap();
    }
}

struct Peer {
    _process: Process,
    socket: Box<dyn Socket>,
}

impl Peer {
    fn start(address: &str, messages: &Messages) -> Self {
        let sizes = [messages.request_bytes().len(), messages.reply_bytes().len()];
        let [request, reply] = sizes.map(|size| size.to_string());
        let process = Process::start(&["raw-socket", address, &request, &reply]);
        loop {
            if let Ok(socket) = connect(address) {
                return Self {
                    _process: process,
                    socket,
                };
            }
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

fn connect(address: &str) -> std::io::Result<Box<dyn Socket>> {
    match address.strip_prefix("unix:") {
        Some(path) => Ok(Box::new(UnixStream::connect(path)?)),
        None => {
            let stream = TcpStream::connect(address)?;
            stream.set_nodelay(true)?;
            Ok(Box::new(stream))
        }
    }
}

fn series(name: &'static str, addresses: [String; 2], messages: &Messages) -> Series {
    let mut peers = addresses.map(|address| Peer::start(&address, messages));
    let request = messages.request_bytes();
    let mut reply = messages.reply_bytes();
    Series::new(name, move || {
        for peer in &mut peers {
            peer.socket.write_all(&request).unwrap();
        }
        for peer in &mut peers {
            peer.socket.read_exact(&mut reply).unwrap();
        }
    })
}

/// Raw rounds over Unix sockets and TCP.
pub fn all(messages: &Messages) -> Vec<Series> {
    let folder = tempfile::tempdir().unwrap();
    let unix = [1, 2].map(|number| format!("unix:{}/raw{number}.sock", folder.path().display()));
    let tcp = [free_port(), free_port()].map(|port| format!("127.0.0.1:{port}"));
    vec![
        series("bare round to 2, raw Unix sockets", unix, messages),
        series("bare round to 2, raw TCP", tcp, messages),
    ]
}
