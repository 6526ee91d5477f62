use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::axis::Axis;
use super::canvas::{Drawn, Picture, Pictured, Surface};
use super::curve::{self, Curve, LINE_WIDTH, Spread, drawable, names};
use super::error::PlotError;
use super::legend::{Legend, curve_keys, distinct};
use super::panel::{
    Axes, Panel, RIGHT_MARGIN, height_for_label, room_above, room_below, room_left,
};
use super::scale::Scale;
use super::style::{LABEL_TEXT, REFERENCE_TEXT, fitted, text, units};
use super::thinning::thinned;
use super::tiling::PICTURE_WIDTH;
use super::time_marks::TimeMarks;
use super::time_panels::{TITLE_HEIGHT, Y_MARGIN, below_title, check_times};

/// Columns of a run over time: one block for every quantity, one above the other, and in a block small panels with common axes
/// where there are more curves than one panel takes. Every panel has a legend of its own.
#[derive(Clone, Debug)]
pub struct QuantityPanels {
    /// Title of the picture.
    pub title: String,
    /// Label of the time axis, with its unit.
    pub time_label: String,
    /// Blocks from top to bottom.
    pub blocks: Vec<Block>,
    /// Marked times, in all panels.
    pub marks: Vec<TimeMarks>,
}

/// The panels of one quantity.
#[derive(Clone, Debug)]
pub struct Block {
    /// Label of the y axis, with its unit.
    pub y_label: String,
    /// Scale of the y axis.
    pub y_scale: Scale,
    /// What is said above the panels.
    pub note: Option<String>,
    /// Curves of every panel, over times that do not decrease.
    panels: Vec<Vec<Curve>>,
}

/// Most curves in one panel.
pub const MOST_CURVES: usize = 8;

/// Panels of a block with several of them in a row.
const IN_A_ROW: usize = 2;

/// Height of a panel in pixels without its legend.
const PANEL_HEIGHT: f64 = 230.0;
const HIGHEST_PANEL: f64 = 420.0;

/// How far a legend reaches into the margin above its panel, in pixels.
const LEGEND_SHIFT: f64 = 10.0;

const NOTE_HEIGHT: f64 = 46.0;

/// Pixel columns that a series is thinned out to, fewer when many series share the picture.
const COLUMNS: usize = 1000;
const COLUMNS_OF_ALL_SERIES: usize = 8000;

impl Block {
    /// Spreads the curves over as few panels as take them, about equally many in each.
    pub fn new(y_label: String, y_scale: Scale, curves: Vec<Curve>) -> Self {
        let panels = curves.len().div_ceil(MOST_CURVES).max(1);
        let in_each = curves.len().div_ceil(panels).max(1);
        let mut panels: Vec<Vec<Curve>> = Vec::with_capacity(panels);
        for curve in curves {
            match panels.last_mut().filter(|last| last.len() < in_each) {
                Some(last) => last.push(curve),
                None => panels.push(vec![curve]),
            }
        }
        Self {
            y_label,
            y_scale,
            note: None,
            panels,
        }
    }

    fn drawable(&self) -> impl Iterator<Item = (f64, f64)> {
        let scales = [Scale::Linear, self.y_scale];
        self.panels
            .iter()
            .flat_map(move |curves| drawable(curves, scales))
    }

    /// Height of a panel in pixels without its legend and what is below it.
    fn panel_height(&self) -> f64 {
        PANEL_HEIGHT.max(room_above("") + height_for_label(&self.y_label, HIGHEST_PANEL))
    }

    fn axis(&self) -> Axis {
        let reach = self
            .y_scale
            .reach(self.drawable().map(|(_, y)| y), Y_MARGIN);
        Axis::vertical(reach, units(self.panel_height() - room_above("")))
    }

    fn in_a_row(&self) -> usize {
        self.panels.len().min(IN_A_ROW)
    }
}

impl Pictured for QuantityPanels {
    fn picture(&self) -> Result<Option<impl Picture>, PlotError> {
        let all = self.blocks.iter().flat_map(|block| &block.panels).flatten();
        all.clone().try_for_each(check_times)?;
        Ok(Layout::new(self, all.count()))
    }
}

/// A picture with all ranges and sizes decided.
struct Layout<'a> {
    plot: &'a QuantityPanels,
    key: Legend,
    blocks: Vec<Laid<'a>>,
    left: i32,
    columns: usize,
}

/// A block with its axes and legends.
struct Laid<'a> {
    block: &'a Block,
    time: Axis,
    values: Axis,
    panels: Vec<(Vec<&'a str>, Legend)>,
    /// Whether the panels at its end have the label of the time axis.
    ends_axis: bool,
}

/// Panels of a block side by side.
struct Line {
    panels: std::ops::Range<usize>,
    legend: f64,
    below: f64,
}

impl<'a> Layout<'a> {
    fn new(plot: &'a QuantityPanels, curves: usize) -> Option<Self> {
        let drawable = plot.blocks.iter().flat_map(Block::drawable);
        let times = Scale::Linear.reach(drawable.map(|(t, _)| t), 0.0);
        times.1?;
        let values: Vec<Axis> = plot.blocks.iter().map(Block::axis).collect();
        let left = values.iter().map(room_left).max().unwrap_or(0);
        let width = |in_a_row: usize| units(PICTURE_WIDTH) / in_a_row as i32;
        let time = |in_a_row| Axis::horizontal(times, width(in_a_row) - units(RIGHT_MARGIN) - left);
        let blocks = plot.blocks.iter().zip(values).enumerate();
        let laid = blocks.map(|(number, (block, values))| {
            let next = plot.blocks.get(number + 1);
            let in_a_row = block.in_a_row();
            let panels = block.panels.iter().map(|curves| {
                let names = distinct(names(curves));
                let legend = Legend::within(width(in_a_row), curve_keys(&names, LINE_WIDTH));
                (names, legend)
            });
            Laid {
                block,
                time: time(in_a_row),
                values,
                panels: panels.collect(),
                ends_axis: in_a_row > 1 || next.is_none_or(|next| next.in_a_row() > 1),
            }
        });
        let axis = time(1);
        Some(Self {
            plot,
            key: Legend::new(plot.marks.iter().filter_map(|own| own.entry(&axis))),
            blocks: laid.collect(),
            left,
            columns: COLUMNS.min(COLUMNS_OF_ALL_SERIES / curves.max(1)).max(50),
        })
    }

