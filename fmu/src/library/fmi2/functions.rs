//! The functions of FMI 2.0 that are needed.

use std::ffi::{c_char, c_int, c_void};

use super::{Bool, Callbacks, Component};
use crate::FmuError;
use crate::description::Abilities;
use crate::library::symbols::Symbols;

type Plain = unsafe extern "C" fn(Component) -> c_int;
type Set<T> = unsafe extern "C" fn(Component, *const u32, usize, *const T) -> c_int;

/// The functions of a library.
pub(in crate::library) struct Functions {
    pub(in crate::library::fmi2) instantiate: unsafe extern "C" fn(
        *const c_char,
        c_int,
        *const c_char,
        *const c_char,
        *const Callbacks,
        Bool,
        Bool,
    ) -> Component,
    pub(in crate::library::fmi2) set_up:
        unsafe extern "C" fn(Component, Bool, f64, f64, Bool, f64) -> c_int,
    pub(in crate::library::fmi2) enter: Plain,
    pub(in crate::library::fmi2) exit: Plain,
    pub(in crate::library::fmi2) terminate: Plain,
    pub(in crate::library::fmi2) free: unsafe extern "C" fn(Component),
    pub(in crate::library::fmi2) get:
        unsafe extern "C" fn(Component, *const u32, usize, *mut f64) -> c_int,
    pub(in crate::library::fmi2) set: Set<f64>,
    pub(in crate::library::fmi2) set_integer: Set<c_int>,
    pub(in crate::library::fmi2) set_boolean: Set<Bool>,
    pub(in crate::library::fmi2) set_text: Set<*const c_char>,
    pub(in crate::library::fmi2) step: unsafe extern "C" fn(Component, f64, f64, Bool) -> c_int,
    pub(in crate::library::fmi2) derivatives: Option<
        unsafe extern "C" fn(Component, *const u32, usize, *const c_int, *const f64) -> c_int,
    >,
    pub(in crate::library::fmi2) states: Option<States>,
    pub(in crate::library::fmi2) bytes: Option<Bytes>,
}

pub(in crate::library) struct States {
    pub(in crate::library::fmi2) get: unsafe extern "C" fn(Component, *mut *mut c_void) -> c_int,
    pub(in crate::library::fmi2) set: unsafe extern "C" fn(Component, *mut c_void) -> c_int,
    pub(in crate::library::fmi2) free: unsafe extern "C" fn(Component, *mut *mut c_void) -> c_int,
}

pub(in crate::library) struct Bytes {
    pub(in crate::library::fmi2) size:
        unsafe extern "C" fn(Component, *mut c_void, *mut usize) -> c_int,
    pub(in crate::library::fmi2) write:
        unsafe extern "C" fn(Component, *mut c_void, *mut u8, usize) -> c_int,
    pub(in crate::library::fmi2) read:
        unsafe extern "C" fn(Component, *const u8, usize, *mut *mut c_void) -> c_int,
}

impl Functions {
    /// Those of a library that says it can do this.
    pub(in crate::library) fn of(
        symbols: &Symbols<'_>,
        abilities: Abilities,
    ) -> Result<Self, FmuError> {
        let keeps = ("canGetAndSetFMUstate", abilities.keeps_states);
        let writes = ("canSerializeFMUstate", abilities.serializes_states);
        let derivatives = ("canInterpolateInputs", abilities.takes_input_derivatives);
        // SAFETY: the types of the fields are those of the standard.
        unsafe {
            Ok(Self {
                instantiate: symbols.needed("fmi2Instantiate")?,
                set_up: symbols.needed("fmi2SetupExperiment")?,
                enter: symbols.needed("fmi2EnterInitializationMode")?,
                exit: symbols.needed("fmi2ExitInitializationMode")?,
                terminate: symbols.needed("fmi2Terminate")?,
                free: symbols.needed("fmi2FreeInstance")?,
                get: symbols.needed("fmi2GetReal")?,
                set: symbols.needed("fmi2SetReal")?,
                set_integer: symbols.needed("fmi2SetInteger")?,
                set_boolean: symbols.needed("fmi2SetBoolean")?,
                set_text: symbols.needed("fmi2SetString")?,
                step: symbols.needed("fmi2DoStep")?,
                derivatives: symbols.flagged("fmi2SetRealInputDerivatives", derivatives)?,
                states: match symbols.flagged("fmi2GetFMUstate", keeps)? {
                    Some(get) => Some(States {
                        get,
                        set: symbols.needed("fmi2SetFMUstate")?,
                        free: symbols.needed("fmi2FreeFMUstate")?,
                    }),
                    None => None,
                },
                bytes: match symbols.flagged("fmi2SerializedFMUstateSize", writes)? {
                    Some(size) => Some(Bytes {
                        size,
                        write: symbols.needed("fmi2SerializeFMUstate")?,
                        read: symbols.needed("fmi2DeSerializeFMUstate")?,
                    }),
                    None => None,
                },
            })
        }
    }
}
