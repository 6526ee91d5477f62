//! Reads `[coupling]`: method, parameters, degree and macro step.

use super::degree::{self, Degrees};
use super::error_kind::{Names, SceneErrorKind};
use super::formula::{Formula, Steps, Unit};
use super::index::Weights;
use super::reader::{Field, POSITIVE, Problems, Section};
use super::resolved::{
    Coupling, Degree, Increment, Iterations, Jacobian, Loads, Method, Order, Otherwise, Spring,
    Variant,
};
use super::step_control::{self, MacroSteps};
use super::written::Value;
use crate::signal::MAX_DEGREE;

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

/// The variants of Hermite coupling.
const VARIANTS: [(&str, Variant); 2] = [("apv", Variant::Apv), ("c0pv", Variant::C0pv)];

/// In which order subsystems step.
const ORDERS: [(&str, Order); 2] = [
    ("jacobi", Order::Jacobi),
    ("gauss-seidel", Order::GaussSeidel),
];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Baumgarte,
    Weighted,
    Hermite,
    Explicit,
    Penalty,
}

const METHODS: [(&str, Kind); 5] = [
    ("hermite", Kind::Hermite),
    ("baumgarte", Kind::Baumgarte),
    ("weighted", Kind::Weighted),
    ("explicit", Kind::Explicit),
    ("penalty", Kind::Penalty),
];

impl Kind {
    /// Keys that not every method has.
    fn parameters(self) -> impl Iterator<Item = &'static str> {
        let corrected: &[&str] = match self {
            Self::Baumgarte | Self::Weighted | Self::Hermite => &CORRECTED,
            Self::Explicit | Self::Penalty => &[],
        };
        self.own_parameters().iter().chain(corrected).copied()
    }

    fn own_parameters(self) -> &'static [&'static str] {
        match self {
            Self::Baumgarte => &["degree", "index", "beta", "gamma"],
            Self::Weighted => &["degree", "index", "a", "b"],
            Self::Hermite => &["variant"],
            Self::Explicit => &["degree", "mu"],
            Self::Penalty => &[
                "degree",
                "order",
                "stiffness",
                "damping",
                "angular_stiffness",
                "angular_damping",
            ],
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Baumgarte => "baumgarte",
            Self::Weighted => "weighted",
            Self::Hermite => "hermite",
            Self::Explicit => "explicit",
            Self::Penalty => "penalty",
        }
    }

    fn highest_degree(self) -> usize {
        match self {
            Self::Explicit => 0,
            _ => MAX_DEGREE,
        }
    }

    fn default_degree(self) -> Degree {
        Degree::Fixed(self.highest_degree().min(1))
    }

    fn default_exchanged_degree(self, degree: Degree) -> Degree {
        match (self, degree) {
            (Self::Hermite, _) => Degree::Fixed(MAX_DEGREE),
            (_, Degree::Automatic) => Degree::Automatic,
            (_, Degree::Fixed(degree)) => Degree::Fixed(self.highest_degree().min(degree.max(2))),
        }
    }

    fn degrees(self) -> Degrees {
        Degrees {
            method: self.name(),
            highest: self.highest_degree(),
            may_change: matches!(self, Self::Baumgarte | Self::Weighted),
        }
    }
}

/// True for a parameter that some methods have, but not the one of this name.
pub(super) fn belongs_to_others(key: &str, method: &str) -> bool {
    let chosen = METHODS.iter().find(|(name, _)| *name == method);
    chosen.is_some_and(|(_, kind)| kind.parameters().all(|own| own != key))
        && !owners(key).is_empty()
}

/// The methods that have a parameter.
fn owners(key: &str) -> Vec<&'static str> {
    METHODS
        .iter()
        .filter(|(_, kind)| kind.parameters().any(|own| own == key))
        .map(|(name, _)| *name)
        .collect()
}

pub(super) fn read(
    section: &Section<'_>,
    duration: Option<f64>,
    problems: &mut Problems<'_>,
) -> Option<Coupling> {
    let kind = section
        .require("method", "method = \"baumgarte\"", problems)
        .and_then(|field| field.choice(&METHODS, problems));
    check_keys(section, kind, problems);
    let steps = step_control::read(section, duration, problems);
    let increment = section
        .get("increment")
        .map_or(Some(Increment::Automatic), |field| {
            read_increment(&field, problems)
        });
    let method = kind.and_then(|kind| read_method(kind, section, steps.as_ref(), problems));
    let degree = match (section.get("degree"), kind, method) {
        (_, _, Some(Method::Hermite { variant })) => Some(Degree::Fixed(variant.degree())),
        (Some(field), ..) => degree::read(&field, kind.map(Kind::degrees), problems),
        (None, kind, _) => kind.map(Kind::default_degree),
    };
    let exchanged_degree = match (section.get("exchanged_degree"), kind, degree) {
        (Some(field), ..) => degree::read(&field, kind.map(Kind::degrees), problems),
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

fn check_keys(section: &Section<'_>, kind: Option<Kind>, problems: &mut Problems<'_>) {
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
            method: kind.name(),
            owners: Names::from(owners.as_slice()),
        };
        problems.report(&entry.key_spot, report);
    }
}

