//! The lower envelope of a scene: what each method costs at best, beside S1 and the paper's own settings.

use serde::Serialize;

use super::envelope::{Cheapest, Cost, Ratio, cheapest, cost_of, ratio};
use super::{SceneReport, SettingReport};

/// The methods of S1.
const S1_METHODS: [&str; 2] = ["baumgarte", "weighted"];

/// What S1 does in every macro step, and here has to be asked for.
const AS_IN_S1: &str = "coupling.jacobian=\"every-step\"";

/// What these methods have here and not in S1.
const EXTRA: &str = "coupling.iterations=";

/// One method and one error.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EnvelopeRow {
    /// The coupling method.
    pub method: String,
    /// Relative error that is asked for.
    pub error: f64,
    /// The cheapest setting of the method; `None` if none of its runs came to its end.
    pub cheapest: Option<Cheapest>,
    /// How many times the integrations of the best S1 setting it needs.
    pub to_best_s1: Option<Ratio>,
    /// How many times those of the best of the paper's own settings.
    pub to_paper: Option<Ratio>,
}

/// One row for each method and target.
pub fn envelope(scene: &SceneReport, targets: &[f64]) -> Vec<EnvelopeRow> {
    let mut methods: Vec<&str> = Vec::new();
    for setting in &scene.settings {
        if !methods.contains(&setting.method.as_str()) {
            methods.push(&setting.method);
        }
    }
    let rows = methods.iter().flat_map(|method| {
        let row = |error: &f64| row(scene, method, *error);
        targets.iter().map(row)
    });
    rows.collect()
}

fn row(scene: &SceneReport, method: &str, error: f64) -> EnvelopeRow {
    let best = |chosen: &dyn Fn(&SettingReport) -> bool| {
        let settings = scene.settings.iter().filter(|setting| chosen(setting));
        cheapest(settings.map(|own| (own.name.clone(), scene.cost(own, error))))
    };
    let own = best(&|setting| setting.method == method);
    let s1 = best(&is_s1);
    let paper = best(&|setting| setting.is_paper);
    let to = |other: Option<Cheapest>| ratio(own.as_ref()?.cost, other?.cost);
    EnvelopeRow {
        method: method.to_owned(),
        error,
        to_best_s1: to(s1),
        to_paper: to(paper),
        cheapest: own,
    }
}

fn is_s1(setting: &SettingReport) -> bool {
    let has = |start: &str| setting.set.iter().any(|set| set.starts_with(start));
    S1_METHODS.contains(&setting.method.as_str()) && has(AS_IN_S1) && !has(EXTRA)
}

impl SceneReport {
    fn cost(&self, setting: &SettingReport, error: f64) -> Option<Cost> {
        let point = |run: &super::StudyRun| {
            let integrations = run.count(|own| own.integrations)?;
            Some((integrations, run.error(self.quantity)?))
        };
        let points: Vec<_> = setting.runs.iter().map(point).collect();
        cost_of(&points, error)
    }
}
