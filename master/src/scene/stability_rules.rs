//! Combinations of method, index and degree that are known to be unstable before anything is run.
//!
//! The rules are the limits of the macro-step map for H -> 0, where masses, stiffnesses and dampings no longer matter:
//! a free relative coordinate under the multiplier alone. They were found from the spectral radius of that map; they are
//! necessary, so a scene that breaks one diverges, but a scene that keeps them may still diverge for large H or for
//! beta below about 0.3 H. Methods 1 and 2 share one rule, since method 2 is method 1 with
//! beta = a H x/v and gamma = b H^2 x, where v and x are the velocity and the position at the end of a macro step of
//! length 1 that a unit value of the newest node causes.

use std::fmt;

use super::place::Place;
use super::resolved::{Coupling, Degree, Index, Method};
use super::whole::Scene;

/// A scene that is sound but known to be unstable.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    /// The key it refers to.
    pub key: &'static str,
    /// Where that key, or the nearest one around it, is set.
    pub place: Option<Place>,
    /// The combination.
    pub what: String,
    /// The rule it breaks, with numbers.
    pub rule: String,
    /// What to try.
    pub remedy: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = &self.place {
            write!(f, "{place}: ")?;
        }
        write!(f, "{}: {}\n  help: {}", self.what, self.rule, self.remedy)
    }
}

/// The stability limit of one degree for index 1, gamma >= offset H^2 + slope beta H, and the response to the newest node.
struct Rule {
    offset: f64,
    slope: f64,
    velocity: f64,
    position: f64,
}

/// For degree 1, 2 and 3; degree 0 is stable at every index.
const RULES: [Rule; 3] = [
    Rule {
        offset: 1.0 / 12.0,
        slope: 0.0,
        velocity: 1.0 / 2.0,
        position: 1.0 / 6.0,
    },
    Rule {
        offset: 1.0 / 12.0,
        slope: 1.0 / 6.0,
        velocity: 5.0 / 12.0,
        position: 1.0 / 8.0,
    },
    Rule {
        offset: 7.0 / 90.0,
        slope: 1.0 / 3.0,
        velocity: 3.0 / 8.0,
        position: 19.0 / 180.0,
    },
];

/// A limit is met if it is missed by rounding only.
const ROUNDING: f64 = 1e-12;

impl Coupling {
    /// Whether a multiplier at `T_{N+1}` is its mean over the step before: the corrector of degree 0 holds it over the
    /// whole step, so as a value in time it belongs to the middle of the step. Not where the degree may change.
    pub fn multipliers_are_step_means(&self) -> bool {
        let highest = match self.degree {
            Degree::Fixed(degree) => degree,
            Degree::Automatic => highest_stable_degree(self.method, self.macro_step),
        };
        self.method.is_corrected() && highest == 0
    }
}

/// The known instabilities of a scene; empty if none is known.
pub fn warnings(scene: &Scene) -> Vec<Warning> {
    if scene.joints.is_empty() {
        return Vec::new();
    }
    let coupling = &scene.coupling;
    let macro_step = shortest_step(coupling);
    let warning = match (coupling.method, coupling.degree) {
        (Method::Explicit { mu }, _) => below_limit_of_mu(macro_step, mu.at(macro_step)),
        (method, Degree::Fixed(degree)) => below_limit(method, degree, macro_step),
        // It does not go beyond the limits.
        (_, Degree::Automatic) => None,
    };
    warning
        .into_iter()
        .map(|warning| Warning {
            place: scene.place(warning.key),
            ..warning
        })
        .collect()
}

/// A variable step that is unstable is repeated with a shorter one, so what counts is the shortest.
fn shortest_step(coupling: &Coupling) -> f64 {
    coupling
        .step_control
        .map_or(coupling.macro_step, |control| control.least_step)
}

/// The highest degree of the polynomials of multipliers that keeps the rules for a macro step of this length in s, as all lower ones do.
pub(crate) fn highest_stable_degree(method: Method, macro_step: f64) -> usize {
    let mut degrees = 1..=RULES.len();
    let unstable = degrees.find(|&degree| below_limit(method, degree, macro_step).is_some());
    unstable.map_or(RULES.len(), |degree| degree - 1)
}

