//! The functions of FMI 2.0 for co-simulation (FMI 2.0.5, sections 2.1 and 4.2).
//!
//! An instance is a [`Component`] with the callbacks of its importer. What fails is told by the logger, with the status Error; no panic leaves a
//! function: it is the status Fatal.

#![allow(
    unsafe_code,
    non_snake_case,
    clippy::missing_safety_doc,
    reason = "functions of the C interface of FMI; the importer keeps to the standard"
)]

mod instance;
mod others;
mod states;

use std::ffi::{c_char, c_int, c_void};

pub use instance::{Callbacks, Instance};
pub use others::*;
pub use states::*;

use instance::{guarded, text};

/// `fmi2Status`.
pub type Status = c_int;
/// The call has done what it should.
pub const OK: Status = 0;
/// It has failed; the instance can go on from a state that was taken before, or be reset.
pub const ERROR: Status = 3;
/// The instance is lost.
pub const FATAL: Status = 4;

/// `fmi2Boolean`.
pub type Boolean = c_int;

/// Version of the standard.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

/// The platform that the types belong to.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

/// A new instance; null if it cannot be made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    name: *const c_char,
    kind: c_int,
    guid: *const c_char,
    resources: *const c_char,
    callbacks: *const Callbacks,
    _visible: Boolean,
    _logging: Boolean,
) -> *mut c_void {
    const CO_SIMULATION: c_int = 1;
    // SAFETY: the importer gives texts that end with 0, and callbacks that outlive the instance.
    let (name, guid, resources) = unsafe { (text(name), text(guid), text(resources)) };
    let callbacks = unsafe { callbacks.as_ref() };
    let instance = Instance::new(&name, &guid, &resources, callbacks, kind == CO_SIMULATION);
    instance.map_or(std::ptr::null_mut(), |own| {
        Box::into_raw(Box::new(own)).cast()
    })
}

/// Ends an instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(instance: *mut c_void) {
    if !instance.is_null() {
        // SAFETY: it was made by `fmi2Instantiate` and is not used any more.
        let instance = unsafe { Box::from_raw(instance.cast::<Instance>()) };
        let _ = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| drop(instance)));
    }
}

/// The times of the experiment.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetupExperiment(
    instance: *mut c_void,
    _has_tolerance: Boolean,
    _tolerance: f64,
    start: f64,
    has_stop: Boolean,
    stop: f64,
) -> Status {
    let stop = (has_stop != 0).then_some(stop);
    unsafe { guarded(instance, |own| own.component.set_up(start, stop)) }
}

/// Parameters may be set from here on as before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterInitializationMode(instance: *mut c_void) -> Status {
    unsafe { guarded(instance, |_| Ok(())) }
}

/// Starts the scene.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2ExitInitializationMode(instance: *mut c_void) -> Status {
    unsafe { guarded(instance, |own| own.component.start().map(|_| ())) }
}

/// The simulation is over; the values stay.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Terminate(instance: *mut c_void) -> Status {
    unsafe { guarded(instance, |_| Ok(())) }
}

/// As after `fmi2Instantiate`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Reset(instance: *mut c_void) -> Status {
    unsafe {
        guarded(instance, |own| {
            own.component.reset();
            Ok(())
        })
    }
}

/// Values of outputs and parameters.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetReal(
    instance: *mut c_void,
    references: *const u32,
    count: usize,
    values: *mut f64,
) -> Status {
    unsafe {
        guarded(instance, |own| {
            for place in 0..count {
                // SAFETY: both arrays have `count` entries.
                *values.add(place) = own.component.get(*references.add(place))?;
            }
            Ok(())
        })
    }
}

/// Values for parameters.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetReal(
    instance: *mut c_void,
    references: *const u32,
    count: usize,
    values: *const f64,
) -> Status {
    unsafe {
        guarded(instance, |own| {
            for place in 0..count {
                // SAFETY: both arrays have `count` entries.
                own.component
                    .set(*references.add(place), *values.add(place))?;
            }
            Ok(())
        })
    }
}

/// A communication step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(
    instance: *mut c_void,
    t: f64,
    step: f64,
    _keeps_no_state_before: Boolean,
) -> Status {
    unsafe { guarded(instance, |own| own.component.step(t, step)) }
}
