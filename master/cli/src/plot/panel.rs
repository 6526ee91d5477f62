use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::axis::{Axis, Reach};
use super::canvas::{Drawn, Surface};
use super::style::{
    FINE_GRID, FRAME, GRID, LABEL_TEXT, REFERENCE_TEXT, TICK_TEXT, TITLE_TEXT, fitted, stroke,
    text, text_width, units,
};

const TICK_LENGTH: f64 = 6.0;
const LINE_SPACING: f64 = 1.35;

/// Pixels to the right of a panel: half of the last tick label stands there.
pub(super) const RIGHT_MARGIN: f64 = 44.0;

const LEFT_MARGIN: f64 = 8.0;
const TOP_MARGIN: f64 = 24.0;
const TITLE_GAP: f64 = 10.0;

/// Height in pixels of the tick labels and the label below a panel.
pub(super) fn room_below() -> f64 {
    2.0 * TICK_LENGTH + LINE_SPACING * (TICK_TEXT + LABEL_TEXT)
}

/// Height in pixels of the title above a panel, or of the upper half of its highest tick label.
pub(super) fn room_above(title: &str) -> f64 {
    if title.is_empty() {
        TOP_MARGIN
    } else {
        TOP_MARGIN + TITLE_GAP + TITLE_TEXT
    }
}

/// Width in drawing units of the tick labels and the label left of a panel.
pub(super) fn room_left(y: &Axis) -> i32 {
    y.label_width() + units(2.0 * TICK_LENGTH + LINE_SPACING * LABEL_TEXT + LEFT_MARGIN)
}

/// Height in pixels that a label needs when it is read from bottom to top, up to `most`.
pub(super) fn height_for_label(label: &str, most: f64) -> f64 {
    let width = f64::from(text_width(label, LABEL_TEXT)) / f64::from(units(1.0));
    (width + LABEL_TEXT).min(most)
}

/// What is said around a panel.
pub(super) struct Labels<'a> {
    /// Title above the panel; an empty one takes no room.
    pub title: &'a str,
    pub x: &'a str,
    pub y: &'a str,
}

/// Axes with their labels.
pub(super) struct Axes<'a> {
    /// Title above the panel; an empty one takes no room.
    pub title: &'a str,
    pub x: Axis,
    pub y: Axis,
    /// Label of the x axis; `None` leaves its tick labels out as well.
    pub x_label: Option<&'a str>,
    pub y_label: &'a str,
    /// Width of everything left of the panel, as from [`room_left`].
    pub left: i32,
    pub grid: bool,
}

/// The inside of the axes: where curves go.
pub(super) struct Panel<DB: Surface> {
    pub area: DrawingArea<DB, Shift>,
    pub x: Axis,
    pub y: Axis,
    pub width: i32,
    pub height: i32,
}

impl<DB: Surface> Panel<DB> {
    /// Draws a panel whose axes are as long as the area allows.
    pub(super) fn filling(
        area: &DrawingArea<DB, Shift>,
        labels: &Labels<'_>,
        [x, y]: [Reach; 2],
        grid: bool,
    ) -> Drawn<DB, Self> {
        let (width, height) = area.dim_in_pixel();
        let around = units(room_above(labels.title) + room_below());
        let y = Axis::vertical(y, height as i32 - around);
        let left = room_left(&y);
        let axes = Axes {
            title: labels.title,
            x: Axis::horizontal(x, width as i32 - units(RIGHT_MARGIN) - left),
            y,
            x_label: Some(labels.x),
            y_label: labels.y,
            left,
            grid,
        };
        Self::new(area, axes)
    }

    /// Draws grid, frame, ticks and labels into the area.
    pub(super) fn new(area: &DrawingArea<DB, Shift>, axes: Axes<'_>) -> Drawn<DB, Self> {
        let below = if axes.x_label.is_some() {
            units(room_below())
        } else {
            0
        };
        let mut chart = ChartBuilder::on(area)
            .margin_left(units(LEFT_MARGIN))
            .margin_right(units(RIGHT_MARGIN).max(axes.x.label_width() / 2 + units(4.0)))
            .margin_top(units(room_above(axes.title)))
            .set_label_area_size(LabelAreaPosition::Left, axes.left - units(LEFT_MARGIN))
            .set_label_area_size(LabelAreaPosition::Bottom, below)
            .build_cartesian_2d(axes.x.clone(), axes.y.clone())?;
        let (width, height) = chart.plotting_area().dim_in_pixel();
        let (width, height) = (width as i32, height as i32);
        let mut mesh = chart.configure_mesh();
        if !axes.grid {
            mesh.disable_mesh();
        }
        mesh.bold_line_style(stroke(GRID, 1.0))
            .light_line_style(stroke(FINE_GRID, 1.0))
            .axis_style(stroke(FRAME, 1.25))
            .set_all_tick_mark_size(units(TICK_LENGTH))
            .label_style(text(TICK_TEXT, FRAME, HPos::Center, VPos::Center))
            .axis_desc_style(text(LABEL_TEXT, FRAME, HPos::Center, VPos::Center))
            .x_desc(fitted(axes.x_label.unwrap_or_default(), LABEL_TEXT, width))
            .y_desc(fitted(axes.y_label, LABEL_TEXT, height))
            .draw()?;
        let panel = Self {
            area: chart.plotting_area().strip_coord_spec(),
            x: axes.x,
            y: axes.y,
            width,
            height,
        };
        panel.frame()?;
        if !axes.title.is_empty() {
            panel.entitle(axes.title)?;
        }
        Ok(panel)
    }

    /// Draws the outline, over what may have covered it.
    pub(super) fn frame(&self) -> Drawn<DB> {
        let corners = [
            (0, 0),
            (self.width, 0),
            (self.width, self.height),
            (0, self.height),
            (0, 0),
        ];
        DB::polyline(&self.area, &corners, stroke(FRAME, 1.25))
    }

    fn entitle(&self, title: &str) -> Drawn<DB> {
        let style = text(TITLE_TEXT, FRAME, HPos::Center, VPos::Center);
        let title = fitted(title, TITLE_TEXT, self.width);
        let above = -units(TITLE_GAP + TITLE_TEXT / 2.0);
        self.area.draw_text(&title, &style, (self.width / 2, above))
    }

    /// Says in the middle of the panel that nothing is there to see.
    pub(super) fn note_no_data(&self) -> Drawn<DB> {
        let style = text(LABEL_TEXT, REFERENCE_TEXT, HPos::Center, VPos::Center);
        self.area
            .draw_text("no data", &style, (self.width / 2, self.height / 2))
    }

    /// Place of a value pair in the panel, in drawing units.
    pub(super) fn place(&self, (x, y): (f64, f64)) -> (i32, i32) {
        self.at(self.x.position(x), self.y.position(y))
    }

    /// Place of two shares of the axes in the panel, in drawing units.
    pub(super) fn at(&self, x: f64, y: f64) -> (i32, i32) {
        let right = (x * f64::from(self.width)).round() as i32;
        let down = ((1.0 - y) * f64::from(self.height)).round() as i32;
        (right, down)
    }
}
