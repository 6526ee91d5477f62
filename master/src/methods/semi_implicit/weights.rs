//! The index of a coupling method and the two parameters from which it follows.

use super::index::Index;
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::formula::{Formula, Steps};
use crate::reading::place::Spot;
use crate::reading::reader::{Field, Problems, Section};

/// The two parameters of a method, the weights of velocity and acceleration: their names and defaults.
pub(super) struct Weights {
    pub(super) method: &'static str,
    pub(super) first: (&'static str, Formula),
    pub(super) second: (&'static str, Formula),
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

impl Weights {
    /// Index and parameters of a method; what is not given follows from what is.
    pub(super) fn resolve(
        &self,
        section: &Section<'_>,
        steps: Option<Steps>,
        problems: &mut Problems<'_>,
    ) -> Option<(Index, Formula, Formula)> {
        let index = read_optional(section.get("index"), |field| read_index(field, problems));
        let first = read_weight(section, self.first, problems);
        let second = read_weight(section, self.second, problems);
        let (given, first, second) = (index?, first?, second?);
        let nothing_given = given.is_none() && first.is_none() && second.is_none();
        let assumed = given.or(nothing_given.then_some(Index::One));
        let first = first.unwrap_or(match assumed {
            Some(Index::One | Index::Two) => self.first.1,
            _ => Formula::ZERO,
        });
        let second = second.unwrap_or(match assumed {
            Some(Index::One) => self.second.1,
            _ => Formula::ZERO,
        });
        let fits = index_of(first, second);
        let Some(index) = fits.filter(|fits| given.is_none_or(|given| given == *fits)) else {
            let kind = self.contradiction(given, fits, first, second);
            problems.report(self.latest_spot(section), kind);
            return None;
        };
        let first = value(first, steps?, self.first.0, section, problems);
        let second = value(second, steps?, self.second.0, section, problems);
        Some((index, first?, second?))
    }

    fn contradiction(
        &self,
        given: Option<Index>,
        fits: Option<Index>,
        first: Formula,
        second: Formula,
    ) -> SceneErrorKind {
        let (first_name, second_name) = (self.first.0, self.second.0);
        let second = format!("{second_name} = {second}");
        let Some(index) = given else {
            return SceneErrorKind::NoSuchIndex {
                first_name,
                second,
                example: self.first.1.to_string(),
            };
        };
        SceneErrorKind::IndexContradiction {
            method: self.method,
            index: index.number(),
            needs: match index {
                Index::One => format!("{first_name} > 0 and {second_name} > 0"),
                Index::Two => format!("{first_name} > 0 and {second_name} = 0"),
                Index::Three => format!("{first_name} = 0 and {second_name} = 0"),
            },
            first: format!("{first_name} = {first}"),
            second,
            fits: fits.map(Index::number),
        }
    }

    /// The index, or that of its parameters that was set last: an override is more likely to be the mistake.
    fn latest_spot<'w>(&self, section: &Section<'w>) -> &'w Spot {
        [self.second.0, self.first.0, "index"]
            .iter()
            .filter_map(|name| section.get(name))
            .map(|field| &field.node.spot)
            .max_by_key(|spot| spot.source)
            .unwrap_or(section.spot)
    }
}

fn read_weight(
    section: &Section<'_>,
    (name, default): (&'static str, Formula),
    problems: &mut Problems<'_>,
) -> Option<Option<Formula>> {
    read_optional(section.get(name), |field| {
        Formula::read(field, default.unit(), problems)
    })
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
    steps: Steps,
    name: &str,
    section: &Section<'_>,
    problems: &mut Problems<'_>,
) -> Option<Formula> {
    let field = section.get(name);
    let spot = field
        .as_ref()
        .map_or(section.spot, |field| &field.node.spot);
    formula
        .over(steps, &section.key_of(name))
        .map_err(|kind| problems.report(spot, kind))
        .ok()
}
