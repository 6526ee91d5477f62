//! The functions of FMI 2.0 for co-simulation (FMI 2.0.5, sections 2.1 and 4.2).
//!
//! An instance is an [`Instance`]; what fails is told by its logger, with the status Error, and a panic is the status Fatal.

mod others;

use std::ffi::{c_char, c_int, c_void};

pub use others::*;

use crate::instance::{Instance, Logger, Logger2, Status, get, guarded, life_functions, set, text};
use crate::states::state_functions;

/// `fmi2Boolean`.
pub type Boolean = c_int;

/// `fmi2CallbackFunctions`.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Callbacks {
    logger: Option<Logger2>,
    allocate: *const c_void,
    free: *const c_void,
    step_finished: *const c_void,
    environment: *mut c_void,
}

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
    // SAFETY: the importer gives texts that end with 0, and callbacks that are there during the call.
    let (name, guid, resources) = unsafe { (text(name), text(guid), text(resources)) };
    let logger = match unsafe { callbacks.as_ref() } {
        Some(&Callbacks {
            logger: Some(logger),
            environment,
            ..
        }) => Logger::Two(logger, environment),
        _ => Logger::None,
    };
    Instance::make(&name, &guid, &resources, logger, kind == CO_SIMULATION)
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

/// Values of outputs and parameters.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetReal(
    instance: *mut c_void,
    references: *const u32,
    count: usize,
    values: *mut f64,
) -> Status {
    unsafe { get(instance, references, count, values) }
}

/// Values for parameters.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetReal(
    instance: *mut c_void,
    references: *const u32,
    count: usize,
    values: *const f64,
) -> Status {
    unsafe { set(instance, references, count, values) }
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

life_functions! { fmi2FreeInstance fmi2ExitInitializationMode fmi2Terminate fmi2Reset }

state_functions! {
    fmi2GetFMUstate fmi2SetFMUstate fmi2FreeFMUstate
    fmi2SerializedFMUstateSize fmi2SerializeFMUstate fmi2DeSerializeFMUstate
}
