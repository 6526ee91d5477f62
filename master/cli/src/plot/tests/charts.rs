use super::*;

const BLUE: &str = "#0072B2";
const REFERENCE: &str = "#B0B0B0";
const RING: &str = "#000000";
const CROSS: &str = "#969696";

/// A decaying oscillation with a residual at 1e-9 and noise on it.
fn oscillation(count: u32) -> TimePanels {
    let times = move || (0..count).map(move |i| 10.0 * f64::from(i) / f64::from(count));
    let wave = |t: f64, phase: f64| 0.1 * (-0.15 * t).exp() * (7.3 * t + phase).cos();
    let noise = |t: f64| 2e-10 * (1e5 * t).sin() * (3.3e4 * t).cos();
    let residual = move |t: f64| 1.3e-9 * (-0.15 * t).exp() * (14.6 * t).sin() + noise(t);
    let positions = vec![
        curve("x₁", times().map(|t| (t, wave(t, 0.0)))),
        curve("x₂", times().map(|t| (t, wave(t, 0.0)))),
        curve("x₁ exact", times().map(|t| (t, wave(t, 0.05)))),
    ];
    over_time(vec![
        time_panel("position x (m)", Scale::Linear, positions),
        time_panel(
            "residual (m)",
            Scale::Linear,
            vec![curve("g", times().map(|t| (t, residual(t))))],
        ),
        time_panel(
            "|residual| (m)",
            Scale::Logarithmic,
            vec![curve("|g|", times().map(|t| (t, residual(t).abs())))],
        ),
        time_panel(
            "multiplier λ (N)",
            Scale::Linear,
            vec![curve("λ", times().map(|t| (t, 4e5 * wave(t, 1.0))))],
        ),
    ])
}

#[test]
fn time_panels_are_small_legible_and_of_one_size_in_both_formats() {
    let directory = Directory::new("time");
    oscillation(300_007).write(&directory.stem()).unwrap();
    let svg = directory.svg();
    assert!(svg.bytes < 300_000, "{} bytes", svg.bytes);
    assert_eq!(svg.shown_size(), directory.png_size());
    assert_eq!(svg.shown_size().0, 1200);
    svg.assert_legible();
    for label in [
        "t (s)",
        "position x (m)",
        "multiplier λ (N)",
        "x₁ exact",
        "1.0·10⁻⁹",
        "10⁻¹⁰",
        "−20000",
    ] {
        assert!(
            svg.texts().contains(&label),
            "{label} is missing in {:?}",
            svg.texts()
        );
    }
    assert!(
        !svg.texts().contains(&"λ"),
        "a curve alone in its panel needs no legend"
    );
}

#[test]
fn many_series_share_the_bound_on_the_file() {
    let directory = Directory::new("many-series");
    let noisy =
        |phase: f64| (0..100_000).map(move |i| (f64::from(i), (phase + 1e3 * f64::from(i)).sin()));
    let all = (0..30)
        .map(|i| curve(&format!("x{i}"), noisy(f64::from(i))))
        .collect();
    let plot = over_time(vec![time_panel("x", Scale::Linear, all)]);
    plot.write(&directory.stem()).unwrap();
    let svg = directory.svg();
    assert!(svg.bytes < 400_000, "{} bytes", svg.bytes);
    svg.assert_legible();
}

#[test]
fn names_with_markup_arrive_as_text() {
    let directory = Directory::new("markup");
    let points = [(0.0, 1.0), (1.0, 2.0)];
    let pair = vec![curve("a<b & \"c\"", points), curve("</svg>", points)];
    let plot = over_time(vec![time_panel("y' > 0", Scale::Linear, pair)]);
    plot.write(&directory.stem()).unwrap();
    let svg = directory.svg();
    for label in [
        "a&lt;b &amp; &quot;c&quot;",
        "&lt;/svg&gt;",
        "y&apos; &gt; 0",
    ] {
        assert!(
            svg.texts().contains(&label),
            "{label} is missing in {:?}",
            svg.texts()
        );
    }
}

#[test]
fn missing_values_are_gaps() {
    let directory = Directory::new("gaps");
    let value = |i: u32| match i {
        20..=29 => f64::NAN,
        60..=64 => f64::INFINITY,
        i => f64::from(i),
    };
    let points = (0..100).map(|i| (f64::from(i), value(i)));
    let panel = time_panel("y", Scale::Linear, vec![curve("y", points)]);
    over_time(vec![panel]).write(&directory.stem()).unwrap();
    let lengths: Vec<usize> = directory
        .svg()
        .polylines(BLUE)
        .iter()
        .map(Vec::len)
        .collect();
    assert_eq!(lengths, [20, 30, 35]);
}

#[test]
fn long_labels_are_neither_cut_nor_on_top_of_each_other() {
    let directory = Directory::new("long");
    let long =
        "constraint residual on the level of accelerations, from the corrector (m/s²)".repeat(3);
    let points = [(0.0, 26.556_718_001), (1.0, 26.556_718_003)];
    let panel = || {
        time_panel(
            &long,
            Scale::Linear,
            vec![curve(&long, points), curve("b", points)],
        )
    };
    let plot = TimePanels {
        title: Some(long.clone()),
        time_label: long.clone(),
        panels: vec![panel(), panel()],
        ..TimePanels::default()
    };
    plot.write(&directory.stem()).unwrap();
    directory.svg().assert_legible();
}

