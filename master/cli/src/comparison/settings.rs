//! The settings in which two runs differ.

use std::collections::{BTreeMap, BTreeSet};

use linchpin_master::scene::{Override, parse};
use serde::Serialize;
use serde_json::Value;

use crate::results::Recorded;

/// A setting that differs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Setting {
    /// Dotted key of the scene, or `program` and `commit` for what has run it.
    pub key: String,
    /// Its value in the first run; absent: not given.
    pub a: Option<String>,
    /// In the second run.
    pub b: Option<String>,
}

/// The settings that differ, by their keys; absent if one of the scenes cannot be read any more.
pub fn that_differ(a: &Recorded, b: &Recorded) -> Option<Vec<Setting>> {
    let [a, b] = [settings(a)?, settings(b)?];
    let keys: BTreeSet<&String> = a.keys().chain(b.keys()).collect();
    let both = keys.into_iter().map(|key| Setting {
        key: key.clone(),
        a: a.get(key).cloned(),
        b: b.get(key).cloned(),
    });
    Some(both.filter(|own| own.a != own.b).collect())
}

/// All settings of a run, and what has run it.
fn settings(run: &Recorded) -> Option<BTreeMap<String, String>> {
    let document = run.document();
    let text = |key: &str| document[key].as_str();
    let overrides = document["overrides"].as_array()?.iter();
    let overrides = overrides.map(|own| own.as_str()?.parse::<Override>().ok());
    let overrides: Vec<Override> = overrides.collect::<Option<_>>()?;
    let scene = parse(text("scene_text")?, text("scene_file")?, &overrides).ok()?;
    let case = run.case();
    let case = case.map(|name| scene.cases.iter().find(|case| case.name == name));
    let scene = match case {
        Some(case) => scene.with_case(case?).ok()?,
        None => scene,
    };
    let mut settings = scene.settings();
    for (key, told) in [("program", "linchpin"), ("commit", "commit")] {
        let value = document.get(told).and_then(Value::as_str);
        settings.extend(value.map(|value| (key.to_owned(), value.to_owned())));
    }
    Some(settings)
}
