//! Stops a run that diverges.

use crate::error::RunError;
use crate::joint::LEAST_MOTION;
use crate::layout::{Layout, Row as LayoutRow};
use crate::results::Row;
use crate::time::MacroStep;
use serde::{Deserialize, Serialize};

/// Watches the opening of the joints and the growth of all values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Guard {
    most_opening: f64,
    most_growth: f64,
    largest_motion: f64,
    steps: usize,
    first_sizes: Vec<f64>,
}

/// A joint that is open by more than this share of the largest motion holds nothing together.
const MOST_OPENING: f64 = 0.5;

/// A value may grow by this factor since the first steps: a start from rest with a small macro step needs much.
const MOST_GROWTH: f64 = 1e12;

/// Number of first steps that set the size of a value.
const FIRST_STEPS: usize = 10;

impl Guard {
    /// For methods that close the joints.
    pub fn of_rigid_joints() -> Self {
        Self {
            most_opening: MOST_OPENING,
            most_growth: MOST_GROWTH,
            largest_motion: LEAST_MOTION,
            steps: 0,
            first_sizes: Vec::new(),
        }
    }

    /// For methods whose joints are springs: only growth is watched.
    pub fn of_springs() -> Self {
        Self {
            most_opening: f64::INFINITY,
            ..Self::of_rigid_joints()
        }
    }

    /// Watches nothing: values that are not finite stop a run in any case.
    pub fn off() -> Self {
        Self {
            most_growth: f64::INFINITY,
            ..Self::of_springs()
        }
    }

    /// Judges the row at the end of a macro step.
    pub fn judge(&mut self, step: MacroStep, row: &Row, layout: &Layout) -> Result<(), RunError> {
        if self.most_growth.is_infinite() {
            return Ok(());
        }
        self.judge_growth(step, row)?;
        if self.most_opening.is_finite() {
            self.judge_opening(step, row, layout)?;
        }
        Ok(())
    }

    fn judge_growth(&mut self, step: MacroStep, row: &Row) -> Result<(), RunError> {
        self.steps += 1;
        let sizes = row.states().map(|(_, value)| value.abs());
        if self.steps <= FIRST_STEPS {
            self.first_sizes.resize(row.states().count(), 0.0);
            for (largest, size) in self.first_sizes.iter_mut().zip(sizes) {
                *largest = largest.max(size);
            }
            return Ok(());
        }
        let largest = self.first_sizes.iter().copied().fold(0.0, f64::max);
        let mut states = row.states();
        match states.find(|(_, value)| value.abs() > self.most_growth * largest) {
            Some((variable, value)) if largest > 0.0 => Err(RunError::Grown {
                t: step.end,
                step: step.length,
                variable: variable.to_owned(),
                value,
                growth: self.most_growth,
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
        for joint in &layout.joints {
            for end in &joint.ends {
                for &place in end.coordinates() {
                    let position = row.output(end.subsystem, place);
                    self.largest_motion = self.largest_motion.max(position.abs());
                }
            }
        }
        for number in 0..layout.rows.len() {
            let opening = row.residuals(number)[0].abs();
            let LayoutRow { joint, condition } = layout.rows[number];
            let motion = if layout.joints[joint].joint.condition(condition).is_length() {
                self.largest_motion
            } else {
                1.0
            };
            if opening > self.most_opening * motion {
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
