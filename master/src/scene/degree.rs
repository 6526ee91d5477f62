//! Reads the degree of the polynomials of coupling variables: a whole number, or a word beside the numbers.

use crate::methods::{Entry, Method};
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::reader::{Field, Problems};
use crate::signal::{AUTOMATIC_DEGREE, Degree, MAX_DEGREE};

/// `method` is absent if it is not known.
pub(super) fn read(
    field: &Field<'_>,
    method: Option<&Entry<Method>>,
    problems: &mut Problems<'_>,
) -> Option<Degree> {
    if field.peek_text().is_none() {
        let highest = method.map_or(MAX_DEGREE, |method| method.highest_degree);
        return field.whole_within(0, highest, problems).map(Degree::Fixed);
    }
    let degree = field.choice(&[(AUTOMATIC_DEGREE, Degree::Automatic)], problems)?;
    let Some(method) = method.filter(|method| !method.may_change_degree) else {
        return Some(degree);
    };
    let kind = SceneErrorKind::NoAutomaticDegree {
        key: field.key.clone(),
        method: method.name,
        highest: method.highest_degree,
    };
    field.report(kind, problems);
    None
}
