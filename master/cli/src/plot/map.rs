use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::RGBColor;

use super::axis::Reach;
use super::canvas::{Drawn, Picture, Pictured, Surface};
use super::colour::GrowthColours;
use super::error::PlotError;
use super::grid::{MapAxis, MapPanel, PlacedCell, Verdict};
use super::legend::{Key, Legend};
use super::panel::{Labels, Panel, room_above, room_below};
use super::region::{NamedPoint, RegionLine, draw_line, draw_point};
use super::style::{Marker, units};
use super::tiling::{Sheet, check_number};

/// Stability over two parameters, in one or several panels: growth factors as colours of the cells, marks for the
/// verdicts on them, lines and named points on top.
#[derive(Clone, Debug)]
pub struct StabilityMap {
    /// Panels, two in a row, at most 12.
    pub panels: Vec<MapPanel>,
    /// Label of the colour bar, which is drawn if any cell has a growth factor.
    pub growth_label: String,
    /// Whether every cell has a mark; without marks there is nothing to see where no cell has a growth factor.
    pub has_marks: bool,
    /// Lines over every panel, in the order of the legend.
    pub lines: Vec<RegionLine>,
    /// Points with a name in every panel.
    pub points: Vec<NamedPoint>,
}

impl Pictured for StabilityMap {
    fn picture(&self) -> Result<Option<impl Picture>, PlotError> {
        check_number(self.panels.len())?;
        self.panels.iter().try_for_each(MapPanel::check)?;
        let layout = Layout::new(self);
        let has_cells = layout.cells.iter().any(|cells| !cells.is_empty());
        let is_seen = has_cells && (self.has_marks || layout.colours.is_some());
        Ok(is_seen.then_some(layout))
    }
}

/// Radius of a mark as a share of the cell, and its largest size in pixels.
const MARK_SHARE: f64 = 0.3;
const LARGEST_MARK: f64 = 8.0;

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
    sheet: Sheet,
}

impl<'a> Layout<'a> {
    fn new(plot: &'a StabilityMap) -> Self {
        let cells: Vec<Vec<PlacedCell>> = plot.panels.iter().map(MapPanel::placed_cells).collect();
        let all = || cells.iter().flatten().map(|placed| placed.cell);
        let found = |verdict: Verdict| all().any(|cell| cell.verdict == verdict);
        let marked = Verdict::ALL
            .into_iter()
            .filter(|verdict| plot.has_marks && found(*verdict))
            .map(|verdict| {
                let (marker, colour) = mark(verdict);
                let key = Key {
                    marker: Some(marker),
                    colour,
                    line: None,
                };
                (key, verdict.name().to_owned())
            });
        let entries = marked.chain(plot.lines.iter().map(RegionLine::entry));
        Self {
            plot,
            colours: GrowthColours::spanning(all().filter_map(|cell| cell.growth)),
            sheet: Sheet::new(Legend::new(entries), plot.panels.len()),
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
        if self.plot.has_marks {
            draw_marks(&inside, cells)?;
        }
        let (mut lines, mut points) = (self.plot.lines.iter(), self.plot.points.iter());
        lines.try_for_each(|line| draw_line(&inside, line))?;
        points.try_for_each(|point| draw_point(&inside, point))?;
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
fn panel_of<DB: Surface>(area: &DrawingArea<DB, Shift>, panel: &MapPanel) -> Drawn<DB, Panel<DB>> {
    let labels = Labels {
        title: &panel.title,
        x: &panel.x.label,
        y: &panel.y.label,
    };
    Panel::filling(area, &labels, [reach(&panel.x), reach(&panel.y)], false)
}

/// Fills every cell with the colour of its growth factor.
fn draw_colours<DB: Surface>(
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

fn reach(axis: &MapAxis) -> Reach {
    let intervals = axis.intervals();
    let ends = intervals.first().zip(intervals.last());
    let range = ends.map(|(first, last)| (first.lower, last.upper));
    (axis.scale, range)
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
        self.sheet.size()
    }

    fn draw<DB: Surface>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let mut rest = self.sheet.below_legend(area)?;
        if let Some(colours) = &self.colours {
            let width = rest.dim_in_pixel().0 as i32;
            let (panels, bar) = rest.split_horizontally(width - colours.width());
            self.draw_colour_bar(colours, &bar)?;
            rest = panels;
        }
        let places = self.sheet.places(&rest);
        let panels = self.plot.panels.iter().zip(&self.cells);
        panels
            .zip(&places)
            .try_for_each(|((panel, cells), place)| self.draw_panel(place, panel, cells))
    }
}
