//! What is known against scenes that are sound.

use std::fmt;

use crate::reading::place::Place;

/// What is known against a scene that is sound.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    /// The key it refers to.
    pub key: &'static str,
    /// Where that key, or the nearest one around it, is set.
    pub place: Option<Place>,
    /// The combination.
    pub what: String,
    /// The rule it breaks, with numbers.
    pub rule: String,
    /// What to try.
    pub remedy: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = &self.place {
            write!(f, "{place}: ")?;
        }
        write!(f, "{}: {}\n  help: {}", self.what, self.rule, self.remedy)
    }
}
