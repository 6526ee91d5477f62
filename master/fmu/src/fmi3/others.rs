//! Functions of FMI 3.0 that an exported scene has nothing for: it has no variables of other types, no inputs, no arrays, no clocks, no
//! events and no derivatives.

use std::ffi::{c_char, c_void};

use crate::instance::{ERROR, OK, Status};

/// What is asked for of nothing is done.
fn of_none(count: usize) -> Status {
    if count == 0 { OK } else { ERROR }
}

/// Functions that get or set values of a type of which there is no variable.
macro_rules! no_variables {
    ($($get:ident $set:ident $value:ty;)*) => {
        $(
            /// There are no variables of this type.
            #[unsafe(no_mangle)]
            pub extern "C" fn $get(
                _: *mut c_void,
                _: *const u32,
                count: usize,
                _: *mut $value,
                _: usize,
            ) -> Status {
                of_none(count)
            }

            /// There are no variables of this type.
            #[unsafe(no_mangle)]
            pub extern "C" fn $set(
                _: *mut c_void,
                _: *const u32,
                count: usize,
                _: *const $value,
                _: usize,
            ) -> Status {
                of_none(count)
            }
        )*
    };
}

no_variables! {
    fmi3GetFloat32 fmi3SetFloat32 f32;
    fmi3GetInt8 fmi3SetInt8 i8;
    fmi3GetUInt8 fmi3SetUInt8 u8;
    fmi3GetInt16 fmi3SetInt16 i16;
    fmi3GetUInt16 fmi3SetUInt16 u16;
    fmi3GetInt32 fmi3SetInt32 i32;
    fmi3GetUInt32 fmi3SetUInt32 u32;
    fmi3GetInt64 fmi3SetInt64 i64;
    fmi3GetUInt64 fmi3SetUInt64 u64;
    fmi3GetBoolean fmi3SetBoolean bool;
    fmi3GetString fmi3SetString *const c_char;
}

/// Functions of clocks, whose third argument is the number of them.
macro_rules! no_clocks {
    ($($name:ident($($value:ty),*);)*) => {
        $(
            /// There are no clocks.
            #[unsafe(no_mangle)]
            pub extern "C" fn $name(
                _: *mut c_void,
                _: *const u32,
                count: usize,
                $(_: $value),*
            ) -> Status {
                of_none(count)
            }
        )*
    };
}

no_clocks! {
    fmi3GetClock(*mut bool);
    fmi3SetClock(*const bool);
    fmi3GetIntervalDecimal(*mut f64, *mut i32);
    fmi3GetIntervalFraction(*mut u64, *mut u64, *mut i32);
    fmi3GetShiftDecimal(*mut f64);
    fmi3GetShiftFraction(*mut u64, *mut u64);
    fmi3SetIntervalDecimal(*const f64);
    fmi3SetIntervalFraction(*const u64, *const u64);
    fmi3SetShiftDecimal(*const f64);
    fmi3SetShiftFraction(*const u64, *const u64);
}

/// Functions that belong to what the description does not offer.
macro_rules! not_offered {
    ($($name:ident($($value:ty),*);)*) => {
        $(
            /// The description does not offer it.
            #[unsafe(no_mangle)]
            pub extern "C" fn $name(_: *mut c_void, $(_: $value),*) -> Status {
                ERROR
            }
        )*
    };
}

not_offered! {
    fmi3EnterEventMode();
    fmi3EnterConfigurationMode();
    fmi3ExitConfigurationMode();
    fmi3EvaluateDiscreteStates();
    fmi3UpdateDiscreteStates(*mut bool, *mut bool, *mut bool, *mut bool, *mut bool, *mut f64);
    fmi3GetDirectionalDerivative(*const u32, usize, *const u32, usize, *const f64, usize, *mut f64, usize);
    fmi3GetAdjointDerivative(*const u32, usize, *const u32, usize, *const f64, usize, *mut f64, usize);
    fmi3GetNumberOfVariableDependencies(u32, *mut usize);
    fmi3GetVariableDependencies(u32, *mut usize, *mut u32, *mut usize, *mut i32, usize);
    fmi3EnterContinuousTimeMode();
    fmi3CompletedIntegratorStep(bool, *mut bool, *mut bool);
    fmi3SetTime(f64);
    fmi3SetContinuousStates(*const f64, usize);
    fmi3GetContinuousStateDerivatives(*mut f64, usize);
    fmi3GetEventIndicators(*mut f64, usize);
    fmi3GetContinuousStates(*mut f64, usize);
    fmi3GetNominalsOfContinuousStates(*mut f64, usize);
    fmi3GetNumberOfEventIndicators(*mut usize);
    fmi3GetNumberOfContinuousStates(*mut usize);
    fmi3ActivateModelPartition(u32, f64);
}

/// Failures are told whatever is wanted.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3SetDebugLogging(
    _: *mut c_void,
    _: bool,
    _: usize,
    _: *const *const c_char,
) -> Status {
    OK
}

/// There are no binaries.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetBinary(
    _: *mut c_void,
    _: *const u32,
    count: usize,
    _: *mut usize,
    _: *mut *const u8,
    _: usize,
) -> Status {
    of_none(count)
}

/// There are no binaries.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3SetBinary(
    _: *mut c_void,
    _: *const u32,
    count: usize,
    _: *const usize,
    _: *const *const u8,
    _: usize,
) -> Status {
    of_none(count)
}

/// There are no derivatives of outputs.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetOutputDerivatives(
    _: *mut c_void,
    _: *const u32,
    count: usize,
    _: *const i32,
    _: *mut f64,
    _: usize,
) -> Status {
    of_none(count)
}
