//! What moments over a step are made of.

use serde::{Deserialize, Serialize};

use crate::layout::{Layout, MomentsFrom};

/// The conditions of joints, exchanged motion and signals by what their moments over a step are made of. A joint whose conditions are all
/// alike stands under its own name.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MomentsOf {
    /// Of integrals of outputs over the step.
    pub integrals: Vec<String>,
    /// Of outputs at instants inside the step.
    pub instants: Vec<String>,
}

impl MomentsOf {
    /// Those of a layout; `None` if nothing is told inside a step.
    pub(super) fn of(layout: &Layout) -> Option<Self> {
        if !layout.inside.is_told() {
            return None;
        }
        let mut found = Self::default();
        let moments = &layout.inside.moments;
        let mut first_row = 0;
        for joint in &layout.joints {
            let rows = first_row..first_row + joint.joint.len();
            first_row = rows.end;
            let kinds = &moments[rows.clone()];
            match kinds.iter().all(|kind| *kind == kinds[0]) {
                true => found.add(kinds[0], joint.name.clone()),
                false => {
                    for (kind, condition) in kinds.iter().zip(0..) {
                        let part = joint.joint.name(condition);
                        found.add(*kind, format!("{}.{part}", joint.name));
                    }
                }
            }
        }
        for exchanged in &layout.exchanged {
            found.add(moments[exchanged.first], exchanged.name.clone());
        }
        Some(found)
    }

    fn add(&mut self, kind: MomentsFrom, name: String) {
        let names = match kind {
            MomentsFrom::Integrals => &mut self.integrals,
            MomentsFrom::Instants => &mut self.instants,
        };
        names.push(name);
    }
}
