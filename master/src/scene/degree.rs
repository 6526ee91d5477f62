//! Reads the degree of the polynomials of coupling variables: a whole number, or a word beside the numbers.

use crate::reading::error_kind::SceneErrorKind;
use crate::reading::reader::{Field, Problems};
use crate::signal::{AUTOMATIC_DEGREE, Degree, MAX_DEGREE};

/// The degrees that a method offers.
pub(super) struct Degrees {
    /// Its name.
    pub(super) method: &'static str,
    pub(super) highest: usize,
    /// Whether corrected values tell the error of a polynomial of every degree.
    pub(super) may_change: bool,
}

/// `offered` is absent if the method is not known.
pub(super) fn read(
    field: &Field<'_>,
    offered: Option<Degrees>,
    problems: &mut Problems<'_>,
) -> Option<Degree> {
    if field.peek_text().is_none() {
        let highest = offered.map_or(MAX_DEGREE, |degrees| degrees.highest);
        return field.whole_within(0, highest, problems).map(Degree::Fixed);
    }
    let degree = field.choice(&[(AUTOMATIC_DEGREE, Degree::Automatic)], problems)?;
    match offered.filter(|degrees| !degrees.may_change) {
        None => Some(degree),
        Some(Degrees {
            method, highest, ..
        }) => {
            let key = field.key.clone();
            let kind = SceneErrorKind::NoAutomaticDegree {
                key,
                method,
                highest,
            };
            field.report(kind, problems);
            None
        }
    }
}
