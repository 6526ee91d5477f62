//! The springs of a penalty coupling, one for each condition of the joints.

use crate::error::RunError;
use crate::layout::Layout;
use crate::scene::{Scene, Spring};

/// The spring of each row: that for lengths or that for angles.
///
/// # Errors
/// The scene gives none of the kind that a joint needs.
pub(super) fn springs_of(
    scene: &Scene,
    lengths: Option<Spring>,
    angles: Option<Spring>,
    layout: &Layout,
) -> Result<Vec<Spring>, RunError> {
    let spring_of = |row: usize| {
        let bound = layout.joint_of(row);
        let condition = bound.joint.condition(layout.rows[row].condition);
        let (spring, key, example, what) = match condition.is_length() {
            true => (lengths, "stiffness", "1e6", "lengths"),
            false => (angles, "angular_stiffness", "1e4", "angles"),
        };
        spring.ok_or_else(|| {
            let message = format!(
                "joint \"{}\" holds {what}, but the penalty coupling has no spring for them",
                bound.name
            );
            let help = format!("add `{key} = {example}` to [coupling]");
            scene.error("coupling.method", message, Some(help)).into()
        })
    };
    (0..layout.rows.len()).map(spring_of).collect()
}
