//! Values of the coupling variables at past macro points.

use std::ops::Range;

use linchpin_proto::polynomial::Polynomial;
use linchpin_proto::v1::Signal;
use nalgebra::{UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::attitude::{attitude, quaternions, rotation_vector};
use super::interpolation_error::ErrorShares;
use super::share::SharePolynomial;

/// Highest degree `k` of the polynomials of coupling variables.
pub const MAX_DEGREE: usize = 3;

/// What the variables are.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Variables {
    /// Degree of the polynomial of each variable.
    pub degrees: Vec<usize>,
    /// First of the three variables of each rotation vector.
    pub rotations: Vec<usize>,
}

/// Values of coupling variables at the last macro points, newest first.
///
/// Times are relative to the present macro point `T_N`, so they do not lose digits as time goes on. Rotation vectors are
/// relative to the attitude at `T_N`; their past values are carried over to the new attitude with every step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct History {
    variables: Variables,
    highest: usize,
    times: Vec<f64>,
    values: Vec<Vec<f64>>,
    #[serde(with = "quaternions")]
    attitudes: Vec<UnitQuaternion<f64>>,
    /// For each variable the number of points since it has jumped; all points if it has not.
    smooth_points: Vec<usize>,
}

/// Which polynomial over the next step.
#[derive(Debug, Clone, Copy)]
pub enum Curve<'a> {
    /// Through `T_N, T_{N-1}, ...`: degree `min(k, N)`, S1 eq. (56).
    Extrapolated,
    /// Through these values of all variables at the end of the step and `T_N, ...`: degree `min(k, N + 1)`, S1 eq. (69). At
    /// the start it has one node more than the extrapolation: that keeps the order of the multipliers.
    Interpolated(&'a [f64]),
}

impl History {
    /// Variables that have the values `initial` at the first macro point; rotation vectors relative to `attitudes`.
    pub fn new(variables: Variables, initial: &[f64], attitudes: Vec<UnitQuaternion<f64>>) -> Self {
        Self::established(variables, 0.0, &[initial.to_vec()], attitudes)
    }

    /// Variables at several equidistant macro points, newest first: a history as it is after a start.
    ///
    /// `values[p][v]` is variable `v` at `T_N - p step`; points that no polynomial reaches are not looked at.
    pub fn established(
        variables: Variables,
        step: f64,
        values: &[Vec<f64>],
        attitudes: Vec<UnitQuaternion<f64>>,
    ) -> Self {
        let highest = variables.degrees.iter().copied().max().unwrap_or(0);
        let mut kept = Vec::with_capacity(highest + 1);
        kept.extend(values.iter().take(highest + 1).cloned());
        let mut times = Vec::with_capacity(highest + 1);
        times.extend((0..kept.len()).map(|point| -(point as f64) * step));
        Self {
            smooth_points: vec![kept.len(); variables.degrees.len()],
            variables,
            highest,
            times,
            values: kept,
            attitudes,
        }
    }

    /// Number of variables.
    pub fn variables(&self) -> usize {
        self.variables.degrees.len()
    }

    /// Values at the newest macro point.
    pub fn newest(&self) -> &[f64] {
        &self.values[0]
    }

    /// Attitudes at the newest macro point, to which rotation vectors are relative.
    pub fn attitudes(&self) -> &[UnitQuaternion<f64>] {
        &self.attitudes
    }

    /// Takes over the values of another history of the same variables, in memory that is already there.
    pub fn copy_from(&mut self, other: &Self) {
        self.times.clone_from(&other.times);
        self.values.clone_from(&other.values);
        self.attitudes.clone_from(&other.attitudes);
        self.variables.degrees.clone_from(&other.variables.degrees);
        self.smooth_points.clone_from(&other.smooth_points);
    }

    /// The first `variables` variables jump in the next step: their extrapolation holds the newest value, their interpolation the
    /// value at the end, and from there their degree grows as at the start.
    pub fn restart(&mut self, variables: Range<usize>) {
        self.smooth_points[variables].fill(0);
    }

