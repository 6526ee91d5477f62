use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::axis::Axis;
use super::canvas::{Drawn, Picture, Pictured, Surface};
use super::curve::{self, Curve, LINE_WIDTH, Spread, drawable, names_to_tell_apart};
use super::error::PlotError;
use super::legend::{Legend, curve_keys};
use super::panel::{
    Axes, Panel, RIGHT_MARGIN, height_for_label, room_above, room_below, room_left,
};
use super::portrait::{self, Portrait};
use super::scale::Scale;
use super::style::{FRAME, TITLE_TEXT, fitted, text, units};
use super::thinning::thinned;
use super::tiling::{PICTURE_WIDTH, Tiling, check_number};
use super::time_marks::TimeMarks;

/// Quantities over a common time axis, one panel above the other, and below them panels over other quantities. A legend
/// is added if a panel has several curves.
///
/// Long series are thinned out to the extremes within each pixel column, which does not change the picture.
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
    pub marks: Vec<TimeMarks>,
}

/// One panel of [`TimePanels`].
#[derive(Clone, Debug)]
pub struct TimePanel {
    /// Label of the y axis, with its unit.
    pub y_label: String,
    /// Scale of the y axis.
    pub y_scale: Scale,
    /// Curves over times that do not decrease.
    pub series: Vec<Curve>,
}

impl Pictured for TimePanels {
    fn picture(&self) -> Result<Option<impl Picture>, PlotError> {
        check_number(self.panels.len() + self.portraits.len())?;
        all_series(self).try_for_each(check_times)?;
        Ok(Layout::new(self))
    }
}

pub(super) const TITLE_HEIGHT: f64 = 42.0;
const PANEL_HEIGHT: f64 = 250.0;
const HIGHEST_PANEL: f64 = 560.0;
pub(super) const Y_MARGIN: f64 = 0.06;

/// Pixel columns that a series is thinned out to, fewer when many series share the picture.
const COLUMNS: usize = 1000;
const COLUMNS_OF_ALL_SERIES: usize = 5500;

fn all_series(plot: &TimePanels) -> impl Iterator<Item = &Curve> {
    plot.panels.iter().flat_map(|panel| &panel.series)
}

pub(super) fn check_times(series: &Curve) -> Result<(), PlotError> {
    let points = &series.points;
    match points.windows(2).position(|pair| pair[1].0 < pair[0].0) {
        None => Ok(()),
        Some(before) => Err(PlotError::TimeDecreases {
            series: series.name.clone(),
            index: before + 1,
            before: points[before].0,
            time: points[before + 1].0,
        }),
    }
}

impl TimePanel {
    fn drawable(&self) -> impl Iterator<Item = (f64, f64)> {
        drawable(&self.series, [Scale::Linear, self.y_scale])
    }

    fn axis(&self) -> Axis {
        let reach = self
            .y_scale
            .reach(self.drawable().map(|(_, y)| y), Y_MARGIN);
        Axis::vertical(reach, units(self.height() - room_above("")))
    }

    fn height(&self) -> f64 {
        PANEL_HEIGHT.max(room_above("") + height_for_label(&self.y_label, HIGHEST_PANEL))
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
        let times = Scale::Linear.reach(drawable.map(|(t, _)| t), 0.0);
        if times.1.is_none() && !plot.portraits.iter().any(Portrait::is_drawable) {
            return None;
        }
        let values: Vec<Axis> = plot.panels.iter().map(TimePanel::axis).collect();
        let left = values.iter().map(room_left).max().unwrap_or(0);
        let width = units(PICTURE_WIDTH - RIGHT_MARGIN) - left;
        let time = Axis::horizontal(times, width);
        let panels = plot.panels.iter().map(|panel| &panel.series[..]);
        let portraits = plot.portraits.iter().map(|portrait| &portrait.paths[..]);
        let names = names_to_tell_apart(panels.chain(portraits));
        let marks = times.1.map(|_| plot.marks.iter());
        let marks = marks
            .into_iter()
            .flatten()
            .filter_map(|own| own.entry(&time));
        let entries = curve_keys(&names, LINE_WIDTH).chain(marks);
        Some(Self {
            plot,
            legend: Legend::new(entries),
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
        self.plot
            .marks
            .iter()
            .try_for_each(|own| own.draw(&inside))?;
        let mut series = panel.series.iter();
        series.try_for_each(|series| self.draw_series(&inside, series))
    }

    fn draw_series<DB: Surface>(&self, inside: &Panel<DB>, series: &Curve) -> Drawn<DB> {
        let runs = thinned(
            series.points.iter().copied(),
            &inside.x,
            &inside.y,
            self.columns,
        );
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
pub(super) fn below_title<DB: Surface>(
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
