//! A coupling method as a scene has it: its parameters, and what follows from them before any worker is known.

use nalgebra::UnitQuaternion;
use serde::Serialize;

use super::method::Built;
use crate::joint::Level;
use crate::layout::Layout;
use crate::reading::formula::Steps;
use crate::reading::key::{Key, Takes};
use crate::reading::reader::{Problems, Section};
use crate::signal::{AUTOMATIC_DEGREE, Degree, History, MAX_DEGREE};
use crate::system::Outputs;
use linchpin_proto::polynomial::MAX_NODES;

/// The parameters of a method: a type of its own, which reads them. Only the first three have no default.
pub(crate) trait Definition: Parameters + Sized {
    /// Its name in a scene.
    const NAME: &'static str;

    /// Keys of `[coupling]` that it has and that not every method has; [`DEGREE`] among them if a scene chooses it.
    const KEYS: &'static [Key];

    /// Reads them, where the macro steps are `steps`; mistakes are reported, and told by `None`.
    fn read(
        section: &Section<'_>,
        steps: Option<Steps>,
        problems: &mut Problems<'_>,
    ) -> Option<Self>;

    /// Whether it corrects its prediction: then it has the keys of iterations, kept columns and variable steps.
    const CORRECTS: bool = false;

    /// Lowest degree of its polynomials.
    const LOWEST_DEGREE: usize = 0;

    /// Highest degree of its polynomials.
    const HIGHEST_DEGREE: usize = MAX_DEGREE;

    /// Whether corrected values tell the error of a polynomial of every degree, so that it may follow the estimates.
    const MAY_CHANGE_DEGREE: bool = false;

    /// Degree of the polynomials of exchanged variables where a scene gives none, if it does not follow from that of the multipliers.
    const EXCHANGED_DEGREE: Option<usize> = None;
}

/// The key of a method whose multipliers have the degree that a scene chooses.
pub(crate) const DEGREE: Key = Key::new("degree", DEGREES_OF_MULTIPLIERS)
    .default("1 (explicit: 0; hermite: 2)")
    .means(
        "degree of the polynomials of the multipliers: 0 to 3, for hermite 2 to 5, with \
         [moments](../theory/moments.md) from 3 on. `\"automatic\"`, for hermite, baumgarte and weighted: on \
         every step the one that the estimates favour, never above the stable ones \
         ([how](../theory/step-control.md#degrees-that-follow-the-error))",
    );

/// The key of the degree of exchanged variables.
pub(crate) const EXCHANGED_DEGREE: Key = Key::new("exchanged_degree", DEGREES)
    .default(
        "2, or the degree of the multipliers if that is more; automatic if `degree` is (explicit: 0; hermite: curves of \
         their own for connected signals)",
    )
    .means(
        "degree of the polynomials of exchanged body motion and connected signals through past values; with \
         hermite of connected signals only. `\"automatic\"`: baumgarte and weighted, by \
         estimates of its own",
    );

const DEGREES_OF_MULTIPLIERS: Takes = Takes::Either(&[
    Takes::Whole(0, MAX_NODES - 3),
    Takes::Choice(&[AUTOMATIC_DEGREE]),
]);

/// Degrees of polynomials.
pub(crate) const DEGREES: Takes = Takes::Either(&[
    Takes::Whole(0, MAX_DEGREE),
    Takes::Choice(&[AUTOMATIC_DEGREE]),
]);

/// What follows from the parameters of a method.
pub trait Parameters {
    /// Highest level of the conditions that it needs.
    fn level(&self) -> Level;

