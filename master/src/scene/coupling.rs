//! Reads `[coupling]`: method, parameters, degree and macro step.

use super::degree::{self, Degrees};
use super::resolved::{Coupling, Degree, Increment, Iterations, Jacobian, Loads, Otherwise};
use super::step_control::{self, MacroSteps};
use crate::methods::{Entry, Method};
use crate::reading::error_kind::{Names, SceneErrorKind};
use crate::reading::reader::{Field, POSITIVE, Problems, Section};
use crate::reading::written::Value;

/// Name of the macro step.
pub(super) const MACRO_STEP: &str = "macro_step";

/// The key whose override changes which other keys there are.
pub(super) const METHOD_KEY: &str = "coupling.method";

/// Keys that every method has.
const COMMON: [&str; 5] = [
    "method",
    "exchanged_degree",
    "loads",
    "macro_step",
    "increment",
];

/// Keys that every method with a corrector has.
const CORRECTED: [&str; 6] = [
    "jacobian",
    "iterations",
    "tolerance",
    "absolute_tolerance",
    "least_step",
    "greatest_step",
];

/// Increments that are not given as a number.
const INCREMENTS: [(&str, Increment); 2] = [
    ("automatic", Increment::Automatic),
    ("derivatives", Increment::Derivatives),
];

/// Who may evaluate loads whose direction turns.
const LOADS: [(&str, Loads); 3] = [
    ("automatic", Loads::Automatic),
    ("worker", Loads::Worker),
    ("master", Loads::Master),
];

/// How long columns are used.
const JACOBIANS: [(&str, Jacobian); 2] = [
    ("reuse", Jacobian::Reuse),
    ("every-step", Jacobian::EveryStep),
];

/// What happens to a step whose corrections have not converged.
const OTHERWISE: [(&str, Otherwise); 3] = [
    ("warn", Otherwise::Warn),
    ("fail", Otherwise::Fail),
    ("reject", Otherwise::Reject),
];

/// Corrections that have not converged after so many passes do not converge.
const MOST_PASSES: usize = 1000;

impl Entry<Method> {
    /// Keys that not every method has.
    fn parameters(&self) -> impl Iterator<Item = &'static str> {
        let corrected: &[&str] = if self.corrects { &CORRECTED } else { &[] };
        self.keys.iter().chain(corrected).copied()
    }

    fn default_degree(&self) -> Degree {
        Degree::Fixed(self.highest_degree.min(1))
    }

    fn default_exchanged_degree(&self, degree: Degree) -> Degree {
        match (self.exchanged_degree, degree) {
            (Some(own), _) => Degree::Fixed(own),
            (None, Degree::Automatic) => Degree::Automatic,
            (None, Degree::Fixed(degree)) => Degree::Fixed(self.highest_degree.min(degree.max(2))),
        }
    }

    fn degrees(&self) -> Degrees {
        Degrees {
            method: self.name,
            highest: self.highest_degree,
            may_change: self.may_change_degree,
        }
    }
}

/// The key of the degree.
const DEGREE: &str = "degree";

/// True for a parameter that means nothing where one method takes the place of another: of those that both have the degree, if they count
/// it from different ones.
pub(super) fn is_set_aside(key: &str, before: Option<&str>, method: &str) -> bool {
    let of = |method: &str| Method::ALL.iter().find(|entry| entry.name == method);
    let lowest = |method: &str| of(method).map(|entry| entry.lowest_degree);
    let counts_otherwise = || before.is_some_and(|before| lowest(before) != lowest(method));
    belongs_to_others(key, method) || key == DEGREE && counts_otherwise()
}

/// True for a parameter that some methods have, but not the one of this name.
fn belongs_to_others(key: &str, method: &str) -> bool {
    let chosen = Method::ALL.iter().find(|entry| entry.name == method);
    chosen.is_some_and(|entry| entry.parameters().all(|own| own != key)) && !owners(key).is_empty()
}

/// The methods that have a parameter.
fn owners(key: &str) -> Vec<&'static str> {
    Method::ALL
        .iter()
        .filter(|entry| entry.parameters().any(|own| own == key))
        .map(|entry| entry.name)
        .collect()
}

