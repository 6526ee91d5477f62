//! The report for programs.

use super::Report;

impl Report {
    /// The report as one JSON object.
    ///
    /// # Errors
    /// None of its values refuses; the writer's error is passed on.
    pub fn to_json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self)
    }
}
