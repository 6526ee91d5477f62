//! States of an instance: taken, given back, and as bytes for another process.

use std::ffi::c_void;

use linchpin_master::run::checkpoint::Checkpoint;

use crate::component::{ComponentError, from_bytes, to_bytes};
use crate::instance::{OK, Status, guarded};

/// A state that is none.
fn no_state() -> ComponentError {
    ComponentError::NoState("it is null".to_owned())
}

/// Takes the present state; one that is there already is replaced.
pub(crate) unsafe fn take(instance: *mut c_void, state: *mut *mut c_void) -> Status {
    unsafe {
        guarded(instance, |own| {
            let saved = own.component.save()?;
            // SAFETY: the importer gives a place, with null or a state of this FMU in it.
            let place = state.as_mut().ok_or_else(no_state)?;
            match place.cast::<Checkpoint>().as_mut() {
                Some(before) => *before = saved,
                None => *place = Box::into_raw(Box::new(saved)).cast(),
            }
            Ok(())
        })
    }
}

/// Goes back to a state.
pub(crate) unsafe fn give_back(instance: *mut c_void, state: *mut c_void) -> Status {
    unsafe {
        guarded(instance, |own| {
            // SAFETY: the importer gives a state of this FMU.
            let state = state.cast::<Checkpoint>().as_ref().ok_or_else(no_state)?;
            own.component.load(state)
        })
    }
}

/// Ends a state, and leaves null in its place.
pub(crate) unsafe fn end(state: *mut *mut c_void) -> Status {
    // SAFETY: as above; the state is not used any more.
    if let Some(place) = unsafe { state.as_mut() } {
        if !place.is_null() {
            drop(unsafe { Box::from_raw(place.cast::<Checkpoint>()) });
        }
        *place = std::ptr::null_mut();
    }
    OK
}

/// Bytes that a state takes.
pub(crate) unsafe fn size(instance: *mut c_void, state: *mut c_void, size: *mut usize) -> Status {
    unsafe {
        guarded(instance, |_| {
            // SAFETY: as above.
            let state = state.cast::<Checkpoint>().as_ref().ok_or_else(no_state)?;
            *size = to_bytes(state)?.len();
            Ok(())
        })
    }
}

/// Writes a state as bytes.
pub(crate) unsafe fn write(
    instance: *mut c_void,
    state: *mut c_void,
    bytes: *mut u8,
    size: usize,
) -> Status {
    unsafe {
        guarded(instance, |_| {
            // SAFETY: as above; there is room for `size` bytes.
            let state = state.cast::<Checkpoint>().as_ref().ok_or_else(no_state)?;
            let written = to_bytes(state)?;
            if written.len() > size {
                let (found, needed) = (size, written.len());
                let text = format!("{found} bytes are given for it, and it takes {needed}");
                return Err(ComponentError::NoState(text));
            }
            std::ptr::copy_nonoverlapping(written.as_ptr(), bytes, written.len());
            Ok(())
        })
    }
}

/// Reads a state from bytes.
pub(crate) unsafe fn read(
    instance: *mut c_void,
    bytes: *const u8,
    size: usize,
    state: *mut *mut c_void,
) -> Status {
    unsafe {
        guarded(instance, |_| {
            // SAFETY: as above; `bytes` has `size` of them.
            let read = from_bytes(std::slice::from_raw_parts(bytes, size))?;
            let place = state.as_mut().ok_or_else(no_state)?;
            match place.cast::<Checkpoint>().as_mut() {
                Some(before) => *before = read,
                None => *place = Box::into_raw(Box::new(read)).cast(),
            }
            Ok(())
        })
    }
}

/// The functions of states under the names of one version of FMI.
macro_rules! state_functions {
    ($take:ident $give_back:ident $end:ident $size:ident $write:ident $read:ident) => {
        /// Takes the present state; one that is there already is replaced.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $take(instance: *mut c_void, state: *mut *mut c_void) -> Status {
            unsafe { $crate::states::take(instance, state) }
        }

        /// Goes back to a state.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $give_back(instance: *mut c_void, state: *mut c_void) -> Status {
            unsafe { $crate::states::give_back(instance, state) }
        }

        /// Ends a state, and leaves null in its place.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $end(_: *mut c_void, state: *mut *mut c_void) -> Status {
            unsafe { $crate::states::end(state) }
        }

        /// Bytes that a state takes.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $size(
            instance: *mut c_void,
            state: *mut c_void,
            size: *mut usize,
        ) -> Status {
            unsafe { $crate::states::size(instance, state, size) }
        }

        /// Writes a state as bytes.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $write(
            instance: *mut c_void,
            state: *mut c_void,
            bytes: *mut u8,
            size: usize,
        ) -> Status {
            unsafe { $crate::states::write(instance, state, bytes, size) }
        }

        /// Reads a state from bytes.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $read(
            instance: *mut c_void,
            bytes: *const u8,
            size: usize,
            state: *mut *mut c_void,
        ) -> Status {
            unsafe { $crate::states::read(instance, bytes, size, state) }
        }
    };
}
pub(crate) use state_functions;
