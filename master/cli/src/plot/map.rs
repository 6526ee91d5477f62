use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::RGBColor;

use super::axis::Axis;
use super::canvas::{Drawn, Picture, Surface, embed_font, svg, write};
use super::colour::GrowthColours;
use super::error::PlotError;
use super::grid::{MapAxis, MapPanel, PlacedCell, Verdict};
use super::legend::{Key, Legend};
use super::panel::{Axes, Panel, inner_height, inner_width, room_above, room_below, room_left};
use super::style::{Marker, units};
use super::tiling::{PICTURE_WIDTH, Tiling, check_number};

/// Stability over two parameters, in one or several panels.
#[derive(Clone, Debug)]
pub struct StabilityMap {
    /// Panels, two in a row, at most 12.
    pub panels: Vec<MapPanel>,
    /// Label of the colour bar, which is drawn if any cell has a growth factor.
    pub growth_label: String,
}

/// Writes `STEM.svg` and `STEM.png`: a mark for the verdict on every cell, its growth factor as the colour behind.
///
/// # Errors
/// [`PlotError`]: grid values not increasing, number of cells does not fit the grid, too many panels, no cell to draw,
/// unwritable path.
pub fn map(plot: &StabilityMap, stem: &Path) -> Result<(), PlotError> {
    write(&checked_layout(plot, stem)?, stem)
}

/// The same picture as the text of an SVG, for a page; `name` is its name in errors.
///
/// # Errors
/// [`PlotError`], as for [`map`], but for the path.
pub fn map_svg(plot: &StabilityMap, name: &str) -> Result<String, PlotError> {
    let stem = Path::new(name);
    svg(&checked_layout(plot, stem)?, stem)
}

fn checked_layout<'a>(plot: &'a StabilityMap, stem: &Path) -> Result<Layout<'a>, PlotError> {
    embed_font()?;
    check_number(plot.panels.len())?;
    plot.panels.iter().try_for_each(MapPanel::check)?;
    let layout = Layout::new(plot);
    if layout.cells.iter().all(Vec::is_empty) {
        return Err(PlotError::NoData {
            stem: stem.to_path_buf(),
        });
    }
    Ok(layout)
}

/// Radius of a mark as a share of the cell, and its largest size in pixels.
const MARK_SHARE: f64 = 0.3;
const LARGEST_MARK: f64 = 8.0;

const VERDICTS: [(Verdict, &str); 3] = [
    (Verdict::Stable, "stable"),
    (Verdict::Unstable, "unstable"),
    (Verdict::Undecided, "undecided"),
];

/// Marks as in stability plots of the co-simulation literature: circles where stable, the rest recedes.
fn mark(verdict: Verdict) -> (Marker, RGBColor) {
    match verdict {
        Verdict::Stable => (Marker::Ring, BLACK),
        Verdict::Unstable => (Marker::Cross, RGBColor(150, 150, 150)),
        Verdict::Undecided => (Marker::Triangle, RGBColor(90, 90, 90)),
    }
}

/// A picture with all sizes decided.
struct Layout<'a> {
    plot: &'a StabilityMap,
    cells: Vec<Vec<PlacedCell>>,
    colours: Option<GrowthColours>,
    legend: Legend,
    tiling: Tiling,
}

impl<'a> Layout<'a> {
    fn new(plot: &'a StabilityMap) -> Self {
        let cells: Vec<Vec<PlacedCell>> = plot.panels.iter().map(MapPanel::placed_cells).collect();
        let all = || cells.iter().flatten().map(|placed| placed.cell);
        let found = |verdict: Verdict| all().any(|cell| cell.verdict == verdict);
        let entries = VERDICTS
            .into_iter()
            .filter(|(verdict, _)| found(*verdict))
            .map(|(verdict, name)| {
                let (marker, colour) = mark(verdict);
                let key = Key {
                    marker: Some(marker),
                    colour,
                    line: None,
                };
                (key, name.to_owned())
            });
        Self {
            plot,
            colours: GrowthColours::spanning(all().filter_map(|cell| cell.growth)),
            legend: Legend::new(entries, units(PICTURE_WIDTH)),
            tiling: Tiling::new(plot.panels.len()),
            cells,
        }
    }

    fn draw_panel<DB: Surface>(
        &self,
        area: &DrawingArea<DB, Shift>,
        panel: &MapPanel,
        cells: &[PlacedCell],
    ) -> Drawn<DB> {
        let inside = panel_of(area, panel)?;
        if cells.is_empty() {
            return inside.note_no_data();
        }
        if let Some(colours) = &self.colours {
            draw_colours(&inside, colours, cells)?;
        }
        draw_marks(&inside, cells)?;
        inside.frame()
    }

