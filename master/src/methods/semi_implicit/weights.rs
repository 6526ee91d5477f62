//! The index of a coupling method and the two parameters from which it follows.

use super::index::Index;
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::formula::{Formula, Steps};
use crate::reading::key::Key;
use crate::reading::reader::{Field, Problems, Section, given};

/// The two parameters of a method, the weights of velocity and acceleration, with their defaults.
pub(super) struct Weights {
    pub(super) method: &'static str,
    /// Degree, index, and the two.
    pub(super) keys: &'static [Key; 4],
    pub(super) first: Formula,
    pub(super) second: Formula,
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
        let [_, index_field, first_field, second_field] = section.fields(self.keys, problems);
        let index = given(index_field.clone(), |field| read_index(field, problems));
        let mut weight = |field: &Option<Field<'_>>| {
            given(field.clone(), |field| Formula::read(field, problems))
        };
        let (first, second) = (weight(&first_field), weight(&second_field));
        let (given, first, second) = (index?, first?, second?);
        let nothing_given = given.is_none() && first.is_none() && second.is_none();
        let assumed = given.or(nothing_given.then_some(Index::One));
        let first = first.unwrap_or(match assumed {
            Some(Index::One | Index::Two) => self.first,
            _ => Formula::ZERO,
        });
        let second = second.unwrap_or(match assumed {
            Some(Index::One) => self.second,
            _ => Formula::ZERO,
        });
        let fits = index_of(first, second);
        let Some(index) = fits.filter(|fits| given.is_none_or(|given| given == *fits)) else {
            let kind = self.contradiction(given, fits, first, second);
            // What was set last: an override is more likely to be the mistake.
            let fields = [second_field, first_field, index_field];
            let spots = fields.iter().flatten().map(|field| &field.node.spot);
            let latest = spots.max_by_key(|spot| spot.source);
            problems.report(latest.unwrap_or(section.spot), kind);
            return None;
        };
        let steps = steps?;
        let mut value = |formula: Formula, field: Option<Field<'_>>, key: &Key| {
            let spot = field.map_or(section.spot, |field| &field.node.spot);
            let value = formula.over(steps, &section.key_of(key.name));
            value.map_err(|kind| problems.report(spot, kind)).ok()
        };
        let first = value(first, first_field, &self.keys[2]);
        let second = value(second, second_field, &self.keys[3]);
        Some((index, first?, second?))
    }

    fn contradiction(
        &self,
        given: Option<Index>,
        fits: Option<Index>,
        first: Formula,
        second: Formula,
    ) -> SceneErrorKind {
        let [_, _, first_name, second_name] = self.keys.each_ref().map(|key| key.name);
        let second = format!("{second_name} = {second}");
        let Some(index) = given else {
            return SceneErrorKind::NoSuchIndex {
                first_name,
                second,
                example: self.first.to_string(),
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
}

fn read_index(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Index> {
    match field.whole(problems)? {
        1 => Some(Index::One),
        2 => Some(Index::Two),
        _ => Some(Index::Three),
    }
}
