//! The library of an FMU in this process. All code that is unsafe is in this file and its folder.
//!
//! What a foreign library does cannot be checked: it is trusted to have the functions of FMI with the types of the standard, and to be
//! as sound as any program. That is why every FMU has a process of its own.

#![allow(unsafe_code, reason = "functions of a foreign library are called")]

mod call;
mod fmi2;
mod fmi3;
mod symbols;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use libloading::Library as Loaded;
use linchpin_worker::Inputs;
use tempfile::TempDir;

use crate::description::{Description, Kind, Version};
use crate::{FmuError, archive};

pub use call::{CallFailure, Status};

/// The functions of a loaded FMU.
enum Functions {
    Two(Arc<fmi2::Functions>),
    Three(Arc<fmi3::Functions>),
}

/// A loaded FMU.
pub struct Library {
    functions: Functions,
    description: Description,
    folder: TempDir,
    /// A call has ended with the status Fatal: no instance may be called any more.
    is_lost: AtomicBool,
    /// Behind the functions, which it must outlive.
    _loaded: Loaded,
}

/// What an instance starts from.
#[derive(Debug)]
pub struct Start<'a> {
    /// Name of the instance.
    pub name: &'a str,
    /// Values that are set before the start.
    pub values: Vec<StartValue>,
    /// Error tolerance that is asked for.
    pub tolerance: Option<f64>,
    /// Start time (s).
    pub time: f64,
    /// Inputs that are set inside a step.
    pub set_inside: &'a [u32],
}

/// A value that is set before the start.
#[derive(Debug, Clone, PartialEq)]
pub struct StartValue {
    /// Which variable.
    pub reference: u32,
    /// Its type.
    pub kind: Kind,
    /// The number, or 0 and 1 for false and true.
    pub number: f64,
    /// The text.
    pub text: String,
}

/// A state that stays inside the FMU.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct State(*mut std::ffi::c_void);

// SAFETY: the pointer is only ever given back to the instance that it came from, by whoever has that instance.
unsafe impl Send for State {}
// SAFETY: as above; a shared reference can do nothing with it.
unsafe impl Sync for State {}

/// How the values of inputs change inside a step.
#[derive(Debug)]
pub struct Inside<'a> {
    /// The polynomials of all inputs over the time since `start`.
    pub inputs: &'a Inputs,
    /// Time from which they count (s).
    pub start: f64,
}

/// What both versions of FMI can do with an instance.
pub trait Instance: Send {
    /// Sets inputs.
    fn set(&self, references: &[u32], values: &[f64]) -> Result<(), CallFailure>;

    /// Reads variables.
    fn get(&self, references: &[u32], values: &mut [f64]) -> Result<(), CallFailure>;

    /// Sets derivatives of inputs with respect to time, in units per s^order.
    fn set_derivatives(
        &self,
        references: &[u32],
        orders: &[i32],
        values: &[f64],
    ) -> Result<(), CallFailure>;

    /// Steps over an interval, its start and its length (s); `may_go_back` says that a state before it may be set afterwards.
    fn step(
        &self,
        interval: [f64; 2],
        may_go_back: bool,
        inside: Option<Inside<'_>>,
    ) -> Result<(), CallFailure>;

    /// Keeps the present state, in the memory of one that is no longer needed.
    fn keep(&self, unneeded: Option<State>) -> Result<State, CallFailure>;

    /// Goes back to a state.
    fn go_back(&self, state: State) -> Result<(), CallFailure>;

    /// Frees a state.
    fn free(&self, state: State);

    /// Writes a state as bytes.
    fn serialize(&self, state: State) -> Result<Vec<u8>, CallFailure>;

    /// Makes a state of bytes.
    fn deserialize(&self, bytes: &[u8]) -> Result<State, CallFailure>;
}

impl Library {
    /// Unpacks the FMU at `path` and loads its library.
    ///
    /// # Errors
    /// [`FmuError`]: the archive, the platform, the library or its functions.
    pub fn load(path: &Path, description: &Description) -> Result<Self, FmuError> {
        refuse_static(path)?;
        let folder = archive::unpack(path)?;
        let wanted = description.library_path();
        let file = folder.path().join(&wanted);
        if !file.is_file() {
            let found = platforms(&folder.path().join("binaries"));
            let path = path.to_owned();
            return Err(FmuError::Platform {
                path,
                wanted,
                found,
            });
        }
        // SAFETY: this runs the initialisers of a foreign library; that they are sound is what serving an FMU takes for granted.
        let loaded = unsafe { Loaded::new(&file) }.map_err(|error| FmuError::Load {
            path: path.to_owned(),
            reason: error.to_string(),
        })?;
        let symbols = symbols::Symbols {
            library: &loaded,
            path,
            version: description.version.name(),
        };
        let functions = match description.version {
            Version::Two => {
                let functions = fmi2::Functions::of(&symbols, description.abilities)?;
                Functions::Two(Arc::new(functions))
            }
            Version::Three => {
                let functions = fmi3::Functions::of(&symbols, description.abilities)?;
                Functions::Three(Arc::new(functions))
            }
        };
        Ok(Self {
            functions,
            description: description.clone(),
            folder,
            is_lost: AtomicBool::new(false),
            _loaded: loaded,
        })
    }

    /// Makes an instance and brings it to its start.
    ///
    /// # Errors
    /// A call that fails.
    pub fn start(self: &Arc<Self>, start: &Start<'_>) -> Result<Box<dyn Instance>, CallFailure> {
        match &self.functions {
            Functions::Two(functions) => {
                Ok(Box::new(fmi2::Instance2::start(self, functions, start)?))
            }
            Functions::Three(functions) => {
                Ok(Box::new(fmi3::Instance3::start(self, functions, start)?))
            }
        }
    }

    /// Resources of the FMU.
    fn resources(&self) -> PathBuf {
        self.folder.path().join("resources")
    }

    /// No instance may be called any more.
    fn lose(&self) {
        self.is_lost.store(true, Ordering::Relaxed);
    }

    fn is_lost(&self) -> bool {
        self.is_lost.load(Ordering::Relaxed)
    }
}

/// A static program has no loader for libraries.
fn refuse_static(path: &Path) -> Result<(), FmuError> {
    if cfg!(target_feature = "crt-static") {
        let path = path.to_owned();
        return Err(FmuError::Static { path });
    }
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        return Err(FmuError::Machine);
    }
    Ok(())
}

/// The platforms for which there are libraries.
fn platforms(binaries: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(binaries).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries
        .filter(|entry| entry.path().is_dir())
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}