    /// Makes the method at the first macro point.
    ///
    /// # Errors
    /// What it lacks.
    fn build(&self, given: Given<'_>) -> Result<Built, Lacking>;

    /// Whether it closes the joints; springs do not.
    fn closes_joints(&self) -> bool {
        true
    }

    /// Whether loads behind an impact owe nothing to those before it.
    fn forgets_loads(&self) -> bool {
        true
    }

    /// The curves of multipliers and exchanged motion, if they are none of Lagrange through past values.
    fn own_curves(&self) -> Option<OwnCurves> {
        None
    }

    /// Lets the polynomials of [`Parameters::own_curves`], if their degree follows the estimates, end one degree lower; whether that is possible.
    fn lower_degree(&mut self) -> bool {
        false
    }

    /// What it wants to know of the inside of a step, if anything; `has_signals` if signals are connected.
    fn inside(&self, _has_signals: bool) -> Option<WantedInside> {
        None
    }

    /// Whether a multiplier of degree 0 at `T_{N+1}` is its mean over the step before.
    fn has_step_means(&self) -> bool {
        false
    }

    /// Number of macro points at which it remembers multipliers of these degrees, the present one included; `None` if it remembers
    /// outputs as well.
    fn remembered_points(&self, _degree: usize, _exchanged_degree: usize) -> Option<usize> {
        Some(0)
    }

    /// What is known to be unstable about it with multipliers of this degree, absent where it follows the estimates, and this macro
    /// step (s), whatever the subsystems are.
    fn instability(&self, _degree: Option<usize>, _macro_step: f64) -> Option<Instability> {
        None
    }
}

/// What moments over a step are to be made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Served {
    /// Integrals of outputs where conditions are linear in outputs and the workers offer them, otherwise outputs at instants.
    Automatic,
    /// Integrals wherever conditions are linear in outputs.
    Integrals,
    /// Outputs at instants.
    Instants,
}

/// What a method wants to know of the inside of a step.
#[derive(Debug, Clone, PartialEq)]
pub struct WantedInside {
    /// Instants, as shares of the step, at which it looks at positions.
    pub shares: Vec<f64>,
    /// Number of integrals of each output in place of them.
    pub weights: usize,
    /// Which of the two.
    pub moments: Served,
    /// Whether it cannot do without.
    pub is_needed: bool,
}

/// Degrees of curves that a method has of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OwnCurves {
    /// Of multipliers; the highest one where it follows the estimates.
    pub multipliers: usize,
    /// Whether that of multipliers follows the estimates.
    pub follow: bool,
    /// Of exchanged motion.
    pub motion: usize,
    /// Whether connected signals have the degree of multipliers where the workers tell something inside a step.
    pub signals: bool,
    /// The key that determines them.
    pub key: &'static str,
}

/// A combination of parameters that is unstable.
#[derive(Debug, Clone, PartialEq)]
pub struct Instability {
    /// The key that it refers to.
    pub key: &'static str,
    /// The combination.
    pub what: String,
    /// The rule that it breaks, with numbers.
    pub rule: String,
    /// What to try.
    pub remedy: String,
}

/// A parameter that the joints of a scene need and that it does not give.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lacking {
    /// What is missing.
    pub message: String,
    /// How it is given.
    pub help: String,
}

/// The first macro point.
pub struct Given<'a> {
    /// What is coupled.
    pub layout: &'a Layout,
    /// The coupling outputs.
    pub outputs: &'a dyn Outputs,
    /// Degrees of the polynomials of multipliers and of exchanged variables.
    pub degrees: [Degree; 2],
    /// The first macro step (s).
    pub macro_step: f64,
    /// Values of all coupling variables.
    pub values: Vec<f64>,
    /// Attitudes to which rotation vectors are relative.
    pub attitudes: Vec<UnitQuaternion<f64>>,
    /// Values at past macro points, newest first, where a study gives them.
    pub established: Option<&'a [Vec<f64>]>,
}

impl Given<'_> {
    /// The history of the variables.
    pub fn history(self) -> History {
        let [degree, exchanged] = self.degrees.map(Degree::highest);
        let variables = self.layout.describe_variables(degree, exchanged);
        match self.established {
            Some(values) => {
                History::established(variables, self.macro_step, values, self.attitudes)
            }
            None => History::new(variables, &self.values, self.attitudes),
        }
    }
}
