//! Combinations of index and degree that are known to be unstable before anything is run.
//!
//! The rules are the limits of the macro-step map for H -> 0, where masses, stiffnesses and dampings no longer matter:
//! a free relative coordinate under the multiplier alone. They were found from the spectral radius of that map; they are
//! necessary, so a scene that breaks one diverges, but a scene that keeps them may still diverge for large H or for
//! beta below about 0.3 H. Methods 1 and 2 share one rule, since method 2 is method 1 with
//! beta = a H x/v and gamma = b H^2 x, where v and x are the velocity and the position at the end of a macro step of
//! length 1 that a unit value of the newest node causes.

use super::index::Index;
use crate::methods::definition::Instability;

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

/// The rule that method 1 breaks with a degree; constant polynomials break none.
pub(super) fn of_baumgarte(
    index: Index,
    [beta, gamma]: [f64; 2],
    degree: usize,
    macro_step: f64,
) -> Option<Instability> {
    let rule = RULES.get(degree.checked_sub(1)?)?;
    match index {
        Index::One => below_limit_of_gamma(degree, rule, macro_step, beta, gamma),
        index => Some(high_index(degree, index)),
    }
}

/// The same of method 2.
pub(super) fn of_weighted(index: Index, [a, b]: [f64; 2], degree: usize) -> Option<Instability> {
    let rule = RULES.get(degree.checked_sub(1)?)?;
    match index {
        Index::One => below_limit_of_b(degree, rule, a, b),
        index => Some(high_index(degree, index)),
    }
}

fn below_limit_of_gamma(
    degree: usize,
    rule: &Rule,
    macro_step: f64,
    beta: f64,
    gamma: f64,
) -> Option<Instability> {
    let limit = rule.offset * macro_step * macro_step + rule.slope * beta * macro_step;
    (gamma < limit * (1.0 - ROUNDING)).then(|| Instability {
        key: "coupling.gamma",
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

fn below_limit_of_b(degree: usize, rule: &Rule, a: f64, b: f64) -> Option<Instability> {
    let offset = rule.offset / rule.position;
    let slope = rule.slope / rule.velocity;
    let limit = offset + slope * a;
    (b < limit * (1.0 - ROUNDING)).then(|| Instability {
        key: "coupling.b",
        what: format!("weighted, index 1, degree {degree} is unstable with b = {b:?}"),
        rule: format!("b must be at least {offset:.4} + {slope:.4} a = {limit:.4} for a = {a:?}"),
        remedy: "try a = 2 and b = 2.6, which is stable for degree 0 to 3, or a lower degree"
            .to_owned(),
    })
}

fn high_index(degree: usize, index: Index) -> Instability {
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
    Instability {
        key: "coupling.degree",
        what: format!("index {} with degree {degree} is {outlook}", index.number()),
        rule: rule.to_owned(),
        remedy: "try degree = 0, or index = 1".to_owned(),
    }
}
