use super::canvas::{Drawn, Surface};
use super::panel::Panel;
use super::scale::extent;
use super::slope_label::{Label, Line};
use super::style::{REFERENCE, stroke};

const LINE_WIDTH: f64 = 1.5;

/// A curve is taken for one of this slope up to this difference.
const LIKENESS: f64 = 0.6;

/// Distance between a curve and its reference line, as a share of the panel's height.
const GAP: f64 = 0.035;

/// Draws a straight line for each slope just below the lowest curve that has about this slope, or through the upper
/// corner of the data if none has. Each is labelled "slope p" where there is most room.
pub(super) fn draw_slopes<DB: Surface>(
    panel: &Panel<DB>,
    curves: &[Vec<(f64, f64)>],
    slopes: &[f64],
) -> Drawn<DB> {
    let curves: Vec<Vec<(f64, f64)>> = curves.iter().map(|curve| shares(panel, curve)).collect();
    let aspect = panel.x.span() / panel.y.span();
    let line = |slope| reference_line(panel, &curves, slope * aspect, LIKENESS * aspect);
    let lines: Vec<(f64, Line)> = slopes
        .iter()
        .filter_map(|&slope| Some((slope, line(slope)?)))
        .collect();
    let mut taken: Vec<(i32, i32)> = curves
        .iter()
        .flat_map(|curve| sampled_curve(panel, curve))
        .collect();
    for (_, line) in &lines {
        DB::polyline(
            &panel.area,
            &[line.from, line.to],
            stroke(REFERENCE, LINE_WIDTH),
        )?;
        taken.extend(line.sampled());
    }
    for (slope, line) in &lines {
        let label = Label::new(format!("slope {slope}").replace('-', "−"));
        if let Some(centre) = label.freest_place(panel, line, &taken) {
            label.draw(panel, centre)?;
            taken.extend(label.corners(centre));
        }
    }
    Ok(())
}

/// The points of a curve as shares of the axes.
fn shares<DB: Surface>(panel: &Panel<DB>, curve: &[(f64, f64)]) -> Vec<(f64, f64)> {
    curve
        .iter()
        .map(|(x, y)| (panel.x.position(*x), panel.y.position(*y)))
        .collect()
}

/// The middle one of the rises between neighbouring points: a plateau at rounding level does not count.
fn typical_rise(curve: &[(f64, f64)]) -> Option<f64> {
    let rise = |pair: &[(f64, f64)]| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0);
    let mut rises: Vec<f64> = curve
        .windows(2)
        .map(rise)
        .filter(|rise| rise.is_finite())
        .collect();
    rises.sort_by(f64::total_cmp);
    rises.get(rises.len() / 2).copied()
}

/// The line of this rise for curves given in shares of the axes, cut at the edges of the panel.
fn reference_line<DB: Surface>(
    panel: &Panel<DB>,
    curves: &[Vec<(f64, f64)>],
    rise: f64,
    likeness: f64,
) -> Option<Line> {
    let at_zero = |curve: &[(f64, f64)]| curve.iter().map(|(x, y)| y - rise * x).reduce(f64::min);
    let alike = |curve: &&Vec<(f64, f64)>| {
        typical_rise(curve).is_some_and(|own| (own - rise).abs() <= likeness)
    };
    let lowest = curves
        .iter()
        .filter(alike)
        .filter_map(|curve| Some((at_zero(curve)?, curve)));
    match lowest.min_by(|one, other| one.0.total_cmp(&other.0)) {
        Some((offset, curve)) => cut(
            panel,
            rise,
            offset - GAP,
            extent(curve.iter().map(|point| point.0))?,
        ),
        None => {
            let (left, right) = extent(curves.iter().flatten().map(|point| point.0))?;
            let (_, top) = extent(curves.iter().flatten().map(|point| point.1))?;
            let corner = if rise < 0.0 { left } else { right };
            cut(panel, rise, top - rise * corner, (left, right))
        }
    }
}

/// The part of the line `y = offset + rise x` over the interval that lies inside the panel.
fn cut<DB: Surface>(
    panel: &Panel<DB>,
    rise: f64,
    offset: f64,
    (left, right): (f64, f64),
) -> Option<Line> {
    let y = |x: f64| offset + rise * x;
    let (mut from, mut to) = (left, right);
    if rise != 0.0 {
        let crossings = [-offset / rise, (1.0 - offset) / rise];
        from = from.max(crossings[0].min(crossings[1]));
        to = to.min(crossings[0].max(crossings[1]));
    }
    let visible = from < to && (0.0..=1.0).contains(&y((from + to) / 2.0));
    visible.then(|| Line {
        from: panel.at(from, y(from)),
        to: panel.at(to, y(to)),
    })
}

fn sampled_curve<DB: Surface>(panel: &Panel<DB>, curve: &[(f64, f64)]) -> Vec<(i32, i32)> {
    let places: Vec<(i32, i32)> = curve.iter().map(|(x, y)| panel.at(*x, *y)).collect();
    let segments = places.windows(2).flat_map(|pair| {
        Line {
            from: pair[0],
            to: pair[1],
        }
        .sampled()
        .collect::<Vec<_>>()
    });
    places
        .first()
        .copied()
        .into_iter()
        .chain(segments)
        .collect()
}
