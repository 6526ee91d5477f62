//! One point of a stability map.

use linchpin_master::scene::Scene;
use serde::{Deserialize, Serialize};

/// What was found at one point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// Value of the horizontal axis.
    pub x: f64,
    /// Value of the vertical axis.
    pub y: f64,
    /// By simulation.
    pub simulated: Simulated,
    /// Spectral radius of the macro-step map, where there is one.
    pub radius: Option<f64>,
}

/// What a simulation showed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Simulated {
    /// Of a linear scene the largest growth of a position or velocity: its largest size in the last tenth of the time over
    /// that in the first. Of any other the largest deviation of the velocities from the reference run, over their largest
    /// size there; not a number if the reference run itself diverged. Infinite if the run failed.
    pub growth: f64,
    /// Growth up to which the run is stable.
    pub most: f64,
    /// Number of macro steps of the length `coupling.macro_step`.
    pub steps: usize,
}

/// Whether simulation and spectral radius say the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Agreement {
    /// They do.
    Agree,
    /// They do not, but the radius is so near 1 that the simulated steps are too few to tell.
    Undecided,
    /// They do not.
    Disagree,
}

/// A simulation in which a position or velocity has grown by more than this is unstable.
pub(super) const MOST_GROWTH: f64 = 10.0;

/// A simulation that is off by more than the whole motion is unstable.
pub(super) const MOST_DEVIATION: f64 = 1.0;

/// A map is stable up to this spectral radius: 1, and rounding.
const STABLE_RADIUS: f64 = 1.0 + 1e-9;

/// A simulation can tell that a map is unstable when its fastest mode grows at least by this factor: it starts as
/// a small part of the motion, and must become ten times the whole.
const TELLING: f64 = 1e3;

impl Simulated {
    pub(super) fn new(growth: f64, most: f64, scene: &Scene) -> Self {
        let steps = (scene.t_end - scene.t_start) / scene.coupling.macro_step;
        Self {
            growth,
            most,
            steps: steps.round() as usize,
        }
    }

    /// Whether the run reached its end, and nothing grew by more than it may.
    pub fn is_stable(&self) -> bool {
        self.growth.is_nan() || self.growth <= self.most
    }
}

impl Cell {
    /// Whether simulation and spectral radius say the same; `None` without a radius.
    pub fn agreement(&self) -> Option<Agreement> {
        let radius = self.radius?;
        let agreement = if (radius <= STABLE_RADIUS) == self.simulated.is_stable() {
            Agreement::Agree
        } else if radius.ln().abs() * (self.simulated.steps as f64) < TELLING.ln() {
            Agreement::Undecided
        } else {
            Agreement::Disagree
        };
        Some(agreement)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn agreement(growth: f64, radius: f64) -> Agreement {
        let simulated = Simulated {
            growth,
            most: MOST_GROWTH,
            steps: 200,
        };
        let cell = Cell {
            x: 1.0,
            y: 1.0,
            simulated,
            radius: Some(radius),
        };
        cell.agreement().unwrap()
    }

    #[test]
    fn a_simulation_that_is_too_short_does_not_disagree() {
        assert_eq!(agreement(1.3, 0.97), Agreement::Agree);
        assert_eq!(agreement(1.3, 1.0 + 1e-10), Agreement::Agree);
        assert_eq!(agreement(f64::INFINITY, 1.2), Agreement::Agree);
        assert_eq!(agreement(1.3, 1.01), Agreement::Undecided);
        assert_eq!(agreement(1.3, 1.04), Agreement::Disagree);
        assert_eq!(agreement(11.0, 0.96), Agreement::Disagree);
    }
}