    fn draw_panel<DB: Surface>(
        &self,
        area: &DrawingArea<DB, Shift>,
        laid: &Laid<'_>,
        number: usize,
        shows_time: bool,
    ) -> Drawn<DB> {
        let axes = Axes {
            title: "",
            x: laid.time.clone(),
            y: laid.values.clone(),
            x_label: shows_time.then_some(&self.plot.time_label),
            y_label: &laid.block.y_label,
            left: self.left,
            grid: true,
        };
        let inside = Panel::new(area, axes)?;
        let curves = &laid.block.panels[number];
        if drawable(curves, [Scale::Linear, laid.block.y_scale])
            .next()
            .is_none()
        {
            return inside.note_no_data();
        }
        self.plot
            .marks
            .iter()
            .try_for_each(|own| own.draw(&inside))?;
        let (names, _) = &laid.panels[number];
        curves.iter().try_for_each(|own| {
            let points = own.points.iter().copied();
            let runs = thinned(points, &inside.x, &inside.y, self.columns);
            curve::draw(&inside, runs, (&own.name, names), Spread::AlongAxis)
        })
    }

    /// Draws a block from the top of the area and gives back what is below it.
    fn draw_block<DB: Surface>(
        &self,
        area: DrawingArea<DB, Shift>,
        laid: &Laid<'_>,
    ) -> Drawn<DB, DrawingArea<DB, Shift>> {
        let mut rest = match &laid.block.note {
            Some(note) => below_note(&area, note)?,
            None => area,
        };
        for line in laid.lines() {
            let height = laid.block.panel_height();
            let (own, below) = rest.split_vertically(units(line.legend + height + line.below));
            let places = own.split_evenly((1, laid.block.in_a_row()));
            for (number, place) in line.panels.clone().zip(places) {
                let (_, legend) = &laid.panels[number];
                // Beside a longer one a legend stands at its panel, near it and not near the panel above.
                let above = line.legend - legend.height() + LEGEND_SHIFT;
                legend.draw(&place.split_vertically(units(above)).1)?;
                let (_, place) = place.split_vertically(units(line.legend));
                let shows_time = laid.shows_time(number);
                let below = if shows_time { room_below() } else { 0.0 };
                let (place, _) = place.split_vertically(units(height + below));
                self.draw_panel(&place, laid, number, shows_time)?;
            }
            rest = below;
        }
        Ok(rest)
    }
}

impl Laid<'_> {
    /// Whether a panel has the label of the time axis: the last one of its column, if the axis ends here.
    fn shows_time(&self, panel: usize) -> bool {
        self.ends_axis && panel + self.block.in_a_row() >= self.panels.len()
    }

    fn lines(&self) -> impl Iterator<Item = Line> {
        let in_a_row = self.block.in_a_row();
        (0..self.panels.len()).step_by(in_a_row).map(move |first| {
            let panels = first..(first + in_a_row).min(self.panels.len());
            let legends = self.panels[panels.clone()]
                .iter()
                .map(|(_, own)| own.height());
            let shows_time = panels.clone().any(|panel| self.shows_time(panel));
            Line {
                panels,
                legend: legends.fold(0.0, f64::max),
                below: if shows_time { room_below() } else { 0.0 },
            }
        })
    }

    /// Height in pixels.
    fn height(&self) -> f64 {
        let note = self.block.note.as_ref().map_or(0.0, |_| NOTE_HEIGHT);
        let height = self.block.panel_height();
        let lines = self.lines().map(|line| line.legend + height + line.below);
        note + lines.sum::<f64>()
    }
}

/// Draws a note over the middle of the area and gives back what is below it.
fn below_note<DB: Surface>(
    area: &DrawingArea<DB, Shift>,
    note: &str,
) -> Drawn<DB, DrawingArea<DB, Shift>> {
    let width = area.dim_in_pixel().0 as i32;
    let (head, rest) = area.split_vertically(units(NOTE_HEIGHT));
    let style = text(LABEL_TEXT, REFERENCE_TEXT, HPos::Center, VPos::Center);
    let place = (width / 2, units(NOTE_HEIGHT - LABEL_TEXT));
    head.draw_text(&fitted(note, LABEL_TEXT, width), &style, place)?;
    Ok(rest)
}

impl Picture for Layout<'_> {
    fn size(&self) -> (u32, u32) {
        let blocks = self.blocks.iter().map(Laid::height).sum::<f64>();
        let height = TITLE_HEIGHT + self.key.height() + blocks;
        (PICTURE_WIDTH as u32, height.ceil() as u32)
    }

    fn draw<DB: Surface>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let rest = below_title(area, &self.plot.title)?;
        let (head, mut rest) = rest.split_vertically(units(self.key.height()));
        self.key.draw(&head)?;
        for laid in &self.blocks {
            rest = self.draw_block(rest, laid)?;
        }
        Ok(())
    }
}
