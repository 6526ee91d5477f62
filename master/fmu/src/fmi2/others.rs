//! Functions of FMI 2.0 that an exported scene has nothing for: it has no variables of other types, no inputs, no derivatives and no
//! asynchronous steps.

use std::ffi::{c_char, c_int, c_void};

use super::Boolean;
use crate::instance::{ERROR, OK, Status};

/// What is asked for of nothing is done.
fn of_none(count: usize) -> Status {
    if count == 0 { OK } else { ERROR }
}

/// Failures are told whatever is wanted.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2SetDebugLogging(
    _: *mut c_void,
    _: Boolean,
    _: usize,
    _: *const *const c_char,
) -> Status {
    OK
}

/// There are no integers.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetInteger(
    _: *mut c_void,
    _: *const u32,
    count: usize,
    _: *mut c_int,
) -> Status {
    of_none(count)
}

/// There are no integers.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2SetInteger(
    _: *mut c_void,
    _: *const u32,
    count: usize,
    _: *const c_int,
) -> Status {
    of_none(count)
}

/// There are no booleans.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetBoolean(
    _: *mut c_void,
    _: *const u32,
    count: usize,
    _: *mut Boolean,
) -> Status {
    of_none(count)
}

/// There are no booleans.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2SetBoolean(
    _: *mut c_void,
    _: *const u32,
    count: usize,
    _: *const Boolean,
) -> Status {
    of_none(count)
}

/// There are no strings.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetString(
    _: *mut c_void,
    _: *const u32,
    count: usize,
    _: *mut *const c_char,
) -> Status {
    of_none(count)
}

/// There are no strings.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2SetString(
    _: *mut c_void,
    _: *const u32,
    count: usize,
    _: *const *const c_char,
) -> Status {
    of_none(count)
}

/// There are no directional derivatives.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetDirectionalDerivative(
    _: *mut c_void,
    _: *const u32,
    _: usize,
    _: *const u32,
    _: usize,
    _: *const f64,
    _: *mut f64,
) -> Status {
    ERROR
}

/// There are no inputs.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2SetRealInputDerivatives(
    _: *mut c_void,
    _: *const u32,
    count: usize,
    _: *const c_int,
    _: *const f64,
) -> Status {
    of_none(count)
}

/// There are no derivatives of outputs.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetRealOutputDerivatives(
    _: *mut c_void,
    _: *const u32,
    count: usize,
    _: *const c_int,
    _: *mut f64,
) -> Status {
    of_none(count)
}

/// No step is pending.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2CancelStep(_: *mut c_void) -> Status {
    ERROR
}

/// No step is pending.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetStatus(_: *mut c_void, _: c_int, _: *mut Status) -> Status {
    ERROR
}

/// No step is pending.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetRealStatus(_: *mut c_void, _: c_int, _: *mut f64) -> Status {
    ERROR
}

/// No step is pending.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetIntegerStatus(_: *mut c_void, _: c_int, _: *mut c_int) -> Status {
    ERROR
}

/// No step is pending.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetBooleanStatus(_: *mut c_void, _: c_int, _: *mut Boolean) -> Status {
    ERROR
}

/// No step is pending.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetStringStatus(_: *mut c_void, _: c_int, _: *mut *const c_char) -> Status {
    ERROR
}
