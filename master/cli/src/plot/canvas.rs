use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use plotters::coord::Shift;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::*;
use plotters::style::{ShapeStyle, register_font};

use super::error::PlotError;
use super::style::UNITS_PER_PIXEL;

/// Name under which the embedded font is registered. The SVG carries it as its font list, and so looks for the same
/// font, or one with the same widths, on the reader's machine.
pub(super) const FONT_FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";

static FONT: &[u8] = include_bytes!("../../assets/DejaVuSans-subset.ttf");

const CHANNELS: usize = 3;

/// Result of drawing on the backend `DB`.
pub type Drawn<DB, T = ()> = Result<T, DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>>;

/// A backend with its own way to draw a line through many points.
pub trait Surface: DrawingBackend {
    /// Draws straight lines between neighbouring points.
    fn polyline(
        area: &DrawingArea<Self, Shift>,
        points: &[(i32, i32)],
        style: ShapeStyle,
    ) -> Drawn<Self>;
}

impl Surface for SVGBackend<'_> {
    fn polyline(
        area: &DrawingArea<Self, Shift>,
        points: &[(i32, i32)],
        style: ShapeStyle,
    ) -> Drawn<Self> {
        area.draw(&PathElement::new(points, style))
    }
}

/// Every segment by itself with round joins: plotters 0.3.7 fills the outline of a bent line as one polygon, which
/// leaves long spikes at sharp turns.
impl Surface for BitMapBackend<'_> {
    fn polyline(
        area: &DrawingArea<Self, Shift>,
        points: &[(i32, i32)],
        style: ShapeStyle,
    ) -> Drawn<Self> {
        let join = style.stroke_width / 2;
        for (index, segment) in points.windows(2).enumerate() {
            if index > 0 {
                area.draw(&Circle::new(segment[0], join, style.filled()))?;
            }
            area.draw(&PathElement::new(segment, style))?;
        }
        Ok(())
    }
}

/// Kinds of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// `STEM.svg`
    Svg,
    /// `STEM.png`
    Png,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Svg, Self::Png];

    /// Ending of its files.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
        }
    }
}

/// Something that can be drawn.
pub trait Chart {
    /// Writes `STEM.svg` and `STEM.png`.
    ///
    /// # Errors
    /// [`PlotError`]: data that do not fit together, too many panels, no point to draw, unwritable path.
    fn write(&self, stem: &Path) -> Result<(), PlotError> {
        self.write_as(stem, &Format::ALL).map(|_| ())
    }

    /// Writes files of these kinds beside each other; their paths.
    ///
    /// # Errors
    /// As for [`Chart::write`].
    fn write_as(&self, stem: &Path, formats: &[Format]) -> Result<Vec<PathBuf>, PlotError>;

    /// The same picture as the text of an SVG, for a page; `name` is its name in errors.
    ///
    /// # Errors
    /// [`PlotError`], as for [`Chart::write`], but for the path.
    fn svg(&self, name: &str) -> Result<String, PlotError>;
}

impl<T: Pictured> Chart for T {
    fn write_as(&self, stem: &Path, formats: &[Format]) -> Result<Vec<PathBuf>, PlotError> {
        let picture = decided(self, stem)?;
        let write = |format: &Format| match format {
            Format::Svg => write_svg(&picture, stem),
            Format::Png => write_png(&picture, stem),
        };
        formats.iter().map(write).collect()
    }

    fn svg(&self, name: &str) -> Result<String, PlotError> {
        let stem = Path::new(name);
        svg(&decided(self, stem)?, stem)
    }
}

/// A chart whose sizes can be decided.
pub trait Pictured {
    /// Its picture; `None` if it has no point to draw.
    fn picture(&self) -> Result<Option<impl Picture>, PlotError>;
}

fn decided<'a>(chart: &'a impl Pictured, stem: &Path) -> Result<impl Picture + 'a, PlotError> {
    embed_font()?;
    chart.picture()?.ok_or_else(|| PlotError::NoData {
        stem: stem.to_path_buf(),
    })
}

/// Something of a fixed size that can be drawn on any surface.
pub trait Picture {
    /// Width and height in pixels.
    fn size(&self) -> (u32, u32);

    /// Draws the picture in drawing units, on a white ground.
    fn draw<DB: Surface>(&self, area: &DrawingArea<DB, Shift>) -> Drawn<DB>;
}

