//! An instance with the callbacks of its importer.

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

use percent_encoding::percent_decode_str;

use super::{ERROR, FATAL, OK, Status};
use crate::component::{Component, ComponentError};

/// `fmi2CallbackLogger`; the message is a format.
type Logger =
    unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...);

/// `fmi2CallbackFunctions`.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Callbacks {
    logger: Option<Logger>,
    allocate: *const c_void,
    free: *const c_void,
    step_finished: *const c_void,
    environment: *mut c_void,
}

/// An instance.
pub struct Instance {
    pub(super) component: Component,
    told: Told,
}

/// Who is told of failures.
struct Told {
    name: CString,
    callbacks: Option<Callbacks>,
}

impl Told {
    fn tell(&self, status: Status, message: &str) {
        let Some(Callbacks {
            logger: Some(logger),
            environment,
            ..
        }) = self.callbacks
        else {
            eprintln!("linchpin: {message}");
            return;
        };
        // The message is a format without arguments.
        let message = message.replace('\0', " ").replace('%', "%%");
        let message = CString::new(message).unwrap_or_default();
        let category = if status == FATAL {
            c"logStatusFatal"
        } else {
            c"logStatusError"
        };
        let name = self.name.as_ptr();
        // SAFETY: the logger is the importer's, and takes texts that end with 0.
        unsafe {
            logger(
                environment,
                name,
                status,
                category.as_ptr(),
                message.as_ptr(),
            );
        }
    }
}

impl Instance {
    pub(super) fn new(
        name: &str,
        token: &str,
        resources: &str,
        callbacks: Option<&Callbacks>,
        is_co_simulation: bool,
    ) -> Option<Self> {
        let told = Told {
            name: CString::new(name).unwrap_or_default(),
            callbacks: callbacks.copied(),
        };
        if !is_co_simulation {
            told.tell(
                ERROR,
                "this FMU is for co-simulation, and was asked for model exchange",
            );
            return None;
        }
        let made = catch_unwind(|| Component::new(&folder_of(resources), token));
        match made {
            Ok(Ok(component)) => Some(Self { component, told }),
            Ok(Err(error)) => {
                told.tell(ERROR, &error.to_string());
                None
            }
            Err(_) => {
                told.tell(FATAL, "a defect of Linchpin: it has panicked");
                None
            }
        }
    }
}

/// The folder that a URI names; a path is taken as it is.
fn folder_of(resources: &str) -> PathBuf {
    let path = resources.strip_prefix("file:").unwrap_or(resources);
    if path == resources {
        return path.into();
    }
    // file:/path and file:///path; an authority can only be this machine.
    let path = match path.strip_prefix("//") {
        Some(rest) => &rest[rest.find('/').unwrap_or(rest.len())..],
        None => path,
    };
    let path: Vec<u8> = percent_decode_str(path).collect();
    String::from_utf8_lossy(&path).into_owned().into()
}

/// The text that ends with 0; empty if there is none.
pub(super) unsafe fn text(text: *const c_char) -> String {
    match text.is_null() {
        true => String::new(),
        // SAFETY: the importer gives a text that ends with 0.
        false => unsafe { CStr::from_ptr(text) }
            .to_string_lossy()
            .into_owned(),
    }
}

/// Calls a function of an instance, and tells what has failed.
pub(super) unsafe fn guarded(
    instance: *mut c_void,
    call: impl FnOnce(&mut Instance) -> Result<(), ComponentError>,
) -> Status {
    // SAFETY: it was made by `fmi2Instantiate`, and one thread at a time uses it.
    let Some(instance) = (unsafe { instance.cast::<Instance>().as_mut() }) else {
        return ERROR;
    };
    match catch_unwind(AssertUnwindSafe(|| call(instance))) {
        Ok(Ok(())) => OK,
        Ok(Err(error)) => {
            instance.told.tell(ERROR, &error.to_string());
            ERROR
        }
        Err(_) => {
            instance
                .told
                .tell(FATAL, "a defect of Linchpin: it has panicked");
            FATAL
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_are_found_in_every_form_that_importers_give() {
        for uri in [
            "file:///tmp/a%20b/resources",
            "file:/tmp/a%20b/resources",
            "file://localhost/tmp/a b/resources",
            "/tmp/a b/resources",
        ] {
            assert_eq!(folder_of(uri), PathBuf::from("/tmp/a b/resources"), "{uri}");
        }
    }
}