#[test]
fn reference_lines_are_parallel_to_curves_of_their_order() {
    let directory = Directory::new("order");
    let steps = || ratios(9, 7.7e-5, 2.1e-2).into_iter();
    let curves = vec![
        curve("k = 2", steps().map(|h| (h, 431.0 * h.powi(3)))),
        curve("k = 0", steps().map(|h| (h, 5.3 * h))),
        curve("k = 1", steps().map(|h| (h, 37.0 * h * h))),
    ];
    let plot = CurvePlot {
        panels: vec![convergence_panel("", curves, &[3.0])],
    };
    plot.write(&directory.stem()).unwrap();
    let svg = directory.svg();
    svg.assert_legible();
    assert!(svg.texts().contains(&"slope 3"));
    let direction = |line: &[(f64, f64)]| {
        let (first, last) = (line[0], line[line.len() - 1]);
        (last.1 - first.1) / (last.0 - first.0)
    };
    let order_three = svg
        .polylines(BLUE)
        .into_iter()
        .find(|line| line.len() == 9)
        .unwrap();
    let reference = &svg.polylines(REFERENCE)[0];
    assert!((direction(reference) / direction(&order_three) - 1.0).abs() < 2e-3);
    let lower = reference[0].1 - order_three[0].1;
    assert!(
        lower > 0.0 && lower < 0.1 * svg.height,
        "just below the curve, not {lower}"
    );
}

#[test]
fn convergence_panels_and_a_work_precision_diagram_are_legible() {
    let directory = Directory::new("convergence");
    let error =
        |h: f64, p: i32| 10f64.powi(p) * h.powi(p) * (1.0 + 0.3 * (700.0 * h).sin()) + 1e-14;
    let curves = |cost: bool| {
        let x = move |h: f64| if cost { 40.0 / h } else { h };
        let points = move |p: i32| {
            ratios(9, 8e-5, 2e-2)
                .into_iter()
                .map(move |h| (x(h), error(h, p)))
        };
        (1..=5)
            .map(|p| curve(&format!("method of order {p}"), points(p)))
            .collect::<Vec<_>>()
    };
    let panels = vec![
        convergence_panel(
            "Baumgarte β = 2H, γ = H²",
            curves(false),
            &[1.0, 2.0, 3.0, 4.0, 5.0],
        ),
        convergence_panel("Work", curves(true), &[-1.0, -2.5]),
        convergence_panel(
            "Nothing converged",
            vec![curve("zero", [(1e-3, 0.0)])],
            &[1.0],
        ),
    ];
    CurvePlot { panels }.write(&directory.stem()).unwrap();
    let svg = directory.svg();
    svg.assert_legible();
    assert_eq!(svg.shown_size(), directory.png_size());
    for label in [
        "slope 5",
        "slope −2.5",
        "no data",
        "method of order 4",
        "Work",
    ] {
        assert!(
            svg.texts().contains(&label),
            "{label} is missing in {:?}",
            svg.texts()
        );
    }
}

#[test]
fn a_map_has_one_mark_for_each_cell() {
    let directory = Directory::new("map");
    let cell = |c: f64, d: f64| {
        let growth = (c / d).powf(0.1) / 2.7;
        let verdict = if growth < 1.0 {
            Verdict::Stable
        } else {
            Verdict::Unstable
        };
        MapCell {
            verdict,
            growth: Some(growth),
        }
    };
    let panel = map_panel("k = 1", ratios(25, 1e2, 1e8), ratios(25, 1e-2, 1e4), cell);
    let stable = panel
        .cells
        .iter()
        .filter(|cell| cell.verdict == Verdict::Stable)
        .count();
    assert!((100..525).contains(&stable), "the map shows both: {stable}");
    let plot = stability_map(vec![panel], "spectral radius ρ");
    plot.write(&directory.stem()).unwrap();
    let svg = directory.svg();
    svg.assert_legible();
    assert!(svg.bytes < 200_000, "{} bytes", svg.bytes);
    assert_eq!(svg.shown_size(), directory.png_size());
    assert_eq!(
        svg.count("circle", "stroke", RING),
        stable + 1,
        "one more in the legend"
    );
    assert_eq!(
        svg.polylines(CROSS).len(),
        625 - stable + 1,
        "one more in the legend"
    );
    for label in [
        "stable",
        "unstable",
        "spectral radius ρ",
        "1",
        "10⁸",
        "k = 1",
    ] {
        assert!(
            svg.texts().contains(&label),
            "{label} is missing in {:?}",
            svg.texts()
        );
    }
    assert!(!svg.texts().contains(&"undecided"));
}

#[test]
fn maps_without_growth_have_no_colour_bar() {
    let directory = Directory::new("two-maps");
    let cell = |_: f64, _: f64| MapCell {
        verdict: Verdict::Undecided,
        growth: None,
    };
    let panel =
        |title, count| map_panel(title, ratios(count, 1.0, 1e3), ratios(7, 1e-6, 1e-5), cell);
    let plot = stability_map(vec![panel("a", 40), panel("b", 3)], "ρ");
    plot.write(&directory.stem()).unwrap();
    let svg = directory.svg();
    svg.assert_legible();
    assert!(!svg.texts().contains(&"ρ"));
    assert_eq!(
        svg.count("rect", "stroke", "none"),
        1,
        "the white ground only"
    );
}
