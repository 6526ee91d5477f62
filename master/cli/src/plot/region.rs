//! Lines and named points over a map.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::{Drawn, Surface};
use super::clip::clipped;
use super::legend::Key;
use super::panel::Panel;
use super::style::{LABEL_TEXT, Marker, stroke, text, units};

/// A line over a map.
#[derive(Clone, Debug)]
pub struct RegionLine {
    /// Name in the legend.
    pub name: String,
    /// Whether it is a row of dots.
    pub is_dotted: bool,
    /// Corners; what is outside of the picture is left out.
    pub points: Vec<(f64, f64)>,
}

/// A point of a map with its name beside it.
#[derive(Clone, Debug)]
pub struct NamedPoint {
    /// Its name.
    pub name: String,
    /// Its place.
    pub place: (f64, f64),
}

const LINE_WIDTH: f64 = 2.5;
const DOT_RADIUS: f64 = 2.5;
const DOT_DISTANCE: f64 = 11.0;
const POINT_RADIUS: f64 = 7.0;
const NAME_GAP: f64 = 12.0;

impl RegionLine {
    /// Its entry in the legend.
    pub(super) fn entry(&self) -> (Key, String) {
        let key = Key {
            marker: self.is_dotted.then_some(Marker::Disc),
            colour: BLACK,
            line: (!self.is_dotted).then_some(LINE_WIDTH),
        };
        (key, self.name.clone())
    }
}

pub(super) fn draw_line<DB: Surface>(inside: &Panel<DB>, line: &RegionLine) -> Drawn<DB> {
    for run in clipped(&line.points, &inside.x, &inside.y) {
        let corners: Vec<(i32, i32)> = run.into_iter().map(|(x, y)| inside.at(x, y)).collect();
        if !line.is_dotted {
            DB::polyline(&inside.area, &corners, stroke(BLACK, LINE_WIDTH))?;
            continue;
        }
        for centre in dots(&corners, f64::from(units(DOT_DISTANCE))) {
            let dot = Circle::new(centre, units(DOT_RADIUS), BLACK.filled());
            inside.area.draw(&dot)?;
        }
    }
    Ok(())
}

/// Places at about equal distances along straight lines, their ends among them.
fn dots(corners: &[(i32, i32)], distance: f64) -> Vec<(i32, i32)> {
    let mut dots = Vec::new();
    for pair in corners.windows(2) {
        let (x, y) = (f64::from(pair[0].0), f64::from(pair[0].1));
        let (dx, dy) = (f64::from(pair[1].0) - x, f64::from(pair[1].1) - y);
        let count = (dx.hypot(dy) / distance).round().max(1.0) as i32;
        dots.extend((0..=count).map(|i| {
            let share = f64::from(i) / f64::from(count);
            (
                (x + share * dx).round() as i32,
                (y + share * dy).round() as i32,
            )
        }));
    }
    dots
}

pub(super) fn draw_point<DB: Surface>(inside: &Panel<DB>, point: &NamedPoint) -> Drawn<DB> {
    let (x, y) = point.place;
    let is_inside = |share: f64| (0.0..=1.0).contains(&share);
    if !(is_inside(inside.x.position(x)) && is_inside(inside.y.position(y))) {
        return Ok(());
    }
    let centre = inside.place(point.place);
    let ground = Circle::new(centre, units(POINT_RADIUS), WHITE.filled());
    inside.area.draw(&ground)?;
    Marker::Ring.draw(&inside.area, centre, units(POINT_RADIUS), BLACK)?;
    let style = text(LABEL_TEXT, BLACK, HPos::Left, VPos::Bottom);
    let gap = units(NAME_GAP);
    let at = (centre.0 + gap, centre.1 - gap / 2);
    inside.area.draw_text(&point.name, &style, at)
}
