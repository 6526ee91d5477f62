//! Instances of FMI 2.0.

mod functions;

use std::cell::Cell;
use std::ffi::{c_char, c_int, c_void};
use std::ptr::null_mut;
use std::sync::Arc;

use super::call::{CallFailure, Messages, OK, Status, terminated, text_of};
use super::{Inside, Instance, Library, Start, StartValue, State};
use crate::description::Kind;
pub(super) use functions::Functions;
use functions::{Bytes, States};

type Component = *mut c_void;
type Environment = *mut c_void;
type Bool = c_int;
type Logger =
    unsafe extern "C" fn(Environment, *const c_char, c_int, *const c_char, *const c_char, ...);

const FALSE: Bool = 0;
const TRUE: Bool = 1;
const CO_SIMULATION: c_int = 1;

/// What an FMU may call; the layout is that of the standard.
#[repr(C)]
struct Callbacks {
    logger: Logger,
    allocate: unsafe extern "C" fn(usize, usize) -> *mut c_void,
    free: unsafe extern "C" fn(*mut c_void),
    step_finished: Option<unsafe extern "C" fn(Environment, c_int)>,
    environment: Environment,
}

unsafe extern "C" {
    fn calloc(count: usize, size: usize) -> *mut c_void;
    fn free(memory: *mut c_void);
}

/// An instance.
pub(super) struct Instance2 {
    library: Arc<Library>,
    functions: Arc<Functions>,
    component: Component,
    messages: Box<Messages>,
    /// The FMU keeps a pointer to it.
    _callbacks: Box<Callbacks>,
    /// It is in no sound state.
    has_failed: Cell<bool>,
}

// SAFETY: FMI lets any thread call an instance, one at a time; whoever has the value is the only one that can.
unsafe impl Send for Instance2 {}

/// A logger has as many arguments as its message names. They are left out: the message is shown as it is.
///
/// # Safety
/// Called by an FMU with what the standard prescribes.
unsafe extern "C" fn log(
    environment: Environment,
    name: *const c_char,
    status: c_int,
    _category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the environment of an instance is its messages, which outlive it.
    let Some(messages) = (unsafe { environment.cast::<Messages>().as_ref() }) else {
        return;
    };
    // SAFETY: texts of the standard end with zero.
    let (name, message) = unsafe { (text_of(name), text_of(message)) };
    messages.note(&name, status, &message);
}

/// [`log`] as the standard declares it.
fn logger() -> Logger {
    let plain: unsafe extern "C" fn(
        Environment,
        *const c_char,
        c_int,
        *const c_char,
        *const c_char,
    ) = log;
    // SAFETY: on Linux and x86_64, the one platform that is served, the caller of a variadic function passes the named arguments as to
    // any other function and cleans up the rest.
    unsafe { std::mem::transmute::<_, Logger>(plain) }
}

impl Instance2 {
    pub(super) fn start(
        library: &Arc<Library>,
        functions: &Arc<Functions>,
        start: &Start<'_>,
    ) -> Result<Self, CallFailure> {
        let own = Self::instantiate(library, functions, start.name)?;
        for value in &start.values {
            own.set_start(value)?;
        }
        let (has_tolerance, tolerance) = asked(start.tolerance);
        // SAFETY: the component is alive, as in all calls that follow.
        own.check("fmi2SetupExperiment", || unsafe {
            (own.functions.set_up)(
                own.component,
                has_tolerance,
                tolerance,
                start.time,
                FALSE,
                0.0,
            )
        })?;
        // SAFETY: as above.
        own.check("fmi2EnterInitializationMode", || unsafe {
            (own.functions.enter)(own.component)
        })?;
        // SAFETY: as above.
        own.check("fmi2ExitInitializationMode", || unsafe {
            (own.functions.exit)(own.component)
        })?;
        Ok(own)
    }