    /// The polynomials of some variables have this degree from now on, at most the highest one with which the history began.
    pub fn set_degree(&mut self, variables: Range<usize>, degree: usize) {
        self.variables.degrees[variables].fill(degree.min(self.highest));
    }

    /// Degrees of the polynomials of all variables.
    pub fn degrees(&self) -> &[usize] {
        &self.variables.degrees
    }

    /// Number of points since a variable has jumped; all points if it has not.
    pub fn smooth_points(&self, variable: usize) -> usize {
        self.smooth_points[variable]
    }

    /// Whether the interpolation of a variable over the next step is a chord because it has no longer past.
    pub fn is_chord(&self, variable: usize) -> bool {
        self.times.len() == 1 && self.past_nodes(variable, true) == 1
    }

    /// Degree of the interpolation of a variable over the next step.
    pub fn interpolated_degree(&self, variable: usize) -> usize {
        self.past_nodes(variable, true)
    }

    /// Times of the macro points that the polynomials of the present degrees reach.
    pub fn reached_times(&self) -> &[f64] {
        let degrees = self.variables.degrees.iter();
        let most = degrees.max().map_or(0, |degree| degree + 1);
        &self.times[..most.min(self.times.len())]
    }

    /// What the difference between interpolation and extrapolation at the end of a step of this length tells of a variable.
    pub fn error_shares(&self, variable: usize, step: f64) -> ErrorShares {
        let extrapolated = self.past_nodes(variable, false);
        let interpolated = self.past_nodes(variable, true);
        ErrorShares::new(&self.times, extrapolated, interpolated, step)
    }

    /// The same for polynomials of another degree, which has one point more: by how much their extrapolation misses the value `end`, and
    /// what that tells. Responses to a change of the end value are those of the present interpolation.
    pub fn miss_of_degree(
        &self,
        variable: usize,
        degree: usize,
        end: f64,
        step: f64,
    ) -> (f64, ErrorShares) {
        let extrapolated = (degree + 1).min(self.times.len());
        let interpolated = self.past_nodes(variable, true);
        let shares = ErrorShares::new(&self.times, extrapolated, interpolated, step);
        let value = self.value_of_nodes(variable, extrapolated, None, step, step);
        (end - value, shares)
    }

    /// Moves on by one macro step of the given length; `values` belong to its end.
    pub fn push(&mut self, length: f64, values: &[f64]) {
        for time in &mut self.times {
            *time -= length;
        }
        let mut newest = if self.values.len() > self.highest {
            self.times.pop();
            self.values.pop().unwrap_or_default()
        } else {
            Vec::with_capacity(values.len())
        };
        newest.clear();
        newest.extend_from_slice(values);
        self.times.insert(0, 0.0);
        self.values.insert(0, newest);
        for points in &mut self.smooth_points {
            *points = (*points + 1).min(self.times.len());
        }
        for rotation in 0..self.variables.rotations.len() {
            self.move_reference(rotation);
        }
    }

    /// Makes the newest value of a rotation vector the attitude that all are relative to.
    fn move_reference(&mut self, rotation: usize) {
        let first = self.variables.rotations[rotation];
        let old = self.attitudes[rotation];
        let newest = attitude(&old, &vector_at(&self.values[0], first));
        let mut later = Vector3::zeros();
        for (point, values) in self.values.iter_mut().enumerate() {
            let mut phi = Vector3::zeros();
            if point > 0 {
                let past = attitude(&old, &vector_at(values, first));
                phi = rotation_vector(&newest, &past, &later);
            }
            values[first..first + 3].copy_from_slice(phi.as_slice());
            later = phi;
        }
        self.attitudes[rotation] = newest;
    }

