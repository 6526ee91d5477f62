//! Ctrl-C and SIGTERM as requests to stop a run.

use std::io::{self, Write};

use linchpin_master::Interrupt;
use tokio::signal::unix::{Signal, SignalKind, signal};

/// Exit code of a command that was interrupted, as shells have it for Ctrl-C.
pub const EXIT_CODE: u8 = 130;

/// From now on Ctrl-C or SIGTERM asks the runs that hold a copy to stop; a second one ends the process at once.
///
/// # Errors
/// The system does not let signals be watched.
pub fn on_signals() -> io::Result<Interrupt> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_io()
        .build()?;
    let mut signals = {
        let _inside = runtime.enter();
        signals()?
    };
    let interrupt = Interrupt::default();
    let requested = interrupt.clone();
    std::thread::spawn(move || {
        runtime.block_on(any(&mut signals));
        requested.request();
        // Whoever closed the error output is not told.
        let _ = writeln!(
            io::stderr(),
            "interrupted: ending the run; interrupt again to end at once"
        );
        runtime.block_on(any(&mut signals));
        std::process::exit(EXIT_CODE.into());
    });
    Ok(interrupt)
}

/// Ctrl-C and SIGTERM from now on; inside a runtime.
pub fn signals() -> io::Result<[Signal; 2]> {
    Ok([
        signal(SignalKind::interrupt())?,
        signal(SignalKind::terminate())?,
    ])
}

/// Waits for either.
pub async fn any([first, second]: &mut [Signal; 2]) {
    tokio::select! {
        _ = first.recv() => {}
        _ = second.recv() => {}
    }
}
