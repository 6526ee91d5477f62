//! The shapes of the curves over a step.

use super::variant::{Family, LEAST_DEGREE};
use crate::layout::Layout;
use crate::signal::SharePolynomial;
use crate::system::unknowns::Unknowns;

/// What a variable is, and so what its curve is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A multiplier: the unknowns are values at the shares of the family.
    Multiplier,
    /// Exchanged motion: the unknowns are value and `H` times the rate at the end, and one part inside the step for each moment.
    Motion,
    /// A connected signal: the unknowns are the end value and one part inside the step for each moment; without moments past values make
    /// the rest.
    Signal,
}

/// The kinds of all variables.
pub fn kinds_of(layout: &Layout) -> Vec<Kind> {
    let mut kinds = vec![Kind::Multiplier; layout.rows.len()];
    for exchanged in &layout.exchanged {
        let kind = match exchanged.rates {
            Some(_) => Kind::Motion,
            None => Kind::Signal,
        };
        kinds.extend((0..exchanged.size()).map(|_| kind));
    }
    kinds
}

/// The shapes of the unknowns and of what is known.
#[derive(Debug, Clone, PartialEq)]
pub struct Shapes {
    /// What they belong to.
    pub family: Family,
    /// Of a multiplier that is 1 at `T_N` and 0 at the unknown nodes; absent where the start value is an unknown.
    pub held: Option<SharePolynomial>,
    multiplier: Vec<SharePolynomial>,
    /// Legendre coefficients of the shapes of a multiplier, and of what is held.
    legendre: Vec<[f64; SharePolynomial::TERMS]>,
    held_legendre: [f64; SharePolynomial::TERMS],
    /// For each degree the values of the integral of Legendre's polynomial from the start on at the unknown nodes of a multiplier.
    integrals: Vec<Vec<f64>>,
    motion: Vec<SharePolynomial>,
    signal: Vec<SharePolynomial>,
}

impl Shapes {
    /// Those of a family.
    pub fn new(family: Family) -> Self {
        let unknown = family.shares();
        let starts_anew = family.variant.starts_anew();
        let all: Vec<f64> = match starts_anew {
            true => unknown.clone(),
            false => [&[0.0], &unknown[..]].concat(),
        };
        let at = |node: f64| {
            let roots = all.iter().copied().filter(|other| *other != node);
            SharePolynomial::with_roots(roots, node)
        };
        let known = family.known_at_start();
        let ends: [&[f64]; 2] = match known {
            3 => [&[0.0, 0.0, 0.0, 4.0, -3.0], &[0.0, 0.0, 0.0, -1.0, 1.0]],
            _ => [&[0.0, 0.0, 3.0, -2.0], &[0.0, 0.0, -1.0, 1.0]],
        };
        let mut motion: Vec<_> = ends.map(SharePolynomial::of).to_vec();
        motion.extend(inside(known, 2, family.moments_of_motion()));
        let mut signal = Vec::new();
        if family.has_own_signals {
            signal.push(SharePolynomial::power(1));
            signal.extend(inside(1, 1, family.moments_of_signals()));
        }
        let held = (!starts_anew).then(|| at(0.0));
        let multiplier: Vec<SharePolynomial> = unknown.iter().map(|&node| at(node)).collect();
        let legendre = SharePolynomial::legendre_coefficients;
        Self {
            family,
            held,
            held_legendre: held.map_or([0.0; SharePolynomial::TERMS], legendre),
            integrals: integrals(family.degree, &unknown),
            legendre: multiplier.iter().copied().map(legendre).collect(),
            multiplier,
            motion,
            signal,
        }
    }

    /// Those of the unknowns of a variable; none for signals through past values.
    pub fn of(&self, kind: Kind) -> &[SharePolynomial] {
        match kind {
            Kind::Multiplier => &self.multiplier,
            Kind::Motion => &self.motion,
            Kind::Signal => &self.signal,
        }
    }

    /// The shape of one unknown as far as polynomials of multipliers of this `degree` have a part in it: the powers behind that, and the
    /// moments that belong to higher degrees, cancel in all that has this degree.
    pub fn within(&self, kind: Kind, unknown: usize, degree: usize) -> SharePolynomial {
        let shape = self.of(kind)[unknown];
        match kind {
            _ if degree >= self.family.degree => shape,
            Kind::Multiplier => SharePolynomial::of(&shape.coefficients()[..=degree]),
            Kind::Motion | Kind::Signal if unknown < unknowns_within(kind, degree) => shape,
            Kind::Motion | Kind::Signal => SharePolynomial::default(),
        }
    }

