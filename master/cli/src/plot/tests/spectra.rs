use super::*;

const BLUE: &str = "#0072B2";

fn radius(x_range: Option<(f64, f64)>, points: &[(f64, f64)]) -> CurvePlot {
    let panel = CurvePanel {
        title: String::new(),
        x_label: "dt / T".into(),
        y_label: "spectral radius".into(),
        scales: [Scale::Logarithmic, Scale::Linear],
        x_range,
        y_range: Some((0.0, 1.25)),
        curves: vec![curve("Moreau", points.iter().copied())],
        markers: Markers::Spread,
        reference_slopes: Vec::new(),
    };
    CurvePlot {
        panels: vec![panel.clone(), panel],
    }
}

#[test]
fn curves_end_at_the_edge_of_their_panel() {
    let directory = Directory::new("curves");
    let plot = radius(
        Some((1e-2, 1e2)),
        &[(1e-2, 1.0), (0.3, 1.0), (0.4, 4.0), (1e2, 4e5)],
    );
    plot.write(&directory.stem()).unwrap();
    let svg = directory.svg();
    assert_eq!(svg.shown_size(), directory.png_size());
    svg.assert_legible();
    for label in ["Moreau", "dt / T", "spectral radius", "0.01", "100", "1.2"] {
        let texts = svg.texts();
        assert!(texts.contains(&label), "{label} is missing in {texts:?}");
    }
    let lines = svg.polylines(BLUE);
    let in_panels: Vec<_> = lines.iter().filter(|line| line.len() == 3).collect();
    assert_eq!(in_panels.len(), 2, "{lines:?}");
    let [level, _, top] = in_panels[0][..] else {
        panic!("three corners");
    };
    assert!(top.1 < level.1 && top.0 > level.0, "{lines:?}");
}

#[test]
fn curves_without_a_point_to_draw_are_refused() {
    let directory = Directory::new("no-curves");
    for plot in [
        radius(None, &[]),
        radius(None, &[(-1.0, 1.0), (1.0, f64::NAN)]),
        radius(Some((1e-2, 1.0)), &[(2.0, 1.0), (3.0, 1.0)]),
    ] {
        let error = plot.write(&directory.stem()).unwrap_err();
        assert!(matches!(error, PlotError::NoData { .. }), "{error}");
    }
    let mut plot = radius(None, &[(1.0, 1.0), (2.0, 1.0)]);
    plot.panels = vec![plot.panels[0].clone(); 13];
    let error = plot.write(&directory.stem()).unwrap_err();
    assert!(matches!(error, PlotError::TooManyPanels { .. }), "{error}");
}

fn plane(growth: Option<f64>) -> StabilityMap {
    let cell = |_: f64, _: f64| MapCell {
        verdict: Verdict::Stable,
        growth,
    };
    let panel = map_panel("", vec![1.0, 10.0, 100.0], vec![1.0, 10.0, 100.0], cell);
    StabilityMap {
        has_marks: false,
        lines: vec![
            RegionLine {
                name: "limit".into(),
                is_dotted: false,
                points: vec![(1.0, 1.0), (1e4, 1e4)],
            },
            RegionLine {
                name: "equal roots".into(),
                is_dotted: true,
                points: vec![(1.0, 10.0), (100.0, 10.0)],
            },
        ],
        points: [("A", 10.0), ("outside", 1e6)]
            .map(|(name, x)| NamedPoint {
                name: name.into(),
                place: (x, 10.0),
            })
            .to_vec(),
        ..stability_map(vec![panel], "spectral radius")
    }
}

#[test]
fn a_region_has_its_lines_and_the_names_of_points_within() {
    let directory = Directory::new("region");
    plane(Some(0.5)).write(&directory.stem()).unwrap();
    let svg = directory.svg();
    assert_eq!(svg.shown_size(), directory.png_size());
    svg.assert_legible();
    let texts = svg.texts();
    for label in ["limit", "equal roots", "A", "spectral radius"] {
        assert!(texts.contains(&label), "{label} is missing in {texts:?}");
    }
    assert!(!texts.contains(&"outside"), "{texts:?}");
    assert!(svg.count("circle", "fill", "#000000") > 20);
}

#[test]
fn a_region_without_a_factor_or_a_cell_is_refused() {
    let directory = Directory::new("no-region");
    let error = plane(None).write(&directory.stem()).unwrap_err();
    assert!(matches!(error, PlotError::NoData { .. }), "{error}");
    let mut plot = plane(Some(0.5));
    plot.panels[0].cells.pop();
    let error = plot.write(&directory.stem()).unwrap_err();
    assert!(matches!(error, PlotError::CellCount { .. }), "{error}");
}
