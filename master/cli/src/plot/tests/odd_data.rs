use super::*;

/// Sequences that trip up careless arithmetic.
fn sequences() -> Vec<Vec<f64>> {
    vec![
        vec![],
        vec![f64::NAN; 3],
        vec![f64::INFINITY, f64::NEG_INFINITY],
        vec![0.0],
        vec![-3.7],
        vec![5.0; 4],
        vec![-1e-7; 2],
        vec![1e-300, 2e-300, 3e-300],
        vec![0.0, 5e-324, 1e-310],
        vec![f64::MIN, f64::MAX],
        vec![-1e300, 1e300],
        vec![1e-300, 1e300],
        vec![0.0, -1.0, 1e-9, f64::NAN, 1e9],
        vec![1.0, 1.0 + f64::EPSILON, 1.0 - f64::EPSILON],
        vec![1e15, 1e15 + 1.0, 1e15 + 2.0],
        vec![9.9e-5, 1.01e-4],
        vec![f64::NAN, 2.0, f64::NAN, 3.0, f64::NAN],
    ]
}

fn holds_any(scale: Scale, values: &[f64]) -> bool {
    values.iter().any(|value| {
        value.is_finite() && value.abs() <= 1e300 && (scale == Scale::Linear || *value >= 1e-300)
    })
}

/// The picture is legible, or it is refused for want of data and was to be.
fn assert_drawn_or_refused(
    directory: &Directory,
    outcome: Result<(), PlotError>,
    drawable: bool,
    data: &str,
) {
    match outcome {
        Ok(()) => {
            assert!(drawable, "drawn: {data}");
            directory.svg().assert_legible();
        }
        Err(error) => {
            assert!(matches!(error, PlotError::NoData { .. }), "{error}: {data}");
            assert!(!drawable, "refused: {data}");
        }
    }
}

#[test]
fn any_values_over_time_are_drawn_or_refused() {
    let directory = Directory::new("odd-values");
    for scale in [Scale::Linear, Scale::Logarithmic] {
        for values in sequences() {
            let points = values
                .iter()
                .enumerate()
                .map(|(i, value)| (i as f64, *value));
            let panel = time_panel("y (m)", scale, vec![curve("y", points)]);
            let outcome = over_time(vec![panel]).write(&directory.stem());
            assert_drawn_or_refused(
                &directory,
                outcome,
                holds_any(scale, &values),
                &format!("{scale:?} {values:?}"),
            );
        }
    }
}

#[test]
fn any_times_are_drawn_or_refused() {
    let directory = Directory::new("odd-times");
    for mut times in sequences() {
        times.sort_by(f64::total_cmp);
        let points = times.iter().map(|t| (*t, 0.25));
        let panel = time_panel("y (m)", Scale::Linear, vec![curve("y", points)]);
        let outcome = over_time(vec![panel]).write(&directory.stem());
        assert_drawn_or_refused(
            &directory,
            outcome,
            holds_any(Scale::Linear, &times),
            &format!("{times:?}"),
        );
    }
}

#[test]
fn any_points_converge_or_are_refused() {
    let directory = Directory::new("odd-points");
    for values in sequences() {
        for (x, y) in [
            (&values, &vec![1e-3; values.len()]),
            (&vec![1e-3; values.len()], &values),
            (&values, &values),
        ] {
            let points = x.iter().copied().zip(y.iter().copied());
            let slopes = [0.0, 1.0, -2.0, 1e300, -1e-300, f64::NAN, f64::INFINITY];
            let panel = convergence_panel("odd", vec![curve("method", points)], &slopes);
            let plot = CurvePlot {
                panels: vec![panel],
            };
            let outcome = plot.write(&directory.stem());
            let drawable = holds_any(Scale::Logarithmic, &values);
            match outcome {
                Ok(()) => assert!(drawable, "drawn: {values:?}"),
                Err(error) => assert!(
                    matches!(error, PlotError::NoData { .. }) && !drawable,
                    "{error}: {values:?}"
                ),
            }
        }
    }
}

fn assert_map_is_legible(directory: &Directory, scale: Scale, grid: &[f64], growth: &[f64]) {
    let cell = |x: f64, y: f64| MapCell {
        verdict: Verdict::Unstable,
        growth: growth.get(((x + y).abs() % 4.0) as usize).copied(),
    };
    let mut panel = map_panel("odd", grid.to_vec(), grid.to_vec(), cell);
    panel.x.scale = scale;
    let plot = stability_map(vec![panel], "ρ");
    plot.write(&directory.stem()).unwrap();
    directory.svg().assert_legible();
}

#[test]
fn any_growth_is_drawn() {
    let directory = Directory::new("odd-growth");
    for growth in sequences() {
        assert_map_is_legible(&directory, Scale::Linear, &[1e-9, 1.0, 2.1, 3.7], &growth);
    }
}

#[test]
fn any_grid_is_drawn() {
    let directory = Directory::new("odd-grid");
    let grids: [&[f64]; 5] = [
        &[3.0],
        &[-1.0, 0.0, 2.0],
        &[1e-300, 1e300],
        &[1.0, 1.0 + 1e-9],
        &[1.0, 1.0 + f64::EPSILON],
    ];
    for scale in [Scale::Linear, Scale::Logarithmic] {
        for grid in grids {
            assert_map_is_legible(&directory, scale, grid, &[0.5, 1.5]);
        }
    }
}
