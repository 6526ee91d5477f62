//! Reads `[coupling]`: method, parameters, degree and macro step.

use super::degree;
use super::resolved::{
    Coupling, Degree, ImpactsAtJoints, Increment, Iterations, Jacobian, Loads, Otherwise,
};
use super::step_control::{self, MACRO_STEP, MacroSteps, TOLERANCE, VARIABLE};
use crate::methods::{DEGREE, EXCHANGED_DEGREE, Entry, Method};
use crate::reading::error_kind::{Names, SceneErrorKind};
use crate::reading::key::{FINITE, Key, POSITIVE, Range, Takes, texts};
use crate::reading::reader::{Field, Problems, Section, choice, given};
use crate::reading::written::Value;

/// The key whose override changes which other keys there are.
pub(super) const METHOD_KEY: &str = "coupling.method";

/// Keys that every method has.
const COMMON: [Key; 7] = [
    Key::new("method", Takes::Choice(Method::NAMES))
        .default("`\"hermite\"`")
        .means("what they compute: [theory](../theory/README.md)"),
    EXCHANGED_DEGREE,
    Key::new("loads", Takes::Choice(&texts(&LOADS)))
        .default_first()
        .means(
            "who evaluates a load whose direction turns with the bodies: `\"worker\"`, at the \
             pose that its body has at every instant; `\"master\"`, which sends force and \
             moment as polynomials; `\"automatic\"`: the worker if it can, but with `jacobian = \
             \"reuse\"` the master for hermite, and for baumgarte and weighted where \
             `tolerance` limits the error",
        ),
    MACRO_STEP,
    Key::new(
        "increment",
        Takes::Either(&[Takes::Number(POSITIVE), Takes::Choice(&texts(&INCREMENTS))]),
    )
    .default("`\"automatic\"`")
    .means(
        "eps: finite differences use eps max(1, abs(u)); `\"derivatives\"`: none where a \
         worker offers directional derivatives (`linchpin describe` tells), otherwise \
         automatic",
    ),
    Key::new("impacts", Takes::Choice(&texts(&IMPACTS)))
        .default_first()
        .means(
            "what crosses the joints of a subsystem whose contacts collide: `\"impulses\"`, so that its partners take \
             part in an impact ([theory](../theory/impacts.md)), or `\"forces\"` alone",
        ),
    Key::new("start_tolerance", Takes::Number(START_TOLERANCE))
        .default_number(CLOSED)
        .means(
            "by how much joints may be open at the start, relative to positions and arms there, in velocities relative to these: \
             [rounded geometry](../guide/when-it-goes-wrong.md#a-joint-is-open-at-the-start) is met by the least shift and turn \
             of the joint at marker b, which the run tells",
        ),
];
/// Joints that are open by less than this share of the motion are closed up to rounding.
pub(crate) const CLOSED: f64 = 1e-9;
/// How far joints may be open at the start at most.
pub(crate) const MOST_TOLERATED: f64 = 0.01;
const START_TOLERANCE: Range = Range {
    words: "from 1e-9, below which it is rounding, to 0.01",
    least: CLOSED,
    most: MOST_TOLERATED,
    ..FINITE
};

/// Keys that every method with a corrector has.
const CORRECTED: [Key; 6] = [
    JACOBIAN,
    ITERATIONS,
    TOLERANCE,
    VARIABLE[0],
    VARIABLE[1],
    VARIABLE[2],
];
const JACOBIAN: Key = Key::new("jacobian", Takes::Choice(&texts(&JACOBIANS)))
    .default_first()
    .means(
        "columns of the coupling Jacobian are integrated in every macro step, or stay in \
         use as long as they serve: `\"reuse\"`",
    );
const ITERATIONS: Key = Key::new("iterations", Takes::Table(|| PASSES.to_vec()))
    .default("one correction")
    .means(
        "`{ most = 10, tolerance = 1e-9, otherwise = \"warn\" }`, corrections of a macro \
         step until they change less than the tolerance",
    );
