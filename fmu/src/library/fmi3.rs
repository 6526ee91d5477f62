//! Instances of FMI 3.0.

mod functions;
mod update;

use std::cell::Cell;
use std::ffi::{c_char, c_int, c_void};
use std::ptr::null_mut;
use std::sync::Arc;

use super::call::{CallFailure, Messages, OK, Status, terminated, text_of};
use super::{Inside, Instance, Library, Start, StartValue, State};
use crate::description::Kind;
pub(super) use functions::Functions;
use functions::{Bytes, States};
use update::{IntermediateUpdate, Update, intermediate_update};

type Handle = *mut c_void;
type Environment = *mut c_void;
type Set<T> = unsafe extern "C" fn(Handle, *const u32, usize, *const T, usize) -> c_int;

/// What the callbacks of an instance see.
#[derive(Default)]
struct Surroundings {
    messages: Messages,
    name: String,
    update: Update,
}

/// An instance.
pub(super) struct Instance3 {
    library: Arc<Library>,
    functions: Arc<Functions>,
    handle: Handle,
    /// The FMU keeps a pointer to it.
    around: Box<Surroundings>,
    /// It is in no sound state.
    has_failed: Cell<bool>,
}

// SAFETY: FMI lets any thread call an instance, one at a time; whoever has the value is the only one that can.
unsafe impl Send for Instance3 {}

/// # Safety
/// Called by an FMU with what the standard prescribes.
unsafe extern "C" fn log(
    environment: Environment,
    status: c_int,
    _category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the environment of an instance outlives it.
    let Some(around) = (unsafe { environment.cast::<Surroundings>().as_ref() }) else {
        return;
    };
    // SAFETY: texts of the standard end with zero.
    let message = unsafe { text_of(message) };
    around.messages.note(&around.name, status, &message);
}

impl Instance3 {
    pub(super) fn start(
        library: &Arc<Library>,
        functions: &Arc<Functions>,
        start: &Start<'_>,
    ) -> Result<Self, CallFailure> {
        let own = Self::instantiate(library, functions, start)?;
        for value in &start.values {
            own.set_start(value)?;
        }
        let tolerance = start.tolerance;
        // SAFETY: the instance is alive, as in all calls that follow.
        own.check("fmi3EnterInitializationMode", || unsafe {
            (functions.enter)(
                own.handle,
                tolerance.is_some(),
                tolerance.unwrap_or_default(),
                start.time,
                false,
                0.0,
            )
        })?;
        // SAFETY: as above.
        own.check("fmi3ExitInitializationMode", || unsafe {
            (functions.exit)(own.handle)
        })?;
        Ok(own)
    }

    fn instantiate(
        library: &Arc<Library>,
        functions: &Arc<Functions>,
        start: &Start<'_>,
    ) -> Result<Self, CallFailure> {
        const FUNCTION: &str = "fmi3InstantiateCoSimulation";
        let around = Box::new(Surroundings {
            name: start.name.to_owned(),
            update: Update::new(functions.set, start.set_inside),
            ..Surroundings::default()
        });
        if library.is_lost() {
            return Err(around.messages.failure(FUNCTION, Status::Lost));
        }
        let environment: *const Surroundings = &*around;
        let resources = format!("{}/", library.resources().display());
        let texts = [start.name, &library.description.token, &resources].map(terminated);
        let [name, token, resources] = texts.each_ref().map(|text| text.as_ptr());
        let inside = start.set_inside;
        let updated: Option<IntermediateUpdate> = match inside.is_empty() {
            true => None,
            false => Some(intermediate_update),
        };
        // SAFETY: texts and lists live over the call, the environment as long as the instance.
        let handle = unsafe {
            (functions.instantiate)(
                name,
                token,
                resources,
                false,
                false,
                false,
                false,
                inside.as_ptr(),
                inside.len(),
                environment.cast_mut().cast(),
                log,
                updated,
            )
        };
        if handle.is_null() {
            return Err(around.messages.failure(FUNCTION, Status::Nothing));
        }
        Ok(Self {
            library: Arc::clone(library),
            functions: Arc::clone(functions),
            handle,
            around,
            has_failed: Cell::new(false),
        })
    }

    fn check(
        &self,
        function: &'static str,
        call: impl FnOnce() -> c_int,
    ) -> Result<(), CallFailure> {
        if self.library.is_lost() {
            return Err(self.failure(function, Status::Lost));
        }
        let answer = self.around.messages.check(function, call());
        if let Err(failure) = &answer {
            self.has_failed.set(failure.status != Status::Discard);
            if failure.status == Status::Fatal {
                self.library.lose();
            }
        }
        answer
    }

    fn failure(&self, function: &'static str, status: Status) -> CallFailure {
        self.around.messages.failure(function, status)
    }

    fn set_start(&self, value: &StartValue) -> Result<(), CallFailure> {
        match value.kind {
            Kind::Real => self.set_one(
                "fmi3SetFloat64",
                Some(self.functions.set),
                value,
                value.number,
            ),
            Kind::Integer => {
                let number = value.number as i32;
                self.set_one("fmi3SetInt32", self.functions.set_integer, value, number)
            }
            Kind::Long => {
                let number = value.number as i64;
                self.set_one("fmi3SetInt64", self.functions.set_long, value, number)
            }
            Kind::Boolean => {
                let flag = value.number != 0.0;
                self.set_one("fmi3SetBoolean", self.functions.set_boolean, value, flag)
            }
            Kind::Text => {
                let text = terminated(&value.text);
                let set = self.functions.set_text;
                self.set_one("fmi3SetString", set, value, text.as_ptr())
            }
        }
    }

