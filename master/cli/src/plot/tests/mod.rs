#![allow(clippy::unwrap_used)]

mod charts;
mod errors;
mod odd_data;
mod portraits;
mod quantities;
mod read;
mod spectra;

use std::path::PathBuf;

use super::*;

/// A directory of its own for one test, removed afterwards.
struct Directory(PathBuf);

impl Directory {
    fn new(test: &str) -> Self {
        let name = format!("linchpin-plot-{}-{test}", std::process::id());
        let path = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn stem(&self) -> PathBuf {
        self.0.join("H=0.5e-3")
    }

    fn svg(&self) -> read::Svg {
        read::Svg::parse(&std::fs::read_to_string(self.0.join("H=0.5e-3.svg")).unwrap())
    }

    fn png_size(&self) -> (u32, u32) {
        let bytes = std::fs::read(self.0.join("H=0.5e-3.png")).unwrap();
        assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
        let number = |from: usize| u32::from_be_bytes(bytes[from..from + 4].try_into().unwrap());
        (number(16), number(20))
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        std::fs::remove_dir_all(&self.0).unwrap();
    }
}

fn time_panel(y_label: &str, y_scale: Scale, series: Vec<Curve>) -> TimePanel {
    TimePanel {
        y_label: y_label.into(),
        y_scale,
        series,
    }
}

fn over_time(panels: Vec<TimePanel>) -> TimePanels {
    TimePanels {
        title: None,
        time_label: "t (s)".into(),
        panels,
        ..TimePanels::default()
    }
}

fn curve(name: &str, points: impl IntoIterator<Item = (f64, f64)>) -> Curve {
    Curve {
        name: name.into(),
        points: points.into_iter().collect(),
    }
}

fn convergence_panel(title: &str, curves: Vec<Curve>, slopes: &[f64]) -> CurvePanel {
    CurvePanel {
        title: title.into(),
        reference_slopes: slopes.to_vec(),
        ..CurvePanel::of_errors("macro step H (s)", "error of x₁ (m)", curves)
    }
}

fn map_panel(
    title: &str,
    x: Vec<f64>,
    y: Vec<f64>,
    cell: impl Fn(f64, f64) -> MapCell,
) -> MapPanel {
    let pairs = y.iter().flat_map(|y| x.iter().map(|x| (*x, *y)));
    let cells = pairs.map(|(x, y)| cell(x, y)).collect();
    let axis = |label: &str, values| MapAxis {
        label: label.into(),
        scale: Scale::Logarithmic,
        values,
    };
    MapPanel {
        title: title.into(),
        x: axis("stiffness c (N/m)", x),
        y: axis("damping d (N s/m)", y),
        cells,
    }
}

fn stability_map(panels: Vec<MapPanel>, growth_label: &str) -> StabilityMap {
    StabilityMap {
        panels,
        growth_label: growth_label.into(),
        has_marks: true,
        lines: Vec::new(),
        points: Vec::new(),
    }
}

/// `count` values from `first` to `last` in equal ratios.
fn ratios(count: u32, first: f64, last: f64) -> Vec<f64> {
    (0..count)
        .map(|i| first * (last / first).powf(f64::from(i) / f64::from(count - 1)))
        .collect()
}
