//! Mistakes in a scene, all of them, each with its place.

use std::fmt;

use super::error_kind::SceneErrorKind;
use super::place::Place;

/// One mistake in a scene.
#[derive(Debug)]
pub struct SceneError {
    /// Where it stands; absent if the file could not be read, or if the key is nowhere in it.
    pub place: Option<Place>,
    /// The case in which it shows, if the scene without its cases is sound.
    pub case: Option<String>,
    /// What is wrong.
    pub kind: SceneErrorKind,
}

impl SceneError {
    pub(crate) fn new(place: Option<Place>, kind: SceneErrorKind) -> Self {
        Self {
            place,
            case: None,
            kind,
        }
    }

    /// What is wrong, with the value found and what is allowed.
    pub fn message(&self) -> String {
        match &self.case {
            Some(case) => format!("case {case:?}: {}", self.kind),
            None => self.kind.to_string(),
        }
    }

    /// What to do about it.
    pub fn help(&self) -> Option<String> {
        self.kind.help()
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = &self.place {
            write!(f, "{place}: ")?;
        }
        f.write_str(&self.message())?;
        match self.help() {
            Some(help) => write!(f, "\n  help: {help}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for SceneError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.kind.source()
    }
}

/// All mistakes of a scene, in the order of the text; never empty.
#[derive(Debug)]
pub struct SceneErrors {
    errors: Vec<SceneError>,
}

impl SceneErrors {
    pub(crate) fn new(mut errors: Vec<SceneError>) -> Self {
        errors.sort_by_key(|error| {
            let place = error.place.as_ref();
            place.map(|place| (place.is_override(), place.span.start))
        });
        Self { errors }
    }

    /// These mistakes and more.
    pub(crate) fn and(self, more: Self) -> Self {
        Self::new(self.into_iter().chain(more).collect())
    }

    /// The mistakes.
    pub fn iter(&self) -> std::slice::Iter<'_, SceneError> {
        self.errors.iter()
    }
}

impl From<SceneError> for SceneErrors {
    fn from(error: SceneError) -> Self {
        Self {
            errors: vec![error],
        }
    }
}

impl IntoIterator for SceneErrors {
    type Item = SceneError;
    type IntoIter = std::vec::IntoIter<SceneError>;

    fn into_iter(self) -> Self::IntoIter {
        self.errors.into_iter()
    }
}

impl<'a> IntoIterator for &'a SceneErrors {
    type Item = &'a SceneError;
    type IntoIter = std::slice::Iter<'a, SceneError>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl fmt::Display for SceneErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, error) in self.errors.iter().enumerate() {
            if i > 0 {
                f.write_str("\n")?;
            }
            write!(f, "{error}")?;
        }
        Ok(())
    }
}

impl std::error::Error for SceneErrors {}