    fn set_one<T>(
        &self,
        function: &'static str,
        set: Option<Set<T>>,
        start: &StartValue,
        value: T,
    ) -> Result<(), CallFailure> {
        let set = set.ok_or_else(|| self.failure(function, Status::Nothing))?;
        // SAFETY: one reference and one value; a text lives over the call, and the FMU copies it.
        self.check(function, || unsafe {
            set(self.handle, &start.reference, 1, &value, 1)
        })
    }

    fn states(&self) -> Result<&States, CallFailure> {
        let states = self.functions.states.as_ref();
        states.ok_or_else(|| self.failure("fmi3GetFMUState", Status::Nothing))
    }

    fn bytes(&self) -> Result<&Bytes, CallFailure> {
        let bytes = self.functions.bytes.as_ref();
        bytes.ok_or_else(|| self.failure("fmi3SerializeFMUState", Status::Nothing))
    }
}

impl Instance for Instance3 {
    fn set(&self, references: &[u32], values: &[f64]) -> Result<(), CallFailure> {
        let length = references.len().min(values.len());
        // SAFETY: both lists have at least this length.
        self.check("fmi3SetFloat64", || unsafe {
            (self.functions.set)(
                self.handle,
                references.as_ptr(),
                length,
                values.as_ptr(),
                length,
            )
        })
    }

    fn get(&self, references: &[u32], values: &mut [f64]) -> Result<(), CallFailure> {
        let length = references.len().min(values.len());
        // SAFETY: both lists have at least this length.
        self.check("fmi3GetFloat64", || unsafe {
            (self.functions.get)(
                self.handle,
                references.as_ptr(),
                length,
                values.as_mut_ptr(),
                length,
            )
        })
    }

    fn set_derivatives(&self, _: &[u32], _: &[i32], _: &[f64]) -> Result<(), CallFailure> {
        // FMI 3 has no such call.
        Err(self.failure("fmi3SetInputDerivatives", Status::Nothing))
    }

    fn step(
        &self,
        [start, length]: [f64; 2],
        may_go_back: bool,
        inside: Option<Inside<'_>>,
    ) -> Result<(), CallFailure> {
        const FUNCTION: &str = "fmi3DoStep";
        let (mut event, mut ends, mut early, mut reached) = (false, false, false, start);
        let inside = inside.as_ref();
        // SAFETY: the instance is alive, and what it writes to lives over the call.
        let step = || unsafe {
            (self.functions.step)(
                self.handle,
                start,
                length,
                !may_go_back,
                &mut event,
                &mut ends,
                &mut early,
                &mut reached,
            )
        };
        // SAFETY: the update is taken back when the call has returned.
        let (answer, missed) = unsafe {
            self.around
                .update
                .during(self.handle, inside, || self.check(FUNCTION, step))
        };
        answer?;
        if let Some(status) = missed {
            return self.around.messages.check("fmi3SetFloat64", status);
        }
        match (ends, early) {
            (true, _) => {
                self.has_failed.set(true);
                Err(self.failure(FUNCTION, Status::Terminated))
            }
            (_, true) => Err(self.failure(FUNCTION, Status::Discard)),
            _ => Ok(()),
        }
    }

    fn keep(&self, unneeded: Option<State>) -> Result<State, CallFailure> {
        let states = self.states()?;
        let mut state = unneeded.map_or(null_mut(), |state| state.0);
        // SAFETY: the state is null or one of this instance that nobody needs.
        self.check("fmi3GetFMUState", || unsafe {
            (states.get)(self.handle, &mut state)
        })?;
        Ok(State(state))
    }

    fn go_back(&self, state: State) -> Result<(), CallFailure> {
        let states = self.states()?;
        // SAFETY: the state is one of this instance, which has not freed it.
        self.check("fmi3SetFMUState", || unsafe {
            (states.set)(self.handle, state.0)
        })?;
        self.has_failed.set(false);
        Ok(())
    }

    fn free(&self, state: State) {
        let mut state = state.0;
        if let (Some(states), false) = (&self.functions.states, self.library.is_lost()) {
            // SAFETY: the state is one of this instance, and is given back once. What it answers changes nothing any more.
            let _ = unsafe { (states.free)(self.handle, &mut state) };
        }
    }

    fn serialize(&self, state: State) -> Result<Vec<u8>, CallFailure> {
        let bytes = self.bytes()?;
        let mut size = 0;
        // SAFETY: the state is one of this instance.
        self.check("fmi3SerializedFMUStateSize", || unsafe {
            (bytes.size)(self.handle, state.0, &mut size)
        })?;
        let mut written = vec![0; size];
        // SAFETY: as above; there is room for as many bytes as it asked for.
        self.check("fmi3SerializeFMUState", || unsafe {
            (bytes.write)(self.handle, state.0, written.as_mut_ptr(), size)
        })?;
        Ok(written)
    }

    fn deserialize(&self, written: &[u8]) -> Result<State, CallFailure> {
        let bytes = self.bytes()?;
        let mut state = null_mut();
        // SAFETY: as many bytes as are told.
        self.check("fmi3DeserializeFMUState", || unsafe {
            (bytes.read)(self.handle, written.as_ptr(), written.len(), &mut state)
        })?;
        Ok(State(state))
    }
}

impl Drop for Instance3 {
    fn drop(&mut self) {
        if self.library.is_lost() {
            return;
        }
        // SAFETY: the instance is alive and not used behind this. Answers change nothing any more.
        unsafe {
            if !self.has_failed.get() {
                let _ = (self.functions.terminate)(self.handle) == OK;
            }
            (self.functions.free)(self.handle);
        }
    }
}
