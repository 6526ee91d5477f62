//! Checks that the columns of the picture's panels are recorded.

use super::discover::did_you_mean;
use crate::error::RunError;
use crate::results::Row;
use crate::scene::Scene;

/// Refuses a panel with a column that the results do not have.
pub(super) fn check(scene: &Scene, row: &Row) -> Result<(), RunError> {
    for panel in &scene.output.panels {
        let over = panel.over.iter().flat_map(|over| &over.column);
        let named = panel.curves.iter().flatten().map(|name| ("columns", name));
        for (key, column) in named.chain(over.map(|name| ("over", name))) {
            if row.get(column).is_none() {
                return Err(refusal(scene, row, (key, &panel.label), column));
            }
        }
    }
    Ok(())
}

fn refusal(scene: &Scene, row: &Row, (key, label): (&str, &str), column: &str) -> RunError {
    let known: Vec<&str> = row.columns().iter().map(String::as_str).collect();
    let message = format!(
        "`{key}` of panel \"{label}\": the results have no column \"{column}\"; they have: {}",
        known.join(", ")
    );
    let help = did_you_mean(column, &known)
        .unwrap_or_else(|| "list an output in output.variables to record it".into());
    scene.error("output.panel", message, Some(help)).into()
}
