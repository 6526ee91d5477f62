//! Models with parameters that hide nothing.

use std::sync::Arc;

use linchpin::conformance::peer::InProcess;
use linchpin::conformance::report::Report;
use linchpin::conformance::{Settings, run};
use linchpin_models::models;
use linchpin_proto::contract::Contract;
use linchpin_proto::v1::{self, Value, value::Kind};
use linchpin_worker::Host;
use serde_json::Value as Json;

/// The built-in models.
pub fn built_in() -> Arc<dyn Contract> {
    Arc::new(Host::new(models()))
}

/// Examines a worker in this process.
#[track_caller]
pub fn examine(worker: Arc<dyn Contract>, settings: &Settings) -> Report {
    run(&InProcess(worker), settings, &|_| ()).unwrap_or_else(|error| panic!("{error}"))
}

/// A model with parameters as JSON, a solver as `kind` or `kind option=value ..`, and macro steps.
pub fn settings(model: &str, parameters: &Json, solver: &str, steps: &[f64]) -> Settings {
    let parameters = parameters.as_object().unwrap().iter();
    Settings {
        model: Some(model.to_owned()),
        parameters: parameters
            .map(|(name, json)| (name.clone(), value(json)))
            .collect(),
        solver: (!solver.is_empty()).then(|| of_text(solver)),
        steps: steps.to_vec(),
    }
}

fn value(json: &Json) -> Value {
    let kind = match json {
        Json::Number(number) => Kind::Number(number.as_f64().unwrap()),
        Json::String(text) => Kind::Text(text.clone()),
        Json::Array(list) => Kind::Numbers(v1::NumberList {
            values: list.iter().map(|own| own.as_f64().unwrap()).collect(),
        }),
        other => panic!("{other}"),
    };
    Value { kind: Some(kind) }
}

fn of_text(solver: &str) -> v1::Solver {
    let mut words = solver.split_whitespace();
    let kind = words.next().unwrap().to_owned();
    let option = |word: &str| {
        let (name, number) = word.split_once('=').unwrap();
        let kind = Some(Kind::Number(number.parse().unwrap()));
        (name.to_owned(), Value { kind })
    };
    v1::Solver {
        kind,
        options: words.map(option).collect(),
    }
}
