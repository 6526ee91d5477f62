//! What an instance is built from.

mod values;

use std::collections::BTreeMap;

use linchpin_proto::v1::{self, value::Kind};

use crate::JointLoad;

pub use values::Values;

/// Parameters, solver, start time and joint loads of a new instance. Defaults of the description are filled in.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    pub(crate) parameters: BTreeMap<String, v1::Value>,
    pub(crate) solver: String,
    pub(crate) options: BTreeMap<String, v1::Value>,
    pub(crate) t_start: f64,
    pub(crate) joint_loads: Vec<JointLoad>,
}

/// Why an instance cannot be built: `field` is the place in the scene's subsystem, e.g. `parameters.m`.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SetupError {
    /// A required value is missing.
    #[error("{field} is missing")]
    Missing {
        /// Place.
        field: String,
    },
    /// A name that the model does not know.
    #[error("{field} is unknown to this model; known: {known}")]
    Unknown {
        /// Place.
        field: String,
        /// Names that are allowed, separated by commas.
        known: String,
    },
    /// A solver that the model does not have.
    #[error("this model has no solver \"{kind}\"; it has: {known}")]
    UnknownSolver {
        /// The kind asked for.
        kind: String,
        /// Kinds that there are, separated by commas.
        known: String,
    },
    /// Not of the right type.
    #[error("{field} must be {expected}")]
    WrongType {
        /// Place.
        field: String,
        /// What is allowed.
        expected: &'static str,
    },
    /// A text that is none of those allowed.
    #[error("{field} = \"{value}\" is unknown; known: {known}")]
    UnknownText {
        /// Place.
        field: String,
        /// The text given.
        value: String,
        /// What is allowed, separated by commas.
        known: String,
    },
    /// A number out of its range.
    #[error("{field} = {value} is out of range: {allowed}")]
    OutOfRange {
        /// Place.
        field: String,
        /// The value given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// Values that the model cannot put together: only it knows the rule.
    #[error("{field}: {reason}")]
    Refused {
        /// Place.
        field: String,
        /// The rule that is broken, by what, and what to do.
        reason: String,
    },
}

impl SetupError {
    /// Place in the scene's subsystem.
    pub fn field(&self) -> &str {
        match self {
            Self::Missing { field }
            | Self::Unknown { field, .. }
            | Self::WrongType { field, .. }
            | Self::UnknownText { field, .. }
            | Self::OutOfRange { field, .. }
            | Self::Refused { field, .. } => field,
            Self::UnknownSolver { .. } => "solver.kind",
        }
    }
}

impl Setup {
    /// Setup of a model that is used without a master, with the defaults of its description.
    ///
    /// # Errors
    /// As for a request that comes over the wire: unknown or missing names.
    pub fn new(
        model: &v1::Model,
        parameters: &[(&str, f64)],
        solver: Option<v1::Solver>,
        t_start: f64,
    ) -> Result<Self, SetupError> {
        let parameters = parameters
            .iter()
            .map(|&(name, number)| {
                (
                    name.to_owned(),
                    v1::Value {
                        kind: Some(Kind::Number(number)),
                    },
                )
            })
            .collect();
        Self::from_request(model, parameters, solver, t_start)
    }

    /// Setup of a model with values of any type, as a request over the wire has them; defaults of the description are
    /// filled in.
    ///
    /// # Errors
    /// [`SetupError`]: names that are unknown or missing, a start time that is not finite.
    pub fn from_request(
        model: &v1::Model,
        mut parameters: BTreeMap<String, v1::Value>,
        solver: Option<v1::Solver>,
        t_start: f64,
    ) -> Result<Self, SetupError> {
        values::finite("t_start".to_owned(), t_start)?;
        complete("parameters", &mut parameters, &model.parameters)?;
        let mut setup = Self {
            parameters,
            solver: String::new(),
            options: BTreeMap::new(),
            t_start,
            joint_loads: Vec::new(),
        };
        let solver = match solver {
            Some(solver) => solver,
            None => v1::Solver {
                kind: model
                    .solvers
                    .first()
                    .map(|kind| kind.name.clone())
                    .unwrap_or_default(),
                options: BTreeMap::new(),
            },
        };
        if let Some(kind) = model.solvers.iter().find(|kind| kind.name == solver.kind) {
            setup.options = solver.options;
            complete("solver", &mut setup.options, &kind.options)?;
        } else if !model.solvers.is_empty() || !solver.kind.is_empty() {
            return Err(SetupError::UnknownSolver {
                kind: solver.kind,
                known: names(model.solvers.iter().map(|kind| &kind.name)),
            });
        }
        setup.solver = solver.kind;
        Ok(setup)
    }

