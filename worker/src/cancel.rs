//! Ends of calls that nobody waits for any more.
//!
//! A call is cancelled when its caller has gone away, its instance is ended or its worker shuts down. A solver looks at [`Cancel`]
//! once in every internal step and gives up with [`StepFailure::Cancelled`]; the instance is then what it was before the call. One
//! that does not look is not ended by force: it computes to the end of its step.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::StepFailure;

/// What can be raised once, by whoever has a copy.
#[derive(Debug, Clone, Default)]
pub(crate) struct Flag(Arc<AtomicBool>);

impl Flag {
    pub fn raise(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Who can cancel a call.
#[derive(Debug, Clone, Copy)]
pub(crate) enum By {
    Worker,
    Caller,
    Instance,
}

/// Whether the call under way is cancelled. Copies stand for the same call and can be given to other threads of the solver.
#[derive(Debug, Clone, Default)]
pub struct Cancel {
    flags: [Option<Flag>; 3],
}

thread_local! {
    static CURRENT: RefCell<Cancel> = RefCell::default();
}

impl Cancel {
    /// That of the call under way on this thread. A solver takes it at the start of a step, on the thread that its method was called
    /// on; without a worker around it, nothing cancels.
    pub fn current() -> Self {
        CURRENT.with_borrow(Clone::clone)
    }

    /// Whether the call is cancelled. It takes about a nanosecond.
    pub fn is_requested(&self) -> bool {
        self.flags.iter().flatten().any(Flag::is_raised)
    }

    /// Gives up at time `t` (s) if the call is cancelled.
    ///
    /// # Errors
    /// [`StepFailure::Cancelled`] then.
    pub fn check(&self, t: f64) -> Result<(), StepFailure> {
        match self.is_requested() {
            true => Err(StepFailure::Cancelled { t }),
            false => Ok(()),
        }
    }

    /// Runs `call`, which `flag` cancels as well.
    pub(crate) fn within<T>(by: By, flag: &Flag, call: impl FnOnce() -> T) -> T {
        let place = by as usize;
        let before = CURRENT.with_borrow_mut(|own| own.flags[place].replace(flag.clone()));
        let _restored = Restored(place, before);
        call()
    }
}

/// Takes a flag away again, also where the call panics.
struct Restored(usize, Option<Flag>);

impl Drop for Restored {
    fn drop(&mut self) {
        let Self(place, before) = self;
        CURRENT.with_borrow_mut(|own| own.flags[*place] = before.take());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_flag_around_a_call_cancels_it_and_no_other_one() {
        let (caller, instance) = (Flag::default(), Flag::default());
        Cancel::within(By::Caller, &caller, || {
            Cancel::within(By::Instance, &instance, || {
                let own = Cancel::current();
                assert!(!own.is_requested());
                caller.raise();
                assert!(
                    std::thread::spawn(move || own.is_requested())
                        .join()
                        .unwrap()
                );
            });
            assert!(Cancel::current().is_requested());
        });
        assert!(!Cancel::current().is_requested());
        Cancel::within(By::Instance, &instance, || {
            assert!(!Cancel::current().is_requested());
            instance.raise();
            let stopped = Cancel::current().check(0.25);
            assert_eq!(stopped, Err(StepFailure::Cancelled { t: 0.25 }));
        });
    }
}
