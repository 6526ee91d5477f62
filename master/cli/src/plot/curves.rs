use plotters::coord::Shift;
use plotters::prelude::*;

use super::axis::Reach;
use super::canvas::{Drawn, Picture, Pictured, Surface};
use super::clip::clipped;
use super::curve::{Curve, drawable, names};
use super::error::PlotError;
use super::legend::{Legend, distinct, style_of};
use super::panel::{Labels, Panel};
use super::scale::Scale;
use super::slope::draw_slopes;
use super::spread::spread;
use super::style::{stroke, units};
use super::tiling::{Sheet, check_number};

/// Curves in one or several panels: errors against step sizes or cost, or any other.
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
    /// Scales of both axes.
    pub scales: [Scale; 2],
    /// Range of the x axis, the first number less than the second; otherwise that of the points.
    pub x_range: Option<(f64, f64)>,
    /// Range of the y axis; otherwise that of the points within the x axis.
    pub y_range: Option<(f64, f64)>,
    /// Curves. Equal names in several panels have equal markers.
    pub curves: Vec<Curve>,
    /// How their markers are placed.
    pub markers: Markers,
    /// Slopes to draw as light reference lines behind the curves, such as the expected orders.
    pub reference_slopes: Vec<f64>,
}

/// Where a curve has its markers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Markers {
    /// At its points, which must be within the ranges of the axes.
    AtPoints,
    /// Few, equally far apart along the x axis, over which points must increase. The curve ends where it leaves the
    /// axes.
    Spread,
}

impl CurvePanel {
    /// Log-log curves with markers at the points: error against step size or cost.
    pub fn of_errors(x_label: &str, y_label: &str, curves: Vec<Curve>) -> Self {
        Self {
            title: String::new(),
            x_label: x_label.to_owned(),
            y_label: y_label.to_owned(),
            scales: [Scale::Logarithmic; 2],
            x_range: None,
            y_range: None,
            curves,
            markers: Markers::AtPoints,
            reference_slopes: Vec::new(),
        }
    }
}

const MARGIN: f64 = 0.05;
const LINE_WIDTH: f64 = 2.0;
const MARKER_RADIUS: f64 = 6.0;
const MARKERS_PER_CURVE: usize = 6;

impl Pictured for CurvePlot {
    fn picture(&self) -> Result<Option<impl Picture>, PlotError> {
        check_number(self.panels.len())?;
        let mut points = self.panels.iter().flat_map(CurvePanel::drawable);
        Ok(points.next().map(|_| Layout::new(self)))
    }
}

impl CurvePanel {
    /// Points within the x axis.
    fn drawable(&self) -> impl Iterator<Item = (f64, f64)> {
        let (low, high) = self.x_range.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let all = drawable(&self.curves, self.scales);
        all.filter(move |(x, _)| low <= *x && *x <= high)
    }

    fn reaches(&self) -> [Reach; 2] {
        let [x, y] = self.scales;
        [
            match self.x_range {
                Some(range) => (x, Some(x.range(range))),
                None => x.reach(self.drawable().map(|(x, _)| x), MARGIN),
            },
            match self.y_range {
                Some(range) => (y, Some(y.range(range))),
                None => y.reach(self.drawable().map(|(_, y)| y), MARGIN),
            },
        ]
    }
}

/// A picture with all sizes decided.
struct Layout<'a> {
    plot: &'a CurvePlot,
    names: Vec<&'a str>,
    sheet: Sheet,
}

impl<'a> Layout<'a> {
    fn new(plot: &'a CurvePlot) -> Self {
        let names = distinct(plot.panels.iter().flat_map(|panel| names(&panel.curves)));
        let legend = Legend::of_curves(&names, LINE_WIDTH);
        Self {
            plot,
            names,
            sheet: Sheet::new(legend, plot.panels.len()),
        }
    }

    fn draw_panel<DB: Surface>(
        &self,
        area: &DrawingArea<DB, Shift>,
        panel: &CurvePanel,
    ) -> Drawn<DB> {
        let labels = Labels {
            title: &panel.title,
            x: &panel.x_label,
            y: &panel.y_label,
        };
        let inside = Panel::filling(area, &labels, panel.reaches(), true)?;
        if panel.drawable().next().is_none() {
            return inside.note_no_data();
        }
        let points = |curve: &Curve| curve.runs(panel.scales).flatten().copied().collect();
        let curves: Vec<Vec<_>> = panel.curves.iter().map(points).collect();
        draw_slopes(&inside, &curves, &panel.reference_slopes)?;
        let mut curves = panel.curves.iter();
        curves.try_for_each(|curve| match panel.markers {
            Markers::AtPoints => self.draw_points(&inside, panel.scales, curve),
            Markers::Spread => self.draw_line(&inside, curve),
        })
    }

    fn draw_points<DB: Surface>(
        &self,
        inside: &Panel<DB>,
        scales: [Scale; 2],
        curve: &Curve,
    ) -> Drawn<DB> {
        let (_, colour, marker) = style_of(&curve.name, &self.names);
        for run in curve.runs(scales) {
            let places: Vec<(i32, i32)> = run.iter().map(|point| inside.place(*point)).collect();
            DB::polyline(&inside.area, &places, stroke(colour, LINE_WIDTH))?;
            for centre in places {
                marker.draw(&inside.area, centre, units(MARKER_RADIUS), colour)?;
            }
        }
        Ok(())
    }

    fn draw_line<DB: Surface>(&self, inside: &Panel<DB>, curve: &Curve) -> Drawn<DB> {
        let (index, colour, marker) = style_of(&curve.name, &self.names);
        let mut places = Vec::new();
        for run in clipped(&curve.points, &inside.x, &inside.y) {
            let run: Vec<(i32, i32)> = run.into_iter().map(|(x, y)| inside.at(x, y)).collect();
            DB::polyline(&inside.area, &run, stroke(colour, LINE_WIDTH))?;
            places.extend(run);
        }
        let offset = (index.unwrap_or(0) as f64 + 0.5) / self.names.len() as f64;
        for centre in spread(&places, inside.width, MARKERS_PER_CURVE, offset) {
            marker.draw(&inside.area, centre, units(MARKER_RADIUS), colour)?;
        }
        Ok(())
    }
}

impl Picture for Layout<'_> {
    fn size(&self) -> (u32, u32) {
        self.sheet.size()
    }

    fn draw<DB: Surface>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let places = self.sheet.places(&self.sheet.below_legend(area)?);
        let mut panels = self.plot.panels.iter().zip(&places);
        panels.try_for_each(|(panel, place)| self.draw_panel(place, panel))
    }
}