    fn instantiate(
        library: &Arc<Library>,
        functions: &Arc<Functions>,
        name: &str,
    ) -> Result<Self, CallFailure> {
        const FUNCTION: &str = "fmi2Instantiate";
        let messages = Box::<Messages>::default();
        let environment: *const Messages = &*messages;
        let callbacks = Box::new(Callbacks {
            logger: logger(),
            allocate: calloc,
            free,
            step_finished: None,
            environment: environment.cast_mut().cast(),
        });
        if library.is_lost() {
            return Err(messages.failure(FUNCTION, Status::Lost));
        }
        let resources = format!("file://{}", library.resources().display());
        let texts = [name, &library.description.token, &resources].map(terminated);
        let [name, token, resources] = texts.each_ref().map(|text| text.as_ptr());
        // SAFETY: texts live over the call, callbacks and their environment as long as the instance.
        let component = unsafe {
            (functions.instantiate)(
                name,
                CO_SIMULATION,
                token,
                resources,
                &*callbacks,
                FALSE,
                FALSE,
            )
        };
        if component.is_null() {
            return Err(messages.failure(FUNCTION, Status::Nothing));
        }
        Ok(Self {
            library: Arc::clone(library),
            functions: Arc::clone(functions),
            component,
            messages,
            _callbacks: callbacks,
            has_failed: Cell::new(false),
        })
    }

    fn check(
        &self,
        function: &'static str,
        call: impl FnOnce() -> c_int,
    ) -> Result<(), CallFailure> {
        if self.library.is_lost() {
            return Err(self.messages.failure(function, Status::Lost));
        }
        let answer = self.messages.check(function, call());
        if let Err(failure) = &answer {
            self.has_failed.set(failure.status != Status::Discard);
            if failure.status == Status::Fatal {
                self.library.lose();
            }
        }
        answer
    }

    fn set_start(&self, value: &StartValue) -> Result<(), CallFailure> {
        let (functions, reference) = (&self.functions, &value.reference);
        let component = self.component;
        match value.kind {
            // SAFETY: one reference and one value, as in all arms.
            Kind::Real => self.check("fmi2SetReal", || unsafe {
                (functions.set)(component, reference, 1, &value.number)
            }),
            Kind::Integer | Kind::Long => {
                let number = value.number as c_int;
                // SAFETY: as above.
                self.check("fmi2SetInteger", || unsafe {
                    (functions.set_integer)(component, reference, 1, &number)
                })
            }
            Kind::Boolean => {
                let flag = Bool::from(value.number != 0.0);
                // SAFETY: as above.
                self.check("fmi2SetBoolean", || unsafe {
                    (functions.set_boolean)(component, reference, 1, &flag)
                })
            }
            Kind::Text => {
                let text = terminated(&value.text);
                // SAFETY: as above; the text lives over the call, and the FMU copies it.
                self.check("fmi2SetString", || unsafe {
                    (functions.set_text)(component, reference, 1, &text.as_ptr())
                })
            }
        }
    }

    fn states(&self) -> Result<&States, CallFailure> {
        let states = self.functions.states.as_ref();
        states.ok_or_else(|| self.messages.failure("fmi2GetFMUstate", Status::Nothing))
    }

    fn bytes(&self) -> Result<&Bytes, CallFailure> {
        let bytes = self.functions.bytes.as_ref();
        bytes.ok_or_else(|| {
            self.messages
                .failure("fmi2SerializeFMUstate", Status::Nothing)
        })
    }
}

impl Instance for Instance2 {
    fn set(&self, references: &[u32], values: &[f64]) -> Result<(), CallFailure> {
        // SAFETY: both lists have the length that is given.
        self.check("fmi2SetReal", || unsafe {
            (self.functions.set)(
                self.component,
                references.as_ptr(),
                references.len().min(values.len()),
                values.as_ptr(),
            )
        })
    }

    fn get(&self, references: &[u32], values: &mut [f64]) -> Result<(), CallFailure> {
        // SAFETY: both lists have the length that is given.
        self.check("fmi2GetReal", || unsafe {
            (self.functions.get)(
                self.component,
                references.as_ptr(),
                references.len().min(values.len()),
                values.as_mut_ptr(),
            )
        })
    }