/// Makes the embedded font known to plotters; needed before any text is measured.
fn embed_font() -> Result<(), PlotError> {
    static REGISTERED: OnceLock<bool> = OnceLock::new();
    let readable =
        REGISTERED.get_or_init(|| register_font(FONT_FAMILY, FontStyle::Normal, FONT).is_ok());
    readable.then_some(()).ok_or(PlotError::Font)
}

fn with_ending(stem: &Path, format: Format) -> PathBuf {
    let mut path = OsString::from(stem);
    path.push(".");
    path.push(format.ending());
    path.into()
}

fn fine_size(picture: &impl Picture) -> (u32, u32) {
    let (width, height) = picture.size();
    (
        width * UNITS_PER_PIXEL.unsigned_abs(),
        height * UNITS_PER_PIXEL.unsigned_abs(),
    )
}

fn paint<DB: Surface>(picture: &impl Picture, backend: DB, stem: &Path) -> Result<(), PlotError> {
    let area = backend.into_drawing_area();
    area.fill(&WHITE)
        .and_then(|()| picture.draw(&area))
        .and_then(|()| area.present())
        .map_err(|error| PlotError::drawing(stem, &error))
}

fn write_svg(picture: &impl Picture, stem: &Path) -> Result<PathBuf, PlotError> {
    let path = with_ending(stem, Format::Svg);
    match std::fs::write(&path, svg(picture, stem)?) {
        Ok(()) => Ok(path),
        Err(source) => Err(PlotError::WriteSvg { path, source }),
    }
}

fn svg(picture: &impl Picture, stem: &Path) -> Result<String, PlotError> {
    let mut drawing = String::new();
    paint(
        picture,
        SVGBackend::with_string(&mut drawing, fine_size(picture)),
        stem,
    )?;
    Ok(in_pixels(&drawing, picture))
}

/// The drawing shown at the size of the picture, with the round line joins of the PNG and no seams between rectangles.
fn in_pixels(drawing: &str, picture: &impl Picture) -> String {
    const STYLE: &str =
        "<style>svg{stroke-linejoin:round} rect{shape-rendering:crispEdges}</style>";
    let (width, height) = picture.size();
    let (fine_width, fine_height) = fine_size(picture);
    let namespace = r#"xmlns="http://www.w3.org/2000/svg">"#;
    drawing
        .replacen(
            &format!(r#"width="{fine_width}" height="{fine_height}""#),
            &format!(r#"width="{width}" height="{height}""#),
            1,
        )
        .replacen(namespace, &format!("{namespace}\n{STYLE}"), 1)
        .replace(r#" opacity="1""#, "")
}

fn write_png(picture: &impl Picture, stem: &Path) -> Result<PathBuf, PlotError> {
    let fine_size = fine_size(picture);
    let mut fine = vec![0; fine_size.0 as usize * fine_size.1 as usize * CHANNELS];
    paint(
        picture,
        BitMapBackend::with_buffer(&mut fine, fine_size),
        stem,
    )?;
    let path = with_ending(stem, Format::Png);
    let mut file = BitMapBackend::new(&path, picture.size());
    let pixels = averaged(&fine, fine_size.0 as usize);
    let written = file
        .blit_bitmap((0, 0), picture.size(), &pixels)
        .and_then(|()| file.present());
    drop(file);
    match written {
        Ok(()) => Ok(path),
        Err(source) => Err(PlotError::WritePng {
            path,
            source: source.into(),
        }),
    }
}

/// One pixel for each square of drawing units: plotters does not smooth slanted edges.
fn averaged(fine: &[u8], fine_width: usize) -> Vec<u8> {
    let side = UNITS_PER_PIXEL.unsigned_abs() as usize;
    let fine_row = fine_width * CHANNELS;
    let mut pixels = Vec::with_capacity(fine.len() / (side * side));
    for rows in fine.chunks_exact(fine_row * side) {
        for column in (0..fine_row).step_by(side * CHANNELS) {
            for channel in 0..CHANNELS {
                let square = (0..side)
                    .flat_map(|row| (0..side).map(move |step| row * fine_row + step * CHANNELS));
                let sum: usize = square
                    .map(|offset| usize::from(rows[column + channel + offset]))
                    .sum();
                pixels.push((sum / (side * side)) as u8);
            }
        }
    }
    pixels
}
