//! Columns of the coupling Jacobian that stay in use: on every shipped scene nearly all macro steps need no perturbed
//! integration, and the errors are those of columns that are new in every step.

#![allow(clippy::unwrap_used, missing_docs)]

use std::fs;
use std::path::{Path, PathBuf};

use linchpin::connect::Place;
use linchpin_master::scene::{Scene, is_study, load};
use linchpin_tests::runs::{Trajectory, run};

/// Macro steps of a run: enough for the columns to grow old, few enough for a test.
const STEPS: f64 = 150.0;

/// The reference takes so many macro steps in one.
const FINER: usize = 4;

/// Columns whose error with new columns in every step is below this share of their size are rounding.
const ROUNDING: f64 = 1e-10;

fn shipped(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            shipped(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "toml") && !is_study(&path) {
            found.push(path);
        }
    }
}

/// Every shipped scene and each of its cases with a method that has columns, cut to a number of macro steps.
fn scenes() -> Vec<(String, Scene)> {
    let mut paths = Vec::new();
    shipped(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes"),
        &mut paths,
    );
    paths.sort();
    let mut scenes = Vec::new();
    for path in paths {
        let scene = load(&path, &[]).unwrap();
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let cases = scene.cases.clone();
        if cases.is_empty() {
            scenes.push((name, scene));
            continue;
        }
        for case in &cases {
            scenes.push((
                format!("{name} [{}]", case.name),
                scene.with_case(case).unwrap(),
            ));
        }
    }
    scenes.retain(|(_, scene)| scene.coupling.method.keeps_columns());
    // Scenes of one subsystem couple nothing.
    scenes.retain(|(_, scene)| !scene.joints.is_empty());
    // Workers that other machines serve are not there.
    scenes.retain(|(name, _)| name != "oscillator-compose");
    scenes
}

fn cut(scene: &Scene, steps: f64, finer: usize, jacobian: &str) -> Scene {
    let h = scene.coupling.macro_step;
    let t_end = scene.t_end.min(scene.t_start + steps * h);
    let set = |key: &str, value: String| linchpin_master::scene::Override {
        key: key.to_owned(),
        value,
    };
    let mut cut = scene
        .with(&[
            set("scene.t_end", format!("{t_end:?}")),
            set("coupling.macro_step", format!("{:?}", h / finer as f64)),
            set("coupling.jacobian", jacobian.to_owned()),
        ])
        .unwrap()
        .with_fixed_steps();
    cut.output.every = 1;
    cut
}

#[test]
fn nearly_all_steps_of_every_shipped_scene_need_no_columns() {
    let scenes = scenes();
    assert!(scenes.len() > 30, "{} scenes and cases", scenes.len());
    for (name, scene) in scenes {
        let trajectory = run(&cut(&scene, STEPS, 1, "reuse"), Place::InProcess);
        let corrections = trajectory.statistics.corrections;
        let (with, all) = (
            corrections.steps_with_columns,
            trajectory.statistics.macro_steps,
        );
        // The first steps have polynomials of growing degree, the last ones may be shorter.
        assert!(
            10 * with <= all,
            "{name}: {with} of {all} steps with columns"
        );
        let causes = trajectory.statistics.integrations_by_cause;
        assert_eq!(causes.sum(), trajectory.integrations, "{name}: {causes:?}");
        println!(
            "{name}: {with} of {all}, {:.2} passes",
            corrections.passes as f64 / all as f64
        );
    }
}

/// Root mean square distance of a column from the reference, and its size.
fn distance(run: &Trajectory, reference: &Trajectory, column: &str) -> (f64, f64) {
    let (own, exact) = (run.column(column), reference.column(column));
    let exact = exact.iter().step_by(FINER);
    let (mut error, mut size) = (0.0, 0.0);
    for (own, exact) in own.iter().zip(exact) {
        error += (own - exact).powi(2);
        size += exact.powi(2);
    }
    (error.sqrt(), size.sqrt())
}

/// Where the motion of all bodies is told by few columns, their errors may not grow by more than 5 %.
#[test]
fn columns_that_stay_in_use_cost_no_accuracy() {
    let mut compared = 0;
    for (name, scene) in scenes().into_iter().filter(|(name, _)| !name.contains('[')) {
        let every = run(&cut(&scene, STEPS, 1, "every-step"), Place::InProcess);
        let reuse = run(&cut(&scene, STEPS, 1, "reuse"), Place::InProcess);
        let reference = run(&cut(&scene, STEPS, FINER, "every-step"), Place::InProcess);
        for kind in [
            &[".angle", "_angle", ".x", ".y", ".z", "_x", "_y", "_z"][..],
            &["lambda", "lambda.x", "lambda.y", "lambda.z"][..],
        ] {
            let (mut sum_every, mut sum_reuse, mut size) = (0.0, 0.0, 0.0);
            let columns = every.columns.iter().filter(|column| {
                kind.iter().any(|end| column.ends_with(end))
                    && column.contains("lambda") == kind.contains(&"lambda")
                    && !column.contains("residual")
            });
            for column in columns {
                let (error, own) = distance(&every, &reference, column);
                sum_every += error.powi(2);
                size += own.powi(2);
                sum_reuse += distance(&reuse, &reference, column).0.powi(2);
            }
            let [every, reuse, size] = [sum_every, sum_reuse, size].map(f64::sqrt);
            println!(
                "{name} {kind:?}: {:.2e} and {:.2e}",
                every / size,
                reuse / size
            );
            if every < ROUNDING * size {
                continue;
            }
            assert!(
                reuse < 1.05 * every,
                "{name} {kind:?}: {every:e}, {reuse:e}, size {size:e}"
            );
            compared += 1;
        }
    }
    assert!(compared >= 10, "{compared}");
}
