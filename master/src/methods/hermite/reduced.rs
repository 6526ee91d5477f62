//! Equations of fewer degrees, or with relaxed top conditions, in place of those of a step.

use super::curves::HermiteCurves;
use super::shapes::{Kind, unknowns_within};
use super::stack::Stack;
use super::variant::{ENDS, LEAST_DEGREE};

/// The top coefficient of a multiplier has to be smaller than this share of those before it.
const FALLING: f64 = 0.5;

/// Coefficients below this share of the largest one of all multipliers of one unit are rounding.
const ROUNDING: f64 = 1e-8;

/// Coefficients below this share may be the noise of a solver: that they do not fall is no news.
const HEARD: f64 = 1e-5;

/// By what share of the largest response of the top condition it is relaxed where the top coefficient does not fall.
const LIMITED: f64 = 0.05;

/// The same where a multiplier is continuous, by degree from 3 on: the parasitic mode of two free bodies dies out within a step. There
/// the condition is always relaxed.
const CONTINUOUS: [f64; 3] = [0.04, 0.0068, 0.0022];

/// A relaxed top condition: `integral of g L''_{p-1} ds + kappa b = 0`, with the coefficient `b = 2 (2p - 1) a_p` of `L_{p-1}` in the derivative
/// of the multiplier, where a load of 1 opens the joint with the power 1; otherwise with the other sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relaxed {
    /// The multiplier.
    pub variable: usize,
    /// Whether its top coefficient stands above what may be noise.
    pub is_heard: bool,
    /// Its degree p.
    degree: usize,
    /// `kappa 2 (2p - 1)` with its sign, in the units of the stacked row.
    factor: f64,
}

impl Stack {
    /// Lets the multipliers have this `degree`, and motion and signals as many moments as belong to it, over `curves` as they are
    /// predicted: in place of the highest conditions the highest coefficients vanish.
    pub fn reduce(&mut self, degree: usize, curves: &HermiteCurves) {
        let shapes = curves.shapes();
        for variable in 0..curves.variables() {
            let (values, start) = (curves.values(variable), curves.start(variable));
            if curves.kind(variable) == Kind::Multiplier {
                for top in degree + 1..=shapes.family.degree {
                    let value = shapes.coefficient(top, start, values);
                    self.replace(self.place_of_top(variable, top), shapes.parts_in(top), value);
                }
                continue;
            }
            for unknown in unknowns_within(curves.kind(variable), degree)..values.len() {
                let known = if unknown == 0 { start } else { 0.0 };
                let parts = (0..values.len()).map(|own| f64::from(u8::from(own == unknown)));
                let place = self.first_end(variable) + unknown;
                self.replace(place, parts, values[unknown] - known);
            }
        }
    }

    /// What stands in place of the highest conditions is met.
    pub fn meet_reduced(&mut self, degree: usize, curves: &HermiteCurves) {
        let highest = curves.shapes().family.degree;
        for variable in 0..curves.variables() {
            if curves.kind(variable) == Kind::Multiplier {
                for top in degree + 1..=highest {
                    self.meet(self.place_of_top(variable, top));
                }
                continue;
            }
            for unknown in unknowns_within(curves.kind(variable), degree)..curves.values(variable).len() {
                self.meet(self.first_end(variable) + unknown);
            }
        }
    }

    /// The relaxed top conditions of multipliers of this degree whose top coefficient does not fall in the solution `change`, or of all
    /// that are continuous.
    pub fn find_relaxed(
        &self,
        degree: usize,
        curves: &HermiteCurves,
        change: Option<&[f64]>,
        relaxed: &mut Vec<Relaxed>,
    ) {
        relaxed.clear();
        if degree <= LEAST_DEGREE {
            return;
        }
        for variable in (0..curves.variables()).filter(|&one| curves.kind(one) == Kind::Multiplier) {
            let alpha = match change {
                None => CONTINUOUS[degree - LEAST_DEGREE - 1],
                Some(change) if !falls(degree, curves, variable, (change, ROUNDING)) => LIMITED,
                Some(_) => continue,
            };
            let kappa = alpha * self.largest_response(degree, curves, variable);
            let is_heard =
                |change| !falls(degree, curves, variable, (change, HEARD));
            relaxed.push(Relaxed {
                is_heard: change.is_some_and(is_heard),
                variable,
                degree,
                factor: self.power(variable) * kappa * 2.0 * (2.0 * degree as f64 - 1.0),
            });
        }
    }

