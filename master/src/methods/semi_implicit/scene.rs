//! The parameters of the methods 1 and 2 of Schweizer & Lu.

use serde::Serialize;

use super::coupling::SemiImplicit;
use super::index::Index;
use super::stability;
use super::weights::Weights;
use crate::joint::Level;
use crate::methods::condition::Condition;
use crate::methods::definition::{Definition, Given, Instability, Lacking, Parameters};
use crate::methods::method::Built;
use crate::reading::formula::{Formula, Steps, Unit};
use crate::reading::reader::{Problems, Section};

/// Schweizer & Lu, method 1: g + beta g' + gamma g'' = 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Baumgarte {
    /// Follows from beta and gamma: see [`Index`].
    pub index: Index,
    /// Weight of the velocity in s; default 2 H.
    pub beta: Formula,
    /// Weight of the acceleration in s^2; default H^2.
    pub gamma: Formula,
}

/// Schweizer & Lu, method 2: weighted multipliers of position, velocity and acceleration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Weighted {
    /// Follows from a and b: see [`Index`].
    pub index: Index,
    /// Weight of the velocity; default 2.
    pub a: f64,
    /// Weight of the acceleration; default 2.6.
    pub b: f64,
}

impl Definition for Baumgarte {
    const NAME: &'static str = "baumgarte";
    const KEYS: &'static [&'static str] = &["degree", "index", "beta", "gamma"];
    const CORRECTS: bool = true;
    const MAY_CHANGE_DEGREE: bool = true;

    fn read(
        section: &Section<'_>,
        steps: Option<Steps>,
        problems: &mut Problems<'_>,
    ) -> Option<Self> {
        let weights = Weights {
            method: Self::NAME,
            first: ("beta", Formula::multiple(2.0, Unit::Time)),
            second: ("gamma", Formula::multiple(1.0, Unit::TimeSquared)),
        };
        let (index, beta, gamma) = weights.resolve(section, steps, problems)?;
        Some(Self { index, beta, gamma })
    }
}

impl Parameters for Baumgarte {
    fn level(&self) -> Level {
        self.index.level()
    }

    fn build(&self, given: Given<'_>) -> Result<Built, Lacking> {
        let Self { beta, gamma, .. } = *self;
        let layout = given.layout;
        let condition = Condition::Baumgarte { beta, gamma };
        Ok(SemiImplicit::build(condition, given.history(), layout))
    }

    fn has_step_means(&self) -> bool {
        true
    }

    fn remembered_points(&self, degree: usize, _exchanged_degree: usize) -> Option<usize> {
        Some(degree + 1)
    }

    fn instability(&self, degree: Option<usize>, macro_step: f64) -> Option<Instability> {
        let weights = [self.beta, self.gamma].map(|formula| formula.at(macro_step));
        stability::of_baumgarte(self.index, weights, degree?, macro_step)
    }
}

impl Definition for Weighted {
    const NAME: &'static str = "weighted";
    const KEYS: &'static [&'static str] = &["degree", "index", "a", "b"];
    const CORRECTS: bool = true;
    const MAY_CHANGE_DEGREE: bool = true;

    fn read(
        section: &Section<'_>,
        steps: Option<Steps>,
        problems: &mut Problems<'_>,
    ) -> Option<Self> {
        let weights = Weights {
            method: Self::NAME,
            first: ("a", Formula::multiple(2.0, Unit::Plain)),
            second: ("b", Formula::multiple(2.6, Unit::Plain)),
        };
        let (index, a, b) = weights.resolve(section, steps, problems)?;
        let [a, b] = [a, b].map(Formula::number);
        Some(Self { index, a, b })
    }
}

impl Parameters for Weighted {
    fn level(&self) -> Level {
        self.index.level()
    }

    fn build(&self, given: Given<'_>) -> Result<Built, Lacking> {
        let Self { a, b, .. } = *self;
        let layout = given.layout;
        let condition = Condition::Weighted { a, b };
        Ok(SemiImplicit::build(condition, given.history(), layout))
    }

    fn has_step_means(&self) -> bool {
        true
    }

    fn remembered_points(&self, degree: usize, _exchanged_degree: usize) -> Option<usize> {
        Some(degree + 1)
    }

    fn instability(&self, degree: Option<usize>, _macro_step: f64) -> Option<Instability> {
        stability::of_weighted(self.index, [self.a, self.b], degree?)
    }
}
