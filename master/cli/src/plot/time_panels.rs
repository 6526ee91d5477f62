use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::axis::Axis;
use super::canvas::{Drawn, Picture, Surface, embed_font, svg, write};
use super::curve::{self, LINE_WIDTH, Spread, names_to_tell_apart};
use super::error::PlotError;
use super::legend::{Legend, curve_keys};
use super::panel::{
    Axes, Panel, RIGHT_MARGIN, height_for_label, room_above, room_below, room_left,
};
use super::portrait::{self, Portrait};
use super::scale::{Scale, padded};
use super::style::{FRAME, TITLE_TEXT, fitted, text, units};
use super::thinning::thinned;
use super::tiling::{PICTURE_WIDTH, Tiling, check_number};
use super::time_marks::TimeMarks;

/// Quantities over a common time axis, one panel above the other, and below them panels over other quantities.
#[derive(Clone, Debug, Default)]
pub struct TimePanels {
    /// Title of the picture.
    pub title: Option<String>,
    /// Label of the time axis, with its unit.
    pub time_label: String,
    /// Panels from top to bottom, at most 12 with the portraits.
    pub panels: Vec<TimePanel>,
    /// Panels with x axes of their own, one or two in a row.
    pub portraits: Vec<Portrait>,
    /// Marked times, in all panels over the time.
    pub marks: TimeMarks,
}

/// One panel of [`TimePanels`].
#[derive(Clone, Debug)]
pub struct TimePanel {
    /// Label of the y axis, with its unit.
    pub y_label: String,
    /// Scale of the y axis.
    pub y_scale: Scale,
    /// Curves; equal names in several panels have equal colours.
    pub series: Vec<TimeSeries>,
}

/// One quantity over time.
#[derive(Clone, Debug)]
pub struct TimeSeries {
    /// Name in the legend.
    pub name: String,
    /// Times, not decreasing.
    pub t: Vec<f64>,
    /// One value for each time.
    pub y: Vec<f64>,
}

/// Writes `STEM.svg` and `STEM.png` with all panels above each other. A legend is added if a panel has several series.
///
/// Long series are thinned out to the extremes within each pixel column, which does not change the picture.
///
/// # Errors
/// [`PlotError`]: lengths of `t` and `y` differ, times decrease, too many panels, no point to draw, unwritable path.
pub fn time_panels(plot: &TimePanels, stem: &Path) -> Result<(), PlotError> {
    write(&checked_layout(plot, stem)?, stem)
}

/// The same picture as the text of an SVG, for a page; `name` is its name in errors.
///
/// # Errors
/// [`PlotError`], as for [`time_panels`], but for the path.
pub fn time_panels_svg(plot: &TimePanels, name: &str) -> Result<String, PlotError> {
    let stem = Path::new(name);
    svg(&checked_layout(plot, stem)?, stem)
}

fn checked_layout<'a>(plot: &'a TimePanels, stem: &Path) -> Result<Layout<'a>, PlotError> {
    embed_font()?;
    check_number(plot.panels.len() + plot.portraits.len())?;
    all_series(plot).try_for_each(checked)?;
    Layout::new(plot).ok_or_else(|| PlotError::NoData {
        stem: stem.to_path_buf(),
    })
}

const TITLE_HEIGHT: f64 = 42.0;
const PANEL_HEIGHT: f64 = 250.0;
const HIGHEST_PANEL: f64 = 560.0;
const Y_MARGIN: f64 = 0.06;

/// Pixel columns that a series is thinned out to, fewer when many series share the picture.
const COLUMNS: usize = 1000;
const COLUMNS_OF_ALL_SERIES: usize = 5500;

fn all_series(plot: &TimePanels) -> impl Iterator<Item = &TimeSeries> {
    plot.panels.iter().flat_map(|panel| &panel.series)
}

fn checked(series: &TimeSeries) -> Result<(), PlotError> {
    if series.t.len() != series.y.len() {
        let (times, values) = (series.t.len(), series.y.len());
        return Err(PlotError::UnequalLengths {
            series: series.name.clone(),
            times,
            values,
        });
    }
    match series.t.windows(2).position(|pair| pair[1] < pair[0]) {
        None => Ok(()),
        Some(before) => Err(PlotError::TimeDecreases {
            series: series.name.clone(),
            index: before + 1,
            before: series.t[before],
            time: series.t[before + 1],
        }),
    }
}

impl TimePanel {
    fn drawable(&self) -> impl Iterator<Item = (f64, f64)> {
        let holds = |&(t, y): &(f64, f64)| Scale::Linear.holds(t) && self.y_scale.holds(y);
        self.series
            .iter()
            .flat_map(TimeSeries::points)
            .filter(holds)
    }

    fn axis(&self) -> Axis {
        let Some(extent) = self.y_scale.extent(self.drawable().map(|(_, y)| y)) else {
            return Axis::blank();
        };
        let range = padded(self.y_scale.range(extent), Y_MARGIN);
        Axis::vertical(self.y_scale, range, units(self.height() - room_above("")))
    }

    fn names(&self) -> Vec<&str> {
        self.series.iter().map(|own| own.name.as_str()).collect()
    }

    fn height(&self) -> f64 {
        PANEL_HEIGHT.max(room_above("") + height_for_label(&self.y_label, HIGHEST_PANEL))
    }
}

