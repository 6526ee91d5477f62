//! The curves of all coupling variables on one macro step, without a past.

mod stepping;

use std::ops::Range;

use linchpin_proto::v1::Signal;
use nalgebra::UnitQuaternion;
use serde::{Deserialize, Serialize};

use crate::methods::hermite::shapes::{Kind, Shapes, kinds_of};
use crate::layout::Layout;
use crate::signal::attitude::quaternions;
use crate::signal::{Curves, ErrorShares, History, SharePolynomial};
use crate::system::unknowns::Unknowns;

/// State of a variable at the present macro point: value, rate and second derivative.
type Start = [f64; 3];

/// The curves over a step of length `H` from the present macro point, and what they continue.
///
/// * multiplier: the polynomial through its values at `0, 1/p, .., 1` of the step;
/// * exchanged motion: `p + v tau + a tau^2/2`, without `a` where it is not read, the two polynomials that bring value and rate at the end
///   to what they are, and those that are 0 at both ends with the rates that are known there;
/// * connected signal: the chord, and polynomials that are 0 at both ends; or the Lagrange polynomial through its end value and past
///   values.
#[derive(Debug, Clone)]
pub struct HermiteCurves {
    length: f64,
    /// Degree of the multipliers' polynomials over the present step.
    degree: usize,
    unknowns: Unknowns,
    kinds: Vec<Kind>,
    shapes: Shapes,
    values: Vec<f64>,
    curves: Vec<SharePolynomial>,
    starts: Vec<Start>,
    /// The curves over the step before, and rates of the second derivatives of motion.
    past: Vec<SharePolynomial>,
    jerks: Vec<f64>,
    past_length: f64,
    has_past: bool,
    /// Whether exchanged variables jump in the present step.
    has_jumped: bool,
    /// What share corrections are expected to miss.
    rate: Option<f64>,
    history: History,
    rotations: Vec<usize>,
    /// For each multiplier whether it is a force.
    are_lengths: Vec<bool>,
    attitudes: Vec<UnitQuaternion<f64>>,
}

/// What the curves are, and what they continue, without what they are made of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Past {
    length: f64,
    values: Vec<f64>,
    starts: Vec<Start>,
    past: Vec<SharePolynomial>,
    jerks: Vec<f64>,
    past_length: f64,
    has_past: bool,
    rate: Option<f64>,
    history: History,
    #[serde(with = "quaternions")]
    attitudes: Vec<UnitQuaternion<f64>>,
}

impl HermiteCurves {
    /// Curves that start from the values of `history`; motion gets its rates by [`HermiteCurves::set_rates`].
    pub fn new(layout: &Layout, shapes: Shapes, unknowns: Unknowns, history: History) -> Self {
        let size = layout.variables();
        let starts = history.newest().iter().map(|&value| [value, 0.0, 0.0]);
        let rotations: Vec<usize> = layout.attitudes().map(|one| one.first).collect();
        let mut starts: Vec<Start> = starts.collect();
        for &first in &rotations {
            starts[first..first + 3].fill([0.0; 3]);
        }
        let constant = |start: &Start| SharePolynomial::of(&start[..1]);
        Self {
            length: 0.0,
            degree: shapes.family.degree,
            kinds: kinds_of(layout),
            shapes,
            values: vec![0.0; unknowns.len()],
            unknowns,
            curves: vec![SharePolynomial::default(); size],
            past: starts.iter().map(constant).collect(),
            jerks: vec![0.0; size],
            past_length: 1.0,
            has_past: false,
            has_jumped: false,
            rate: None,
            starts,
            rotations,
            are_lengths: layout.are_lengths().collect(),
            attitudes: history.attitudes().to_vec(),
            history,
        }
    }

    /// Takes over another state of the same curves, in memory that is already there.
    pub fn copy_from(&mut self, other: &Self) {
        self.length = other.length;
        self.degree = other.degree;
        self.values.clone_from(&other.values);
        self.curves.clone_from(&other.curves);
        self.starts.clone_from(&other.starts);
        self.past.clone_from(&other.past);
        self.jerks.clone_from(&other.jerks);
        self.past_length = other.past_length;
        self.has_past = other.has_past;
        self.rate = other.rate;
        self.history.copy_from(&other.history);
        self.attitudes.clone_from(&other.attitudes);
    }

    /// What they are, to be written.
    pub fn past(&self) -> Past {
        Past {
            length: self.length,
            values: self.values.clone(),
            starts: self.starts.clone(),
            past: self.past.clone(),
            jerks: self.jerks.clone(),
            past_length: self.past_length,
            has_past: self.has_past,
            rate: self.rate,
            history: self.history.clone(),
            attitudes: self.attitudes.clone(),
        }
    }

    /// Goes on from what was written.
    pub fn resume(&mut self, past: Past) {
        self.length = past.length;
        self.values = past.values;
        self.starts = past.starts;
        self.past = past.past;
        self.jerks = past.jerks;
        self.past_length = past.past_length;
        self.has_past = past.has_past;
        self.rate = past.rate;
        self.history = past.history;
        self.attitudes = past.attitudes;
        self.shape_curves();
    }

    /// Exchanged variables jump in the present step: the next ones do not continue them.
    pub fn restart_exchanged(&mut self) {
        self.history.restart(self.are_lengths.len()..self.kinds.len());
        self.has_jumped = true;
    }

    /// Gives the multipliers' polynomials this degree from the next prediction on.
    pub fn set_degree(&mut self, degree: usize) {
        self.degree = degree;
    }

    /// What the curves are made of.
    pub fn shapes(&self) -> &Shapes {
        &self.shapes
    }

