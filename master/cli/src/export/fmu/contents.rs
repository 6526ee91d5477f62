//! What the library of an exported scene finds in the archive.

use std::fs;
use std::path::Path;

use linchpin_master::scene::{Override, Scene, SceneErrors, parse};
use linchpin_proto::v1::{Value, value::Kind};
use serde::{Deserialize, Serialize};

use super::FmuExportError;

/// The file in the folder of resources.
pub const FILE: &str = "linchpin.json";

/// A scene and what an importer sees of it. The value reference of an output is its place among the outputs, that of a parameter its place behind them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Contents {
    /// Tells that the description belongs to these contents.
    pub token: String,
    /// Text of the scene.
    pub scene: String,
    /// Settings of it that are changed, each as `KEY=VALUE`.
    pub settings: Vec<String>,
    /// The case, if the scene has some.
    pub case: Option<String>,
    /// Result columns.
    pub outputs: Vec<String>,
    /// Parameters of subsystems, each as `SUBSYSTEM.NAME`.
    pub parameters: Vec<String>,
}

impl Contents {
    /// Gives them the token that tells them from others: those of equal contents are equal.
    pub(super) fn sign(&mut self) {
        let names = [&self.settings, &self.outputs, &self.parameters];
        let names: Vec<String> = names.iter().map(|own| own.join("\n")).collect();
        let case = self.case.as_deref().unwrap_or_default();
        let scene = crc32fast::hash(self.scene.as_bytes());
        let rest = crc32fast::hash(format!("{}\n\n{case}", names.join("\n\n")).as_bytes());
        let version = env!("CARGO_PKG_VERSION");
        self.token = format!("linchpin-{version}-{scene:08x}-{rest:08x}");
    }

    /// Reads them from the folder of resources.
    ///
    /// # Errors
    /// [`FmuExportError::Resources`].
    pub fn read(resources: &Path) -> Result<Self, FmuExportError> {
        let path = resources.join(FILE);
        let damaged = |what: String| FmuExportError::Resources {
            path: path.clone(),
            what,
        };
        let text = fs::read_to_string(&path).map_err(|error| damaged(error.to_string()))?;
        serde_json::from_str(&text).map_err(|error| damaged(error.to_string()))
    }

    /// The scene with its settings, as it is in its case.
    ///
    /// # Errors
    /// Mistakes in the scene; a case that it does not have.
    pub fn scene(&self) -> Result<Scene, FmuExportError> {
        let settings = self.settings.iter().map(|text| {
            let setting: Result<Override, _> = text.parse();
            setting.map_err(|_| FmuExportError::NoSetting(text.clone()))
        });
        let settings: Vec<Override> = settings.collect::<Result<_, _>>()?;
        let scene = parse(&self.scene, "scene.toml", &settings).map_err(boxed)?;
        let names: Vec<String> = scene.cases.iter().map(|case| case.name.clone()).collect();
        match &self.case {
            None if names.is_empty() => Ok(scene),
            None => Err(FmuExportError::WhichCase(names)),
            Some(name) => {
                let case = scene.cases.iter().find(|case| case.name == *name);
                let case = case.ok_or_else(|| FmuExportError::NoCase {
                    name: name.clone(),
                    known: names,
                })?;
                scene.with_case(case).map_err(boxed)
            }
        }
    }
}

fn boxed(errors: SceneErrors) -> FmuExportError {
    FmuExportError::Scene(Box::new(errors))
}

/// Where a parameter `SUBSYSTEM.NAME` stands in a scene: number of the subsystem, and the name.
pub fn find_parameter<'a>(scene: &Scene, parameter: &'a str) -> Option<(usize, &'a str)> {
    let (subsystem, name) = parameter.split_once('.')?;
    let number = { scene.subsystems.iter() }.position(|own| own.name == subsystem)?;
    Some((number, name))
}

/// Gives a parameter of a subsystem a number.
pub fn set_parameter(scene: &mut Scene, (number, name): (usize, &str), value: f64) {
    let kind = Some(Kind::Number(value));
    let parameters = &mut scene.subsystems[number].parameters;
    parameters.insert(name.to_owned(), Value { kind });
}
