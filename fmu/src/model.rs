//! An FMU as a model of a worker.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::AtomicUsize;
use std::sync::{Arc, OnceLock};

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Model, Setup, Subsystem};

use crate::description::{Description, Kind, Role, Variable, Version};
use crate::library::{CallFailure, Library, Start};
use crate::subsystem::{Running, Way};
use crate::{FmuError, markers, parameters};

/// Inputs by their value and their derivatives at the start of a call (FMI 2).
pub const INPUT_DERIVATIVES: &str = "input-derivatives";
/// Inputs that are set inside a call (FMI 3).
pub const INTERMEDIATE_UPDATE: &str = "intermediate-update";
/// Inputs that are constant during a call, and several calls for a macro step.
pub const SUB_STEPS: &str = "sub-steps";

/// Options of these solvers.
pub const SUBSTEPS: &str = "substeps";
/// See [`SUBSTEPS`].
pub const ORDER: &str = "order";
/// See [`SUBSTEPS`].
pub const TOLERANCE: &str = "tolerance";

/// Highest order of derivatives of inputs: signals have no more.
pub const HIGHEST_ORDER: usize = linchpin_proto::polynomial::MAX_NODES - 1;

/// Most sub-steps of a macro step.
const MOST_SUBSTEPS: f64 = 10_000.0;

/// A loaded FMU.
pub struct Fmu {
    description: Description,
    library: Arc<Library>,
    /// Highest order of derivatives of inputs that it takes, once it was asked.
    order: OnceLock<usize>,
    /// Instances at present.
    instances: Arc<AtomicUsize>,
}

impl Fmu {
    /// Reads, unpacks and loads the FMU at `path`.
    ///
    /// # Errors
    /// [`FmuError`].
    pub fn load(path: &Path) -> Result<Self, FmuError> {
        let description = Description::of(path)?;
        let library = Arc::new(Library::load(path, &description)?);
        Ok(Self {
            description,
            library,
            order: OnceLock::new(),
            instances: Arc::default(),
        })
    }

    fn refuse(&self, field: &str, reason: String) -> SetupError {
        let field = field.to_owned();
        let reason = format!("FMU \"{}\": {reason}", self.description.name);
        SetupError::Refused { field, reason }
    }

    fn failed(&self, failure: &CallFailure) -> SetupError {
        self.refuse("parameters", failure.to_string())
    }

    fn way(&self, setup: &Setup) -> Result<Way, SetupError> {
        let whole = |value: f64| value.fract() == 0.0;
        let substeps = setup.option_in(
            SUBSTEPS,
            "it must be a whole number from 0 (as many as keep the order) to 10000",
            |value| whole(value) && (0.0..=MOST_SUBSTEPS).contains(&value),
        )? as usize;
        match setup.solver() {
            INPUT_DERIVATIVES => {
                let order = setup.option_in(
                    ORDER,
                    "it must be a whole number from 0 (the highest that the FMU takes) to 7",
                    |value| whole(value) && (0.0..=HIGHEST_ORDER as f64).contains(&value),
                )? as usize;
                let order = match order {
                    0 => self.ask_order(setup)?,
                    order => order,
                };
                Ok(Way::Pieces { substeps, order })
            }
            INTERMEDIATE_UPDATE => Ok(Way::Inside {
                substeps: substeps.max(1),
            }),
            _ => Ok(Way::Pieces { substeps, order: 0 }),
        }
    }

    /// FMI has no way to say which orders of derivatives count: an instance that is good for nothing else is asked.
    fn ask_order(&self, setup: &Setup) -> Result<usize, SetupError> {
        if let Some(&order) = self.order.get() {
            return Ok(order);
        }
        let Some(input) = inputs(&self.description).next() else {
            return Ok(0);
        };
        let start = self.start(setup, &[])?;
        let asked = self.library.start(&start);
        let asked = asked.map_err(|failure| self.failed(&failure))?;
        let reference = &[input.reference];
        let takes = |order: &usize| {
            let order = i32::try_from(*order).unwrap_or(i32::MAX);
            asked.set_derivatives(reference, &[order], &[0.0]).is_ok()
        };
        let order = (1..=HIGHEST_ORDER).take_while(takes).count();
        tracing::info!(
            fmu = self.description.name,
            order,
            "derivatives of inputs are taken"
        );
        Ok(*self.order.get_or_init(|| order))
    }