pub(super) fn read(
    section: &Section<'_>,
    duration: Option<f64>,
    problems: &mut Problems<'_>,
) -> Option<Coupling> {
    let choices: Vec<(&str, &Entry<Method>)> =
        Method::ALL.iter().map(|own| (own.name, own)).collect();
    let kind = section
        .require("method", "method = \"baumgarte\"", problems)
        .and_then(|field| field.choice(&choices, problems));
    check_keys(section, kind, problems);
    let steps = step_control::read(section, duration, problems);
    let increment = section
        .get("increment")
        .map_or(Some(Increment::Automatic), |field| {
            read_increment(&field, problems)
        });
    let range = steps.as_ref().map(MacroSteps::range);
    let method = kind.and_then(|kind| (kind.read)(section, range, problems));
    let own_curves = method.and_then(|method| method.parameters().own_curves());
    let degree = match (section.get(DEGREE), kind, own_curves) {
        (_, _, Some(own)) if own.follow => Some(Degree::Automatic),
        (_, _, Some(own)) => Some(Degree::Fixed(own.multipliers)),
        // A method that counts it otherwise has read it.
        (_, Some(kind), None) if kind.lowest_degree > 0 => None,
        (Some(field), ..) => degree::read(&field, kind.map(Entry::degrees), problems),
        (None, kind, _) => kind.map(Entry::default_degree),
    };
    let exchanged_degree = match (section.get("exchanged_degree"), kind, degree) {
        (Some(field), ..) => degree::read(&field, kind.map(Entry::degrees), problems),
        (None, Some(kind), Some(degree)) => Some(kind.default_exchanged_degree(degree)),
        (None, ..) => None,
    };
    let loads = section
        .get("loads")
        .map_or(Some(Loads::Automatic), |field| {
            field.choice(&LOADS, problems)
        });
    let jacobian = match section.get("jacobian") {
        Some(field) => field.choice(&JACOBIANS, problems),
        None => Some(Jacobian::Reuse),
    };
    let iterations = match section.get("iterations") {
        Some(field) => field
            .section(problems)
            .and_then(|section| read_iterations(&section, steps.as_ref(), problems))
            .map(Some),
        None => Some(None),
    };
    let MacroSteps { first, control } = steps?;
    Some(Coupling {
        method: method?,
        degree: degree?,
        exchanged_degree: exchanged_degree?,
        loads: loads?,
        macro_step: first,
        step_control: control,
        increment: increment?,
        jacobian: jacobian?,
        iterations: iterations?,
    })
}

fn check_keys(section: &Section<'_>, kind: Option<&Entry<Method>>, problems: &mut Problems<'_>) {
    let Some(kind) = kind else {
        return check_keys_of_all_methods(section, problems);
    };
    let mut allowed = COMMON.to_vec();
    allowed.extend(kind.parameters());
    for (key, entry) in section.table {
        let owners = owners(key);
        if allowed.contains(&key.as_str()) {
            continue;
        }
        if owners.is_empty() {
            section.report_unknown_key(key, entry, &allowed, problems);
            continue;
        }
        let report = SceneErrorKind::KeyOfOtherMethod {
            key: key.clone(),
            method: kind.name,
            owners: Names::from(owners.as_slice()),
        };
        problems.report(&entry.key_spot, report);
    }
}

fn check_keys_of_all_methods(section: &Section<'_>, problems: &mut Problems<'_>) {
    let mut allowed = COMMON.to_vec();
    for key in Method::ALL.iter().flat_map(Entry::parameters) {
        if !allowed.contains(&key) {
            allowed.push(key);
        }
    }
    section.allow_only(&allowed, problems);
}

fn read_iterations(
    section: &Section<'_>,
    steps: Option<&MacroSteps>,
    problems: &mut Problems<'_>,
) -> Option<Iterations> {
    section.allow_only(&["most", "tolerance", "otherwise"], problems);
    let most = section
        .get("most")
        .map_or(Some(10), |field| field.whole(1, MOST_PASSES, problems));
    let tolerance = section
        .get("tolerance")
        .map_or(Some(1e-9), |field| field.number(&POSITIVE, problems));
    let otherwise = match section.get("otherwise") {
        Some(field) => read_otherwise(&field, steps, problems),
        None => Some(Otherwise::Warn),
    };
    Some(Iterations {
        most: u32::try_from(most?).ok()?,
        tolerance: tolerance?,
        otherwise: otherwise?,
    })
}

fn read_otherwise(
    field: &Field<'_>,
    steps: Option<&MacroSteps>,
    problems: &mut Problems<'_>,
) -> Option<Otherwise> {
    let otherwise = field.choice(&OTHERWISE, problems)?;
    let is_fixed = steps.is_some_and(|steps| steps.control.is_none());
    if otherwise == Otherwise::Reject && is_fixed {
        let key = field.key.clone();
        field.report(SceneErrorKind::RejectOfFixedSteps { key }, problems);
        return None;
    }
    Some(otherwise)
}

fn read_increment(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Increment> {
    match &field.node.value {
        Value::Text(_) => field.choice(&INCREMENTS, problems),
        _ => field.number(&POSITIVE, problems).map(Increment::Relative),
    }
}
