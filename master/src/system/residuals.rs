//! The conditions of the joints and of the exchanged variables.

use super::equations::System;
use super::motion::motion_of;
use super::point::Point;
use crate::joint::{Level, ROUNDING};
use crate::layout::Layout;

impl System {
    /// Only the conditions; the Jacobians stay as they are.
    pub fn assemble_residuals<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64] + Copy,
        point: Point<'_>,
    ) {
        self.motions.clear();
        let joints = 0..layout.joints.len();
        self.motions
            .extend(joints.map(|joint| motion_of(layout, joint, outputs)));
        let mut row = 0;
        for (joint, motion) in layout.joints.iter().zip(&self.motions) {
            for condition in joint.joint.conditions() {
                let values = condition.values(self.level, motion);
                for &level in self.level.up_to() {
                    self.residuals[level as usize][row] = values[level as usize];
                }
                row += 1;
            }
        }
        for exchanged in &layout.exchanged {
            let shown = exchanged.read(outputs(exchanged.subsystem), point.attitudes, point.w);
            let variables = exchanged.first..exchanged.first + exchanged.size();
            for (&shown, variable) in shown.iter().zip(variables) {
                for &level in self.level.up_to() {
                    self.residuals[level as usize][variable] = point.w[variable] - shown;
                }
            }
            if let Some(rates) = exchanged.rates_among(&self.unknowns) {
                let own = outputs(exchanged.subsystem);
                let phi = exchanged.vector(&shown);
                let speed = rates.speed(own, &phi);
                let acceleration = rates.acceleration(own);
                for component in 0..exchanged.size() {
                    let variable = exchanged.first + component;
                    self.residuals[Level::Velocity as usize][variable] =
                        point.rates[variable] - point.step * speed[component];
                    self.residuals[Level::Acceleration as usize][variable] =
                        -point.step * point.step * acceleration[component];
                }
            }
        }
    }

    /// Takes what is rounding in the residuals as 0, so that a condition that is met asks for no change.
    pub fn drop_rounding(&mut self, layout: &Layout, point: Point<'_>) {
        let mut row = 0;
        for (joint, motion) in layout.joints.iter().zip(&self.motions) {
            for condition in joint.joint.conditions() {
                for &level in self.level.up_to() {
                    let residual = &mut self.residuals[level as usize][row];
                    drop_below(ROUNDING * condition.extent(level, motion), residual);
                }
                row += 1;
            }
        }
        for (row, variable) in point.w.iter().enumerate().skip(self.rows) {
            for &level in self.level.up_to() {
                drop_below(
                    ROUNDING * variable.abs(),
                    &mut self.residuals[level as usize][row],
                );
            }
        }
    }
}

fn drop_below(least: f64, residual: &mut f64) {
    if residual.abs() <= least {
        *residual = 0.0;
    }
}
