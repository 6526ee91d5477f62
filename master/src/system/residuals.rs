//! The conditions of the joints and of the exchanged variables.

use super::equations::System;
use super::motion::motion_up_to;
use super::point::Point;
use crate::joint::{Level, product};
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
            .extend(joints.map(|joint| motion_up_to(self.level, layout, joint, outputs)));
        self.factors.clear();
        let mut row = 0;
        for (joint, motion) in layout.joints.iter().zip(&self.motions) {
            for condition in joint.joint.conditions() {
                let factors = condition.factors(motion);
                let values = product(self.level, &factors);
                self.factors.push(factors);
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
            let rates = exchanged.rates_among(&self.unknowns);
            if let Some(rates) = rates.filter(|_| self.level > Level::Position) {
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
}
