//! Calls that take long do not hold up the rest.
//!
//! In a runtime of several threads one of them waits for what comes in. If that one begins to compute, no other takes its place as long
//! as nothing else wakes one. So a thread beside the runtime looks every few milliseconds whether a call computes on and on, and wakes
//! another one then. A call that is over before costs some atomic operations, and no thread is woken.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread::Thread;
use std::time::Duration;

use tokio::runtime::Handle;

/// Pause between two looks.
const PAUSE: Duration = Duration::from_millis(5);

/// Looks after the calls of a server as long as it lives.
pub(super) struct Sentry {
    seen: Arc<Seen>,
    thread: Thread,
}

#[derive(Default)]
struct Seen {
    /// Calls that have begun, and those that have ended.
    begun: AtomicU64,
    over: AtomicU64,
    sleeps: AtomicBool,
    ends: AtomicBool,
}

impl Sentry {
    /// Looks after calls on `runtime`.
    pub fn start(runtime: Handle) -> std::io::Result<Self> {
        let seen = Arc::<Seen>::default();
        let watched = Arc::clone(&seen);
        let builder = std::thread::Builder::new().name("linchpin-sentry".to_owned());
        let thread = builder.spawn(move || watched.watch(&runtime))?;
        let thread = thread.thread().clone();
        Ok(Self { seen, thread })
    }

    /// Runs a call.
    pub fn look_after<T>(&self, call: impl FnOnce() -> T) -> T {
        self.seen.begun.fetch_add(1, Ordering::SeqCst);
        let _over = Over(&self.seen);
        if self.seen.sleeps.load(Ordering::SeqCst) {
            self.thread.unpark();
        }
        call()
    }
}

impl Drop for Sentry {
    fn drop(&mut self) {
        self.seen.ends.store(true, Ordering::SeqCst);
        self.thread.unpark();
    }
}

/// The end of a call, also of one that panics.
struct Over<'a>(&'a Seen);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.over.fetch_add(1, Ordering::SeqCst);
    }
}

impl Seen {
    /// How many calls have begun and ended.
    fn calls(&self) -> [u64; 2] {
        [&self.begun, &self.over].map(|count| count.load(Ordering::SeqCst))
    }

    fn watch(&self, runtime: &Handle) {
        let mut last = [0; 2];
        while !self.ends.load(Ordering::SeqCst) {
            let calls = self.calls();
            if calls == last {
                match calls[0] == calls[1] {
                    true => self.sleep(calls),
                    // An empty task wakes a thread, which then waits for what comes in.
                    false => drop(runtime.spawn(std::future::ready(()))),
                }
            }
            last = calls;
            std::thread::sleep(PAUSE);
        }
    }

    /// Sleeps until another call begins.
    fn sleep(&self, last: [u64; 2]) {
        self.sleeps.store(true, Ordering::SeqCst);
        // A call that begins from here on sees that this sleeps.
        if self.calls() == last && !self.ends.load(Ordering::SeqCst) {
            std::thread::park();
        }
        self.sleeps.store(false, Ordering::SeqCst);
    }
}
