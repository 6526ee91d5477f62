//! The largest difference of every column of two tables.
//!
//! Rows at equal times are compared as they are. Otherwise the rows of the table that has fewer of them in the common time are
//! compared with the other table, whose values between its rows are those of straight lines. What such a line misses, `y''/2 (t - t0)
//! (t1 - t)` with the second derivative by the divided differences of three neighbouring rows, is told beside the difference.

use std::cmp::Ordering;

use linchpin_master::results::Quantity;
use serde::Serialize;

use super::ComparisonError;
use super::table::Table;

/// How the rows of two tables were brought together.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Grid {
    /// Whether both have the same times, bit by bit.
    pub is_common: bool,
    /// Whether both begin and end at the same times.
    pub is_whole: bool,
    /// First time that was compared (s).
    pub from: f64,
    /// Last time that was compared (s).
    pub to: f64,
    /// Number of times that were compared.
    pub rows: usize,
}

/// A column of two tables.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Compared {
    /// Its name.
    pub name: String,
    /// Its unit; both units where they differ.
    pub unit: String,
    /// What kind of number it is.
    pub quantity: Quantity,
    /// Largest difference, in the unit.
    pub largest: f64,
    /// The same as a share of the size; 0 for no difference.
    pub relative: f64,
    /// Time of the largest difference (s).
    pub t: f64,
    /// Largest magnitude of both, in the unit.
    pub size: f64,
    /// What straight lines between rows are estimated to miss at most, in the unit; 0 where rows were compared as they are.
    pub interpolation: f64,
}

impl Compared {
    /// Whether the difference is above `tolerance` times the size.
    pub fn differs(&self, tolerance: f64) -> bool {
        self.largest > 0.0 && self.relative > tolerance
    }

    /// Whether it tells of the coupling and not of what is coupled.
    fn is_of_coupling(&self) -> bool {
        matches!(
            self.quantity,
            Quantity::Residual
                | Quantity::Step
                | Quantity::Degree
                | Quantity::ErrorEstimate
                | Quantity::Rejections
        )
    }
}

/// Compares all columns that both tables have but the time, the largest difference relative to its size first; what tells of the
/// coupling comes last, where nothing but the step may differ by all of its size.
///
/// # Errors
/// [`ComparisonError::Apart`]
pub fn compare(a: &Table, b: &Table) -> Result<(Grid, Vec<Compared>), ComparisonError> {
    let ((a0, a1), (b0, b1)) = (a.span(), b.span());
    let (from, to) = (a0.max(b0), a1.min(b1));
    if from > to {
        return Err(ComparisonError::Apart {
            a: a.folder.clone(),
            b: b.folder.clone(),
            of_a: a.span(),
            of_b: b.span(),
        });
    }
    let inside = |own: &Table| {
        let first = own.times().partition_point(|t| *t < from);
        let end = own.times().partition_point(|t| *t <= to);
        first..end
    };
    let (of_a, of_b) = (inside(a), inside(b));
    let is_common = a.times()[of_a.clone()] == b.times()[of_b.clone()];
    let (coarse, fine, range) = match of_a.len() <= of_b.len() {
        true => (a, b, of_a),
        false => (b, a, of_b),
    };
    let grid = Grid {
        is_common,
        is_whole: (a0, a1) == (b0, b1),
        from,
        to,
        rows: range.len(),
    };
    let places = coarse.columns.iter().enumerate().skip(1);
    let places = places.filter_map(|(place, own)| Some((place, fine.place(own.name())?)));
    let mut compared: Vec<Compared> = places
        .map(|(of_coarse, of_fine)| {
            let points = range.clone().map(|row| {
                let t = coarse.times()[row];
                let (value, missed) = at(fine.times(), &fine.values[of_fine], t);
                (t, [coarse.values[of_coarse][row], value], missed)
            });
            let mut own = largest(points);
            own.name = coarse.columns[of_coarse].name().to_owned();
            let units = [coarse, fine].map(|table| {
                let place = if std::ptr::eq(table, coarse) {
                    of_coarse
                } else {
                    of_fine
                };
                table.columns[place].column.unit.as_str()
            });
            own.quantity = coarse.columns[of_coarse].quantity();
            own.unit = match units {
                [one, other] if one == other => one.to_owned(),
                [one, other] => format!("{one} | {other}"),
            };
            own
        })
        .collect();
    compared.sort_by(|one, other| {
        let order = other.relative.partial_cmp(&one.relative);
        let order = order.unwrap_or(Ordering::Equal);
        one.is_of_coupling()
            .cmp(&other.is_of_coupling())
            .then(order)
    });
    Ok((grid, compared))
}

/// The largest of differences at times, with the size of all values and what interpolation misses.
fn largest(points: impl Iterator<Item = (f64, [f64; 2], f64)>) -> Compared {
    let mut own = Compared {
        name: String::new(),
        unit: String::new(),
        quantity: Quantity::Output,
        largest: 0.0,
        relative: 0.0,
        t: 0.0,
        size: 0.0,
        interpolation: 0.0,
    };
    let mut is_first = true;
    for (t, [one, other], missed) in points {
        let difference = difference(one, other);
        if is_first || difference > own.largest {
            (own.largest, own.t) = (difference, t);
        }
        is_first = false;
        for value in [one, other] {
            if value.is_finite() {
                own.size = own.size.max(value.abs());
            }
        }
        own.interpolation = own.interpolation.max(missed);
    }
    own.relative = match own.largest {
        0.0 => 0.0,
        largest => largest / own.size,
    };
    own
}

