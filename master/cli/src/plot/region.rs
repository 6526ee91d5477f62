use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::{Drawn, Picture, Pictured, Surface};
use super::clip::clipped;
use super::colour::GrowthColours;
use super::error::PlotError;
use super::grid::{MapPanel, PlacedCell};
use super::legend::{Key, Legend};
use super::map::{draw_colours, panel_of};
use super::panel::{Panel, room_above, room_below};
use super::style::{LABEL_TEXT, Marker, stroke, text, units};
use super::tiling::Sheet;

/// Growth factors over two parameters as colours, with lines and named points on top.
#[derive(Clone, Debug)]
pub struct RegionPlot {
    /// The factors; verdicts are not marked.
    pub panel: MapPanel,
    /// Label of the colour bar.
    pub growth_label: String,
    /// Lines, in the order of the legend.
    pub lines: Vec<RegionLine>,
    /// Points with a name.
    pub points: Vec<NamedPoint>,
}

/// A line through a [`RegionPlot`].
#[derive(Clone, Debug)]
pub struct RegionLine {
    /// Name in the legend.
    pub name: String,
    /// Whether it is a row of dots.
    pub is_dotted: bool,
    /// Corners; what is outside of the picture is left out.
    pub points: Vec<(f64, f64)>,
}

/// A point of a [`RegionPlot`] with its name beside it.
#[derive(Clone, Debug)]
pub struct NamedPoint {
    /// Its name.
    pub name: String,
    /// Its place.
    pub place: (f64, f64),
}

impl Pictured for RegionPlot {
    fn picture(&self) -> Result<Option<impl Picture>, PlotError> {
        self.panel.check()?;
        let cells = self.panel.placed_cells();
        let growth = cells.iter().filter_map(|placed| placed.cell.growth);
        let colours = GrowthColours::spanning(growth);
        Ok(colours.map(|colours| Layout::new(self, cells, colours)))
    }
}

const LINE_WIDTH: f64 = 2.5;
const DOT_RADIUS: f64 = 2.5;
const DOT_DISTANCE: f64 = 11.0;
const POINT_RADIUS: f64 = 7.0;
const NAME_GAP: f64 = 12.0;

/// A picture with all sizes decided.
struct Layout<'a> {
    plot: &'a RegionPlot,
    cells: Vec<PlacedCell>,
    colours: GrowthColours,
    sheet: Sheet,
}

impl<'a> Layout<'a> {
    fn new(plot: &'a RegionPlot, cells: Vec<PlacedCell>, colours: GrowthColours) -> Self {
        let entry = |line: &RegionLine| {
            let key = Key {
                marker: line.is_dotted.then_some(Marker::Disc),
                colour: BLACK,
                line: (!line.is_dotted).then_some(LINE_WIDTH),
            };
            (key, line.name.clone())
        };
        Self {
            plot,
            cells,
            colours,
            sheet: Sheet::new(Legend::new(plot.lines.iter().map(entry)), 1),
        }
    }
}

fn draw_line<DB: Surface>(inside: &Panel<DB>, line: &RegionLine) -> Drawn<DB> {
    for run in clipped(&line.points, &inside.x, &inside.y) {
        let corners: Vec<(i32, i32)> = run.into_iter().map(|(x, y)| inside.at(x, y)).collect();
        if !line.is_dotted {
            DB::polyline(&inside.area, &corners, stroke(BLACK, LINE_WIDTH))?;
            continue;
        }
        for centre in dots(&corners, f64::from(units(DOT_DISTANCE))) {
            let dot = Circle::new(centre, units(DOT_RADIUS), BLACK.filled());
            inside.area.draw(&dot)?;
        }
    }
    Ok(())
}

/// Places at about equal distances along straight lines, their ends among them.
fn dots(corners: &[(i32, i32)], distance: f64) -> Vec<(i32, i32)> {
    let mut dots = Vec::new();
    for pair in corners.windows(2) {
        let (x, y) = (f64::from(pair[0].0), f64::from(pair[0].1));
        let (dx, dy) = (f64::from(pair[1].0) - x, f64::from(pair[1].1) - y);
        let count = (dx.hypot(dy) / distance).round().max(1.0) as i32;
        dots.extend((0..=count).map(|i| {
            let share = f64::from(i) / f64::from(count);
            (
                (x + share * dx).round() as i32,
                (y + share * dy).round() as i32,
            )
        }));
    }
    dots
}

fn draw_point<DB: Surface>(inside: &Panel<DB>, point: &NamedPoint) -> Drawn<DB> {
    let (x, y) = point.place;
    let is_inside = |share: f64| (0.0..=1.0).contains(&share);
    if !(is_inside(inside.x.position(x)) && is_inside(inside.y.position(y))) {
        return Ok(());
    }
    let centre = inside.place(point.place);
    let ground = Circle::new(centre, units(POINT_RADIUS), WHITE.filled());
    inside.area.draw(&ground)?;
    Marker::Ring.draw(&inside.area, centre, units(POINT_RADIUS), BLACK)?;
    let style = text(LABEL_TEXT, BLACK, HPos::Left, VPos::Bottom);
    let gap = units(NAME_GAP);
    let at = (centre.0 + gap, centre.1 - gap / 2);
    inside.area.draw_text(&point.name, &style, at)
}

impl Picture for Layout<'_> {
    fn size(&self) -> (u32, u32) {
        self.sheet.size()
    }

    fn draw<DB: Surface>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB> {
        let rest = self.sheet.below_legend(area)?;
        let (width, height) = rest.dim_in_pixel();
        let (panel, bar) = rest.split_horizontally(width as i32 - self.colours.width());
        let (above, _) = bar.split_vertically(height as i32 - units(room_below()));
        let (_, bar) = above.split_vertically(units(room_above(&self.plot.panel.title)));
        self.colours.draw(&bar, &self.plot.growth_label)?;

        let inside = panel_of(&panel, &self.plot.panel)?;
        draw_colours(&inside, &self.colours, &self.cells)?;
        let mut lines = self.plot.lines.iter();
        lines.try_for_each(|line| draw_line(&inside, line))?;
        let mut points = self.plot.points.iter();
        points.try_for_each(|point| draw_point(&inside, point))?;
        inside.frame()
    }
}