    /// Number of past nodes of a variable's curve, and its value at the end of the step if that is a node.
    fn nodes(&self, variable: usize, curve: Curve<'_>) -> (usize, Option<f64>) {
        let end = match curve {
            Curve::Extrapolated => None,
            Curve::Interpolated(ends) => Some(ends[variable]),
        };
        (self.past_nodes(variable, end.is_some()), end)
    }

    fn past_nodes(&self, variable: usize, has_end: bool) -> usize {
        let most = self.variables.degrees[variable] + 1;
        match has_end {
            false => self.smooth_points[variable].clamp(1, most),
            true => self.smooth_points[variable].min(most - 1),
        }
    }

    /// Degree of the polynomial of a variable, which it has as soon as there are enough points.
    pub fn degree(&self, variable: usize) -> usize {
        self.variables.degrees[variable]
    }

    /// The signal of `sum_i factor_i variable_i`, all of one degree.
    pub fn signal(
        &self,
        combination: &[(usize, f64)],
        curve: Curve<'_>,
        step: f64,
        signal: &mut Signal,
    ) {
        signal.nodes.clear();
        signal.values.clear();
        let leading = combination.first().map_or(0, |&(variable, _)| variable);
        let (past, _) = self.nodes(leading, curve);
        if let Curve::Interpolated(ends) = curve {
            signal.nodes.push(step);
            signal.values.push(combine(combination, ends));
        }
        signal.nodes.extend_from_slice(&self.times[..past]);
        let values = self.values[..past].iter();
        signal
            .values
            .extend(values.map(|values| combine(combination, values)));
    }

    /// Value of one variable's curve at `tau` after the present macro point; `step` is the length of the step.
    ///
    /// Not a number if the history is not finite; that is found when the multipliers are checked.
    pub fn value(&self, variable: usize, curve: Curve<'_>, step: f64, tau: f64) -> f64 {
        let (_, end) = self.nodes(variable, curve);
        self.value_through(variable, end, step, tau)
    }

    /// Value at `tau` of one variable's interpolation through the end value `end`, or of its extrapolation.
    pub fn value_through(&self, variable: usize, end: Option<f64>, step: f64, tau: f64) -> f64 {
        let past = self.past_nodes(variable, end.is_some());
        self.value_of_nodes(variable, past, end, step, tau)
    }

    fn value_of_nodes(
        &self,
        variable: usize,
        past: usize,
        end: Option<f64>,
        step: f64,
        tau: f64,
    ) -> f64 {
        let (mut nodes, mut values) = ([0.0; MAX_DEGREE + 1], [0.0; MAX_DEGREE + 1]);
        let mut len = 0;
        if let Some(end) = end {
            (nodes[0], values[0]) = (step, end);
            len = 1;
        }
        for (time, past) in self.times[..past].iter().zip(&self.values) {
            (nodes[len], values[len]) = (*time, past[variable]);
            len += 1;
        }
        Polynomial::through(&nodes[..len], &values[..len])
            .map_or(f64::NAN, |polynomial| polynomial.value(tau))
    }

    /// The polynomial of a variable's interpolation that is 1 at the end of the step and 0 at its other nodes.
    pub fn end_shape(&self, variable: usize, step: f64) -> SharePolynomial {
        let past = self.times[..self.past_nodes(variable, true)].iter();
        SharePolynomial::with_roots(past.map(|time| time / step), 1.0)
    }
}

/// Three values in a row as a vector.
pub fn vector_at(values: &[f64], first: usize) -> Vector3<f64> {
    Vector3::new(values[first], values[first + 1], values[first + 2])
}

