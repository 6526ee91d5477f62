//! Stops a run that diverges.

use crate::error::RunError;
use crate::layout::{Layout, Row as LayoutRow};
use crate::results::Row;
use crate::results::growth::{Growth, MOST_GROWTH};
use crate::time::MacroStep;
use serde::{Deserialize, Serialize};

/// Watches the opening of the joints and the growth of all values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Guard {
    watches_growth: bool,
    watches_openings: bool,
    /// Size of the mechanism in m, then of its motion where that is larger.
    largest_motion: f64,
    growth: Growth,
}

/// A joint that is open by more than this share of the largest motion holds nothing together.
const MOST_OPENING: f64 = 0.5;

/// Motion below this share of the size of a mechanism is no measure of an opening: a joint may rest in the origin, and then its positions
/// are nothing but rounding.
const LEAST_MOTION: f64 = 1e-3;

impl Guard {
    /// For methods that close the joints of a mechanism of this size in m, which starts in `row`.
    pub fn of_rigid_joints(size: f64, row: &Row) -> Self {
        Self {
            watches_openings: true,
            largest_motion: LEAST_MOTION * size,
            ..Self::of_springs(row)
        }
    }

    /// For methods whose joints are springs: only growth is watched.
    pub fn of_springs(row: &Row) -> Self {
        let sizes = row.states().map(|(_, value)| value.abs());
        Self {
            watches_growth: true,
            growth: Growth::from(sizes.fold(0.0, f64::max)),
            ..Self::off()
        }
    }

    /// Watches nothing: values that are not finite stop a run in any case.
    pub fn off() -> Self {
        Self {
            watches_growth: false,
            watches_openings: false,
            largest_motion: 0.0,
            growth: Growth::default(),
        }
    }

    /// Judges the row at the end of a macro step.
    pub fn judge(&mut self, step: MacroStep, row: &Row, layout: &Layout) -> Result<(), RunError> {
        if self.watches_growth {
            self.judge_growth(step, row)?;
        }
        if self.watches_openings && !self.growth.is_young() {
            self.judge_opening(step, row, layout)?;
        }
        Ok(())
    }

    fn judge_growth(&mut self, step: MacroStep, row: &Row) -> Result<(), RunError> {
        let largest = row
            .states()
            .max_by(|(_, one), (_, other)| one.abs().total_cmp(&other.abs()));
        match largest {
            Some((variable, value)) if self.growth.take(value.abs()) => Err(RunError::Grown {
                t: step.end,
                step: step.length,
                variable: variable.to_owned(),
                value,
                growth: MOST_GROWTH,
            }),
            _ => Ok(()),
        }
    }

    fn judge_opening(
        &mut self,
        step: MacroStep,
        row: &Row,
        layout: &Layout,
    ) -> Result<(), RunError> {
        let reached = layout.largest_position(|subsystem, place| row.output(subsystem, place));
        self.largest_motion = self.largest_motion.max(reached);
        for number in 0..layout.rows.len() {
            let opening = row.residuals(number)[0].abs();
            let LayoutRow { joint, condition } = layout.rows[number];
            let motion = if layout.joints[joint].joint.condition(condition).is_length() {
                self.largest_motion
            } else {
                1.0
            };
            if opening > MOST_OPENING * motion {
                return Err(RunError::Diverged {
                    t: step.end,
                    step: step.length,
                    joint: layout.joint_of(number).name.clone(),
                    opening,
                    motion,
                });
            }
        }
        Ok(())
    }
}
