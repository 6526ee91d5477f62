use super::axis::Axis;

/// A place as shares of both axes.
type Place = (f64, f64);

/// What axes show of the straight lines between points, in shares of the axes. A point that an axis cannot hold
/// breaks the line.
pub(super) fn clipped(points: &[(f64, f64)], x: &Axis, y: &Axis) -> Vec<Vec<Place>> {
    let place = |&(a, b): &(f64, f64)| {
        let is_held = x.holds(a) && y.holds(b);
        is_held.then(|| (x.position(a), y.position(b)))
    };
    let mut runs: Vec<Vec<Place>> = Vec::new();
    for pair in points.windows(2) {
        let [Some(from), Some(to)] = [place(&pair[0]), place(&pair[1])] else {
            continue;
        };
        let Some((from, to)) = inside(from, to) else {
            continue;
        };
        match runs.last_mut() {
            Some(run) if run.last() == Some(&from) => run.push(to),
            _ => runs.push(vec![from, to]),
        }
    }
    runs
}

/// The part of a line within the unit square (Liang & Barsky 1984).
fn inside(from: Place, to: Place) -> Option<(Place, Place)> {
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for (start, end) in [(from.0, to.0), (from.1, to.1)] {
        let length = end - start;
        if length == 0.0 {
            if !(0.0..=1.0).contains(&start) {
                return None;
            }
            continue;
        }
        let (one, other) = (-start / length, (1.0 - start) / length);
        first = first.max(one.min(other));
        last = last.min(one.max(other));
    }
    let at = |share: f64| {
        (
            from.0 + share * (to.0 - from.0),
            from.1 + share * (to.1 - from.1),
        )
    };
    let start = if first == 0.0 { from } else { at(first) };
    let end = if last == 1.0 { to } else { at(last) };
    (first < last).then_some((start, end))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::scale::Scale;

    fn axes() -> (Axis, Axis) {
        (
            Axis::horizontal((Scale::Logarithmic, Some((-1.0, 1.0))), 1000),
            Axis::vertical((Scale::Linear, Some((0.0, 2.0))), 1000),
        )
    }

    #[test]
    fn a_curve_ends_where_it_leaves_the_panel_and_comes_back() {
        let (x, y) = axes();
        let points = [(0.1, 1.0), (1.0, 3.0), (10.0, 1.0), (100.0, 1.0)];
        let runs = clipped(&points, &x, &y);
        let expected = [
            [(0.0, 0.5), (0.25, 1.0)].to_vec(),
            [(0.75, 1.0), (1.0, 0.5)].to_vec(),
        ];
        assert_eq!(runs, expected);
    }

    #[test]
    fn what_is_inside_stays_one_line() {
        let (x, y) = axes();
        let points = [(0.1, 0.0), (1.0, 1.0), (10.0, 2.0)];
        assert_eq!(
            clipped(&points, &x, &y),
            [[(0.0, 0.0), (0.5, 0.5), (1.0, 1.0)]]
        );
    }

    #[test]
    fn gaps_and_places_outside_are_left_out() {
        let (x, y) = axes();
        let gap = [(0.1, 1.0), (1.0, f64::NAN), (2.0, 1.0), (-1.0, 1.0)];
        assert!(clipped(&gap, &x, &y).is_empty());
        let above = [(0.1, 5.0), (10.0, 5.0)];
        assert!(clipped(&above, &x, &y).is_empty());
    }
}
