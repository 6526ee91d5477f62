//! The parameters of the methods 1 and 2 of Schweizer & Lu.

use serde::Serialize;

use super::coupling::SemiImplicit;
use super::index::Index;
use super::stability;
use super::weights::Weights;
use crate::joint::Level;
use crate::methods::condition::Condition;
use crate::methods::definition::{DEGREE, Definition, Given, Instability, Lacking, Parameters};
use crate::methods::method::Built;
use crate::reading::formula::{Formula, Steps};
use crate::reading::key::{Key, NOT_NEGATIVE, Takes, Unit};
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

const INDEX: Key = Key::new("index", Takes::Whole(1, 3))
    .default("follows from the parameters")
    .means("if given, it must fit them");
const BAUMGARTE: [Key; 4] = [
    DEGREE,
    INDEX,
    Key::new("beta", Takes::Formula(Unit::Time, NOT_NEGATIVE))
        .default("2H if index 1 or 2 needs it")
        .means(
            "weight of the velocity level, s. Larger: smoother multipliers, slower closing of \
             the joint",
        ),
    Key::new("gamma", Takes::Formula(Unit::TimeSquared, NOT_NEGATIVE))
        .default("H^2 if index 1 needs it")
        .means("weight of the acceleration level, s^2"),
];
const WEIGHTED: [Key; 4] = [
    DEGREE,
    INDEX,
    Key::new("a", Takes::Formula(Unit::Plain, NOT_NEGATIVE))
        .default("2 if index 1 or 2 needs it")
        .means("weight of the velocity multiplier"),
    Key::new("b", Takes::Formula(Unit::Plain, NOT_NEGATIVE))
        .default("2.6 if index 1 needs it")
        .means("weight of the acceleration multiplier"),
];

impl Definition for Baumgarte {
    const NAME: &'static str = "baumgarte";
    const KEYS: &'static [Key] = &BAUMGARTE;
    const CORRECTS: bool = true;
    const MAY_CHANGE_DEGREE: bool = true;

    fn read(
        section: &Section<'_>,
        steps: Option<Steps>,
        problems: &mut Problems<'_>,
    ) -> Option<Self> {
        let weights = Weights {
            method: Self::NAME,
            keys: &BAUMGARTE,
            first: Formula::multiple(2.0, Unit::Time),
            second: Formula::multiple(1.0, Unit::TimeSquared),
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
    const KEYS: &'static [Key] = &WEIGHTED;
    const CORRECTS: bool = true;
    const MAY_CHANGE_DEGREE: bool = true;

    fn read(
        section: &Section<'_>,
        steps: Option<Steps>,
        problems: &mut Problems<'_>,
    ) -> Option<Self> {
        let weights = Weights {
            method: Self::NAME,
            keys: &WEIGHTED,
            first: Formula::multiple(2.0, Unit::Plain),
            second: Formula::multiple(2.6, Unit::Plain),
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
