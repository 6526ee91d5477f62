use std::path::PathBuf;

use plotters::drawing::DrawingAreaErrorKind;

/// Why a picture was not written.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    /// No panel contains a point that can be drawn.
    #[error(
        "nothing to draw for {}: every point is missing, not finite, or not positive on a logarithmic axis",
        stem.display()
    )]
    NoData {
        /// Path of the picture without its extension.
        stem: PathBuf,
    },
    /// The times of a series go backwards.
    #[error(
        "series `{series}`: time {time} at index {index} follows {before}; times must not decrease"
    )]
    TimeDecreases {
        /// Name of the series.
        series: String,
        /// Index of the earlier time.
        index: usize,
        /// Time before it.
        before: f64,
        /// The time itself.
        time: f64,
    },
    /// The grid values of a map are not an increasing sequence.
    #[error(
        "map `{panel}`, axis `{axis}`: value {value} at index {index} must be finite and above the one before"
    )]
    GridOrder {
        /// Title of the panel.
        panel: String,
        /// Label of the axis.
        axis: String,
        /// Index of the value.
        index: usize,
        /// The value.
        value: f64,
    },
    /// A map has not one cell for each pair of grid values.
    #[error(
        "map `{panel}` has {cells} cells for a grid of {columns} columns and {rows} rows; it needs columns * rows"
    )]
    CellCount {
        /// Title of the panel.
        panel: String,
        /// Number of cells.
        cells: usize,
        /// Number of x values.
        columns: usize,
        /// Number of y values.
        rows: usize,
    },
    /// More panels than a picture holds.
    #[error(
        "{panels} panels are too many for one picture, {allowed} are allowed; write several pictures"
    )]
    TooManyPanels {
        /// Number of panels given.
        panels: usize,
        /// Largest number allowed.
        allowed: usize,
    },
    /// The SVG file could not be written.
    #[error("cannot write {}: its directory must exist and be writable", path.display())]
    WriteSvg {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The PNG file could not be written.
    #[error("cannot write {}: its directory must exist and be writable", path.display())]
    WritePng {
        /// The file.
        path: PathBuf,
        /// What the encoder said.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// The embedded font is damaged.
    #[error("the font embedded in this program cannot be read; build it again from clean sources")]
    Font,
    /// The drawing library refused a shape or a text.
    #[error("cannot draw {}: {reason}", stem.display())]
    Drawing {
        /// Path of the picture without its extension.
        stem: PathBuf,
        /// What the library said.
        reason: String,
    },
}

impl PlotError {
    pub(super) fn drawing<E: std::error::Error + Send + Sync>(
        stem: &std::path::Path,
        error: &DrawingAreaErrorKind<E>,
    ) -> Self {
        Self::Drawing {
            stem: stem.to_path_buf(),
            reason: error.to_string(),
        }
    }
}
