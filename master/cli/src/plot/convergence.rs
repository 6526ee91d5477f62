use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::axis::Axis;
use super::canvas::{Drawn, Picture, Surface, embed_font, svg, write};
use super::error::PlotError;
use super::legend::{Legend, distinct};
use super::panel::{Axes, Panel, inner_height, inner_width, room_left};
use super::scale::{Scale, padded};
use super::slope::draw_slopes;
use super::style::{curve_style, stroke, units};
use super::tiling::{PICTURE_WIDTH, Tiling, check_number};

/// Log-log curves in one or several panels: error against step size, or error against cost.
#[derive(Clone, Debug)]
pub struct ConvergencePlot {
    /// Panels, two in a row, at most 12.
    pub panels: Vec<ConvergencePanel>,
}

/// One panel of a [`ConvergencePlot`].
#[derive(Clone, Debug)]
pub struct ConvergencePanel {
    /// Title above the panel; an empty one takes no room.
    pub title: String,
    /// Label of the x axis, with its unit.
    pub x_label: String,
    /// Label of the y axis, with its unit.
    pub y_label: String,
    /// Curves; equal names in several panels have equal colours and markers.
    pub curves: Vec<ConvergenceCurve>,
    /// Slopes to draw as light reference lines, such as the expected orders.
    pub reference_slopes: Vec<f64>,
}

/// One curve of a [`ConvergencePanel`].
#[derive(Clone, Debug)]
pub struct ConvergenceCurve {
    /// Name in the legend; an empty one is left out there.
    pub name: String,
    /// Points in the order in which they are joined: (step size or cost, error). A point that is not positive and
    /// finite is left out and breaks the line.
    pub points: Vec<(f64, f64)>,
}

/// Writes `STEM.svg` and `STEM.png` with both axes logarithmic, markers at the points and reference slopes behind them.
///
/// # Errors
/// [`PlotError`]: too many panels, no point to draw, unwritable path.
pub fn convergence(plot: &ConvergencePlot, stem: &Path) -> Result<(), PlotError> {
    write(&checked_layout(plot, stem)?, stem)
}

/// The same picture as the text of an SVG, for a page; `name` is its name in errors.
///
/// # Errors
/// [`PlotError`]: too many panels, no point to draw.
pub fn convergence_svg(plot: &ConvergencePlot, name: &str) -> Result<String, PlotError> {
    let stem = Path::new(name);
    svg(&checked_layout(plot, stem)?, stem)
}

fn checked_layout<'a>(plot: &'a ConvergencePlot, stem: &Path) -> Result<Layout<'a>, PlotError> {
    embed_font()?;
    check_number(plot.panels.len())?;
    if plot
        .panels
        .iter()
        .all(|panel| panel.runs().next().is_none())
    {
        return Err(PlotError::NoData {
            stem: stem.to_path_buf(),
        });
    }
    Ok(Layout::new(plot))
}

const MARGIN: f64 = 0.05;
const LINE_WIDTH: f64 = 2.0;
const MARKER_RADIUS: f64 = 6.0;

const LOG: Scale = Scale::Logarithmic;

impl ConvergenceCurve {
    fn runs(&self) -> impl Iterator<Item = &[(f64, f64)]> {
        self.points
            .split(|(x, y)| !(LOG.holds(*x) && LOG.holds(*y)))
            .filter(|run| !run.is_empty())
    }
}

impl ConvergencePanel {
    fn runs(&self) -> impl Iterator<Item = &[(f64, f64)]> {
        self.curves.iter().flat_map(ConvergenceCurve::runs)
    }

    fn drawable_curves(&self) -> Vec<Vec<(f64, f64)>> {
        let points = |curve: &ConvergenceCurve| curve.runs().flatten().copied().collect();
        self.curves.iter().map(points).collect()
    }

    fn range(&self, coordinate: impl Fn(&(f64, f64)) -> f64) -> Option<(f64, f64)> {
        let extent = LOG.extent(self.runs().flatten().map(coordinate))?;
        Some(padded(LOG.range(extent), MARGIN))
    }
}

/// A picture with all sizes decided.
struct Layout<'a> {
    plot: &'a ConvergencePlot,
    names: Vec<&'a str>,
    legend: Legend,
    tiling: Tiling,
}

impl<'a> Layout<'a> {
    fn new(plot: &'a ConvergencePlot) -> Self {
        let curves = plot.panels.iter().flat_map(|panel| &panel.curves);
        let names = distinct(curves.map(|curve| curve.name.as_str()));
        let legend = Legend::of_curves(&names, LINE_WIDTH, units(PICTURE_WIDTH));
        Self {
            plot,
            names,
            legend,
            tiling: Tiling::new(plot.panels.len()),
        }
    }

    fn draw_panel<DB: Surface>(
        &self,
        area: &DrawingArea<DB, Shift>,
        panel: &ConvergencePanel,
    ) -> Drawn<DB> {
        let height = inner_height(area, &panel.title);
        let y_range = panel.range(|point| point.1);
        let y = y_range.map_or_else(Axis::blank, |range| Axis::vertical(LOG, range, height));
        let left = room_left(&y);
        let width = inner_width(area, left);
        let x_range = panel.range(|point| point.0);
        let x = x_range.map_or_else(Axis::blank, |range| Axis::horizontal(LOG, range, width));
        let axes = Axes {
            title: &panel.title,
            x,
            y,
            x_label: Some(&panel.x_label),
            y_label: &panel.y_label,
            left,
            grid: true,
        };
        let inside = Panel::new(area, axes)?;
        if panel.runs().next().is_none() {
            return inside.note_no_data();
        }
        draw_slopes(&inside, &panel.drawable_curves(), &panel.reference_slopes)?;
        panel
            .curves
            .iter()
            .try_for_each(|curve| self.draw_curve(&inside, curve))
    }

    fn draw_curve<DB: Surface>(&self, inside: &Panel<DB>, curve: &ConvergenceCurve) -> Drawn<DB> {
        let index = self.names.iter().position(|name| *name == curve.name);
        let (colour, marker) = curve_style(index.unwrap_or(0));
        for run in curve.runs() {
            let places: Vec<(i32, i32)> = run.iter().map(|point| inside.place(*point)).collect();
            DB::polyline(&inside.area, &places, stroke(colour, LINE_WIDTH))?;
            for centre in places {
                marker.draw(&inside.area, centre, units(MARKER_RADIUS), colour)?;
            }
        }
        Ok(())
    }
}

impl Picture for Layout<'_> {
    fn size(&self) -> (u32, u32) {
        (
            PICTURE_WIDTH as u32,
            (self.legend.height() + self.tiling.height()).ceil() as u32,
        )
    }

    fn draw<DB: Surface>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let (head, rest) = area.split_vertically(units(self.legend.height()));
        self.legend.draw(&head)?;
        let places = self.tiling.places(&rest);
        self.plot
            .panels
            .iter()
            .zip(&places)
            .try_for_each(|(panel, place)| self.draw_panel(place, panel))
    }
}