impl TimeSeries {
    fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.t.iter().copied().zip(self.y.iter().copied())
    }
}

/// A picture with all ranges and sizes decided.
struct Layout<'a> {
    plot: &'a TimePanels,
    names: Vec<&'a str>,
    legend: Legend,
    time: Axis,
    values: Vec<Axis>,
    left: i32,
    columns: usize,
}

impl<'a> Layout<'a> {
    fn new(plot: &'a TimePanels) -> Option<Self> {
        let drawable = plot.panels.iter().flat_map(TimePanel::drawable);
        let times = Scale::Linear.extent(drawable.map(|(t, _)| t));
        if times.is_none() && !plot.portraits.iter().any(Portrait::is_drawable) {
            return None;
        }
        let values: Vec<Axis> = plot.panels.iter().map(TimePanel::axis).collect();
        let left = values.iter().map(room_left).max().unwrap_or(0);
        let width = units(PICTURE_WIDTH - RIGHT_MARGIN) - left;
        let time = times.map_or_else(Axis::blank, |times| {
            Axis::horizontal(Scale::Linear, Scale::Linear.range(times), width)
        });
        let panels = plot.panels.iter().map(TimePanel::names);
        let names = names_to_tell_apart(panels.chain(plot.portraits.iter().map(Portrait::names)));
        let marks = times.and_then(|_| plot.marks.entry(&time));
        let entries = curve_keys(&names, LINE_WIDTH).chain(marks);
        Some(Self {
            plot,
            legend: Legend::new(entries, units(PICTURE_WIDTH)),
            names,
            time,
            values,
            left,
            columns: COLUMNS
                .min(COLUMNS_OF_ALL_SERIES / all_series(plot).count().max(1))
                .max(50),
        })
    }

    fn draw_panel<DB: Surface>(
        &self,
        area: &DrawingArea<DB, Shift>,
        panel: &TimePanel,
        values: &Axis,
        x_label: Option<&str>,
    ) -> Drawn<DB> {
        let axes = Axes {
            title: "",
            x: self.time.clone(),
            y: values.clone(),
            x_label,
            y_label: &panel.y_label,
            left: self.left,
            grid: true,
        };
        let inside = Panel::new(area, axes)?;
        if panel.drawable().next().is_none() {
            return inside.note_no_data();
        }
        self.plot.marks.draw(&inside)?;
        panel
            .series
            .iter()
            .try_for_each(|series| self.draw_series(&inside, series))
    }

    fn draw_series<DB: Surface>(&self, inside: &Panel<DB>, series: &TimeSeries) -> Drawn<DB> {
        let runs = thinned(series.points(), &inside.x, &inside.y, self.columns);
        let name = (series.name.as_str(), &self.names[..]);
        curve::draw(inside, runs, name, Spread::AlongAxis)
    }

    fn draw_portraits<DB: Surface>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        if self.plot.portraits.is_empty() {
            return Ok(());
        }
        let places = Tiling::new(self.plot.portraits.len()).places(area);
        let mut placed = self.plot.portraits.iter().zip(&places);
        placed.try_for_each(|(portrait, place)| portrait.draw(place, &self.names))
    }
}

/// Draws the title over the middle of the area and gives back what is below it.
fn below_title<DB: Surface>(
    area: &DrawingArea<DB, Shift>,
    title: &str,
) -> Drawn<DB, DrawingArea<DB, Shift>> {
    let width = area.dim_in_pixel().0 as i32;
    let (head, rest) = area.split_vertically(units(TITLE_HEIGHT));
    let style = text(TITLE_TEXT, FRAME, HPos::Center, VPos::Center);
    head.draw_text(
        &fitted(title, TITLE_TEXT, width),
        &style,
        (width / 2, units(TITLE_HEIGHT / 2.0)),
    )?;
    Ok(rest)
}

impl Picture for Layout<'_> {
    fn size(&self) -> (u32, u32) {
        let title = self.plot.title.as_ref().map_or(0.0, |_| TITLE_HEIGHT);
        let mut height = title + self.legend.height();
        if !self.plot.panels.is_empty() {
            height += self.plot.panels.iter().map(TimePanel::height).sum::<f64>() + room_below();
        }
        let rows = self.plot.portraits.len().div_ceil(portrait::IN_A_ROW);
        height += portrait::HEIGHT * rows as f64;
        (PICTURE_WIDTH as u32, height.ceil() as u32)
    }

    fn draw<DB: Surface>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let rest = match &self.plot.title {
            Some(title) => below_title(area, title)?,
            None => area.clone(),
        };
        let (head, mut rest) = rest.split_vertically(units(self.legend.height()));
        self.legend.draw(&head)?;
        let last = self.plot.panels.len().saturating_sub(1);
        for (index, (panel, values)) in self.plot.panels.iter().zip(&self.values).enumerate() {
            let x_label = (index == last).then_some(self.plot.time_label.as_str());
            let height = panel.height() + x_label.map_or(0.0, |_| room_below());
            let (own, below) = rest.split_vertically(units(height));
            self.draw_panel(&own, panel, values, x_label)?;
            rest = below;
        }
        self.draw_portraits(&rest)
    }
}