/// The magnitude of a difference; none between numbers of equal bits or two that are none, infinite where only one is a finite
/// number.
fn difference(one: f64, other: f64) -> f64 {
    if one == other || (one.is_nan() && other.is_nan()) {
        return 0.0;
    }
    let difference = (one - other).abs();
    if difference.is_nan() {
        f64::INFINITY
    } else {
        difference
    }
}

/// The value at a time between the first and the last of `times`, and about how much a straight line misses of it.
fn at(times: &[f64], values: &[f64], t: f64) -> (f64, f64) {
    let next = times.partition_point(|own| *own < t);
    if times.get(next) == Some(&t) {
        return (values[next], 0.0);
    }
    let last = next - 1;
    let (t0, t1) = (times[last], times[next]);
    let share = (t - t0) / (t1 - t0);
    let value = values[last] + share * (values[next] - values[last]);
    let slope = |i: usize| (values[i + 1] - values[i]) / (times[i + 1] - times[i]);
    let half_curvature = |middle: usize| {
        let (before, behind) = (middle - 1, middle + 1);
        let change = slope(middle) - slope(before);
        (change / (times[behind] - times[before])).abs()
    };
    let middles = [last, next].into_iter();
    let middles = middles.filter(|middle| (1..times.len() - 1).contains(middle));
    let curvature = middles.map(half_curvature).fold(0.0, f64::max);
    (value, curvature * (t - t0) * (t1 - t))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::ReportedColumn;
    use linchpin_master::results::Column;

    fn table(name: &str, times: &[f64], of: impl Fn(f64) -> f64) -> Table {
        let column = |name: &str, unit: &str| ReportedColumn {
            column: Column {
                name: name.into(),
                unit: unit.into(),
                description: String::new(),
                quantity: Quantity::Output,
                marker: None,
            },
            drawn: true,
        };
        Table {
            folder: name.into(),
            columns: vec![column("t", "s"), column("body.x", "m")],
            values: vec![times.to_vec(), times.iter().map(|t| of(*t)).collect()],
        }
    }

    fn equal_steps(end: f64, steps: u32) -> Vec<f64> {
        (0..=steps)
            .map(|i| end * f64::from(i) / f64::from(steps))
            .collect()
    }

    #[test]
    fn the_largest_difference_is_found_with_its_time_and_its_share() {
        let times = equal_steps(0.7, 70);
        let a = table("a", &times, |t| 3.0 - t);
        let b = table(
            "b",
            &times,
            |t| if t == times[41] { 2.0 - t } else { 3.0 - t },
        );
        let (grid, columns) = compare(&a, &b).unwrap();
        assert!(grid.is_common && grid.is_whole && grid.rows == 71);
        let own = &columns[0];
        assert_eq!(
            (own.name.as_str(), own.unit.as_str(), own.t),
            ("body.x", "m", times[41])
        );
        assert!((own.largest - 1.0).abs() < 1e-15 && own.size == 3.0);
        assert_eq!(own.relative, own.largest / 3.0);
        assert_eq!(own.interpolation, 0.0);
        assert!(own.differs(0.3) && !own.differs(0.34));
        assert!(!compare(&a, &a).unwrap().1[0].differs(0.0));
    }

    /// Of a parabola a straight line misses what is told, and no more.
    #[test]
    fn other_times_are_interpolated_and_what_that_misses_is_told() {
        let parabola = |t: f64| 2.5 * t * t - t + 0.3;
        let a = table("a", &equal_steps(1.1, 17), parabola);
        let b = table("b", &equal_steps(1.1, 40), parabola);
        for (one, other) in [(&a, &b), (&b, &a)] {
            let (grid, columns) = compare(one, other).unwrap();
            assert!(!grid.is_common && grid.is_whole && grid.rows == 18);
            let own = &columns[0];
            assert!(own.largest > 0.0);
            assert!((own.largest - own.interpolation).abs() < 1e-12, "{own:?}");
        }
        let line = |t: f64| 2.5 * t - 0.7;
        let (a, b) = (
            table("a", &equal_steps(1.1, 17), line),
            table("b", &equal_steps(1.1, 40), line),
        );
        assert!(compare(&a, &b).unwrap().1[0].largest < 1e-15 * 4.0);
    }

    #[test]
    fn only_common_times_are_compared() {
        let a = table("a", &equal_steps(1.0, 8), |t| t);
        let b = table("b", &equal_steps(0.5, 4), |t| t);
        let (grid, columns) = compare(&a, &b).unwrap();
        assert!(grid.is_common && !grid.is_whole);
        assert_eq!((grid.from, grid.to, grid.rows), (0.0, 0.5, 5));
        assert_eq!(columns[0].largest, 0.0);
        let later: Vec<f64> = equal_steps(1.0, 8).iter().map(|t| t + 3.0).collect();
        let error = compare(&a, &table("c", &later, |t| t)).unwrap_err();
        assert!(matches!(error, ComparisonError::Apart { .. }));
    }

    #[test]
    fn numbers_that_are_none_differ_from_those_that_are() {
        assert_eq!(difference(f64::NAN, f64::NAN), 0.0);
        assert_eq!(difference(f64::INFINITY, f64::INFINITY), 0.0);
        assert_eq!(difference(f64::NAN, 1.0), f64::INFINITY);
        assert_eq!(difference(f64::INFINITY, f64::NEG_INFINITY), f64::INFINITY);
        assert_eq!(difference(0.0, -0.0), 0.0);
    }
}