    /// Draws the colour bar beside all panels, from the top of the first to the bottom of the last.
    fn draw_colour_bar<DB: Surface>(
        &self,
        colours: &GrowthColours,
        area: &DrawingArea<DB, Shift>,
    ) -> Drawn<DB> {
        let titles = self
            .plot
            .panels
            .iter()
            .take(2)
            .map(|panel| room_above(&panel.title));
        let top = units(titles.fold(0.0, f64::max));
        let bottom = area.dim_in_pixel().1 as i32 - units(room_below());
        let (above, _) = area.split_vertically(bottom);
        let (_, bar) = above.split_vertically(top);
        colours.draw(&bar, &self.plot.growth_label)
    }
}

/// The axes of a panel, without its cells.
pub(super) fn panel_of<DB: Surface>(
    area: &DrawingArea<DB, Shift>,
    panel: &MapPanel,
) -> Drawn<DB, Panel<DB>> {
    let height = inner_height(area, &panel.title);
    let y = axis(&panel.y, |range| {
        Axis::vertical(panel.y.scale, range, height)
    });
    let left = room_left(&y);
    let width = inner_width(area, left);
    let x = axis(&panel.x, |range| {
        Axis::horizontal(panel.x.scale, range, width)
    });
    let axes = Axes {
        title: &panel.title,
        x,
        y,
        x_label: Some(&panel.x.label),
        y_label: &panel.y.label,
        left,
        grid: false,
    };
    Panel::new(area, axes)
}

/// Fills every cell with the colour of its growth factor.
pub(super) fn draw_colours<DB: Surface>(
    inside: &Panel<DB>,
    colours: &GrowthColours,
    cells: &[PlacedCell],
) -> Drawn<DB> {
    for placed in cells {
        if let Some(colour) = placed.cell.growth.and_then(|growth| colours.of(growth)) {
            let (lower, upper) = corners(inside, placed);
            let cell = Rectangle::new([lower, upper], colour.filled());
            inside.area.draw(&cell)?;
        }
    }
    Ok(())
}

fn axis(axis: &MapAxis, with_range: impl FnOnce((f64, f64)) -> Axis) -> Axis {
    let intervals = axis.intervals();
    match (intervals.first(), intervals.last()) {
        (Some(first), Some(last)) => with_range((first.lower, last.upper)),
        _ => Axis::blank(),
    }
}

/// Lower left and upper right corner of a cell, in drawing units.
fn corners<DB: Surface>(inside: &Panel<DB>, placed: &PlacedCell) -> ((i32, i32), (i32, i32)) {
    let corner = |(x, y)| inside.at(inside.x.share(x), inside.y.share(y));
    (corner(placed.lower), corner(placed.upper))
}

fn draw_marks<DB: Surface>(inside: &Panel<DB>, cells: &[PlacedCell]) -> Drawn<DB> {
    let smaller_side = |placed: &PlacedCell| {
        let (lower, upper) = corners(inside, placed);
        (upper.0 - lower.0).min(lower.1 - upper.1)
    };
    let side = cells.iter().map(smaller_side).min().unwrap_or(0);
    let radius = ((MARK_SHARE * f64::from(side)) as i32).clamp(1, units(LARGEST_MARK));
    for placed in cells {
        let (marker, colour) = mark(placed.cell.verdict);
        let lighter = if placed.cell.verdict == Verdict::Stable {
            radius
        } else {
            (radius * 3 / 4).max(1)
        };
        marker.draw(&inside.area, inside.place(placed.centre), lighter, colour)?;
    }
    Ok(())
}

impl Picture for Layout<'_> {
    fn size(&self) -> (u32, u32) {
        (
            PICTURE_WIDTH as u32,
            (self.legend.height() + self.tiling.height()).ceil() as u32,
        )
    }

    fn draw<DB: Surface>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let (head, mut rest) = area.split_vertically(units(self.legend.height()));
        self.legend.draw(&head)?;
        if let Some(colours) = &self.colours {
            let width = rest.dim_in_pixel().0 as i32;
            let (panels, bar) = rest.split_horizontally(width - colours.width());
            self.draw_colour_bar(colours, &bar)?;
            rest = panels;
        }
        let places = self.tiling.places(&rest);
        let panels = self.plot.panels.iter().zip(&self.cells);
        panels
            .zip(&places)
            .try_for_each(|((panel, cells), place)| self.draw_panel(place, panel, cells))
    }
}
