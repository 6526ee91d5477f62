use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::{Drawn, Surface};
use super::style::{
    FRAME, LABEL_TEXT, Marker, curve_style, fitted, stroke, text, text_width, units,
};
use super::tiling::PICTURE_WIDTH;

/// What stands for a name in a legend.
#[derive(Clone, Copy)]
pub(super) struct Key {
    pub marker: Option<Marker>,
    pub colour: RGBColor,
    /// Width in pixels of the line through the place of the marker, if there is one.
    pub line: Option<f64>,
}

/// Names with their keys, in centred rows.
pub(super) struct Legend {
    rows: Vec<Vec<Entry>>,
}

struct Entry {
    key: Key,
    name: String,
    width: i32,
}

const ROW_HEIGHT: f64 = 34.0;
const KEY_WIDTH: f64 = 56.0;
const GAP: f64 = 32.0;
const MARKER_RADIUS: f64 = 6.0;

impl Legend {
    /// Breaks the entries into rows as wide as a picture.
    pub(super) fn new(entries: impl IntoIterator<Item = (Key, String)>) -> Self {
        Self::within(units(PICTURE_WIDTH), entries)
    }

    /// The same with rows of another width, in drawing units.
    pub(super) fn within(width: i32, entries: impl IntoIterator<Item = (Key, String)>) -> Self {
        let mut rows: Vec<Vec<Entry>> = Vec::new();
        let mut free = 0;
        for (key, name) in entries {
            let name = fitted(&name, LABEL_TEXT, width - units(KEY_WIDTH + GAP));
            let entry = Entry {
                key,
                width: units(KEY_WIDTH + GAP) + text_width(&name, LABEL_TEXT),
                name,
            };
            match rows.last_mut().filter(|_| entry.width <= free) {
                Some(row) => {
                    free -= entry.width;
                    row.push(entry);
                }
                None => {
                    free = width - entry.width;
                    rows.push(vec![entry]);
                }
            }
        }
        Self { rows }
    }

    /// One entry for each name, in the styles of the curves in this order.
    pub(super) fn of_curves(names: &[&str], line: f64) -> Self {
        Self::new(curve_keys(names, line))
    }

    /// Height in pixels.
    pub(super) fn height(&self) -> f64 {
        ROW_HEIGHT * self.rows.len() as f64
    }

    /// Draws the rows from the top of the area.
    pub(super) fn draw<DB: Surface>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let width = area.dim_in_pixel().0 as i32;
        for (index, row) in self.rows.iter().enumerate() {
            let y = units(ROW_HEIGHT * (index as f64 + 0.5));
            let mut x = (width - row.iter().map(|entry| entry.width).sum::<i32>() + units(GAP)) / 2;
            for entry in row {
                entry.draw(area, (x, y))?;
                x += entry.width;
            }
        }
        Ok(())
    }
}

/// Keys and names of the curves in this order.
pub(super) fn curve_keys<'a>(
    names: &'a [&str],
    line: f64,
) -> impl Iterator<Item = (Key, String)> + 'a {
    names.iter().enumerate().map(move |(index, name)| {
        let (colour, marker) = curve_style(index);
        let key = Key {
            marker: Some(marker),
            colour,
            line: Some(line),
        };
        (key, (*name).to_owned())
    })
}

/// Place of a name among those of a legend, and the style of its curve.
pub(super) fn style_of(name: &str, names: &[&str]) -> (Option<usize>, RGBColor, Marker) {
    let index = names.iter().position(|other| *other == name);
    let (colour, marker) = curve_style(index.unwrap_or(0));
    (index, colour, marker)
}

impl Entry {
    fn draw<DB: Surface>(&self, area: &DrawingArea<DB, Shift>, (x, y): (i32, i32)) -> Drawn<DB> {
        let name_at = x + units(KEY_WIDTH);
        let line_end = name_at - units(8.0);
        if let Some(width) = self.key.line {
            DB::polyline(
                area,
                &[(x, y), (line_end, y)],
                stroke(self.key.colour, width),
            )?;
        }
        let centre = match self.key.line {
            Some(_) => (x + line_end) / 2,
            None => line_end - units(MARKER_RADIUS + 4.0),
        };
        if let Some(marker) = self.key.marker {
            marker.draw(area, (centre, y), units(MARKER_RADIUS), self.key.colour)?;
        }
        area.draw_text(
            &self.name,
            &text(LABEL_TEXT, FRAME, HPos::Left, VPos::Center),
            (name_at, y),
        )
    }
}

/// The names without repetition, in the order in which they come; empty ones are left out.
pub(super) fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut kept = Vec::new();
    for name in names {
        if !(name.is_empty() || kept.contains(&name)) {
            kept.push(name);
        }
    }
    kept
}
