//! Checks that the columns of the picture's panels are recorded.

use super::tie::did_you_mean;
use crate::error::RunError;
use crate::results::Row;
use crate::scene::Scene;

/// Refuses a panel with a column that the results do not have.
pub(super) fn check(scene: &Scene, row: &Row) -> Result<(), RunError> {
    let curves = scene.output.panels.iter().flat_map(|panel| &panel.curves);
    for column in curves.flatten() {
        if row.get(column).is_none() {
            let known: Vec<&str> = row.columns().iter().map(String::as_str).collect();
            let message = format!(
                "the results have no column \"{column}\"; they have: {}",
                known.join(", ")
            );
            let help = did_you_mean(column, &known)
                .unwrap_or_else(|| "list an output in output.variables to record it".into());
            return Err(scene.error("output.panel", message, Some(help)).into());
        }
    }
    Ok(())
}
