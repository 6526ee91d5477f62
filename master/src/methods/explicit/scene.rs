//! The parameters of the explicit method.

use serde::Serialize;

use super::coupling::ExplicitCoupling;
use crate::joint::Level;
use crate::methods::definition::{DEGREE, Definition, Given, Instability, Lacking, Parameters};
use crate::methods::method::Built;
use crate::reading::formula::{Formula, Steps};
use crate::reading::key::{Key, POSITIVE, Takes, Unit};
use crate::reading::reader::{Problems, Section};

/// The explicit index-1 method of Gu & Asada: (mu d/dt + 1)^2 g = 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Explicit {
    /// Time constant in s, greater than 0.
    pub mu: Formula,
}

const MU: Key = Key::new("mu", Takes::Formula(Unit::Time, POSITIVE))
    .required("mu = \"10H\"")
    .default("required for explicit")
    .means(
        "time constant of the closing, s, such as `\"10H\"`; H of the step that has just \
         ended. Smaller: more accurate, less stable",
    );

/// A limit is met if it is missed by rounding only.
const ROUNDING: f64 = 1e-12;

impl Definition for Explicit {
    const NAME: &'static str = "explicit";
    const KEYS: &'static [Key] = &[DEGREE, MU];
    const HIGHEST_DEGREE: usize = 0;

    fn read(
        section: &Section<'_>,
        steps: Option<Steps>,
        problems: &mut Problems<'_>,
    ) -> Option<Self> {
        let field = section.require(&MU, problems)?;
        let formula = Formula::read(&field, problems)?;
        let mu = formula
            .over(steps?, &field.key)
            .map_err(|kind| field.report(kind, problems));
        Some(Self { mu: mu.ok()? })
    }
}

impl Parameters for Explicit {
    fn level(&self) -> Level {
        Level::Acceleration
    }

    /// The multipliers follow from the states at the same macro point, so no past is taken.
    fn build(&self, mut given: Given<'_>) -> Result<Built, Lacking> {
        given.established = None;
        let layout = given.layout;
        Ok(ExplicitCoupling::build(self.mu, given.history(), layout))
    }

    /// A free relative coordinate under (mu d/dt + 1)^2 g = 0: s'' is held over the step, and for mu < H the map of
    /// (s, H s') has an eigenvalue beyond the unit circle.
    fn instability(&self, _degree: Option<usize>, macro_step: f64) -> Option<Instability> {
        let mu = self.mu.at(macro_step);
        (mu < macro_step * (1.0 - ROUNDING)).then(|| Instability {
            key: "coupling.mu",
            what: format!("the explicit method is unstable with mu = {mu:?}"),
            rule: format!("mu must be at least H = {macro_step:?}"),
            remedy: "try mu = \"10H\", or a smaller macro step".to_owned(),
        })
    }
}