    fn start<'a>(&'a self, setup: &Setup, set_inside: &'a [u32]) -> Result<Start<'a>, SetupError> {
        let tolerance = setup.option_in(
            TOLERANCE,
            "it must be 0 (the FMU's own) or greater",
            |value| value >= 0.0,
        )?;
        Ok(Start {
            name: &self.description.name,
            values: parameters::start_values(&self.description, setup)?,
            tolerance: Some(tolerance).filter(|value| *value > 0.0),
            time: setup.t_start(),
            set_inside,
        })
    }
}

impl Model for Fmu {
    fn describe(&self) -> v1::Model {
        let parameters = parameters::all(&self.description).into_iter();
        v1::Model {
            parameters: parameters.chain(markers::keys()).collect(),
            ..described(&self.description, &[])
        }
    }

    fn describe_with(
        &self,
        parameters: &BTreeMap<String, v1::Value>,
    ) -> Result<v1::Model, SetupError> {
        parameters::check(&self.description, parameters)?;
        let markers = markers::markers(&self.description, parameters)?;
        Ok(v1::Model {
            parameters: parameters::given(&self.description, parameters),
            ..described(&self.description, &markers)
        })
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        let markers = markers::markers(&self.description, setup.all_parameters())?;
        let way = self.way(setup)?;
        let inputs: Vec<u32> = inputs(&self.description).map(|own| own.reference).collect();
        let outputs = outputs(&self.description, &markers).into_iter();
        let outputs = outputs.map(|own| (own.name.clone(), own.reference));
        let set_inside = match way {
            Way::Inside { .. } => &inputs[..],
            Way::Pieces { .. } => &[],
        };
        let start = self.start(setup, set_inside)?;
        let running = Running::start(
            &self.library,
            &self.instances,
            &self.description,
            (&start, way),
            (inputs.clone(), outputs.collect()),
        );
        Ok(Box::new(
            running.map_err(|reason| self.refuse("parameters", reason))?,
        ))
    }
}

/// Inputs that signals may drive.
fn inputs(description: &Description) -> impl Iterator<Item = &Variable> {
    let all = description.variables.iter();
    all.filter(|own| own.kind == Kind::Real && own.role == Role::Input)
}

/// Outputs, and what markers read beside them.
fn outputs<'a>(description: &'a Description, markers: &[v1::Marker]) -> Vec<&'a Variable> {
    let is_read = |own: &Variable| {
        let lists = markers.iter().flat_map(|marker| {
            [&marker.position, &marker.velocity, &marker.acceleration].into_iter()
        });
        { lists }.flatten().any(|name| *name == own.name)
    };
    let all = description.variables.iter();
    all.filter(|own| own.kind == Kind::Real && (own.role == Role::Output || is_read(own)))
        .collect()
}

