//! The functions of FMI 3.0 that are needed.

use std::ffi::{c_char, c_int, c_void};

use super::update::IntermediateUpdate;
use super::{Environment, Handle, Set};
use crate::FmuError;
use crate::description::Abilities;
use crate::library::symbols::Symbols;

type Plain = unsafe extern "C" fn(Handle) -> c_int;
type LogMessage = unsafe extern "C" fn(Environment, c_int, *const c_char, *const c_char);

/// The functions of a library. `bool` is that of C, as in the standard.
pub(in crate::library) struct Functions {
    pub instantiate: unsafe extern "C" fn(
        *const c_char,
        *const c_char,
        *const c_char,
        bool,
        bool,
        bool,
        bool,
        *const u32,
        usize,
        Environment,
        LogMessage,
        Option<IntermediateUpdate>,
    ) -> Handle,
    pub enter: unsafe extern "C" fn(Handle, bool, f64, f64, bool, f64) -> c_int,
    pub exit: Plain,
    pub terminate: Plain,
    pub free: unsafe extern "C" fn(Handle),
    pub get: unsafe extern "C" fn(Handle, *const u32, usize, *mut f64, usize) -> c_int,
    pub set: Set<f64>,
    pub set_integer: Option<Set<i32>>,
    pub set_long: Option<Set<i64>>,
    pub set_boolean: Option<Set<bool>>,
    pub set_text: Option<Set<*const c_char>>,
    pub step: unsafe extern "C" fn(
        Handle,
        f64,
        f64,
        bool,
        *mut bool,
        *mut bool,
        *mut bool,
        *mut f64,
    ) -> c_int,
    pub states: Option<States>,
    pub bytes: Option<Bytes>,
}

pub(in crate::library) struct States {
    pub get: unsafe extern "C" fn(Handle, *mut *mut c_void) -> c_int,
    pub set: unsafe extern "C" fn(Handle, *mut c_void) -> c_int,
    pub free: unsafe extern "C" fn(Handle, *mut *mut c_void) -> c_int,
}

pub(in crate::library) struct Bytes {
    pub size: unsafe extern "C" fn(Handle, *mut c_void, *mut usize) -> c_int,
    pub write: unsafe extern "C" fn(Handle, *mut c_void, *mut u8, usize) -> c_int,
    pub read: unsafe extern "C" fn(Handle, *const u8, usize, *mut *mut c_void) -> c_int,
}

impl Functions {
    /// Those of a library that says it can do this.
    pub(in crate::library) fn of(
        symbols: &Symbols<'_>,
        abilities: Abilities,
    ) -> Result<Self, FmuError> {
        let keeps = ("canGetAndSetFMUState", abilities.keeps_states);
        let writes = ("canSerializeFMUState", abilities.serializes_states);
        // SAFETY: the types of the fields are those of the standard.
        unsafe {
            Ok(Self {
                instantiate: symbols.needed("fmi3InstantiateCoSimulation")?,
                enter: symbols.needed("fmi3EnterInitializationMode")?,
                exit: symbols.needed("fmi3ExitInitializationMode")?,
                terminate: symbols.needed("fmi3Terminate")?,
                free: symbols.needed("fmi3FreeInstance")?,
                get: symbols.needed("fmi3GetFloat64")?,
                set: symbols.needed("fmi3SetFloat64")?,
                set_integer: symbols.needed("fmi3SetInt32").ok(),
                set_long: symbols.needed("fmi3SetInt64").ok(),
                set_boolean: symbols.needed("fmi3SetBoolean").ok(),
                set_text: symbols.needed("fmi3SetString").ok(),
                step: symbols.needed("fmi3DoStep")?,
                states: match symbols.flagged("fmi3GetFMUState", keeps)? {
                    Some(get) => Some(States {
                        get,
                        set: symbols.needed("fmi3SetFMUState")?,
                        free: symbols.needed("fmi3FreeFMUState")?,
                    }),
                    None => None,
                },
                bytes: match symbols.flagged("fmi3SerializedFMUStateSize", writes)? {
                    Some(size) => Some(Bytes {
                        size,
                        write: symbols.needed("fmi3SerializeFMUState")?,
                        read: symbols.needed("fmi3DeserializeFMUState")?,
                    }),
                    None => None,
                },
            })
        }
    }
}
