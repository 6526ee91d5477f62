//! What the curves become over a step: predicted, changed, and what the next step starts from.

use nalgebra::Vector3;

use crate::methods::hermite::continuation::{continued, continued_degree};
use crate::methods::hermite::shapes::Kind;
use crate::signal::attitude::{attitude, rotation_of_change};
use crate::signal::{Curve, SharePolynomial, vector_at};

use super::HermiteCurves;

impl HermiteCurves {
    /// Predicts the curves over a step of length `length`: multipliers and signals go on as they did, motion by its jerk.
    pub fn predict(&mut self, length: f64) {
        self.length = length;
        let past_length = self.past_length;
        let degree = continued_degree(length / past_length, self.rate).min(self.degree);
        for variable in 0..self.kinds.len() {
            let ahead = |share: f64| 1.0 + share * length / past_length;
            let [p, v, a] = self.starts[variable];
            let jerk = self.jerks[variable] * length.powi(3);
            let (speed, bend) = (v * length, a * length * length);
            let past = || continued(&self.past[variable], degree);
            let kind = self.kinds[variable];
            let values = &mut self.values[self.unknowns.of(variable)];
            match kind {
                Kind::Multiplier => {
                    let past = past();
                    for (value, &share) in values.iter_mut().zip(self.unknowns.shares()) {
                        *value = past.value(ahead(share));
                    }
                }
                Kind::Motion => {
                    values.fill(0.0);
                    values[0] = p + speed + bend / 2.0 + jerk / 6.0;
                    values[1] = speed + bend + jerk / 2.0;
                }
                Kind::Signal if self.shapes.of(kind).is_empty() => {
                    values[0] = self
                        .history
                        .value(variable, Curve::Extrapolated, length, length);
                }
                Kind::Signal => {
                    values.fill(0.0);
                    let past = past();
                    let [middle, end] = [0.5, 1.0].map(|share| past.value(ahead(share)));
                    values[0] = end;
                    // The first part inside is a parabola that is 1/4 in the middle.
                    if let Some(bow) = values.get_mut(1) {
                        *bow = 4.0 * (middle - (p + end) / 2.0);
                    }
                }
            }
        }
        self.shape_curves();
    }

    /// Changes the unknowns.
    pub fn change(&mut self, change: &[f64]) {
        for (value, change) in self.values.iter_mut().zip(change) {
            *value += change;
        }
        self.shape_curves();
    }

    /// Makes the curves from the unknowns.
    pub(super) fn shape_curves(&mut self) {
        let has_acceleration = self.has_acceleration();
        for variable in 0..self.kinds.len() {
            let [p, v, a] = self.starts[variable];
            let (speed, bend) = (v * self.length, a * self.length * self.length);
            let values = &self.values[self.unknowns.of(variable)];
            let mut curve = SharePolynomial::default();
            match self.kinds[variable] {
                Kind::Multiplier => {
                    if let Some(held) = &self.shapes.held {
                        curve.add(p, held);
                    }
                    for (value, shape) in values.iter().zip(self.shapes.of(Kind::Multiplier)) {
                        curve.add(*value, shape);
                    }
                }
                Kind::Motion => {
                    let bend = if has_acceleration { bend } else { 0.0 };
                    curve = SharePolynomial::of(&[p, speed, bend / 2.0]);
                    let missing = [
                        values[0] - curve.value(1.0),
                        values[1] - curve.derivative(1.0),
                    ];
                    let inside = values[2..].iter().copied();
                    let missing = missing.into_iter().chain(inside);
                    for (missing, shape) in missing.zip(self.shapes.of(Kind::Motion)) {
                        curve.add(missing, shape);
                    }
                }
                Kind::Signal => {
                    curve = SharePolynomial::of(&[p]);
                    let missing = [values[0] - p].into_iter();
                    let missing = missing.chain(values[1..].iter().copied());
                    for (missing, shape) in missing.zip(self.shapes.of(Kind::Signal)) {
                        curve.add(missing, shape);
                    }
                }
            }
            self.curves[variable] = curve;
        }
    }

    /// Moves on to the end of the step, where all variables have the values `ends` and motion the second derivatives
    /// `accelerations`; those of rotation vectors are angular accelerations.
    pub fn move_on(&mut self, ends: &[f64], accelerations: &[f64]) {
        let has_acceleration = self.has_acceleration();
        for variable in 0..self.kinds.len() {
            if self.kinds[variable] == Kind::Motion {
                let speed = self.values[self.unknowns.of(variable)][1] / self.length;
                let [_, before_speed, before] = self.starts[variable];
                let now = match has_acceleration {
                    true => accelerations[variable],
                    false => (speed - before_speed) / self.length,
                };
                self.jerks[variable] = match has_acceleration {
                    true => (now - before) / self.length,
                    false => 0.0,
                };
                self.starts[variable] = [ends[variable], speed, now];
            } else {
                self.starts[variable] = [ends[variable], 0.0, 0.0];
            }
        }
        for (rotation, &first) in self.rotations.iter().enumerate() {
            let phi = vector_at(ends, first);
            let rate = Vector3::from_fn(|component, _| self.starts[first + component][1]);
            let omega = rotation_of_change(&phi, &rate);
            self.attitudes[rotation] = attitude(&self.attitudes[rotation], &phi);
            for component in 0..3 {
                let start = &mut self.starts[first + component];
                start[0] = 0.0;
                start[1] = omega[component];
            }
        }
        std::mem::swap(&mut self.past, &mut self.curves);
        if std::mem::take(&mut self.has_jumped) {
            for variable in self.are_lengths.len()..self.kinds.len() {
                self.past[variable] = SharePolynomial::of(&self.starts[variable][..1]);
                self.jerks[variable] = 0.0;
            }
        }
        self.past_length = self.length;
        self.has_past = true;
        self.history.push(self.length, ends);
    }
}
