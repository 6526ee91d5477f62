//! Signals as requests to stop.

use std::fs;
use std::io::{self, Write};
use std::sync::OnceLock;

use linchpin_master::Interrupt;
use tokio::signal::unix::{Signal, SignalKind, signal};
use tokio::sync::mpsc::{UnboundedReceiver, unbounded_channel};

/// What a shell adds to the number of a signal for the exit code of a command that it ended.
const EXIT_CODE_OF_SIGNALS: u8 = 128;

/// A signal that asks a command to end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Request {
    name: &'static str,
    kind: SignalKind,
    /// Whether somebody who sends it again means it: others come again by themselves.
    is_insistent: bool,
}

/// The signal of this process that was first, if there was one.
static FIRST: OnceLock<Request> = OnceLock::new();

/// The interrupt of this process.
static INTERRUPT: OnceLock<Interrupt> = OnceLock::new();

impl Request {
    /// Every signal that ends a process unless it is watched, and that somebody sends to have that.
    fn all() -> [Self; 6] {
        let request = |name, kind, is_insistent| Self {
            name,
            kind,
            is_insistent,
        };
        // Its number is that of the system, as the others have it; Tokio has no name for it.
        let cpu_time = SignalKind::from_raw(rustix::process::Signal::XCPU.as_raw());
        [
            request("SIGINT", SignalKind::interrupt(), true),
            request("SIGTERM", SignalKind::terminate(), true),
            request("SIGQUIT", SignalKind::quit(), true),
            request("SIGHUP", SignalKind::hangup(), false),
            request("SIGUSR1", SignalKind::user_defined1(), false),
            request("SIGXCPU", cpu_time, false),
        ]
    }

    /// Its name, such as SIGTERM.
    pub fn name(self) -> &'static str {
        self.name
    }

    /// Exit code of a command that it ended: 128 and its number.
    pub fn exit_code(self) -> u8 {
        let number = u8::try_from(self.kind.as_raw_value()).unwrap_or_default();
        EXIT_CODE_OF_SIGNALS.saturating_add(number)
    }
}

/// The signal that asked this process to end, if one has.
pub fn received() -> Option<Request> {
    FIRST.get().copied()
}

/// What stops the runs of this process. From now on signals ask for that; a second Ctrl-C, SIGTERM or SIGQUIT ends the
/// process at once.
///
/// # Errors
/// The system does not let signals be watched.
pub fn on_signals() -> io::Result<Interrupt> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_io()
        .build()?;
    let mut signals = {
        let _inside = runtime.enter();
        Signals::watch()?
    };
    let interrupt = of_process();
    let requested = interrupt.clone();
    std::thread::spawn(move || {
        runtime.block_on(async {
            let Some(first) = signals.next().await else {
                return;
            };
            let _ = FIRST.set(first);
            requested.request();
            // Whoever closed the error output is not told.
            let _ = writeln!(
                io::stderr(),
                "interrupted by {}: ending in good order; interrupt again to end at once",
                first.name
            );
            while let Some(again) = signals.next().await {
                if again.is_insistent {
                    std::process::exit(again.exit_code().into());
                }
            }
        });
    });
    Ok(interrupt)
}

/// What stops the runs of this process, whether signals are watched or not.
pub fn of_process() -> Interrupt {
    INTERRUPT.get_or_init(Interrupt::default).clone()
}

/// Requests to end, as they come.
pub struct Signals {
    requests: UnboundedReceiver<Request>,
}

impl Signals {
    /// Watches from now on; inside a runtime. A write beyond the size that files may have is an error from now on, and no end of
    /// the process; a signal that the process was started to ignore as `nohup` has it stays ignored.
    ///
    /// # Errors
    /// The system does not let signals be watched.
    pub fn watch() -> io::Result<Self> {
        let (sender, requests) = unbounded_channel();
        let ignores_hangup = is_ignored(SignalKind::hangup());
        for request in Request::all() {
            if request.kind == SignalKind::hangup() && ignores_hangup {
                continue;
            }
            let mut signal: Signal = signal(request.kind)?;
            let sender = sender.clone();
            tokio::spawn(async move {
                while signal.recv().await.is_some() && sender.send(request).is_ok() {}
            });
        }
        // Watched, it ends nothing; what is too large says so where it is written.
        drop(signal(SignalKind::from_raw(
            rustix::process::Signal::XFSZ.as_raw(),
        ))?);
        Ok(Self { requests })
    }

    /// Waits for the next one; `None` if there can be none.
    pub async fn next(&mut self) -> Option<Request> {
        self.requests.recv().await
    }
}

/// Whether this process ignores a signal; false where the system does not tell.
fn is_ignored(kind: SignalKind) -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status
        .lines()
        .find_map(|line| line.strip_prefix("SigIgn:"))
        .and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    ignored.is_some_and(|mask| mask >> (kind.as_raw_value() - 1) & 1 == 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exit_codes_are_those_of_a_shell() {
        let codes = Request::all().map(|request| (request.name(), request.exit_code()));
        let expected = [
            ("SIGINT", 130),
            ("SIGTERM", 143),
            ("SIGQUIT", 131),
            ("SIGHUP", 129),
            ("SIGUSR1", 138),
            ("SIGXCPU", 152),
        ];
        assert_eq!(codes, expected);
    }
}
