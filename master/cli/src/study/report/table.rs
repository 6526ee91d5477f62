//! The numbers of a report for other programs: `report.csv` and `report.json`.

use linchpin_master::results::Statistics;
use serde::Serialize;

use super::pictures::MONOLITHIC;
use super::summary::{EnvelopeRow, envelope};
use super::{Depth, Ending, Report, SceneReport, SettingReport};
use crate::study::errors::Quantity;
use crate::study::orders;

/// One run; what is not known is an empty field in the table and null in JSON.
#[derive(Serialize)]
struct Row<'a> {
    scene: &'a str,
    setting: &'a str,
    method: &'a str,
    is_paper: bool,
    macro_step: Option<f64>,
    tolerance: Option<f64>,
    ending: &'static str,
    stable: bool,
    reason: Option<String>,
    measure: &'static str,
    error: Option<f64>,
    order: Option<f64>,
    nrms_position: Option<f64>,
    nrms_velocity: Option<f64>,
    nrms_state: Option<f64>,
    nrms_multiplier: Option<f64>,
    integrations: Option<u64>,
    predictor: Option<u64>,
    columns: Option<u64>,
    passes: Option<u64>,
    corrector: Option<u64>,
    exchanges: Option<u64>,
    macro_steps: Option<u64>,
    solver_steps: Option<u64>,
    wall_time: Option<f64>,
}

#[derive(Serialize)]
struct Json<'a> {
    linchpin: &'static str,
    study: &'a str,
    title: &'a str,
    quick: bool,
    sequential: bool,
    scenes: Vec<SceneJson<'a>>,
}

#[derive(Serialize)]
struct SceneJson<'a> {
    name: &'a str,
    file: &'a str,
    measure: &'static str,
    reference: &'a str,
    settings: Vec<SettingJson<'a>>,
    monolithic: Vec<RunJson<'a>>,
    envelope: Vec<EnvelopeRow>,
}

#[derive(Serialize)]
struct SettingJson<'a> {
    name: &'a str,
    set: &'a [String],
    runs: Vec<RunJson<'a>>,
}

#[derive(Serialize)]
struct RunJson<'a> {
    #[serde(flatten)]
    row: Row<'a>,
    statistics: Option<&'a Statistics>,
}

impl Report {
    /// A row of `report.csv` for each run, those of monolithic scenes behind those of the settings.
    pub fn rows(&self) -> impl Iterator<Item = impl Serialize> {
        self.scenes.iter().flat_map(|scene| {
            let settings = scene.settings.iter().flat_map(|own| scene.rows(own));
            settings.chain(scene.monolithic_rows()).map(|(row, _)| row)
        })
    }
}

/// Everything as JSON.
///
/// # Errors
/// A number has no JSON.
pub fn json(report: &Report) -> Result<String, serde_json::Error> {
    let json = Json {
        linchpin: env!("CARGO_PKG_VERSION"),
        study: &report.name,
        title: &report.title,
        quick: report.depth == Depth::Quick,
        sequential: true,
        scenes: report
            .scenes
            .iter()
            .map(|scene| scene.json(&report.targets))
            .collect(),
    };
    Ok(serde_json::to_string_pretty(&json)? + "\n")
}

impl SceneReport {
    fn rows<'a>(
        &'a self,
        setting: &'a SettingReport,
    ) -> impl Iterator<Item = (Row<'a>, &'a Ending)> {
        let orders = orders::neighbouring(&setting.runs, self.quantity);
        let runs = setting.runs.iter().zip(orders);
        runs.map(|(run, order)| {
            let row = Row {
                method: &setting.method,
                is_paper: setting.is_paper,
                macro_step: Some(run.macro_step),
                order,
                ..self.row(&setting.name, &run.ending)
            };
            (row, &run.ending)
        })
    }

    fn monolithic_rows(&self) -> impl Iterator<Item = (Row<'_>, &Ending)> {
        self.monolithic.iter().map(|run| {
            let row = Row {
                tolerance: Some(run.tolerance),
                ..self.row(MONOLITHIC, &run.ending)
            };
            (row, &run.ending)
        })
    }

    fn row<'a>(&'a self, setting: &'a str, ending: &Ending) -> Row<'a> {
        let statistics = ending.statistics();
        let causes = statistics.map(|own| own.integrations_by_cause);
        let reason = ending.instability(self.quantity);
        Row {
            scene: &self.name,
            setting,
            method: "",
            is_paper: false,
            macro_step: None,
            tolerance: None,
            ending: ending.word(),
            stable: reason.is_none(),
            reason,
            measure: self.quantity.name(),
            error: ending.error(self.quantity),
            order: None,
            nrms_position: ending.error(Quantity::Position),
            nrms_velocity: ending.error(Quantity::Velocity),
            nrms_state: ending.error(Quantity::State),
            nrms_multiplier: ending.error(Quantity::Multiplier),
            integrations: statistics.map(|own| own.integrations),
            predictor: causes.map(|own| own.predictor),
            columns: causes.map(|own| own.columns),
            passes: causes.map(|own| own.passes),
            corrector: causes.map(|own| own.corrector),
            exchanges: statistics.map(|own| own.exchanges),
            macro_steps: statistics.map(|own| own.macro_steps),
            solver_steps: statistics.map(|own| own.solver_steps),
            wall_time: ending.wall_time(),
        }
    }

    fn json(&self, targets: &[f64]) -> SceneJson<'_> {
        let settings = self.settings.iter().map(|setting| SettingJson {
            name: &setting.name,
            set: &setting.set,
            runs: self.rows(setting).map(RunJson::new).collect(),
        });
        SceneJson {
            name: &self.name,
            file: &self.file,
            measure: self.quantity.name(),
            reference: &self.reference,
            settings: settings.collect(),
            monolithic: self.monolithic_rows().map(RunJson::new).collect(),
            envelope: envelope(self, targets),
        }
    }
}

impl<'a> RunJson<'a> {
    fn new((row, ending): (Row<'a>, &'a Ending)) -> Self {
        let statistics = ending.statistics();
        Self { row, statistics }
    }
}
