//! The index of a coupling method and the two parameters from which it follows.

use super::error_kind::SceneErrorKind;
use super::formula::{Formula, Unit};
use super::place::Spot;
use super::reader::{Field, Problems, Section};
use super::resolved::Index;

/// The two parameters of a method: the weights of velocity and acceleration.
pub(super) struct PairRules {
    pub(super) method: &'static str,
    /// Name, default, and the default as it is written.
    pub(super) first: (&'static str, Formula, &'static str),
    /// Name and default.
    pub(super) second: (&'static str, Formula),
    pub(super) units: (Unit, Unit),
}

/// The index that belongs to two weights, if any does.
fn index_of(first: Formula, second: Formula) -> Option<Index> {
    match (first.is_zero(), second.is_zero()) {
        (true, true) => Some(Index::Three),
        (false, true) => Some(Index::Two),
        (false, false) => Some(Index::One),
        (true, false) => None,
    }
}

/// Index and parameters of a method; what is not given follows from what is.
pub(super) fn resolve_pair(
    rules: &PairRules,
    section: &Section<'_>,
    macro_step: Option<f64>,
    problems: &mut Problems<'_>,
) -> Option<(Index, f64, f64)> {
    let index = read_optional(section.get("index"), |field| read_index(field, problems));
    let first_field = section.get(rules.first.0);
    let first = read_optional(first_field, |field| {
        Formula::read(field, rules.units.0, problems)
    });
    let second_field = section.get(rules.second.0);
    let second = read_optional(second_field, |field| {
        Formula::read(field, rules.units.1, problems)
    });
    let (given, first, second) = (index?, first?, second?);
    let assumed = given.or((first.is_none() && second.is_none()).then_some(Index::One));
    let first = first.unwrap_or(match assumed {
        Some(Index::One | Index::Two) => rules.first.1,
        _ => Formula::ZERO,
    });
    let second = second.unwrap_or(match assumed {
        Some(Index::One) => rules.second.1,
        _ => Formula::ZERO,
    });
    let index = match (given, index_of(first, second)) {
        (None, Some(index)) => index,
        (Some(given), Some(index)) if given == index => index,
        (given, fits) => {
            let kind = contradiction(rules, given, fits, (first, second));
            problems.report(latest_spot(rules, section), kind);
            return None;
        }
    };
    let first = value(first, macro_step?, rules.first.0, section, problems);
    let second = value(second, macro_step?, rules.second.0, section, problems);
    Some((index, first?, second?))
}

/// Absent is `Some(None)`; `None` is a mistake that has been reported.
fn read_optional<'w, T>(
    field: Option<Field<'w>>,
    read: impl FnOnce(&Field<'w>) -> Option<T>,
) -> Option<Option<T>> {
    match field {
        Some(field) => read(&field).map(Some),
        None => Some(None),
    }
}

fn read_index(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Index> {
    match field.whole(1, 3, problems)? {
        1 => Some(Index::One),
        2 => Some(Index::Two),
        _ => Some(Index::Three),
    }
}

fn value(
    formula: Formula,
    macro_step: f64,
    name: &str,
    section: &Section<'_>,
    problems: &mut Problems<'_>,
) -> Option<f64> {
    let field = section.get(name);
    let spot = field
        .as_ref()
        .map_or(section.spot, |field| &field.node.spot);
    formula
        .at(macro_step, &section.key_of(name))
        .map_err(|kind| problems.report(spot, kind))
        .ok()
}

fn contradiction(
    rules: &PairRules,
    given: Option<Index>,
    fits: Option<Index>,
    (first, second): (Formula, Formula),
) -> SceneErrorKind {
    let (first_name, second_name) = (rules.first.0, rules.second.0);
    match given {
        Some(index) => SceneErrorKind::IndexContradiction {
            method: rules.method,
            index: index.number(),
            needs: match index {
                Index::One => format!("{first_name} > 0 and {second_name} > 0"),
                Index::Two => format!("{first_name} > 0 and {second_name} = 0"),
                Index::Three => format!("{first_name} = 0 and {second_name} = 0"),
            },
            first: format!("{first_name} = {first}"),
            second: format!("{second_name} = {second}"),
            fits: fits.map(Index::number),
        },
        None => SceneErrorKind::NoSuchIndex {
            first_name,
            second: format!("{second_name} = {second}"),
            example: rules.first.2,
        },
    }
}

/// The index, or that of its parameters that was set last: an override is more likely to be the mistake.
fn latest_spot<'w>(rules: &PairRules, section: &Section<'w>) -> &'w Spot {
    [rules.second.0, rules.first.0, "index"]
        .iter()
        .filter_map(|name| section.get(name))
        .map(|field| &field.node.spot)
        .max_by_key(|spot| spot.source)
        .unwrap_or(section.spot)
}
