//! A run that others are compared with.

/// The macro points of a run, which need not be at equal distances.
pub struct Trajectory {
    t: Vec<f64>,
    /// Row after row; not a number where a column has no value.
    values: Vec<f64>,
    columns: usize,
    largest_step: f64,
}

/// Macro points of two grids are the same if they differ by less than this share of a step.
const SAME_POINT: f64 = 1e-6;

/// Points of the polynomial between macro points. For a motion of the angular frequency omega it is off by at most
/// (omega h)^8 / 940 of the amplitude, h being the distance of the points.
const NODES: usize = 8;

impl Trajectory {
    /// One of so many columns, without a macro point.
    pub fn new(columns: usize) -> Self {
        Self {
            t: Vec::new(),
            values: Vec::new(),
            columns,
            largest_step: 0.0,
        }
    }

    /// Takes a macro point.
    pub fn add(&mut self, t: f64, values: &[Option<f64>]) {
        if let Some(before) = self.t.last() {
            self.largest_step = self.largest_step.max(t - before);
        }
        self.t.push(t);
        let values = values.iter();
        self.values
            .extend(values.map(|value| value.unwrap_or(f64::NAN)));
    }

    /// Value at a macro point.
    pub fn at_point(&self, column: usize, t: f64) -> Option<f64> {
        let tolerance = SAME_POINT * self.largest_step;
        let place = self.t.partition_point(|&known| known < t - tolerance);
        let known = self.t.get(place)?;
        let is_common = (known - t).abs() <= tolerance;
        is_common.then(|| self.at(place, column))
    }

    /// Value at a macro point, or that of the polynomial through the nearest ones; `None` outside of the run.
    pub fn value(&self, column: usize, t: f64) -> Option<f64> {
        self.at_point(column, t)
            .or_else(|| self.interpolated(column, t))
    }

    /// Neville's scheme.
    fn interpolated(&self, column: usize, t: f64) -> Option<f64> {
        let after = self.t.partition_point(|&known| known < t);
        if after == 0 || after == self.t.len() {
            return None;
        }
        let nodes = NODES.min(self.t.len());
        let first = after.saturating_sub(nodes / 2).min(self.t.len() - nodes);
        let times = &self.t[first..first + nodes];
        let mut values: [f64; NODES] = std::array::from_fn(|place| match place < nodes {
            true => self.at(first + place, column),
            false => 0.0,
        });
        for reach in 1..nodes {
            for place in 0..nodes - reach {
                let (left, right) = (times[place], times[place + reach]);
                let weighted = (t - left) * values[place + 1] - (t - right) * values[place];
                values[place] = weighted / (right - left);
            }
        }
        Some(values[0])
    }

    fn at(&self, point: usize, column: usize) -> f64 {
        self.values[point * self.columns + column]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polynomial of degree 7 on unequal steps is met between the points; 0.3 is a point.
    #[test]
    fn between_points_it_is_a_polynomial() {
        let polynomial = |t: f64| 3.0 - t + 0.7 * t.powi(3) - 2.1 * t.powi(7);
        let t: Vec<f64> = (0..12)
            .map(|n| 0.1 * f64::from(n * n) / 3.0 + 0.3)
            .collect();
        let trajectory = Trajectory {
            values: t.iter().map(|t| polynomial(*t)).collect(),
            columns: 1,
            largest_step: 0.7,
            t,
        };
        assert_eq!(trajectory.at_point(0, 0.3), Some(polynomial(0.3)));
        assert_eq!(trajectory.at_point(0, 0.32), None);
        for t in [0.31, 0.4, 1.234, 3.0, 4.2] {
            let (found, exact) = (trajectory.value(0, t).unwrap(), polynomial(t));
            assert!(
                (found - exact).abs() < 1e-11 * (1.0 + exact.abs()),
                "{t}: {found} {exact}"
            );
        }
        assert_eq!(trajectory.value(0, 0.29), None);
        assert_eq!(trajectory.value(0, 4.4), None);
    }
}
