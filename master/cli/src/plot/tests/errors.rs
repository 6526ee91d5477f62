use super::*;

fn constant() -> TimePanels {
    over_time(vec![time_panel(
        "y",
        Scale::Linear,
        vec![curve("y", [(0.0, 1.0), (1.0, 1.0)])],
    )])
}

fn square(cells: usize) -> MapPanel {
    let cell = |_: f64, _: f64| MapCell {
        verdict: Verdict::Stable,
        growth: None,
    };
    let mut panel = map_panel("k = 2", vec![1.0, 2.0], vec![1.0, 2.0], cell);
    panel.cells.truncate(cells);
    panel
}

fn map_error(panel: MapPanel) -> PlotError {
    let directory = Directory::new("map-error");
    let plot = stability_map(vec![panel], "ρ");
    plot.write(&directory.stem()).unwrap_err()
}

#[test]
fn a_missing_directory_is_named() {
    let stem = std::env::temp_dir()
        .join("linchpin-no-such-directory")
        .join("x");
    let error = constant().write(&stem).unwrap_err();
    assert!(
        matches!(&error, PlotError::WriteSvg { path, .. } if path.ends_with("x.svg")),
        "{error}"
    );
    assert!(
        error.to_string().contains("linchpin-no-such-directory"),
        "{error}"
    );
}

#[test]
fn a_directory_in_place_of_the_png_is_named() {
    let directory = Directory::new("png");
    std::fs::create_dir(directory.0.join("H=0.5e-3.png")).unwrap();
    let error = constant().write(&directory.stem()).unwrap_err();
    assert!(
        matches!(&error, PlotError::WritePng { path, .. } if path.is_dir()),
        "{error}"
    );
}

#[test]
fn times_that_go_backwards_are_refused() {
    let points = [(0.0, 1.0), (0.5, 1.0), (0.5, 2.0), (0.25, 1.0)];
    let plot = over_time(vec![time_panel(
        "y",
        Scale::Linear,
        vec![curve("y", points)],
    )]);
    let error = plot
        .write(&std::env::temp_dir().join("unused"))
        .unwrap_err();
    assert!(
        matches!(error, PlotError::TimeDecreases { index: 3, .. }),
        "{error}"
    );
}

#[test]
fn pictures_without_panels_or_with_too_many_are_refused() {
    let stem = std::env::temp_dir().join("unused");
    assert!(matches!(
        over_time(vec![]).write(&stem),
        Err(PlotError::NoData { .. })
    ));
    assert!(matches!(
        CurvePlot { panels: vec![] }.write(&stem),
        Err(PlotError::NoData { .. })
    ));
    let empty = stability_map(vec![], "");
    assert!(matches!(empty.write(&stem), Err(PlotError::NoData { .. })));
    let mut crowded = constant();
    crowded.panels = vec![crowded.panels[0].clone(); 13];
    let error = crowded.write(&stem).unwrap_err();
    assert!(
        matches!(
            error,
            PlotError::TooManyPanels {
                panels: 13,
                allowed: 12
            }
        ),
        "{error}"
    );
}

#[test]
fn a_map_needs_a_cell_for_each_pair() {
    let error = map_error(square(3));
    assert!(
        matches!(
            error,
            PlotError::CellCount {
                cells: 3,
                columns: 2,
                rows: 2,
                ..
            }
        ),
        "{error}"
    );
}

#[test]
fn grid_values_must_increase_and_be_finite() {
    for (values, wrong) in [
        ([2.0, 2.0], 1),
        ([f64::NAN, 2.0], 0),
        ([1.0, f64::INFINITY], 1),
    ] {
        let mut panel = square(4);
        panel.y.values = values.to_vec();
        let error = map_error(panel);
        assert!(
            matches!(&error, PlotError::GridOrder { index, .. } if *index == wrong),
            "{error}"
        );
        assert!(error.to_string().contains("damping d"), "{error}");
    }
}

#[test]
fn a_logarithmic_axis_without_positive_values_has_nothing_to_draw() {
    let mut panel = square(4);
    panel.y.values = vec![-2.0, -1.0];
    assert!(matches!(map_error(panel), PlotError::NoData { .. }));
}
