use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::axis::Axis;
use super::canvas::{Drawn, Picture, Surface, embed_font, write};
use super::clip::clipped;
use super::error::PlotError;
use super::legend::{Legend, distinct};
use super::panel::{Axes, Panel, inner_height, inner_width, room_left};
use super::scale::{Scale, padded};
use super::spread::spread;
use super::style::{curve_style, stroke, units};
use super::tiling::{PICTURE_WIDTH, Tiling, check_number};

/// Curves in one or several panels, with a scale for each abscissa and a linear ordinate.
#[derive(Clone, Debug)]
pub struct CurvePlot {
    /// Panels, two in a row, at most 12.
    pub panels: Vec<CurvePanel>,
}

/// One panel of a [`CurvePlot`].
#[derive(Clone, Debug)]
pub struct CurvePanel {
    /// Title above the panel; an empty one takes no room.
    pub title: String,
    /// Label of the x axis, with its unit.
    pub x_label: String,
    /// Label of the y axis, with its unit.
    pub y_label: String,
    /// Scale of the x axis.
    pub x_scale: Scale,
    /// Range of the x axis, the first number less than the second; otherwise that of the points.
    pub x_range: Option<(f64, f64)>,
    /// Range of the y axis; otherwise that of the points within the x axis. Curves end where they leave it.
    pub y_range: Option<(f64, f64)>,
    /// Curves; equal names in several panels have equal colours and markers.
    pub curves: Vec<Curve>,
}

/// One curve of a [`CurvePanel`].
#[derive(Clone, Debug)]
pub struct Curve {
    /// Name in the legend.
    pub name: String,
    /// Points with increasing abscissas. One that is not finite breaks the line.
    pub points: Vec<(f64, f64)>,
}

/// Writes `STEM.svg` and `STEM.png`.
///
/// # Errors
/// [`PlotError`]: too many panels, no point to draw, unwritable path.
pub fn curves(plot: &CurvePlot, stem: &Path) -> Result<(), PlotError> {
    embed_font()?;
    check_number(plot.panels.len())?;
    let has_points = |panel: &CurvePanel| panel.drawable().next().is_some();
    if !plot.panels.iter().any(has_points) {
        return Err(PlotError::NoData {
            stem: stem.to_path_buf(),
        });
    }
    write(&Layout::new(plot), stem)
}

const Y_MARGIN: f64 = 0.05;
const LINE_WIDTH: f64 = 2.0;
const MARKER_RADIUS: f64 = 6.0;
const MARKERS_PER_CURVE: usize = 6;

impl CurvePanel {
    /// Points within the x axis.
    fn drawable(&self) -> impl Iterator<Item = (f64, f64)> {
        let (low, high) = self.x_range.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let all = self.curves.iter().flat_map(|curve| &curve.points).copied();
        all.filter(move |(x, y)| {
            self.x_scale.holds(*x) && Scale::Linear.holds(*y) && low <= *x && *x <= high
        })
    }

    fn x_axis(&self, width: i32) -> Axis {
        let extent = self.x_range;
        let extent = extent.or_else(|| self.x_scale.extent(self.drawable().map(|(x, _)| x)));
        extent.map_or_else(Axis::blank, |extent| {
            Axis::horizontal(self.x_scale, self.x_scale.range(extent), width)
        })
    }

    fn y_axis(&self, height: i32) -> Axis {
        let scale = Scale::Linear;
        let of_points = || {
            let extent = scale.extent(self.drawable().map(|(_, y)| y))?;
            Some(padded(scale.range(extent), Y_MARGIN))
        };
        let range = self.y_range.or_else(of_points);
        range.map_or_else(Axis::blank, |range| Axis::vertical(scale, range, height))
    }
}

/// A picture with all sizes decided.
struct Layout<'a> {
    plot: &'a CurvePlot,
    names: Vec<&'a str>,
    legend: Legend,
    tiling: Tiling,
}

impl<'a> Layout<'a> {
    fn new(plot: &'a CurvePlot) -> Self {
        let curves = plot.panels.iter().flat_map(|panel| &panel.curves);
        let names = distinct(curves.map(|curve| curve.name.as_str()));
        Self {
            plot,
            legend: Legend::of_curves(&names, LINE_WIDTH, units(PICTURE_WIDTH)),
            names,
            tiling: Tiling::new(plot.panels.len()),
        }
    }

    fn draw_panel<DB: Surface>(
        &self,
        area: &DrawingArea<DB, Shift>,
        panel: &CurvePanel,
    ) -> Drawn<DB> {
        let y = panel.y_axis(inner_height(area, &panel.title));
        let left = room_left(&y);
        let axes = Axes {
            title: &panel.title,
            x: panel.x_axis(inner_width(area, left)),
            y,
            x_label: Some(&panel.x_label),
            y_label: &panel.y_label,
            left,
            grid: true,
        };
        let inside = Panel::new(area, axes)?;
        if panel.drawable().next().is_none() {
            return inside.note_no_data();
        }
        let curves = panel.curves.iter();
        { curves }.try_for_each(|curve| self.draw_curve(&inside, curve))
    }

    fn draw_curve<DB: Surface>(&self, inside: &Panel<DB>, curve: &Curve) -> Drawn<DB> {
        let index = self.names.iter().position(|name| *name == curve.name);
        let index = index.unwrap_or(0);
        let (colour, marker) = curve_style(index);
        let mut places = Vec::new();
        for run in clipped(&curve.points, &inside.x, &inside.y) {
            let run: Vec<(i32, i32)> = run.into_iter().map(|(x, y)| inside.at(x, y)).collect();
            DB::polyline(&inside.area, &run, stroke(colour, LINE_WIDTH))?;
            places.extend(run);
        }
        let offset = (index as f64 + 0.5) / self.names.len() as f64;
        for centre in spread(&places, inside.width, MARKERS_PER_CURVE, offset) {
            marker.draw(&inside.area, centre, units(MARKER_RADIUS), colour)?;
        }
        Ok(())
    }
}

impl Picture for Layout<'_> {
    fn size(&self) -> (u32, u32) {
        let height = self.legend.height() + self.tiling.height();
        (PICTURE_WIDTH as u32, height.ceil() as u32)
    }

    fn draw<DB: Surface>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let (head, rest) = area.split_vertically(units(self.legend.height()));
        self.legend.draw(&head)?;
        let places = self.tiling.places(&rest);
        let panels = self.plot.panels.iter().zip(&places);
        { panels }.try_for_each(|(panel, place)| self.draw_panel(place, panel))
    }
}