fn described(description: &Description, markers: &[v1::Marker]) -> v1::Model {
    let abilities = description.abilities;
    let variable = |own: &Variable| v1::Variable {
        name: own.name.clone(),
        unit: own.unit.clone(),
        description: own.description.clone(),
        default: None,
    };
    let input = |own: &Variable| v1::Variable {
        default: Some(own.number().unwrap_or_default()),
        ..variable(own)
    };
    let outputs = outputs(description, markers);
    v1::Model {
        name: description.name.clone(),
        description: text(description),
        inputs: inputs(description).map(input).collect(),
        outputs: outputs.into_iter().map(variable).collect(),
        markers: markers.to_vec(),
        solvers: solvers(description),
        capabilities: Some(v1::Capabilities {
            // A solver with a tolerance chooses its steps, and chooses others when an input is a little different.
            repeats_step_sequence: description.tolerance.is_none(),
            exportable_snapshot: abilities.keeps_states && abilities.serializes_states,
            ..v1::Capabilities::default()
        }),
        forward_only: (!abilities.keeps_states).then(|| {
            let flag = flag(
                description.version,
                ["canGetAndSetFMUstate", "canGetAndSetFMUState"],
            );
            format!(
                "FMU \"{}\" cannot set a state: {flag} is not true in its modelDescription.xml",
                description.name
            )
        }),
        ..v1::Model::default()
    }
}

/// What it is, and what it cannot do.
fn text(description: &Description) -> String {
    let abilities = description.abilities;
    let grades = [
        (
            abilities.keeps_states,
            ["canGetAndSetFMUstate", "canGetAndSetFMUState"],
            "methods without a corrector only",
        ),
        (
            abilities.serializes_states,
            ["canSerializeFMUstate", "canSerializeFMUState"],
            "no checkpoints",
        ),
        (
            abilities.takes_input_derivatives || abilities.updates_inside,
            ["canInterpolateInputs", "providesIntermediateUpdate"],
            "inputs by sub-steps",
        ),
        (
            abilities.varies_steps,
            ["canHandleVariableCommunicationStepSize"; 2],
            "steps of one length only",
        ),
    ];
    let lacks = grades.into_iter().filter(|(is_there, ..)| !is_there);
    let lacks: Vec<String> = lacks
        .map(|(_, flags, what)| format!("{what} ({})", flag(description.version, flags)))
        .collect();
    let own = match description.text.as_str() {
        "" => String::new(),
        text => format!("{text}; "),
    };
    let lacks = match &lacks[..] {
        [] => String::new(),
        lacks => format!("; not offered, so: {}", lacks.join(", ")),
    };
    format!("{own}FMU of FMI {}{lacks}", description.version.name())
}

fn flag(version: Version, [two, three]: [&'static str; 2]) -> &'static str {
    match version {
        Version::Two => two,
        Version::Three => three,
    }
}

fn solvers(description: &Description) -> Vec<v1::SolverKind> {
    let option = |name: &str, description: &str, default: f64| v1::Parameter {
        name: name.to_owned(),
        unit: String::new(),
        description: description.to_owned(),
        default: Some(default),
    };
    let substeps = |default| {
        option(
            SUBSTEPS,
            "equal parts of a macro step, one call each; 0: as many as keep the order",
            default,
        )
    };
    let tolerance = || {
        option(
            TOLERANCE,
            "relative tolerance that the FMU is asked for; 0: its own",
            description.tolerance.unwrap_or_default(),
        )
    };
    let kind = |name: &str, text: &str, options| v1::SolverKind {
        name: name.to_owned(),
        description: text.to_owned(),
        options,
        without_impacts: false,
    };
    let mut kinds = Vec::new();
    if description.abilities.takes_input_derivatives {
        let order = option(
            ORDER,
            "highest derivative of inputs that is given, 1 to 7; 0: the highest that the FMU takes",
            0.0,
        );
        kinds.push(kind(
            INPUT_DERIVATIVES,
            "inputs by their value and derivatives at the start of every call",
            vec![order, substeps(0.0), tolerance()],
        ));
    }
    let mut inputs = inputs(description);
    if description.abilities.updates_inside && inputs.all(|own| own.is_updated_inside) {
        kinds.push(kind(
            INTERMEDIATE_UPDATE,
            "inputs are set inside a call, where the FMU asks for them",
            vec![substeps(1.0), tolerance()],
        ));
    }
    kinds.push(kind(
        SUB_STEPS,
        "inputs are constant during a call; their values keep the moments of the polynomial over the macro step",
        vec![substeps(0.0), tolerance()],
    ));
    kinds
}
