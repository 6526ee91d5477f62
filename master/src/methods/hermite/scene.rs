//! The parameters of Hermite coupling.

use serde::Serialize;

use super::coupling::HermiteCoupling;
use super::moments::Rule;
use super::variant::{Family, HIGHEST_DEGREE, LEAST_DEGREE, Variant};
use crate::joint::Level;
use crate::methods::definition::{
    Definition, DEGREE, EXCHANGED_DEGREE, Given, Lacking, OwnCurves, Parameters, Served, WantedInside,
};
use crate::methods::method::Built;
use crate::reading::formula::Steps;
use crate::reading::key::{Key, Takes, texts};
use crate::reading::reader::{Field, Problems, Section, choice};
use crate::signal::{AUTOMATIC_DEGREE, Degree, History, MAX_DEGREE, Variables};

/// Polynomials of their own on every macro step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Hermite {
    /// What holds at the start of a step; default [`Variant::Apv`].
    pub variant: Variant,
    /// Degree p of the multipliers' polynomials, the highest one if it follows the estimates; default 2.
    pub degree: usize,
    /// Whether the degree follows the estimates.
    pub degree_follows: bool,
    /// Most instants inside a step at which the workers tell their positions.
    pub instants: usize,
    /// Whether the scene says how many.
    pub instants_are_given: bool,
    /// What moments over a step are made of; default [`Served::Instants`].
    pub moments: Served,
    /// Whether top conditions are relaxed where the top coefficients do not fall; default true.
    pub limiter: bool,
    /// Whether connected signals are polynomials through past values; default: only where a worker tells nothing inside a step.
    pub continues_signals: bool,
}

/// Instants where a scene gives no number of them: responses of up to 12 rad within a step are told apart.
const INSTANTS: usize = 4;

/// More are not needed for responses of 48 rad within a step.
const MOST_INSTANTS: usize = 16;

const KEYS: [Key; 5] = [
    Key::new("variant", Takes::Choice(&texts(&VARIANTS)))
        .default_first()
        .means("[what holds at the start of a step](../theory/hermite.md#the-variants)"),
    DEGREE,
    Key::new("instants", Takes::Whole(1, MOST_INSTANTS))
        .default("4, or the degree if that is more; with connected signals two more than the degree")
        .means(
            "instants inside a macro step at which the workers tell their positions, for degree 3 and more \
             and for connected signals; at least degree - 1. More tell faster responses apart: 3 rad within a step each",
        ),
    Key::new("moments", Takes::Choice(&texts(&SERVED)))
        .default_first()
        .means(
            "what the [moments](../theory/moments.md#moments-from-integrals) of conditions are made of: outputs at instants inside the \
             step, or `\"integrals\"` of outputs over it where the conditions are linear in outputs, and instants elsewhere; a worker of \
             such a condition that does not offer integrals is refused. `\"automatic\"`: integrals where all workers of a condition \
             offer them",
        ),
    Key::new("limiter", Takes::Choice(&texts(&SWITCH)))
        .default_first()
        .means("whether the [top condition is relaxed](../theory/moments.md#the-limiter) where the top coefficient does not fall"),
];
const SERVED: [(&str, Served); 3] =
    [("instants", Served::Instants), ("integrals", Served::Integrals), ("automatic", Served::Automatic)];
const SWITCH: [(&str, bool); 2] = [("on", true), ("off", false)];
const VARIANTS: [(&str, Variant); 2] = [("apv", Variant::Apv), ("c0pv", Variant::C0pv)];

impl Definition for Hermite {
    const NAME: &'static str = "hermite";
    const KEYS: &'static [Key] = &KEYS;
    const CORRECTS: bool = true;
    const LOWEST_DEGREE: usize = LEAST_DEGREE;
    const EXCHANGED_DEGREE: Option<usize> = Some(MAX_DEGREE);

    fn read(
        section: &Section<'_>,
        _steps: Option<Steps>,
        problems: &mut Problems<'_>,
    ) -> Option<Self> {
        let [variant, degree, instants, moments, limiter] = section.fields(&KEYS, problems);
        let variant = choice(variant, &VARIANTS, problems);
        let degree = match degree {
            Some(field) => read_degree(&field, problems),
            None => Some(Degree::Fixed(LEAST_DEGREE)),
        };
        let highest = match degree {
            None | Some(Degree::Automatic) => HIGHEST_DEGREE,
            Some(Degree::Fixed(degree)) => degree,
        };
        let instants_are_given = instants.is_some();
        let instants = match instants {
            Some(field) => field.whole_within(highest - 1, MOST_INSTANTS, problems),
            None => Some(INSTANTS.max(highest)),
        };
        let moments = choice(moments, &SERVED, problems);
        let limiter = choice(limiter, &SWITCH, problems);
        Some(Self {
            moments: moments?,
            limiter: limiter?,
            variant: variant?,
            degree: highest,
            degree_follows: degree? == Degree::Automatic,
            instants: instants?,
            instants_are_given,
            continues_signals: section.get(&EXCHANGED_DEGREE).is_some(),
        })
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
        let inside = &layout.inside;
        let family = self.family(inside.is_told());
        let rule = self.rule(inside.shares.len(), layout.has_signals()).with_integrals(inside.weights);
        let outputs = given.outputs;
        Ok(HermiteCoupling::build((family, &rule, self.limiter), history, layout, outputs))
    }

    fn inside(&self, has_signals: bool) -> Option<WantedInside> {
        let has_own_signals = has_signals && !self.continues_signals;
        let family = self.family(has_own_signals);
        // The weight of a moment of motion has the degree of its number, as has that of a signal.
        let weights = family.moments_of_motion().max(family.moments_of_signals());
        // More than a curve meets by its moments: the others show what it misses.
        let instants = match has_own_signals && !self.instants_are_given {
            true => self.instants.max(self.degree + 2),
            false => self.instants,
        };
        (weights > 0).then(|| WantedInside {
            shares: self.rule(instants, has_signals).shares,
            weights,
            moments: self.moments,
            is_needed: self.degree > LEAST_DEGREE,
        })
    }

    fn lower_degree(&mut self) -> bool {
        if !self.degree_follows || self.degree == LEAST_DEGREE {
            return false;
        }
        self.degree -= 1;
        self.degree_follows = self.degree > LEAST_DEGREE;
        true
    }

    fn forgets_loads(&self) -> bool {
        self.variant.starts_anew()
    }

    fn own_curves(&self) -> Option<OwnCurves> {
        Some(OwnCurves {
            multipliers: self.degree,
            follow: self.degree_follows,
            signals: !self.continues_signals,
            motion: self.family(true).motion_degree(),
            key: "coupling.degree",
        })
    }

    fn remembered_points(&self, _degree: usize, _exchanged_degree: usize) -> Option<usize> {
        Some(usize::from(!self.variant.starts_anew()))
    }
}

/// A whole number, or `"automatic"`.
fn read_degree(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Degree> {
    if field.peek_text().is_some() {
        return field.choice(&[(AUTOMATIC_DEGREE, Degree::Automatic)], problems);
    }
    let degree = field.whole_within(LEAST_DEGREE, HIGHEST_DEGREE, problems);
    degree.map(Degree::Fixed)
}

impl Hermite {
    /// The curves, if the workers tell something inside a step or not.
    fn family(&self, is_told_inside: bool) -> Family {
        Family {
            variant: self.variant,
            degree: self.degree,
            has_own_signals: is_told_inside && !self.continues_signals,
        }
    }

    fn rule(&self, instants: usize, has_signals: bool) -> Rule {
        Rule::new(instants, has_signals && !self.continues_signals)
    }
}