    /// The largest response of the top condition of a multiplier to integrals of Legendre's polynomials.
    fn largest_response(&self, degree: usize, curves: &HermiteCurves, variable: usize) -> f64 {
        let place = self.place_of_top(variable, degree);
        let responses = (0..degree).map(|number| {
            let integrals = curves.shapes().integrals(number);
            let own = self.own_entries(place);
            own.zip(integrals).map(|(entry, value)| entry * value).sum::<f64>().abs()
        });
        responses.fold(0.0, f64::max)
    }

    /// Relaxes these conditions, in Jacobian and residual.
    pub fn relax(&mut self, relaxed: &[Relaxed], curves: &HermiteCurves) {
        for one in relaxed {
            let place = self.place_of_top(one.variable, one.degree);
            let parts = curves.shapes().parts_in(one.degree);
            self.add_to_row(place, parts.map(|part| one.factor * part));
        }
        self.relax_residual(relaxed, curves);
    }

    /// The same in the residual alone.
    pub fn relax_residual(&mut self, relaxed: &[Relaxed], curves: &HermiteCurves) {
        for one in relaxed {
            let place = self.place_of_top(one.variable, one.degree);
            let (start, values) = (curves.start(one.variable), curves.values(one.variable));
            let top = curves.shapes().coefficient(one.degree, start, values);
            self.add_residual(place, one.factor * top);
        }
    }

    /// The place of the condition of a multiplier that its coefficient of this degree belongs to: `g' = 0`, `g = 0`, then the moments.
    fn place_of_top(&self, variable: usize, degree: usize) -> usize {
        let first = self.first_end(variable);
        match degree {
            0 | 1 => first + 1,
            2 => first,
            _ => first + ENDS.len() + degree - LEAST_DEGREE - 1,
        }
    }
}

/// The largest ratio of the top coefficient of a multiplier, of this degree, to those before it; 1 at most.
pub fn top_share(degree: usize, curves: &HermiteCurves) -> f64 {
    let multipliers = (0..curves.variables()).filter(|&one| curves.kind(one) == Kind::Multiplier);
    multipliers
        .map(|variable| share(degree, curves, variable, (None, ROUNDING)))
        .fold(0.0, f64::max)
}

/// Whether the coefficients of a multiplier fall towards the top one, where all unknowns change by `change`.
fn falls(
    degree: usize,
    curves: &HermiteCurves,
    variable: usize,
    (change, noise): (&[f64], f64),
) -> bool {
    share(degree, curves, variable, (Some(change), noise)) <= FALLING
}

/// The ratio of the top coefficient of a multiplier to those before it; 0 where it is noise, 1 at most.
fn share(
    degree: usize,
    curves: &HermiteCurves,
    variable: usize,
    (change, noise): (Option<&[f64]>, f64),
) -> f64 {
    let shapes = curves.shapes();
    let coefficient = |variable: usize, degree: usize| {
        let own = |change: &[f64]| shapes.coefficient(degree, 0.0, &change[curves.unknowns_of(variable)]);
        let (start, values) = (curves.start(variable), curves.values(variable));
        (shapes.coefficient(degree, start, values) + change.map_or(0.0, own)).abs()
    };
    let top = coefficient(variable, degree);
    if top <= FALLING * coefficient(variable, degree - 1) && change.is_some() {
        return 0.0;
    }
    let like = curves.like(variable);
    let all = like.flat_map(|one| (0..degree).map(move |degree| (one, degree)));
    let largest = all.map(|(one, degree)| coefficient(one, degree)).fold(0.0, f64::max);
    match top <= noise * largest {
        true => 0.0,
        false => {
            let before = coefficient(variable, degree - 1).max(coefficient(variable, degree - 2));
            (top / before).min(1.0)
        }
    }
}
