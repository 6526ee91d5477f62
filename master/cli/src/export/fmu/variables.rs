//! What an importer sees of a scene: result columns and parameters, and how the run steps.

use linchpin_master::results::{Column, Quantity, Row};
use linchpin_master::scene::{Scene, Served};
use linchpin_master::setup::{Options, describe};
use linchpin_proto::v1::{self, value::Kind};

use super::contents::{Contents, find_parameter};
use super::error::FmuExportError;
use crate::connect::{Connector, Place};
use crate::simulate;

/// An exported variable.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its unit, 1 or empty if there is none.
    pub unit: String,
    /// In words.
    pub description: String,
    /// Value at the start.
    pub start: f64,
}

/// A scene as an importer sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct Exported {
    /// What the library finds.
    pub contents: Contents,
    /// Name of the scene.
    pub name: String,
    /// Start and end in s.
    pub span: [f64; 2],
    /// First macro step in s.
    pub macro_step: f64,
    /// Tolerance, if the macro step follows one.
    pub tolerance: Option<f64>,
    /// The outputs, in the order of the contents.
    pub outputs: Vec<Variable>,
    /// The parameters, the same.
    pub parameters: Vec<Variable>,
    /// Whether states can be taken and given back.
    pub has_states: bool,
}

impl Exported {
    /// Starts the scene of `contents` in this process, and takes what it shows. Without outputs all outputs of subsystems and multipliers among the
    /// result columns are taken.
    ///
    /// # Errors
    /// The scene does not start, or does not have what is asked for.
    pub fn of(mut contents: Contents) -> Result<Self, FmuExportError> {
        for names in [&contents.outputs, &contents.parameters] {
            let twice =
                { names.iter().enumerate() }.find(|(place, name)| names[..*place].contains(name));
            if let Some((_, name)) = twice {
                return Err(FmuExportError::Twice(name.clone()));
            }
        }
        let scene = contents.scene()?;
        let inside = { scene.subsystems.iter() }.find(|own| matches!(own.served, Served::Fmu(_)));
        if let Some(fmu) = inside {
            return Err(FmuExportError::FmuInside(fmu.name.clone()));
        }
        let connector = Connector::new(Place::InProcess);
        let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
        let failed = |error| FmuExportError::Run(Box::new(error));
        let models = describe(&scene, &mut connect).map_err(failed)?;
        let started = simulate::start(&scene, &connector, &Options::default(), None);
        let run = started.map_err(failed)?;
        let outputs = outputs(run.row(), &contents.outputs)?;
        contents.outputs = outputs.iter().map(|own| own.name.clone()).collect();
        let parameters = contents.parameters.iter();
        let parameters = parameters.map(|name| parameter(&scene, &models, name));
        let parameters: Vec<Variable> = parameters.collect::<Result<_, _>>()?;
        for variable in &parameters {
            let found = find_parameter(&scene, &variable.name);
            let given = found.and_then(|(number, name)| number_of(&scene, number, name));
            if let (None, Some((number, name))) = (given, found) {
                let subsystem = &scene.subsystems[number].name;
                let value = variable.start;
                let setting = format!("subsystem.{subsystem}.parameters.{name}={value:?}");
                contents.settings.push(setting);
            }
        }
        contents.sign();
        let coupling = &scene.coupling;
        Ok(Self {
            name: scene.name.clone(),
            span: [scene.t_start, scene.t_end],
            macro_step: coupling.macro_step,
            tolerance: coupling
                .step_control
                .as_ref()
                .map(|control| control.tolerance),
            outputs,
            parameters,
            has_states: models.iter().all(exports_states),
            contents,
        })
    }
}

fn exports_states(model: &v1::Model) -> bool {
    { model.capabilities }.is_some_and(|capabilities| capabilities.exportable_snapshot)
}

fn is_shown(column: &Column) -> bool {
    use Quantity::{Acceleration, Attitude, Multiplier, Output, Position, Velocity};
    [
        Position,
        Attitude,
        Velocity,
        Acceleration,
        Output,
        Multiplier,
    ]
    .contains(&column.quantity)
}

fn outputs(row: &Row, names: &[String]) -> Result<Vec<Variable>, FmuExportError> {
    let columns = row.descriptions().iter().filter(|column| is_shown(column));
    let columns: Vec<&Column> = columns.collect();
    let variable = |column: &Column| Variable {
        name: column.name.clone(),
        unit: column.unit.clone(),
        description: column.description.clone(),
        start: row.get(&column.name).unwrap_or_default(),
    };
    if names.is_empty() {
        return Ok(columns.into_iter().map(variable).collect());
    }
    let of = |name: &String| {
        let found = columns.iter().find(|column| column.name == *name);
        let found = found.ok_or_else(|| FmuExportError::NoOutput {
            name: name.clone(),
            known: columns.iter().map(|own| own.name.clone()).collect(),
        });
        found.map(|column| variable(column))
    };
    names.iter().map(of).collect()
}

fn parameter(scene: &Scene, models: &[v1::Model], name: &str) -> Result<Variable, FmuExportError> {
    let found = find_parameter(scene, name).and_then(|(number, own)| {
        let described = { models[number].parameters.iter() }.find(|known| known.name == own);
        let default = described.and_then(|known| known.default);
        let start = number_of(scene, number, own).or(default)?;
        let of = |text: fn(&v1::Parameter) -> &String| {
            described.map_or_else(String::new, |known| text(known).clone())
        };
        Some(Variable {
            name: name.to_owned(),
            unit: of(|known| &known.unit),
            description: of(|known| &known.description),
            start,
        })
    });
    found.ok_or_else(|| FmuExportError::NoParameter {
        name: name.to_owned(),
        known: parameters_with_numbers(scene, models),
    })
}

/// The number that the scene gives a parameter of a subsystem.
pub fn number_of(scene: &Scene, number: usize, name: &str) -> Option<f64> {
    match scene.subsystems[number].parameters.get(name)?.kind {
        Some(Kind::Number(given)) => Some(given),
        _ => None,
    }
}

fn parameters_with_numbers(scene: &Scene, models: &[v1::Model]) -> Vec<String> {
    let subsystems = scene.subsystems.iter().zip(models).enumerate();
    let all = subsystems.flat_map(|(number, (own, model))| {
        let described = model.parameters.iter();
        let numbers = described.filter(move |known| {
            number_of(scene, number, &known.name)
                .or(known.default)
                .is_some()
        });
        numbers.map(move |known| format!("{}.{}", own.name, known.name))
    });
    all.collect()
}
