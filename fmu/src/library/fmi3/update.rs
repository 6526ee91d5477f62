//! Inputs that are set inside a step, when the FMU asks for them.

use std::cell::{Cell, RefCell};
use std::ffi::{c_int, c_void};
use std::ptr::{null, null_mut};

use super::super::Inside;
use super::super::call::OK;
use super::{Environment, Handle, Set, Surroundings};

/// The callback of the standard.
pub(super) type IntermediateUpdate =
    unsafe extern "C" fn(Environment, f64, bool, bool, bool, bool, *mut bool, *mut f64);

/// What the callback needs during a step.
pub(super) struct Update {
    set: Option<Set<f64>>,
    references: Vec<u32>,
    values: RefCell<Vec<f64>>,
    handle: Cell<Handle>,
    /// The inputs of the step under way; null outside a step.
    inside: Cell<*const c_void>,
    /// The first status that was not OK.
    missed: Cell<Option<c_int>>,
}

impl Default for Update {
    fn default() -> Self {
        Self {
            set: None,
            references: Vec::new(),
            values: RefCell::default(),
            handle: Cell::new(null_mut()),
            inside: Cell::new(null()),
            missed: Cell::new(None),
        }
    }
}

impl Update {
    /// Sets `references`, which are all inputs of the instance in their order, by `set`.
    pub(super) fn new(set: Set<f64>, references: &[u32]) -> Self {
        Self {
            set: Some(set),
            references: references.to_vec(),
            values: RefCell::new(vec![0.0; references.len()]),
            ..Self::default()
        }
    }

    /// Carries out a step of `handle` under these inputs; answers as well whether setting them has failed.
    ///
    /// # Safety
    /// `step` calls no other instance, and `handle` is alive.
    pub(super) unsafe fn during<T>(
        &self,
        handle: Handle,
        inside: Option<&Inside<'_>>,
        step: impl FnOnce() -> T,
    ) -> (T, Option<c_int>) {
        self.handle.set(handle);
        self.missed.set(None);
        self.inside
            .set(inside.map_or(null(), |inside| std::ptr::from_ref(inside).cast()));
        let answer = step();
        self.inside.set(null());
        (answer, self.missed.take())
    }

    fn at(&self, t: f64) {
        // SAFETY: `during` keeps what it points to alive while it is not null, and the FMU calls back inside of its step only.
        let inside = unsafe { self.inside.get().cast::<Inside<'_>>().as_ref() };
        let (Some(inside), Some(set)) = (inside, self.set) else {
            return;
        };
        // An FMU that calls back from the setting of its inputs gets the same again.
        let Ok(mut values) = self.values.try_borrow_mut() else {
            return;
        };
        inside.inputs.values_at(t - inside.start, &mut values);
        let length = self.references.len();
        // SAFETY: both lists have this length, and the instance is the one that calls.
        let status = unsafe {
            set(
                self.handle.get(),
                self.references.as_ptr(),
                length,
                values.as_ptr(),
                length,
            )
        };
        if status != OK && self.missed.get().is_none() {
            self.missed.set(Some(status));
        }
    }
}

/// Sets the inputs where the FMU takes them.
///
/// # Safety
/// Called by an FMU inside a step with what the standard prescribes.
pub(super) unsafe extern "C" fn intermediate_update(
    environment: Environment,
    t: f64,
    takes_inputs: bool,
    _may_be_read: bool,
    _step_is_over: bool,
    _may_return_early: bool,
    return_early: *mut bool,
    _return_at: *mut f64,
) {
    // SAFETY: the environment of an instance outlives it.
    let around = unsafe { environment.cast::<Surroundings>().as_ref() };
    // SAFETY: the FMU gives a place for the answer, or null.
    if let Some(return_early) = unsafe { return_early.as_mut() } {
        *return_early = false;
    }
    if let (Some(around), true) = (around, takes_inputs) {
        around.update.at(t);
    }
}
