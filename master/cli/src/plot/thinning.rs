use super::axis::Axis;

/// Points of a curve that are joined by a line.
pub(super) type Run = Vec<(f64, f64)>;

/// The curve as unbroken runs with at most four points for each of `columns` equal intervals of the x axis: the
/// first, the lowest, the highest and the last. With one column for each pixel the picture is that of all points.
///
/// A point that an axis does not hold breaks the line, unless the line goes on within the same column.
pub(super) fn thinned(
    points: impl Iterator<Item = (f64, f64)>,
    x: &Axis,
    y: &Axis,
    columns: usize,
) -> Vec<Run> {
    let mut runs = Vec::new();
    let mut run = Run::new();
    let mut column: Option<Column> = None;
    let mut interrupted = false;
    for point in points {
        if !(x.holds(point.0) && y.holds(point.1)) {
            interrupted = true;
            continue;
        }
        let place = (x.position(point.0) * columns as f64) as usize;
        match &mut column {
            Some(open) if open.place == place => open.extend(point),
            _ => {
                run.extend(
                    column
                        .replace(Column::starting(place, point))
                        .into_iter()
                        .flat_map(Column::extremes),
                );
                if interrupted && !run.is_empty() {
                    runs.push(std::mem::take(&mut run));
                }
            }
        }
        interrupted = false;
    }
    run.extend(column.into_iter().flat_map(Column::extremes));
    runs.push(run);
    runs.retain(|run| !run.is_empty());
    runs
}

/// The remarkable points of one column, each with its index in the column.
struct Column {
    place: usize,
    count: usize,
    first: (f64, f64),
    lowest: (usize, (f64, f64)),
    highest: (usize, (f64, f64)),
    last: (f64, f64),
}

impl Column {
    fn starting(place: usize, point: (f64, f64)) -> Self {
        Self {
            place,
            count: 1,
            first: point,
            lowest: (0, point),
            highest: (0, point),
            last: point,
        }
    }

    fn extend(&mut self, point: (f64, f64)) {
        if point.1 < self.lowest.1.1 {
            self.lowest = (self.count, point);
        }
        if point.1 > self.highest.1.1 {
            self.highest = (self.count, point);
        }
        self.last = point;
        self.count += 1;
    }

    fn extremes(self) -> impl Iterator<Item = (f64, f64)> {
        let mut points = [
            (0, self.first),
            self.lowest,
            self.highest,
            (self.count - 1, self.last),
        ];
        points.sort_by_key(|(index, _)| *index);
        let repeated = move |place: usize| place > 0 && points[place].0 == points[place - 1].0;
        (0..points.len())
            .filter(move |place| !repeated(*place))
            .map(move |place| points[place].1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::scale::Scale;

    fn axes(x: (f64, f64), y: (f64, f64)) -> (Axis, Axis) {
        (
            Axis::horizontal((Scale::Linear, Some(x)), 4000),
            Axis::vertical((Scale::Linear, Some(y)), 1000),
        )
    }

    #[test]
    fn few_points_stay_as_they_are() {
        let (x, y) = axes((0.0, 3.0), (-1.0, 1.0));
        let points = [(0.0, 0.5), (1.0, -0.5), (2.0, 0.25), (3.0, 1.0)];
        assert_eq!(thinned(points.into_iter(), &x, &y, 1000), [points.to_vec()]);
    }

    #[test]
    fn a_spike_of_one_point_in_a_million_survives() {
        let (x, y) = axes((0.0, 1.0), (-1.0, 9.0));
        let count = 1_000_003;
        let value = |i| {
            if i == 777_777 {
                8.875
            } else {
                (f64::from(i) * 0.1).sin()
            }
        };
        let points = (0..count).map(|i| (f64::from(i) / f64::from(count), value(i)));
        let runs = thinned(points, &x, &y, 1000);
        assert_eq!(runs.len(), 1);
        assert!(runs[0].len() <= 4000, "{}", runs[0].len());
        assert!(runs[0].iter().any(|point| point.1 == 8.875));
        assert!(runs[0].windows(2).all(|pair| pair[0].0 < pair[1].0));
    }

    #[test]
    fn a_gap_wider_than_a_column_breaks_the_line() {
        let (x, y) = axes((0.0, 10.0), (0.0, 1.0));
        let points = (0..=10).map(|i| {
            (
                f64::from(i),
                if (4..=6).contains(&i) { f64::NAN } else { 0.5 },
            )
        });
        let runs = thinned(points, &x, &y, 100);
        assert_eq!(runs.iter().map(Vec::len).collect::<Vec<_>>(), [4, 4]);
    }

    #[test]
    fn gaps_within_a_column_do_not_multiply_the_runs() {
        let (x, y) = axes((0.0, 1.0), (0.0, 1.0));
        let points = (0..100_000).map(|i| {
            (
                f64::from(i) / 1e5,
                if i % 2 == 0 { 0.5 } else { f64::INFINITY },
            )
        });
        let runs = thinned(points, &x, &y, 50);
        assert!(runs.len() <= 50);
    }
}