/// The rule that a method breaks with a degree; constant polynomials break none.
fn below_limit(method: Method, degree: usize, macro_step: f64) -> Option<Warning> {
    let rule = RULES.get(degree.checked_sub(1)?)?;
    match method {
        Method::Baumgarte {
            index: Index::One,
            beta,
            gamma,
        } => {
            let [beta, gamma] = [beta, gamma].map(|formula| formula.at(macro_step));
            below_limit_of_gamma(degree, rule, macro_step, beta, gamma)
        }
        Method::Weighted {
            index: Index::One,
            a,
            b,
        } => below_limit_of_b(degree, rule, a, b),
        Method::Baumgarte { index, .. } | Method::Weighted { index, .. } => {
            Some(high_index(degree, index))
        }
        Method::Hermite { .. } | Method::Explicit { .. } | Method::Penalty { .. } => None,
    }
}

/// A free relative coordinate under (mu d/dt + 1)^2 g = 0: s'' is held over the step, and for mu < H the map of
/// (s, H s') has an eigenvalue beyond the unit circle.
fn below_limit_of_mu(macro_step: f64, mu: f64) -> Option<Warning> {
    (mu < macro_step * (1.0 - ROUNDING)).then(|| Warning {
        key: "coupling.mu",
        place: None,
        what: format!("the explicit method is unstable with mu = {mu:?}"),
        rule: format!("mu must be at least H = {macro_step:?}"),
        remedy: "try mu = \"10H\", or a smaller macro step".to_owned(),
    })
}

fn below_limit_of_gamma(
    degree: usize,
    rule: &Rule,
    macro_step: f64,
    beta: f64,
    gamma: f64,
) -> Option<Warning> {
    let limit = rule.offset * macro_step * macro_step + rule.slope * beta * macro_step;
    (gamma < limit * (1.0 - ROUNDING)).then(|| Warning {
        key: "coupling.gamma",
        place: None,
        what: format!("baumgarte, index 1, degree {degree} is unstable with gamma = {gamma:?}"),
        rule: format!(
            "gamma must be at least {} = {limit:.4e} for H = {macro_step:?} and beta = {beta:?}",
            limit_in_words(rule)
        ),
        remedy: "try beta = \"2H\" and gamma = \"H^2\", which is stable for degree 0 to 3, or a lower degree"
            .to_owned(),
    })
}

fn limit_in_words(rule: &Rule) -> String {
    let offset = format!("{:.4} H^2", rule.offset);
    if rule.slope == 0.0 {
        offset
    } else {
        format!("{offset} + {:.4} beta H", rule.slope)
    }
}

fn below_limit_of_b(degree: usize, rule: &Rule, a: f64, b: f64) -> Option<Warning> {
    let offset = rule.offset / rule.position;
    let slope = rule.slope / rule.velocity;
    let limit = offset + slope * a;
    (b < limit * (1.0 - ROUNDING)).then(|| Warning {
        key: "coupling.b",
        place: None,
        what: format!("weighted, index 1, degree {degree} is unstable with b = {b:?}"),
        rule: format!("b must be at least {offset:.4} + {slope:.4} a = {limit:.4} for a = {a:?}"),
        remedy: "try a = 2 and b = 2.6, which is stable for degree 0 to 3, or a lower degree"
            .to_owned(),
    })
}

fn high_index(degree: usize, index: Index) -> Warning {
    let rule = match (index, degree) {
        (Index::Two, 1) => {
            "index 2 with degree 1 is stable only with both a large velocity weight and damping in the subsystems"
        }
        (Index::Two, _) => "index 2 needs degree 0; degree 2 and 3 are unstable for any parameters",
        _ => "index 3 needs degree 0; degree 1 to 3 are unstable for any parameters",
    };
    let outlook = if (index, degree) == (Index::Two, 1) {
        "mostly unstable"
    } else {
        "unstable"
    };
    Warning {
        key: "coupling.degree",
        place: None,
        what: format!("index {} with degree {degree} is {outlook}", index.number()),
        rule: rule.to_owned(),
        remedy: "try degree = 0, or index = 1".to_owned(),
    }
}