    /// For each unknown of a multiplier its part in the coefficient of Legendre's polynomial of this degree.
    pub fn parts_in(&self, degree: usize) -> impl Iterator<Item = f64> {
        self.legendre.iter().map(move |own| own[degree])
    }

    /// The coefficient of Legendre's polynomial of this degree of a multiplier that starts at `start` and has the unknown `values`.
    pub fn coefficient(&self, degree: usize, start: f64, values: &[f64]) -> f64 {
        let parts = self.parts_in(degree).zip(values);
        start * self.held_legendre[degree] + parts.map(|(part, value)| part * value).sum::<f64>()
    }

    /// The unknowns of a multiplier that is the integral of Legendre's polynomial of this degree from the start on.
    pub fn integrals(&self, degree: usize) -> impl Iterator<Item = f64> {
        self.integrals[degree].iter().copied()
    }

    /// Number of unknowns of a variable.
    pub fn unknowns(&self, kind: Kind) -> usize {
        self.of(kind).len().max(1)
    }

    /// Degree of the curve of a variable; `None` for signals through past values.
    pub fn degree(&self, kind: Kind) -> Option<usize> {
        match kind {
            Kind::Multiplier => Some(self.family.degree),
            Kind::Motion => Some(self.family.motion_degree()),
            Kind::Signal => self.signal.len().checked_sub(1).map(|moments| moments + 1),
        }
    }

    /// The values of the shapes of all unknowns at one share of the step.
    pub fn at(&self, layout: &Layout, share: f64) -> Vec<f64> {
        let kinds = kinds_of(layout).into_iter();
        kinds
            .flat_map(|kind| match self.of(kind) {
                [] => vec![share],
                shapes => shapes.iter().map(|shape| shape.value(share)).collect(),
            })
            .collect()
    }

    /// The unknowns of a macro step.
    pub fn unknowns_of(&self, layout: &Layout) -> Unknowns {
        let shares = self.family.shares();
        let at_shares = |shape: &SharePolynomial| -> Vec<f64> {
            shares.iter().map(|&share| shape.value(share)).collect()
        };
        let kinds = kinds_of(layout);
        let of_kind = |kind: &Kind| match kind {
            // Only the end value of a signal is known to change; no load is made of signals.
            Kind::Signal => [1.0, 0.0]
                .into_iter()
                .chain(std::iter::repeat(0.0))
                .take(self.unknowns(*kind))
                .flat_map(|at_end| vec![at_end; shares.len()])
                .collect(),
            kind => self.of(*kind).iter().flat_map(at_shares).collect(),
        };
        let units = kinds.iter().flat_map(|kind| {
            let ends: &[[f64; 3]] = match kind {
                Kind::Motion => &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
                Kind::Multiplier | Kind::Signal => &[[1.0; 3]],
            };
            let inside = std::iter::repeat([0.0; 3]);
            let all = ends.iter().copied().chain(inside);
            all.take(self.unknowns(*kind))
        });
        let shapes = kinds.iter().map(of_kind).collect();
        Unknowns::new(layout, shares.clone(), shapes, units.collect())
    }
}

/// Number of unknowns of a variable that belong to multipliers of this degree.
pub fn unknowns_within(kind: Kind, degree: usize) -> usize {
    match kind {
        Kind::Multiplier => degree + 1,
        Kind::Motion => degree.max(LEAST_DEGREE),
        Kind::Signal => degree,
    }
}

/// Shapes that vanish at the start and at the end of the step with these powers.
fn inside(at_start: usize, at_end: usize, number: usize) -> impl Iterator<Item = SharePolynomial> {
    let ends = [SharePolynomial::of(&[0.0, 1.0]), SharePolynomial::of(&[1.0, -1.0])];
    let powers = [at_start, at_end];
    let vanishing = ends.iter().zip(powers).fold(SharePolynomial::power(0), |product, (end, power)| {
        (0..power).fold(product, |product, _| product.times(end))
    });
    (0..number).map(move |degree| vanishing.times(&SharePolynomial::legendre(degree)))
}

fn integrals(degrees: usize, nodes: &[f64]) -> Vec<Vec<f64>> {
    let of = |degree: usize| {
        let integral = SharePolynomial::legendre(degree).integrated();
        nodes.iter().map(|&node| integral.value(node)).collect()
    };
    (0..degrees).map(of).collect()
}
