//! Columns of the coupling Jacobian that stay in use: on every shipped scene nearly all macro steps need no perturbed
//! integration, and the errors are those of columns that are new in every step.

#![allow(clippy::unwrap_used, missing_docs)]

use std::fs;
use std::path::{Path, PathBuf};

use linchpin::connect::Place;
use linchpin_master::scene::{Jacobian, Scene, is_spectrum, is_study, load};
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::with_settings;

/// Macro steps of a run: enough for the columns to grow old, few enough for a test.
const STEPS: f64 = 150.0;

/// The reference takes so many macro steps in one.
const FINER: usize = 4;

/// Solvers whose errors are far below those of the coupling.
const TIGHT: &str = "subsystem.*.solver={ kind = \"radau5\", rtol = 1e-12, atol = 1e-12 }";

/// Columns whose error with new columns in every step is below this share of their size are rounding.
const ROUNDING: f64 = 1e-10;

fn shipped(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            shipped(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "toml")
            && !is_study(&path)
            && !is_spectrum(&path)
        {
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
    // Benchmarks have tests of their own; their bodies turn too far in a step for columns to stay.
    paths.retain(|path| {
        path.parent()
            .is_none_or(|folder| !folder.ends_with("benchmarks"))
    });
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
    scenes.retain(|(_, scene)| scene.coupling.method.corrects());
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

/// Also where steps vary as the scenes say: responses over one length follow from those over others.
#[test]
fn steps_that_follow_the_error_need_no_columns_either() {
    let all = scenes().into_iter();
    let varying = all.filter(|(_, scene)| scene.coupling.step_control.is_some());
    let mut count = 0;
    for (name, scene) in varying {
        count += 1;
        let run_with = |jacobian| {
            let mut own = scene.clone();
            own.coupling.jacobian = jacobian;
            run(&own, Place::InProcess)
        };
        let (reuse, every) = (run_with(Jacobian::Reuse), run_with(Jacobian::EveryStep));
        let with = reuse.statistics.corrections.steps_with_columns;
        let steps = reuse.statistics.macro_steps;
        let context = format!(
            "{name}: {with} of {steps} steps with columns, {} integrations, {} with columns in every step",
            reuse.integrations, every.integrations
        );
        println!("{context}");
        assert!(10 * with <= steps, "{context}");
        assert!(reuse.integrations < every.integrations, "{context}");
    }
    assert!(count >= 5, "{count}");
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

/// Error of the motion or of the multipliers with new columns in every step, with kept ones, and the size of what is compared. Runs with
/// a fourth of the macro step are the reference.
fn errors(scene: &Scene, steps: f64, of_multipliers: bool) -> [f64; 3] {
    let every = run(&cut(scene, steps, 1, "every-step"), Place::InProcess);
    let reuse = run(&cut(scene, steps, 1, "reuse"), Place::InProcess);
    let reference = run(&cut(scene, steps, FINER, "every-step"), Place::InProcess);
    let ends = match of_multipliers {
        true => &["lambda", "lambda.x", "lambda.y", "lambda.z"][..],
        false => &[".angle", "_angle", ".x", ".y", ".z", "_x", "_y", "_z"][..],
    };
    let columns = every.columns.iter().filter(|column| {
        ends.iter().any(|end| column.ends_with(end))
            && column.contains("lambda") == of_multipliers
            && !column.contains("residual")
    });
    let mut sums = [0.0; 3];
    for column in columns {
        let (error, size) = distance(&every, &reference, column);
        let own = distance(&reuse, &reference, column).0;
        for (sum, one) in sums.iter_mut().zip([error, own, size]) {
            *sum += one * one;
        }
    }
    sums.map(f64::sqrt)
}

/// Where the motion of all bodies is told by few columns, their errors may not grow by more than 5 %.
#[test]
fn columns_that_stay_in_use_cost_no_accuracy() {
    let mut compared = 0;
    for (name, scene) in scenes().into_iter().filter(|(name, _)| !name.contains('[')) {
        for of_multipliers in [false, true] {
            let [every, reuse, size] = errors(&scene, STEPS, of_multipliers);
            println!(
                "{name} {of_multipliers}: {:.2e} and {:.2e}",
                every / size,
                reuse / size
            );
            if every < ROUNDING * size {
                continue;
            }
            assert!(
                reuse < 1.05 * every,
                "{name} {of_multipliers}: {every:e}, {reuse:e}, size {size:e}"
            );
            compared += 1;
        }
    }
    assert!(compared >= 10, "{compared}");
}

/// Also where H hardly resolves the motion, so that old columns fit badly.
#[test]
fn coarse_steps_lose_no_accuracy_either() {
    let couplings = [
        "method=weighted degree=1",
        "method=weighted degree=2 exchanged_degree=3",
        "method=baumgarte degree=1",
    ];
    for name in ["universal-pendulum", "revolute-pendulum"] {
        let path = format!("../scenes/spatial/{name}.toml");
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        for coupling in couplings {
            for step in ["2e-2", "5e-3"] {
                let text = fs::read_to_string(&path).unwrap();
                let coupling = format!("{coupling} macro_step={step}");
                let scene = with_settings(&text, &coupling, &["scene.t_end=0.5", TIGHT]);
                for of_multipliers in [false, true] {
                    let [every, reuse, _] = errors(&scene, STEPS, of_multipliers);
                    println!("{name} {coupling} {of_multipliers}: {every:e} and {reuse:e}");
                    assert!(
                        reuse < 1.05 * every,
                        "{name} {coupling} {of_multipliers}: {every:e}, {reuse:e}"
                    );
                }
            }
        }
    }
}
