//! The parameters of Hermite coupling.

use serde::Serialize;

use super::coupling::HermiteCoupling;
use super::variant::Variant;
use crate::joint::Level;
use crate::methods::definition::{Definition, Given, Lacking, OwnCurves, Parameters};
use crate::methods::method::Built;
use crate::reading::formula::Steps;
use crate::reading::key::{Key, Takes, texts};
use crate::reading::reader::{Problems, Section, choice};
use crate::signal::{History, MAX_DEGREE, Variables};

/// Polynomials of their own on every macro step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Hermite {
    /// Which conditions fix them; default [`Variant::Apv`].
    pub variant: Variant,
}

const KEYS: [Key; 1] = [Key::new("variant", Takes::Choice(&texts(&VARIANTS)))
    .default_first()
    .means("[what they demand](../theory/hermite.md#the-variants)")];
const VARIANTS: [(&str, Variant); 2] = [("apv", Variant::Apv), ("c0pv", Variant::C0pv)];

impl Definition for Hermite {
    const NAME: &'static str = "hermite";
    const KEYS: &'static [Key] = &KEYS;
    const CORRECTS: bool = true;
    const EXCHANGED_DEGREE: Option<usize> = Some(MAX_DEGREE);

    fn read(
        section: &Section<'_>,
        _steps: Option<Steps>,
        problems: &mut Problems<'_>,
    ) -> Option<Self> {
        let [variant] = section.fields(&KEYS, problems);
        let variant = choice(variant, &VARIANTS, problems);
        Some(Self { variant: variant? })
    }
}

impl Parameters for Hermite {
    fn level(&self) -> Level {
        self.variant.level()
    }

    fn build(&self, given: Given<'_>) -> Result<Built, Lacking> {
        let layout = given.layout;
        let [_, exchanged] = given.degrees;
        let variables = Variables {
            degrees: vec![exchanged.highest(); layout.variables()],
            rotations: Vec::new(),
        };
        let start = given.established.and_then(|values| values.first());
        let values = start.map_or(&given.values[..layout.variables()], |start| start);
        let history = History::new(variables, values, given.attitudes);
        let (variant, outputs) = (self.variant, given.outputs);
        Ok(HermiteCoupling::build(variant, history, layout, outputs))
    }

    fn own_curves(&self) -> Option<OwnCurves> {
        Some(OwnCurves {
            multipliers: self.variant.degree(),
            motion: self.variant.motion_degree(),
            key: "coupling.variant",
        })
    }

    fn remembered_points(&self, _degree: usize, _exchanged_degree: usize) -> Option<usize> {
        Some(usize::from(!self.variant.starts_anew()))
    }
}