/// `sum_i factor_i values_i`
pub fn combine(combination: &[(usize, f64)], values: &[f64]) -> f64 {
    combination
        .iter()
        .map(|&(variable, factor)| factor * values[variable])
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIRST: [(usize, f64); 1] = [(0, 1.0)];

    fn of_degrees(degrees: &[usize]) -> Variables {
        Variables {
            degrees: degrees.to_vec(),
            rotations: Vec::new(),
        }
    }

    fn value_at(signal: &Signal, tau: f64) -> f64 {
        Polynomial::from_signal(signal).unwrap().value(tau)
    }

    #[test]
    fn degrees_grow_at_the_start() {
        let mut history = History::new(of_degrees(&[2]), &[1.0], Vec::new());
        let mut signal = Signal::default();
        let mut nodes = Vec::new();
        for n in 0..4 {
            history.signal(&FIRST, Curve::Extrapolated, 0.1, &mut signal);
            let extrapolation = signal.nodes.len();
            history.signal(&FIRST, Curve::Interpolated(&[0.0]), 0.1, &mut signal);
            nodes.push((extrapolation, signal.nodes.len()));
            history.push(0.1, &[n as f64]);
        }
        assert_eq!(nodes, [(1, 2), (2, 3), (3, 3), (3, 3)]);
    }

    #[test]
    fn constant_interpolation_holds_the_end_value() {
        let history = History::new(of_degrees(&[0]), &[1.0], Vec::new());
        let mut signal = Signal::default();
        history.signal(&FIRST, Curve::Interpolated(&[7.0]), 0.1, &mut signal);
        assert_eq!(value_at(&signal, 0.03), 7.0);
        assert_eq!(history.end_shape(0, 0.1).value(0.3), 1.0);
    }

    #[test]
    fn a_parabola_over_unequal_steps_is_continued_exactly() {
        let parabola = |t: f64| 1.0 + 2.0 * t - 3.0 * t * t;
        let mut history = History::new(of_degrees(&[0, 2]), &[0.0, parabola(0.0)], Vec::new());
        let mut t = 0.0;
        for length in [0.1, 0.25, 0.05] {
            t += length;
            history.push(length, &[t, parabola(t)]);
        }
        let mut signal = Signal::default();
        history.signal(&[(1, 2.0)], Curve::Extrapolated, 0.3, &mut signal);
        assert!((value_at(&signal, 0.3) - 2.0 * parabola(t + 0.3)).abs() < 1e-13);
        let value = history.value(1, Curve::Extrapolated, 0.3, 0.2);
        assert!((value - parabola(t + 0.2)).abs() < 1e-13);
        assert_eq!(history.value(0, Curve::Extrapolated, 0.3, 0.2), t);
        let ends = [0.0, parabola(t + 0.3)];
        let curve = Curve::Interpolated(&ends);
        history.signal(&[(1, 1.0)], curve, 0.3, &mut signal);
        assert!((value_at(&signal, 0.2) - parabola(t + 0.2)).abs() < 1e-13);
        assert!((history.value(1, curve, 0.3, 0.2) - parabola(t + 0.2)).abs() < 1e-13);
        let raised = [0.0, ends[1] + 1.0];
        let shape = history.value(1, Curve::Interpolated(&raised), 0.3, 0.2) - parabola(t + 0.2);
        assert!((history.end_shape(1, 0.3).value(0.2 / 0.3) - shape).abs() < 1e-13);
    }

    /// A body that turns about a fixed axis at a constant rate, through many turns.
    #[test]
    fn a_steady_turn_is_continued_through_any_attitude() {
        let variables = Variables {
            degrees: vec![2; 4],
            rotations: vec![1],
        };
        let start = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -1.0, 2.0));
        let omega = Vector3::new(2.0, -1.0, 1.5);
        let mut history = History::new(variables, &[0.0; 4], vec![start]);
        let mut t = 0.0;
        for step in [0.4, 0.7, 0.5].into_iter().cycle().take(40) {
            t += step;
            let phi = omega * step;
            history.push(step, &[0.0, phi.x, phi.y, phi.z]);
            let expected = attitude(&start, &(omega * t));
            assert!(history.attitudes()[0].angle_to(&expected) < 1e-12);
        }
        for (component, expected) in (omega * 0.6).iter().enumerate() {
            let found = history.value(1 + component, Curve::Extrapolated, 0.6, 0.6);
            assert!((found - expected).abs() < 1e-11, "{found} {expected}");
        }
    }
}