    /// The same setup with these joint loads.
    pub fn with_joint_loads(self, joint_loads: Vec<JointLoad>) -> Self {
        Self {
            joint_loads,
            ..self
        }
    }

    /// The joint loads that the subsystem evaluates. None, unless the capabilities of the description say so.
    pub fn joint_loads(&self) -> &[JointLoad] {
        &self.joint_loads
    }

    /// Time at which the instance starts.
    pub fn t_start(&self) -> f64 {
        self.t_start
    }

    /// Kind of the solver asked for: one of the description.
    pub fn solver(&self) -> &str {
        &self.solver
    }

    /// All parameters.
    pub fn parameters(&self) -> Values<'_> {
        Values::parameters(&self.parameters)
    }

    /// All parameters by name, for models whose names are up to the scene.
    pub fn all_parameters(&self) -> &BTreeMap<String, v1::Value> {
        &self.parameters
    }

    /// A parameter that is a number.
    pub fn parameter(&self, name: &str) -> Result<f64, SetupError> {
        self.parameters().number(name)
    }

    /// A parameter that is a text.
    pub fn text_parameter(&self, name: &str) -> Result<&str, SetupError> {
        self.parameters().text(name)
    }

    /// A parameter that is a list of numbers, of any length.
    pub fn numbers_parameter(&self, name: &str) -> Result<&[f64], SetupError> {
        self.parameters().numbers(name)
    }

    /// A parameter that must be positive.
    pub fn positive_parameter(&self, name: &str) -> Result<f64, SetupError> {
        self.parameter_in(name, "it must be greater than 0", |value| value > 0.0)
    }

    /// A parameter that must not be negative.
    pub fn non_negative_parameter(&self, name: &str) -> Result<f64, SetupError> {
        self.parameter_in(name, "it must be 0 or greater", |value| value >= 0.0)
    }

    /// A parameter with a range of its own, told to the user by `allowed`.
    pub fn parameter_in(
        &self,
        name: &str,
        allowed: &'static str,
        is_allowed: impl Fn(f64) -> bool,
    ) -> Result<f64, SetupError> {
        self.parameters().number_in(name, allowed, is_allowed)
    }

    /// An option of the solver that must be positive.
    pub fn positive_option(&self, name: &str) -> Result<f64, SetupError> {
        self.option_in(name, "it must be greater than 0", |value| value > 0.0)
    }

    /// An option of the solver with a range of its own, told to the user by `allowed`.
    pub fn option_in(
        &self,
        name: &str,
        allowed: &'static str,
        is_allowed: impl Fn(f64) -> bool,
    ) -> Result<f64, SetupError> {
        Values::options(&self.options).number_in(name, allowed, is_allowed)
    }
}

fn complete(
    table: &str,
    values: &mut BTreeMap<String, v1::Value>,
    known: &[v1::Parameter],
) -> Result<(), SetupError> {
    for name in values.keys() {
        if !known.iter().any(|parameter| &parameter.name == name) {
            return Err(SetupError::Unknown {
                field: format!("{table}.{name}"),
                known: names(known.iter().map(|parameter| &parameter.name)),
            });
        }
    }
    for parameter in known {
        if values.contains_key(&parameter.name) {
            continue;
        }
        let default = parameter.default.ok_or_else(|| SetupError::Missing {
            field: format!("{table}.{}", parameter.name),
        })?;
        let value = v1::Value {
            kind: Some(Kind::Number(default)),
        };
        values.insert(parameter.name.clone(), value);
    }
    Ok(())
}

/// Names for a message.
pub(crate) fn names<'a>(names: impl Iterator<Item = &'a String>) -> String {
    let names: Vec<&str> = names.map(String::as_str).collect();
    if names.is_empty() {
        return "none".into();
    }
    names.join(", ")
}