fn check_keys_of_all_methods(section: &Section<'_>, problems: &mut Problems<'_>) {
    let mut allowed = COMMON.to_vec();
    for key in METHODS.iter().flat_map(|(_, kind)| kind.parameters()) {
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

fn read_method(
    kind: Kind,
    section: &Section<'_>,
    steps: Option<&MacroSteps>,
    problems: &mut Problems<'_>,
) -> Option<Method> {
    let steps = steps.map(MacroSteps::range);
    match kind {
        Kind::Baumgarte => {
            let weights = Weights {
                method: kind.name(),
                first: ("beta", Formula::multiple(2.0, Unit::Time)),
                second: ("gamma", Formula::multiple(1.0, Unit::TimeSquared)),
            };
            let (index, beta, gamma) = weights.resolve(section, steps, problems)?;
            Some(Method::Baumgarte { index, beta, gamma })
        }
        Kind::Weighted => {
            let weights = Weights {
                method: kind.name(),
                first: ("a", Formula::multiple(2.0, Unit::Plain)),
                second: ("b", Formula::multiple(2.6, Unit::Plain)),
            };
            let (index, a, b) = weights.resolve(section, steps, problems)?;
            let [a, b] = [a, b].map(Formula::number);
            Some(Method::Weighted { index, a, b })
        }
        Kind::Hermite => {
            let field = section.get("variant");
            let variant = field.map_or(Some(Variant::Apv), |field| {
                field.choice(&VARIANTS, problems)
            });
            Some(Method::Hermite { variant: variant? })
        }
        Kind::Explicit => {
            let field = section.require("mu", "mu = \"10H\"", problems)?;
            let formula = Formula::read_positive(&field, Unit::Time, problems)?;
            let mu = formula
                .over(steps?, &field.key)
                .map_err(|kind| field.report(kind, problems));
            Some(Method::Explicit { mu: mu.ok()? })
        }
        Kind::Penalty => read_penalty(section, steps?, problems),
    }
}

/// Springs for lengths and for angles. At least one is needed; which one the joints need is known when the models have
/// described their markers.
fn read_penalty(
    section: &Section<'_>,
    steps: Steps,
    problems: &mut Problems<'_>,
) -> Option<Method> {
    let order = section
        .get("order")
        .map_or(Some(Order::Jacobi), |field| field.choice(&ORDERS, problems));
    let has = |(stiffness, _, damping): SpringKeys| {
        section.get(stiffness).is_some() || section.get(damping).is_some()
    };
    let angles = match has(ANGULAR) {
        true => read_spring(section, ANGULAR, steps, problems).map(Some),
        false => Some(None),
    };
    let lengths = match has(LINEAR) || !has(ANGULAR) {
        true => read_spring(section, LINEAR, steps, problems).map(Some),
        false => Some(None),
    };
    Some(Method::Penalty {
        order: order?,
        lengths: lengths?,
        angles: angles?,
    })
}

/// The keys of a spring: stiffness with an example, damping.
type SpringKeys = (&'static str, &'static str, &'static str);

const LINEAR: SpringKeys = ("stiffness", "stiffness = 1e6", "damping");

const ANGULAR: SpringKeys = (
    "angular_stiffness",
    "angular_stiffness = 1e4",
    "angular_damping",
);

fn read_spring(
    section: &Section<'_>,
    (stiffness, example, damping): SpringKeys,
    steps: Steps,
    problems: &mut Problems<'_>,
) -> Option<Spring> {
    let stiffness = section
        .require(stiffness, example, problems)
        .and_then(|field| {
            let formula = Formula::read_positive(&field, Unit::PerTimeSquared, problems)?;
            let value = formula.fixed(steps, &field.key);
            value.map_err(|kind| field.report(kind, problems)).ok()
        });
    let damping = section.get(damping).map_or(Some(0.0), |field| {
        let formula = Formula::read(&field, Unit::PerTime, problems)?;
        let value = formula.fixed(steps, &field.key);
        value.map_err(|kind| field.report(kind, problems)).ok()
    });
    Some(Spring {
        stiffness: stiffness?,
        damping: damping?,
    })
}
