use plotters::coord::Shift;
use plotters::prelude::*;

use super::canvas::{Drawn, Surface};
use super::error::PlotError;
use super::legend::Legend;
use super::style::units;

/// Width in pixels of every picture.
pub(super) const PICTURE_WIDTH: f64 = 1200.0;

const SINGLE_PANEL_HEIGHT: f64 = 760.0;
const PANEL_HEIGHT: f64 = 520.0;
const MOST_PANELS: usize = 12;

/// Refuses more panels than a picture holds.
pub(super) fn check_number(panels: usize) -> Result<(), PlotError> {
    if panels > MOST_PANELS {
        return Err(PlotError::TooManyPanels {
            panels,
            allowed: MOST_PANELS,
        });
    }
    Ok(())
}

/// A legend above panels of equal size.
pub(super) struct Sheet {
    legend: Legend,
    tiling: Tiling,
}

impl Sheet {
    pub(super) fn new(legend: Legend, panels: usize) -> Self {
        let tiling = Tiling::new(panels);
        Self { legend, tiling }
    }

    /// Width and height in pixels.
    pub(super) fn size(&self) -> (u32, u32) {
        let height = self.legend.height() + self.tiling.height();
        (PICTURE_WIDTH as u32, height.ceil() as u32)
    }

    /// Draws the legend and gives back what is below it.
    pub(super) fn below_legend<DB: Surface>(
        &self,
        area: &DrawingArea<DB, Shift>,
    ) -> Drawn<DB, DrawingArea<DB, Shift>> {
        let (head, rest) = area.split_vertically(units(self.legend.height()));
        self.legend.draw(&head)?;
        Ok(rest)
    }

    /// The places of the panels in what is below the legend.
    pub(super) fn places<DB: Surface>(
        &self,
        area: &DrawingArea<DB, Shift>,
    ) -> Vec<DrawingArea<DB, Shift>> {
        self.tiling.places(area)
    }
}

/// Equal places for panels: one, or two in a row.
pub(super) struct Tiling {
    rows: usize,
    columns: usize,
}

impl Tiling {
    pub(super) fn new(panels: usize) -> Self {
        let columns = panels.clamp(1, 2);
        Self {
            rows: panels.div_ceil(columns),
            columns,
        }
    }

    /// Height in pixels.
    pub(super) fn height(&self) -> f64 {
        let panel = if self.columns == 1 {
            SINGLE_PANEL_HEIGHT
        } else {
            PANEL_HEIGHT
        };
        self.rows as f64 * panel
    }

    /// The places row by row.
    pub(super) fn places<DB: Surface>(
        &self,
        area: &DrawingArea<DB, Shift>,
    ) -> Vec<DrawingArea<DB, Shift>> {
        area.split_evenly((self.rows, self.columns))
    }
}
