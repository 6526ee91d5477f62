//! Marked times, such as those of impacts: thin lines behind the curves.

use plotters::prelude::*;
use plotters::style::RGBColor;

use super::axis::Axis;
use super::canvas::{Drawn, Surface};
use super::legend::Key;
use super::panel::Panel;
use super::style::{Marker, stroke, units};

/// What happens at marked times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkKind {
    /// Bodies impact.
    Impact,
    /// A macro step that ends there was repeated with a shorter one.
    Rejection,
}

/// Times at which something happens.
#[derive(Clone, Debug)]
pub struct TimeMarks {
    /// What.
    pub kind: MarkKind,
    /// The times, in any order.
    pub t: Vec<f64>,
}

impl MarkKind {
    /// Name in the legend.
    fn name(self) -> &'static str {
        match self {
            Self::Impact => "impact",
            Self::Rejection => "step repeated",
        }
    }

    /// Colours of lines and bands: fainter than all curves, and other hues than the grid.
    fn colours(self) -> [RGBColor; 2] {
        match self {
            Self::Impact => [RGBColor(238, 178, 150), RGBColor(252, 234, 225)],
            Self::Rejection => [RGBColor(190, 178, 226), RGBColor(236, 232, 248)],
        }
    }
}

const LINE_WIDTH: f64 = 1.0;

/// Marks closer than this, in pixels, are a band; lines so close would cover the panel.
const CLOSE: f64 = 5.0;

impl TimeMarks {
    /// What stands for them in a legend, if one of them has a place on the axis.
    pub(super) fn entry(&self, time: &Axis) -> Option<(Key, String)> {
        let key = Key {
            marker: Some(Marker::Bar),
            colour: self.kind.colours()[0],
            line: None,
        };
        let is_seen = self.t.iter().any(|t| is_on(time, *t));
        is_seen.then(|| (key, self.kind.name().to_owned()))
    }

    /// Draws them over the whole height of a panel: alone a line, those close together a pale band between two lines.
    pub(super) fn draw<DB: Surface>(&self, inside: &Panel<DB>) -> Drawn<DB> {
        let [line_colour, band_colour] = self.kind.colours();
        let seen = self.t.iter().filter(|t| is_on(&inside.x, **t));
        let places = seen.map(|t| inside.at(inside.x.position(*t), 0.0).0);
        for (first, last) in bands(places.collect()) {
            let (above, below) = ((first, 0), (last, inside.height));
            if first < last {
                let band = Rectangle::new([above, below], band_colour.filled());
                inside.area.draw(&band)?;
            }
            for x in [first, last] {
                let line = [(x, 0), (x, inside.height)];
                DB::polyline(&inside.area, &line, stroke(line_colour, LINE_WIDTH))?;
                if first == last {
                    break;
                }
            }
        }
        Ok(())
    }
}

fn is_on(axis: &Axis, t: f64) -> bool {
    axis.holds(t) && (0.0..=1.0).contains(&axis.position(t))
}

/// First and last of every group of places that are close together.
fn bands(mut places: Vec<i32>) -> Vec<(i32, i32)> {
    places.sort_unstable();
    let mut bands: Vec<(i32, i32)> = Vec::new();
    for place in places {
        match bands.last_mut() {
            Some((_, last)) if place - *last < units(CLOSE) => *last = place,
            _ => bands.push((place, place)),
        }
    }
    bands
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_close_together_are_one_band() {
        let close = units(CLOSE) - 1;
        let places = vec![400, 0, close, 2 * close, 400];
        assert_eq!(bands(places), [(0, 2 * close), (400, 400)]);
        assert_eq!(bands(Vec::new()), []);
    }
}
