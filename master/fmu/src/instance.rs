//! An instance with the callbacks of its importer, and the calls that both versions of FMI have.

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

use percent_encoding::percent_decode_str;

use crate::component::{Component, ComponentError};

/// `fmi2Status` and `fmi3Status`, which have equal numbers.
pub type Status = c_int;
/// The call has done what it should.
pub const OK: Status = 0;
/// It has failed; the instance can go on from a state that was taken before, or be reset.
pub const ERROR: Status = 3;
/// The instance is lost.
pub const FATAL: Status = 4;

/// `fmi2CallbackLogger`; the message is a format.
pub type Logger2 =
    unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...);

/// `fmi3LogMessageCallback`.
pub type Logger3 = unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char);

/// Who is told of failures, each with the environment that it was given with.
#[derive(Debug, Clone, Copy)]
pub enum Logger {
    /// Nobody: the error output takes it.
    None,
    /// An importer of FMI 2.
    Two(Logger2, *mut c_void),
    /// An importer of FMI 3.
    Three(Logger3, *mut c_void),
}

/// An instance.
pub struct Instance {
    pub(crate) component: Component,
    told: Told,
}

struct Told {
    name: CString,
    logger: Logger,
}

impl Told {
    fn tell(&self, status: Status, message: &str) {
        let message = message.replace('\0', " ");
        let category = match status {
            FATAL => c"logStatusFatal",
            _ => c"logStatusError",
        };
        let ended = |message: String| CString::new(message).unwrap_or_default();
        match self.logger {
            Logger::None => eprintln!("linchpin: {message}"),
            Logger::Two(logger, environment) => {
                // A format without arguments.
                let message = ended(message.replace('%', "%%"));
                let (name, category) = (self.name.as_ptr(), category.as_ptr());
                // SAFETY: the logger is the importer's, and takes texts that end with 0.
                unsafe { logger(environment, name, status, category, message.as_ptr()) };
            }
            Logger::Three(logger, environment) => {
                let message = ended(message);
                // SAFETY: as above.
                unsafe { logger(environment, status, category.as_ptr(), message.as_ptr()) };
            }
        }
    }
}

impl Instance {
    /// A new instance on the heap, for [`guarded`] and [`end`]; null if it cannot be made, which the logger is told.
    pub(crate) fn make(
        name: &str,
        token: &str,
        resources: &str,
        logger: Logger,
        is_co_simulation: bool,
    ) -> *mut c_void {
        let told = Told {
            name: CString::new(name).unwrap_or_default(),
            logger,
        };
        if !is_co_simulation {
            told.tell(
                ERROR,
                "this FMU is for co-simulation, and was asked for something else",
            );
            return std::ptr::null_mut();
        }
        let made = catch_unwind(|| Component::new(&folder_of(resources), token));
        match made {
            Ok(Ok(component)) => Box::into_raw(Box::new(Self { component, told })).cast(),
            Ok(Err(error)) => {
                told.tell(ERROR, &error.to_string());
                std::ptr::null_mut()
            }
            Err(_) => {
                told.tell(FATAL, PANIC);
                std::ptr::null_mut()
            }
        }
    }
}

const PANIC: &str = "a defect of Linchpin: it has panicked";

/// Ends an instance.
pub(crate) unsafe fn end(instance: *mut c_void) {
    if !instance.is_null() {
        // SAFETY: it is one of `Instance::make`, and is not used any more.
        let instance = unsafe { Box::from_raw(instance.cast::<Instance>()) };
        let _ = catch_unwind(AssertUnwindSafe(|| drop(instance)));
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
pub(crate) unsafe fn text(text: *const c_char) -> String {
    match text.is_null() {
        true => String::new(),
        // SAFETY: the importer gives a text that ends with 0.
        false => unsafe { CStr::from_ptr(text) }
            .to_string_lossy()
            .into_owned(),
    }
}

/// Calls a function of an instance, and tells what has failed.
pub(crate) unsafe fn guarded(
    instance: *mut c_void,
    call: impl FnOnce(&mut Instance) -> Result<(), ComponentError>,
) -> Status {
    // SAFETY: it is one of `Instance::make`, and one thread at a time uses it.
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
            instance.told.tell(FATAL, PANIC);
            FATAL
        }
    }
}

/// Values of variables.
pub(crate) unsafe fn get(
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
pub(crate) unsafe fn set(
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

/// The functions of an instance's life that have equal arguments in both versions of FMI, under the names of one.
macro_rules! life_functions {
    ($end:ident $start:ident $terminate:ident $reset:ident) => {
        /// Ends an instance.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $end(instance: *mut c_void) {
            unsafe { $crate::instance::end(instance) }
        }

        /// Starts the scene.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $start(instance: *mut c_void) -> Status {
            unsafe { guarded(instance, |own| own.component.start().map(|_| ())) }
        }

        /// The simulation is over; the values stay.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $terminate(instance: *mut c_void) -> Status {
            unsafe { guarded(instance, |_| Ok(())) }
        }

        /// As after it was made.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $reset(instance: *mut c_void) -> Status {
            unsafe {
                guarded(instance, |own| {
                    own.component.reset();
                    Ok(())
                })
            }
        }
    };
}
pub(crate) use life_functions;

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
