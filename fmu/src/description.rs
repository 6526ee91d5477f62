//! What an FMU says about itself in modelDescription.xml.

mod read;
mod xml;

use std::path::Path;

use crate::{FmuError, archive};

/// Most bytes of a description.
const MOST_BYTES: u64 = 256 << 20;

/// Version of FMI.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Version {
    /// FMI 2.0.
    Two,
    /// FMI 3.0.
    Three,
}

impl Version {
    /// As text, for messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Two => "2.0",
            Self::Three => "3.0",
        }
    }
}

/// What an FMU can do, beyond stepping.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Abilities {
    /// `canGetAndSetFMUstate`, `canGetAndSetFMUState`: it can go back.
    pub keeps_states: bool,
    /// `canSerializeFMUstate`, `canSerializeFMUState`: its states can leave the process.
    pub serializes_states: bool,
    /// `canInterpolateInputs` of FMI 2: derivatives of inputs are understood.
    pub takes_input_derivatives: bool,
    /// `providesIntermediateUpdate` of FMI 3: inputs may be set inside a step.
    pub updates_inside: bool,
    /// `canHandleVariableCommunicationStepSize`.
    pub varies_steps: bool,
    /// `canBeInstantiatedOnlyOncePerProcess`.
    pub once_per_process: bool,
}

/// Type of a variable, as far as it is offered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// `Real`, `Float64`.
    Real,
    /// `Integer`, `Enumeration` of FMI 2, `Int32` of FMI 3.
    Integer,
    /// `Int64`, `Enumeration` of FMI 3.
    Long,
    /// `Boolean`.
    Boolean,
    /// `String`.
    Text,
}

/// The role of a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Driven from outside.
    Input,
    /// Meant to be read.
    Output,
    /// Constant while it runs, and may be set before.
    Parameter,
    /// Anything else.
    Local,
}

/// One scalar variable.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its value reference.
    pub reference: u32,
    /// Its type.
    pub kind: Kind,
    /// Its role.
    pub role: Role,
    /// Whether it may be set before the start: parameters, and what has an exact start value.
    pub is_settable: bool,
    /// Its start value as it is written.
    pub start: Option<String>,
    /// Its unit; empty if there is none.
    pub unit: String,
    /// How many SI units its unit is, and the offset, where it is no SI unit.
    pub scale: Option<[f64; 2]>,
    /// What it is.
    pub description: String,
    /// Whether it may be set inside a step (FMI 3).
    pub is_updated_inside: bool,
}

impl Variable {
    /// Its start value as a number; `true` is 1.
    pub fn number(&self) -> Option<f64> {
        let start = self.start.as_deref()?.trim();
        match (self.kind, start) {
            (Kind::Text, _) => None,
            (Kind::Boolean, "true") => Some(1.0),
            (Kind::Boolean, "false") => Some(0.0),
            _ => start.parse().ok().filter(|value: &f64| value.is_finite()),
        }
    }
}

/// What an FMU says about itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Description {
    /// Version of FMI.
    pub version: Version,
    /// Name of the model.
    pub name: String,
    /// What it is.
    pub text: String,
    /// `guid`, `instantiationToken`.
    pub token: String,
    /// Name of its library, without the end.
    pub library: String,
    /// What it can do.
    pub abilities: Abilities,
    /// Tolerance of the default experiment.
    pub tolerance: Option<f64>,
    /// All scalar variables of the types that are offered.
    pub variables: Vec<Variable>,
}

impl Description {
    /// Reads the description out of an archive.
    ///
    /// # Errors
    /// [`FmuError`]: no archive, no description in it, or one that is not understood.
    pub fn of(path: &Path) -> Result<Self, FmuError> {
        let bytes = archive::read(path, "modelDescription.xml", MOST_BYTES)?;
        Self::parse(&bytes).map_err(|reason| FmuError::Description {
            path: path.to_owned(),
            reason,
        })
    }

    fn parse(bytes: &[u8]) -> Result<Self, String> {
        read::description(&xml::Element::read(bytes)?)
    }

    /// Path of the library in the archive, for Linux on x86_64.
    pub fn library_path(&self) -> String {
        let folder = match self.version {
            Version::Two => "linux64",
            Version::Three => "x86_64-linux",
        };
        format!("binaries/{folder}/{}.so", self.library)
    }

    /// The variable of this name.
    pub fn variable(&self, name: &str) -> Option<&Variable> {
        self.variables.iter().find(|variable| variable.name == name)
    }
}