const PASSES: [Key; 3] = [
    Key::new("most", Takes::Whole(1, MOST_PASSES))
        .default_number(PASSES_BY_DEFAULT as f64)
        .means("so many corrections after the first one at most"),
    Key::new("tolerance", Takes::Number(POSITIVE))
        .default_number(TOLERANCE_BY_DEFAULT)
        .means("the change below which a correction is the last one"),
    Key::new("otherwise", Takes::Choice(&texts(&OTHERWISE)))
        .default_first()
        .means(
            "a step that has not converged is counted (`\"warn\"`), ends the run with t, H, the \
             variable and the rate (`\"fail\"`) or, with `coupling.tolerance` only, is repeated \
             with a shorter macro step (`\"reject\"`)",
        ),
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

/// What crosses joints in an impact.
const IMPACTS: [(&str, ImpactsAtJoints); 2] = [
    ("impulses", ImpactsAtJoints::Impulses),
    ("forces", ImpactsAtJoints::Forces),
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

/// The method of a scene that names none.
const BY_DEFAULT: &str = "hermite";

const PASSES_BY_DEFAULT: u32 = 10;
const TOLERANCE_BY_DEFAULT: f64 = 1e-9;

impl Entry<Method> {
    /// Keys that not every method has.
    fn parameters(&self) -> impl Iterator<Item = Key> {
        let corrected: &[Key] = if self.corrects { &CORRECTED } else { &[] };
        self.keys.iter().chain(corrected).copied()
    }

    pub(super) fn has(&self, key: &str) -> bool {
        self.parameters().any(|own| own.name == key)
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
}

/// True for a parameter that means nothing where one method takes the place of another: of those that both have the degree, if they count
/// it from different ones.
pub(super) fn is_set_aside(key: &str, before: Option<&str>, method: &str) -> bool {
    let of = |method: &str| Method::ALL.iter().find(|entry| entry.name == method);
    let lowest = |method: &str| of(method).map(|entry| entry.lowest_degree);
    let counts_otherwise = || before.is_some_and(|before| lowest(before) != lowest(method));
    belongs_to_others(key, method) || key == DEGREE.name && counts_otherwise()
}

/// True for a parameter that some methods have, but not the one of this name.
fn belongs_to_others(key: &str, method: &str) -> bool {
    let chosen = Method::ALL.iter().find(|entry| entry.name == method);
    chosen.is_some_and(|entry| !entry.has(key)) && !methods_with(key).is_empty()
}

/// The methods that have a key of `[coupling]` that not every method has; none for those that all have.
pub fn methods_with(key: &str) -> Vec<&'static str> {
    let owners = Method::ALL.iter().filter(|entry| entry.has(key));
    owners.map(|entry| entry.name).collect()
}

/// Every key that some method has.
pub(super) fn keys_of_all_methods() -> Vec<Key> {
    let mut all = COMMON.to_vec();
    for key in Method::ALL.iter().flat_map(Entry::parameters) {
        if all.iter().all(|earlier| earlier.name != key.name) {
            all.push(key);
        }
    }
    all
}

pub(super) fn read(
    section: &Section<'_>,
    duration: Option<f64>,
    problems: &mut Problems<'_>,
) -> Option<Coupling> {
    let choices: Vec<(&str, &Entry<Method>)> =
        Method::ALL.iter().map(|own| (own.name, own)).collect();
    let [
        method,
        exchanged_degree,
        loads,
        _,
        increment,
        impacts,
        start_tolerance,
    ] = section.fields(&COMMON, problems);
    let [jacobian, iterations, ..] = section.fields(&CORRECTED, problems);
    let kind = match method {
        Some(field) => field.choice(&choices, problems),
        None => Method::ALL.iter().find(|own| own.name == BY_DEFAULT),
    };
    check_keys(section, kind, problems);
    let steps = step_control::read(section, duration, problems);
    let increment = match increment {
        Some(field) => read_increment(&field, problems),
        None => Some(Increment::Automatic),
    };
    let range = steps.as_ref().map(MacroSteps::range);
    let method = kind.and_then(|kind| (kind.read)(section, range, problems));
    let own_curves = method.and_then(|method| method.parameters().own_curves());
    let degree = match (section.get(&DEGREE), kind, own_curves) {
        (_, _, Some(own)) if own.follow => Some(Degree::Automatic),
        (_, _, Some(own)) => Some(Degree::Fixed(own.multipliers)),
        // A method that counts it otherwise has read it.
        (_, Some(kind), None) if kind.lowest_degree > 0 => None,
        (Some(field), ..) => degree::read(&field, kind, problems),
        (None, kind, _) => kind.map(Entry::default_degree),
    };
    let exchanged_degree = match (exchanged_degree, kind, degree) {
        (Some(field), ..) => degree::read(&field, kind, problems),
        (None, Some(kind), Some(degree)) => Some(kind.default_exchanged_degree(degree)),
        (None, ..) => None,
    };
    let loads = choice(loads, &LOADS, problems);
    let impacts = choice(impacts, &IMPACTS, problems);
    let start_tolerance = start_tolerance.map_or(Some(CLOSED), |field| field.number(problems));
    let jacobian = choice(jacobian, &JACOBIANS, problems);
    let iterations = given(iterations, |field| {
        read_iterations(&field.section(problems)?, steps.as_ref(), problems)
    });
    let MacroSteps { first, control } = steps?;
    Some(Coupling {
        method: method?,
        degree: degree?,
        exchanged_degree: exchanged_degree?,
        loads: loads?,
        impacts: impacts?,
        macro_step: first,
        step_control: control,
        increment: increment?,
        jacobian: jacobian?,
        iterations: iterations?,
        start_tolerance: start_tolerance?,
    })
}

fn check_keys(section: &Section<'_>, kind: Option<&Entry<Method>>, problems: &mut Problems<'_>) {
    let Some(kind) = kind else {
        return section.allow_only(&keys_of_all_methods(), problems);
    };
    let mut allowed = COMMON.to_vec();
    allowed.extend(kind.parameters());
    for (key, entry) in section.table {
        let owners = methods_with(key);
        if allowed.iter().any(|own| own.name == key) {
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

fn read_iterations(
    section: &Section<'_>,
    steps: Option<&MacroSteps>,
    problems: &mut Problems<'_>,
) -> Option<Iterations> {
    let [most, tolerance, otherwise] = section.read(&PASSES, problems);
    let most = given(most, |field| u32::try_from(field.whole(problems)?).ok());
    let tolerance = tolerance.map_or(Some(TOLERANCE_BY_DEFAULT), |field| field.number(problems));
    let otherwise = match otherwise {
        Some(field) => read_otherwise(&field, steps, problems),
        None => Some(Otherwise::Warn),
    };
    Some(Iterations {
        most: most?.unwrap_or(PASSES_BY_DEFAULT),
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
        _ => field.number(problems).map(Increment::Relative),
    }
}
