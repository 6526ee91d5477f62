//! The functions of FMI 3.0 for co-simulation (FMI 3.0.2, sections 2.2 and 4.2).
//!
//! An instance is an [`Instance`]; what fails is told by its logger, with the status Error, and a panic is the status Fatal.

mod others;

use std::ffi::{c_char, c_void};

pub use others::*;

use crate::component::ComponentError;
use crate::instance::{
    Instance, Logger, Logger3, OK, Status, get, guarded, life_functions, set, text,
};
use crate::states::state_functions;

/// Version of the standard.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

/// An instance, if it is for co-simulation; null if it cannot be made.
unsafe fn instantiate(
    [name, token, resources]: [*const c_char; 3],
    (log, environment): (Option<Logger3>, *mut c_void),
    is_co_simulation: bool,
) -> *mut c_void {
    // SAFETY: the importer gives texts that end with 0.
    let [name, token, resources] = [name, token, resources].map(|own| unsafe { text(own) });
    let logger = log.map_or(Logger::None, |log| Logger::Three(log, environment));
    Instance::make(&name, &token, &resources, logger, is_co_simulation)
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
    unsafe { instantiate([name, token, resources], (log, environment), true) }
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
    unsafe { instantiate([name, token, resources], (log, environment), false) }
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
    unsafe { instantiate([name, token, resources], (log, environment), false) }
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

unsafe fn refuse_count(instance: *mut c_void, variables: usize, values: usize) -> Status {
    let error = ComponentError::WrongCount { variables, values };
    unsafe { guarded(instance, |_| Err(error)) }
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
        false => unsafe { refuse_count(instance, count, value_count) },
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
        false => unsafe { refuse_count(instance, count, value_count) },
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

/// Steps follow at once.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3EnterStepMode(_: *mut c_void) -> Status {
    OK
}

life_functions! { fmi3FreeInstance fmi3ExitInitializationMode fmi3Terminate fmi3Reset }

state_functions! {
    fmi3GetFMUState fmi3SetFMUState fmi3FreeFMUState
    fmi3SerializedFMUStateSize fmi3SerializeFMUState fmi3DeserializeFMUState
}
