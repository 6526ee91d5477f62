//! References to subsystems and their variables.

use super::error_kind::{Names, SceneErrorKind};
use super::names::Registry;
use super::nearest::nearest;
use super::reader::{Field, Problems};

/// Subsystem and variable of a field such as `"crank.rate"`; `allowed` says what it may be.
pub(crate) fn read_variable(
    field: &Field<'_>,
    allowed: &'static str,
    subsystems: &Registry<'_>,
    problems: &mut Problems<'_>,
) -> Option<(usize, String)> {
    let text = field.text(problems)?;
    match text.split_once('.') {
        Some((name, variable)) if !variable.is_empty() => {
            let subsystem = find_name(name, field, subsystems, problems)?;
            Some((subsystem, variable.to_owned()))
        }
        _ => {
            let kind = SceneErrorKind::InvalidReference {
                key: field.key.clone(),
                found: text.to_owned(),
                allowed,
            };
            field.report(kind, problems);
            None
        }
    }
}

/// The place of what a field refers to by name.
pub(crate) fn find_name(
    name: &str,
    field: &Field<'_>,
    subsystems: &Registry<'_>,
    problems: &mut Problems<'_>,
) -> Option<usize> {
    let found = subsystems.position(name);
    if found.is_none() {
        let known: Vec<&str> = subsystems.names().collect();
        let kind = SceneErrorKind::UnknownName {
            key: field.key.clone(),
            name: name.to_owned(),
            nearest: nearest(name, known.iter().copied()),
            known: Names::from(known.as_slice()),
        };
        field.report(kind, problems);
    }
    found
}
