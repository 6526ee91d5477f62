//! The picture of the costs.

use std::path::Path;

use linchpin::plot::{Chart, Curve, CurvePanel, CurvePlot};

use crate::macro_steps::Cost;
use crate::solver::Solution;

/// Draws the costs of workers in process and in processes, and of the two eliminations for a chain.
pub fn draw(costs: &[Vec<Cost>; 2], solutions: &[Solution]) {
    let chains = solutions.iter().filter(|one| one.arrangement == "chain");
    let elimination = |of: fn(&Solution) -> f64| {
        let points = chains.clone().map(|one| (one.bodies as f64, of(one)));
        points.collect()
    };
    let curves = vec![
        curve("dense", elimination(|one| one.dense)),
        curve("sparse", elimination(|one| one.sparse)),
    ];
    let solver = CurvePanel {
        title: "one solution of the coupling system".into(),
        reference_slopes: vec![1.0, 3.0],
        ..CurvePanel::of_errors("links", "time in µs", curves)
    };
    let titles = [
        "macro step, workers in process",
        "macro step, one process each",
    ];
    let steps = titles
        .into_iter()
        .zip(costs)
        .map(|(title, costs)| panel(title, costs));
    let plot = CurvePlot {
        panels: steps.chain([solver]).collect(),
    };
    let stem = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/chain-cost");
    plot.write(&stem).unwrap();
    println!("\n{}.svg", stem.display());
}

fn panel(title: &str, costs: &[Cost]) -> CurvePanel {
    let points = |of: fn(&Cost) -> f64| {
        let points = costs.iter().map(|cost| (cost.links as f64, of(cost)));
        points.collect()
    };
    let curves = vec![
        curve("whole", points(|cost| cost.whole)),
        curve("master", points(|cost| cost.master)),
        curve("assemble and solve", points(|cost| cost.solving)),
    ];
    CurvePanel {
        title: title.into(),
        reference_slopes: vec![1.0],
        ..CurvePanel::of_errors("links", "time in µs", curves)
    }
}

fn curve(name: &str, points: Vec<(f64, f64)>) -> Curve {
    Curve {
        name: name.into(),
        points,
    }
}
