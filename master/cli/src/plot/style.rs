use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{RGBColor, ShapeStyle, TextStyle};

use super::canvas::{Drawn, FONT_FAMILY, Surface};

/// Drawing units in one pixel of the picture: plotters has whole coordinates, and curves need finer ones.
pub(super) const UNITS_PER_PIXEL: i32 = 3;

/// Text heights (em) in pixels.
pub(super) const TICK_TEXT: f64 = 20.0;
pub(super) const LABEL_TEXT: f64 = 22.0;
pub(super) const TITLE_TEXT: f64 = 24.0;

pub(super) const GRID: RGBColor = RGBColor(226, 226, 226);
pub(super) const FINE_GRID: RGBColor = RGBColor(242, 242, 242);
pub(super) const FRAME: RGBColor = RGBColor(60, 60, 60);
pub(super) const REFERENCE: RGBColor = RGBColor(176, 176, 176);
pub(super) const REFERENCE_TEXT: RGBColor = RGBColor(120, 120, 120);

/// Number of colours.
pub(crate) const PALETTE_SIZE: usize = 7;

/// Okabe and Ito, "Color Universal Design" (2008), without the yellow that vanishes on white.
const PALETTE: [RGBColor; PALETTE_SIZE] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 0, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
];

/// plotters divides a font size by this to get the em.
const SIZE_PER_EM: f64 = 1.24;

/// Pixels in drawing units.
pub(super) fn units(pixels: f64) -> i32 {
    (pixels * f64::from(UNITS_PER_PIXEL)).round() as i32
}

fn font(em: f64) -> FontDesc<'static> {
    FontDesc::new(
        FontFamily::Name(FONT_FAMILY),
        em * SIZE_PER_EM * f64::from(UNITS_PER_PIXEL),
        FontStyle::Normal,
    )
}

/// Text of the given height in pixels, anchored as told.
pub(super) fn text(
    em: f64,
    colour: RGBColor,
    horizontal: HPos,
    vertical: VPos,
) -> TextStyle<'static> {
    font(em).color(&colour).pos(Pos::new(horizontal, vertical))
}

/// Width of a text in drawing units. The font is embedded, so that measuring fails only where drawing reports it.
pub(super) fn text_width(text: &str, em: f64) -> i32 {
    font(em).box_size(text).map_or(0, |(width, _)| width as i32)
}

/// The text, shortened with an ellipsis if it is wider than `width` drawing units.
pub(super) fn fitted(text: &str, em: f64, width: i32) -> String {
    if text_width(text, em) <= width {
        return text.to_owned();
    }
    let mut kept = text.to_owned();
    while kept.pop().is_some() {
        let shortened = format!("{}…", kept.trim_end());
        if text_width(&shortened, em) <= width {
            return shortened;
        }
    }
    String::new()
}

/// A line of the given width in pixels.
pub(super) fn stroke(colour: RGBColor, pixels: f64) -> ShapeStyle {
    ShapeStyle {
        color: colour.to_rgba(),
        filled: false,
        stroke_width: units(pixels).unsigned_abs(),
    }
}

/// Shape of a data point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Marker {
    Disc,
    Square,
    Triangle,
    Diamond,
    Cross,
    Plus,
    TriangleDown,
    Ring,
    Bar,
}

const MARKERS: [Marker; 7] = [
    Marker::Disc,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Cross,
    Marker::Plus,
    Marker::TriangleDown,
];

/// Red, green and blue of the n-th colour; they come again after [`PALETTE_SIZE`].
pub(crate) fn palette_colour(index: usize) -> [u8; 3] {
    let RGBColor(red, green, blue) = PALETTE[index % PALETTE_SIZE];
    [red, green, blue]
}

/// Colour and marker of the n-th curve: 49 pairs, neighbours differ in both.
pub(super) fn curve_style(index: usize) -> (RGBColor, Marker) {
    let round = index / PALETTE_SIZE;
    (
        PALETTE[index % PALETTE_SIZE],
        MARKERS[(index + round) % MARKERS.len()],
    )
}

impl Marker {
    /// Draws the marker around a centre; `radius` is that of the disc of equal weight, in drawing units.
    pub(super) fn draw<DB: Surface>(
        self,
        area: &DrawingArea<DB, Shift>,
        centre: (i32, i32),
        radius: i32,
        colour: RGBColor,
    ) -> Drawn<DB> {
        let line = ShapeStyle {
            color: colour.to_rgba(),
            filled: false,
            stroke_width: (radius / 3).max(2) as u32,
        };
        let around = |shares: &[(f64, f64)]| -> Vec<(i32, i32)> {
            let place =
                |centre: i32, share: f64| centre + (share * f64::from(radius)).round() as i32;
            shares
                .iter()
                .map(|&(x, y)| (place(centre.0, x), place(centre.1, y)))
                .collect()
        };
        let filled =
            |corners: &[(f64, f64)]| area.draw(&Polygon::new(around(corners), colour.filled()));
        let path = |points: &[(f64, f64)]| DB::polyline(area, &around(points), line);
        match self {
            Self::Disc => area.draw(&Circle::new(centre, radius, colour.filled())),
            Self::Ring => area.draw(&Circle::new(centre, radius, line)),
            Self::Square => filled(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
            Self::Triangle => filled(&[(0.0, -1.25), (1.1, 0.75), (-1.1, 0.75)]),
            Self::TriangleDown => filled(&[(0.0, 1.25), (1.1, -0.75), (-1.1, -0.75)]),
            Self::Diamond => filled(&[(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)]),
            Self::Cross => path(&[
                (-0.9, -0.9),
                (0.9, 0.9),
                (0.0, 0.0),
                (0.9, -0.9),
                (-0.9, 0.9),
            ]),
            Self::Bar => path(&[(0.0, -2.2), (0.0, 2.2)]),
            Self::Plus => path(&[(-1.2, 0.0), (1.2, 0.0), (0.0, 0.0), (0.0, -1.2), (0.0, 1.2)]),
        }
    }
}
