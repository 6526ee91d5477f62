//! The functions of FMI 3.0 for co-simulation (FMI 3.0.2, sections 2.2 and 4.2).
//!
//! An instance is an [`Instance`]; what fails is told by its logger, with the status Error, and a panic is the status Fatal.

mod others;

use std::ffi::{c_char, c_void};

pub use others::*;

use crate::instance::{ERROR, Instance, Logger, Logger3, OK, Status, end, get, guarded, set, text};
use crate::states;

/// Version of the standard.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

fn logger(logger: Option<Logger3>, environment: *mut c_void) -> Logger {
    logger.map_or(Logger::None, |logger| Logger::Three(logger, environment))
}

/// A new instance; null if it cannot be made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    _logging: bool,
    _event_mode: bool,
    _early_return: bool,
    _intermediate: *const u32,
    _intermediate_count: usize,
    environment: *mut c_void,
    log: Option<Logger3>,
    _update: *const c_void,
) -> *mut c_void {
    // SAFETY: the importer gives texts that end with 0.
    let (name, token, resources) = unsafe { (text(name), text(token), text(resources)) };
    let logger = logger(log, environment);
    Instance::make(&name, &token, &resources, logger, true)
}

/// There is no model exchange.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    _logging: bool,
    environment: *mut c_void,
    log: Option<Logger3>,
) -> *mut c_void {
    // SAFETY: as above.
    let (name, token, resources) = unsafe { (text(name), text(token), text(resources)) };
    let logger = logger(log, environment);
    Instance::make(&name, &token, &resources, logger, false)
}

/// There is no scheduled execution.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    _logging: bool,
    environment: *mut c_void,
    log: Option<Logger3>,
    _clock_update: *const c_void,
    _lock: *const c_void,
    _unlock: *const c_void,
) -> *mut c_void {
    // SAFETY: as above.
    let (name, token, resources) = unsafe { (text(name), text(token), text(resources)) };
    let logger = logger(log, environment);
    Instance::make(&name, &token, &resources, logger, false)
}

/// Ends an instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeInstance(instance: *mut c_void) {
    unsafe { end(instance) }
}

/// Takes the times of the experiment; parameters may be set from here on as before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterInitializationMode(
    instance: *mut c_void,
    _has_tolerance: bool,
    _tolerance: f64,
    start: f64,
    has_stop: bool,
    stop: f64,
) -> Status {
    let stop = has_stop.then_some(stop);
    unsafe { guarded(instance, |own| own.component.set_up(start, stop)) }
}

/// Starts the scene.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3ExitInitializationMode(instance: *mut c_void) -> Status {
    unsafe { guarded(instance, |own| own.component.start().map(|_| ())) }
}

/// The simulation is over; the values stay.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3Terminate(instance: *mut c_void) -> Status {
    unsafe { guarded(instance, |_| Ok(())) }
}

/// As after instantiation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3Reset(instance: *mut c_void) -> Status {
    unsafe {
        guarded(instance, |own| {
            own.component.reset();
            Ok(())
        })
    }
}

/// Values of outputs, parameters and the time. No variable is an array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFloat64(
    instance: *mut c_void,
    references: *const u32,
    count: usize,
    values: *mut f64,
    value_count: usize,
) -> Status {
    match count == value_count {
        true => unsafe { get(instance, references, count, values) },
        false => ERROR,
    }
}

/// Values for parameters.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFloat64(
    instance: *mut c_void,
    references: *const u32,
    count: usize,
    values: *const f64,
    value_count: usize,
) -> Status {
    match count == value_count {
        true => unsafe { set(instance, references, count, values) },
        false => ERROR,
    }
}

/// A communication step. It never needs events, never ends early, and never asks for the end.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DoStep(
    instance: *mut c_void,
    t: f64,
    step: f64,
    _keeps_no_state_before: bool,
    event_needed: *mut bool,
    terminate: *mut bool,
    early_return: *mut bool,
    last_time: *mut f64,
) -> Status {
    unsafe {
        guarded(instance, |own| {
            let stepped = own.component.step(t, step);
            // SAFETY: the importer gives places for all of them, or null.
            for place in [event_needed, terminate, early_return] {
                if let Some(place) = place.as_mut() {
                    *place = false;
                }
            }
            if let Some(last) = last_time.as_mut() {
                *last = if stepped.is_ok() {
                    t + step
                } else {
                    own.component.t()
                };
            }
            stepped
        })
    }
}

/// Takes the present state; one that is there already is replaced.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFMUState(instance: *mut c_void, state: *mut *mut c_void) -> Status {
    unsafe { states::take(instance, state) }
}

/// Goes back to a state.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFMUState(instance: *mut c_void, state: *mut c_void) -> Status {
    unsafe { states::give_back(instance, state) }
}

/// Ends a state, and leaves null in its place.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeFMUState(_: *mut c_void, state: *mut *mut c_void) -> Status {
    unsafe { states::end(state) }
}

/// Bytes that a state takes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializedFMUStateSize(
    instance: *mut c_void,
    state: *mut c_void,
    size: *mut usize,
) -> Status {
    unsafe { states::size(instance, state, size) }
}

/// Writes a state as bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializeFMUState(
    instance: *mut c_void,
    state: *mut c_void,
    bytes: *mut u8,
    size: usize,
) -> Status {
    unsafe { states::write(instance, state, bytes, size) }
}

/// Reads a state from bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DeserializeFMUState(
    instance: *mut c_void,
    bytes: *const u8,
    size: usize,
    state: *mut *mut c_void,
) -> Status {
    unsafe { states::read(instance, bytes, size, state) }
}

/// Steps follow at once.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3EnterStepMode(_: *mut c_void) -> Status {
    OK
}