    fn set_derivatives(
        &self,
        references: &[u32],
        orders: &[i32],
        values: &[f64],
    ) -> Result<(), CallFailure> {
        const FUNCTION: &str = "fmi2SetRealInputDerivatives";
        let Some(derivatives) = self.functions.derivatives else {
            return Err(self.messages.failure(FUNCTION, Status::Nothing));
        };
        let length = references.len().min(orders.len()).min(values.len());
        // SAFETY: all lists have at least this length.
        self.check(FUNCTION, || unsafe {
            derivatives(
                self.component,
                references.as_ptr(),
                length,
                orders.as_ptr(),
                values.as_ptr(),
            )
        })
    }

    fn step(
        &self,
        [start, length]: [f64; 2],
        may_go_back: bool,
        _inside: Option<Inside<'_>>,
    ) -> Result<(), CallFailure> {
        let never_back = if may_go_back { FALSE } else { TRUE };
        // SAFETY: the component is alive.
        self.check("fmi2DoStep", || unsafe {
            (self.functions.step)(self.component, start, length, never_back)
        })
    }

    fn keep(&self, unneeded: Option<State>) -> Result<State, CallFailure> {
        let states = self.states()?;
        let mut state = unneeded.map_or(null_mut(), |state| state.0);
        // SAFETY: the state is null or one of this instance that nobody needs.
        self.check("fmi2GetFMUstate", || unsafe {
            (states.get)(self.component, &mut state)
        })?;
        Ok(State(state))
    }

    fn go_back(&self, state: State) -> Result<(), CallFailure> {
        let states = self.states()?;
        // SAFETY: the state is one of this instance, which has not freed it.
        self.check("fmi2SetFMUstate", || unsafe {
            (states.set)(self.component, state.0)
        })?;
        self.has_failed.set(false);
        Ok(())
    }

    fn free(&self, state: State) {
        let mut state = state.0;
        if let (Some(states), false) = (&self.functions.states, self.library.is_lost()) {
            // SAFETY: the state is one of this instance, and is given back once. What it answers changes nothing any more.
            let _ = unsafe { (states.free)(self.component, &mut state) };
        }
    }

    fn serialize(&self, state: State) -> Result<Vec<u8>, CallFailure> {
        let bytes = self.bytes()?;
        let mut size = 0;
        // SAFETY: the state is one of this instance.
        self.check("fmi2SerializedFMUstateSize", || unsafe {
            (bytes.size)(self.component, state.0, &mut size)
        })?;
        let mut written = vec![0; size];
        // SAFETY: as above; there is room for as many bytes as it asked for.
        self.check("fmi2SerializeFMUstate", || unsafe {
            (bytes.write)(self.component, state.0, written.as_mut_ptr(), size)
        })?;
        Ok(written)
    }

    fn deserialize(&self, written: &[u8]) -> Result<State, CallFailure> {
        let bytes = self.bytes()?;
        let mut state = null_mut();
        // SAFETY: as many bytes as are told.
        self.check("fmi2DeSerializeFMUstate", || unsafe {
            (bytes.read)(self.component, written.as_ptr(), written.len(), &mut state)
        })?;
        Ok(State(state))
    }
}

impl Drop for Instance2 {
    fn drop(&mut self) {
        if self.library.is_lost() {
            return;
        }
        let functions = &self.functions;
        // SAFETY: the component is alive and not used behind this. Answers change nothing any more.
        unsafe {
            if !self.has_failed.get() {
                let _ = (functions.terminate)(self.component) == OK;
            }
            (functions.free)(self.component);
        }
    }
}

fn asked(tolerance: Option<f64>) -> (Bool, f64) {
    match tolerance {
        Some(tolerance) => (TRUE, tolerance),
        None => (FALSE, 0.0),
    }
}
