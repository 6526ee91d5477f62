//! Coupling variables over macro time: the values at past macro points and the polynomials through them.

use linchpin_proto::polynomial::Polynomial;
use linchpin_proto::v1::Signal;

/// Highest degree `k` of the polynomials of coupling variables.
pub const MAX_DEGREE: usize = 3;

/// Values of coupling variables at the last macro points, newest first.
///
/// Times are relative to the present macro point `T_N`, so they do not lose digits as time goes on.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    degree: usize,
    times: Vec<f64>,
    values: Vec<Vec<f64>>,
}

impl History {
    /// Variables that have the value `initial` at the first macro point; polynomials of degree at most `degree`.
    pub fn new(degree: usize, initial: &[f64]) -> Self {
        let mut history = Self {
            degree,
            times: vec![0.0],
            values: vec![initial.to_vec()],
        };
        history.reserve();
        history
    }

    fn reserve(&mut self) {
        self.times.reserve(self.degree + 1);
        self.values.reserve(self.degree + 1);
    }

    /// Variables at several equidistant macro points, newest first: a history as it is after a start.
    ///
    /// `values[p][v]` is variable `v` at `T_N - p step`; more than `degree + 1` points are not looked at.
    pub fn established(degree: usize, step: f64, values: &[Vec<f64>]) -> Self {
        let values: Vec<_> = values.iter().take(degree + 1).cloned().collect();
        let times = (0..values.len())
            .map(|point| -(point as f64) * step)
            .collect();
        Self {
            degree,
            times,
            values,
        }
    }

    /// Number of variables.
    pub fn variables(&self) -> usize {
        self.values.first().map_or(0, Vec::len)
    }

    /// Values at the newest macro point.
    pub fn newest(&self) -> &[f64] {
        &self.values[0]
    }

    /// Moves on by one macro step of the given length; `values` belong to its end.
    pub fn push(&mut self, length: f64, values: &[f64]) {
        for time in &mut self.times {
            *time -= length;
        }
        let mut newest = if self.values.len() > self.degree {
            self.times.pop();
            self.values.pop().unwrap_or_default()
        } else {
            Vec::new()
        };
        newest.clear();
        newest.extend_from_slice(values);
        self.times.insert(0, 0.0);
        self.values.insert(0, newest);
    }

    /// Number of nodes of the extrapolation through `T_N, T_{N-1}, ...`: degree `min(k, N)`, S1 eq. (56).
    fn extrapolation_nodes(&self) -> usize {
        self.times.len().min(self.degree + 1)
    }

    /// Number of nodes of the interpolation through `T_{N+1}, T_N, ...`: degree `min(k, N + 1)`, S1 eq. (69).
    /// At the start it has one node more than the extrapolation: that keeps the order of the multipliers.
    fn interpolation_nodes(&self) -> usize {
        (self.times.len() + 1).min(self.degree + 1)
    }

    /// The extrapolated signal of the combination `sum_i factor_i variable_i`.
    pub fn extrapolate(&self, combination: &[(usize, f64)], signal: &mut Signal) {
        let nodes = self.extrapolation_nodes();
        signal.nodes.clear();
        signal.values.clear();
        signal.nodes.extend_from_slice(&self.times[..nodes]);
        let values = self.values[..nodes].iter();
        signal
            .values
            .extend(values.map(|values| combine(combination, values)));
    }

    /// Extrapolated value of one variable at `tau` after the present macro point.
    ///
    /// Not a number if the history is not finite; that is found when the multipliers are checked.
    pub fn extrapolated_value(&self, variable: usize, tau: f64) -> f64 {
        let nodes = self.extrapolation_nodes();
        let mut values = [0.0; MAX_DEGREE + 1];
        for (value, past) in values.iter_mut().zip(&self.values[..nodes]) {
            *value = past[variable];
        }
        Polynomial::through(&self.times[..nodes], &values[..nodes])
            .map_or(f64::NAN, |polynomial| polynomial.value(tau))
    }

    /// The interpolated signal of the combination whose value at the end of a step of length `step` is `end`.
    pub fn interpolate(
        &self,
        combination: &[(usize, f64)],
        step: f64,
        end: f64,
        signal: &mut Signal,
    ) {
        let past = self.interpolation_nodes() - 1;
        signal.nodes.clear();
        signal.values.clear();
        signal.nodes.push(step);
        signal.values.push(end);
        signal.nodes.extend_from_slice(&self.times[..past]);
        let values = self.values[..past].iter();
        signal
            .values
            .extend(values.map(|values| combine(combination, values)));
    }
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

    fn value_at(signal: &Signal, tau: f64) -> f64 {
        Polynomial::from_signal(signal).unwrap().value(tau)
    }

    #[test]
    fn degrees_grow_at_the_start() {
        let mut history = History::new(2, &[1.0]);
        let mut signal = Signal::default();
        let mut nodes = Vec::new();
        for n in 0..4 {
            history.extrapolate(&FIRST, &mut signal);
            let extrapolation = signal.nodes.len();
            history.interpolate(&FIRST, 0.1, 0.0, &mut signal);
            nodes.push((extrapolation, signal.nodes.len()));
            history.push(0.1, &[n as f64]);
        }
        assert_eq!(nodes, [(1, 2), (2, 3), (3, 3), (3, 3)]);
    }

    #[test]
    fn constant_interpolation_holds_the_end_value() {
        let history = History::new(0, &[1.0]);
        let mut signal = Signal::default();
        history.interpolate(&FIRST, 0.1, 7.0, &mut signal);
        assert_eq!(value_at(&signal, 0.03), 7.0);
    }

    #[test]
    fn a_parabola_over_unequal_steps_is_continued_exactly() {
        let parabola = |t: f64| 1.0 + 2.0 * t - 3.0 * t * t;
        let mut history = History::new(2, &[parabola(0.0)]);
        let mut t = 0.0;
        for length in [0.1, 0.25, 0.05] {
            t += length;
            history.push(length, &[parabola(t)]);
        }
        let mut signal = Signal::default();
        history.extrapolate(&[(0, 2.0)], &mut signal);
        assert!((value_at(&signal, 0.3) - 2.0 * parabola(t + 0.3)).abs() < 1e-13);
        assert!((history.extrapolated_value(0, 0.3) - parabola(t + 0.3)).abs() < 1e-13);
        history.interpolate(&FIRST, 0.3, parabola(t + 0.3), &mut signal);
        assert!((value_at(&signal, 0.2) - parabola(t + 0.2)).abs() < 1e-13);
    }
}