    /// Number of variables.
    pub fn variables(&self) -> usize {
        self.kinds.len()
    }

    /// What a variable is.
    pub fn kind(&self, variable: usize) -> Kind {
        self.kinds[variable]
    }

    /// Numbers of the unknowns of a variable.
    pub fn unknowns_of(&self, variable: usize) -> Range<usize> {
        self.unknowns.of(variable)
    }

    /// Values of the unknowns of a variable.
    pub fn values(&self, variable: usize) -> &[f64] {
        &self.values[self.unknowns.of(variable)]
    }

    /// All multipliers that are forces, or all that are moments, as one is.
    pub fn like(&self, variable: usize) -> impl Iterator<Item = usize> {
        let are_lengths = self.are_lengths.iter().enumerate();
        are_lengths
            .filter(move |(_, is_length)| **is_length == self.are_lengths[variable])
            .map(|(like, _)| like)
    }

    /// Value of a variable at the present macro point.
    pub fn start(&self, variable: usize) -> f64 {
        self.starts[variable][0]
    }

    /// Whether there was a step before.
    pub fn has_past(&self) -> bool {
        self.has_past
    }

    /// What the difference between corrected and predicted values tells of the multipliers.
    pub fn load_error(&self) -> ErrorShares {
        match self.has_past {
            true => {
                ErrorShares::of_continuation(self.shapes.family.degree, self.past_length / self.length)
            }
            false => ErrorShares::WITHOUT_PAST,
        }
    }

    /// The value of a connected signal at the present macro point if its curve over the step is a chord because it has no longer past.
    pub fn chord_start(&self, variable: usize) -> Option<f64> {
        let is_chord = self.history.is_chord(variable);
        is_chord.then(|| self.history.newest()[variable])
    }

    /// What the difference between corrected and predicted end value tells of a connected signal.
    pub fn signal_error(&self, variable: usize, step: f64) -> ErrorShares {
        self.history.error_shares(variable, step)
    }

    /// What the curve of a connected signal misses as far as the motion that it drives feels it: with coefficients that fall by a ratio `r` the
    /// curve of degree p misses `r` times its top coefficient, whose mean is a sixth, and p - 1 of its moments vanish.
    pub fn signal_effect(&self, variable: usize) -> f64 {
        let values = self.values(variable);
        let coefficient = |degree: usize| match degree {
            0 => 0.0,
            1 => (values[0] - self.start(variable)).abs(),
            _ => values.get(degree - 1).map_or(0.0, |value| value.abs()),
        };
        let degree = self.degree;
        let top = coefficient(degree);
        let before = coefficient(degree - 1).max(coefficient(degree.saturating_sub(2)));
        let ratio = if top < before { top / before } else { 1.0 };
        top / 6.0 * ratio.powi(degree as i32)
    }

    /// Rate and second derivative of a variable of motion at the present macro point.
    pub fn set_rates(&mut self, variable: usize, speed: f64, acceleration: f64) {
        self.starts[variable][1] = speed;
        self.starts[variable][2] = acceleration;
    }

    /// Corrections of the next steps are expected to miss this share of what they change.
    pub fn expect_rate(&mut self, rate: Option<f64>) {
        self.rate = rate;
    }

    /// The values of all variables at one share of the step.
    pub fn sample(&self, share: f64, values: &mut [f64]) {
        for (variable, value) in values.iter_mut().enumerate() {
            *value = self.value(variable, share * self.length);
        }
    }

    /// `H` times the rate of every variable of motion at the end of the step.
    pub fn sample_rates(&self, rates: &mut [f64]) {
        for (variable, rate) in rates.iter_mut().enumerate() {
            if self.kinds[variable] == Kind::Motion {
                *rate = self.values[self.unknowns.of(variable)][1];
            }
        }
    }

    fn has_acceleration(&self) -> bool {
        self.shapes.family.known_at_start() > 2
    }

    /// Values of all variables at the present macro point.
    pub fn starts(&self) -> impl Iterator<Item = f64> {
        self.starts.iter().map(|start| start[0])
    }

    fn degree_of(&self, variable: usize) -> usize {
        let own = self.shapes.degree(self.kinds[variable]);
        own.unwrap_or_else(|| self.history.degree(variable).max(1))
    }

    /// Whether a variable is a polynomial through past values.
    fn is_through_past(&self, variable: usize) -> bool {
        self.shapes.of(self.kinds[variable]).is_empty()
    }
}

impl Curves for HermiteCurves {
    fn length(&self) -> f64 {
        self.length
    }

    fn attitudes(&self) -> &[UnitQuaternion<f64>] {
        &self.attitudes
    }

    fn value(&self, variable: usize, tau: f64) -> f64 {
        if self.is_through_past(variable) {
            let end = self.values[self.unknowns.of(variable).start];
            return self.history.value_through(variable, Some(end), self.length, tau);
        }
        self.curves[variable].value(tau / self.length)
    }

    fn signal(&self, combination: &[(usize, f64)], signal: &mut Signal) {
        signal.nodes.clear();
        signal.values.clear();
        let degree = combination
            .first()
            .map_or(0, |&(first, _)| self.degree_of(first));
        for node in 0..=degree {
            let tau = self.length * node as f64 / degree as f64;
            let terms = combination.iter();
            let value = terms.map(|&(variable, factor)| factor * self.value(variable, tau));
            signal.nodes.push(tau);
            signal.values.push(value.sum());
        }
    }

    fn shape(&self, variable: usize, shape: usize) -> SharePolynomial {
        match self.shapes.of(self.kinds[variable]) {
            [] => self.history.end_shape(variable, self.length),
            _ => self.shapes.within(self.kinds[variable], shape, self.degree),
        }
    }
}
