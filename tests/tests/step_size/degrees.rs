//! Degrees that follow the estimates.
//!
//! [`COMMAND`] prints the table of docs/evidence/step-size.md, and writes it with `LINCHPIN_WRITE=1`.

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_tests::errors::Errors;
use linchpin_tests::evidence;
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::{oscillator_with, with_settings};

use super::hard_scenes::{ALL, Hard};

const METHODS: [&str; 2] = ["weighted", "baumgarte"];

/// Integrations with a fixed degree from 1 to 3, the fewest, and with one that follows the estimates; error and degrees of the latter.
struct Compared {
    fixed: [u64; 3],
    automatic: u64,
    line: String,
}

fn compare(scene: &Hard, method: &str, tolerance: f64) -> Compared {
    let with = |degree: &str| {
        scene.run(
            &format!("method={method} degree={degree} jacobian=every-step"),
            tolerance,
        )
    };
    let fixed = ["1", "2", "3"].map(|degree| with(degree).trajectory.integrations);
    let own = with("automatic");
    let degrees = own
        .trajectory
        .statistics
        .degrees
        .unwrap()
        .multipliers
        .unwrap();
    let automatic = own.trajectory.integrations;
    let line = format!(
        "| {} | {method} | {tolerance:e} | {} | {} | {} | {automatic} | {:.1e} | {} | {} |",
        scene.name,
        fixed[0],
        fixed[1],
        fixed[2],
        own.error.largest,
        own.trajectory.rejected,
        degrees.map(|steps| steps.to_string()).join(", "),
    );
    Compared {
        fixed,
        automatic,
        line,
    }
}

/// The tolerance is met, which [`Hard::run`] asserts, at no more than 1.2 times the cost of the best fixed degree. Lengths of steps
/// come in a grid of 9 %, so that alone may make a run longer by as much.
#[test]
fn an_automatic_degree_costs_no_more_than_the_best_fixed_one() {
    for scene in ALL {
        for method in METHODS {
            for tolerance in [1e-4, 1e-6] {
                let Compared {
                    fixed,
                    automatic,
                    line,
                } = compare(&scene, method, tolerance);
                let best = fixed.into_iter().min().unwrap();
                assert!(automatic as f64 <= 1.2 * best as f64, "{line}");
            }
        }
    }
}

const COMMAND: &str = "cargo test --release -p linchpin-tests --test step_size -- --ignored --nocapture table_of_degrees";

#[test]
#[ignore = "prints a table of docs/evidence/step-size.md"]
fn table_of_degrees() {
    let mut table = String::from(
        "| scene | method | tolerance | k = 1 | k = 2 | k = 3 | automatic | largest error | rejected \
         | steps with k = 0, 1, 2, 3 |\n|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for scene in ALL {
        for method in METHODS {
            for tolerance in [1e-4, 1e-6, 1e-8] {
                table += &compare(&scene, method, tolerance).line;
                table.push('\n');
            }
        }
    }
    evidence::show("step-size.md", "degrees", COMMAND, &table);
}

fn degrees(trajectory: &Trajectory) -> Vec<usize> {
    let degrees = trajectory.column("degree");
    degrees[1..].iter().map(|degree| *degree as usize).collect()
}

#[test]
fn a_smooth_start_leads_to_the_highest_degree() {
    let scene = oscillator_with(
        "method=weighted index=1 degree=automatic tolerance=1e-7",
        &[],
    );
    let degrees = degrees(&run(&scene, Place::InProcess));
    assert_eq!(degrees[..4], [1, 2, 3, 3]);
    let highest = degrees.iter().filter(|degree| **degree == 3).count();
    assert!(5 * highest > 4 * degrees.len(), "{degrees:?}");
}

/// With equal steps the degree of the smallest error is taken.
#[test]
fn fixed_steps_have_the_degree_of_the_smallest_error() {
    for method in ["method=weighted index=1", "index=1 beta=2H gamma=H^2"] {
        for step in ["5e-3", "2e-3"] {
            let errors = |degree: &str| {
                let coupling = format!("{method} degree={degree} macro_step={step}");
                Errors::against_closed_form(&oscillator_with(&coupling, &[]))
            };
            let best = (0..=3)
                .map(|degree| errors(&degree.to_string()).x)
                .fold(f64::INFINITY, f64::min);
            let automatic = errors("automatic");
            assert!(automatic.x < 1.1 * best, "{method}: {automatic:?} {best}");
        }
    }
}

/// Combinations that are unstable with higher degrees, at any step or at long ones, run to their end.
#[test]
fn the_degree_stays_below_the_limit_of_stability() {
    let runs = |coupling: &str| -> Vec<Scene> {
        let fixed = oscillator_with(&format!("{coupling} degree=automatic macro_step=1e-3"), &[]);
        let variable = format!("{coupling} degree=automatic tolerance=1e-4");
        vec![fixed, oscillator_with(&variable, &[])]
    };
    for (coupling, highest) in [
        ("method=weighted index=1 a=1 b=1", 1),
        ("method=weighted index=2 a=1 b=0", 0),
        ("index=2 beta=2H", 0),
        ("index=3 beta=0", 0),
    ] {
        for scene in runs(coupling) {
            let trajectory = run(&scene, Place::InProcess);
            let degrees = degrees(&trajectory);
            assert_eq!(degrees.iter().max(), Some(&highest), "{coupling}");
            assert_eq!(trajectory.column("t").last(), Some(&scene.t_end));
        }
    }
}

/// gamma = 1e-6 against the rules H^2/12, H^2/12 + beta H/6 and 7/90 H^2 + beta H/3 for beta = 2e-3.
#[test]
fn parameters_that_do_not_follow_the_step_lower_the_degree_of_longer_ones() {
    let longest = [f64::INFINITY, 3.465e-3, 2.001e-3, 1.303e-3];
    let coupling = "index=1 beta=2e-3 gamma=1e-6 degree=automatic tolerance=1e-3 macro_step=1e-5";
    let trajectory = run(&oscillator_with(coupling, &[]), Place::InProcess);
    let steps = &trajectory.column("step")[1..];
    let degrees = degrees(&trajectory);
    for (step, degree) in steps.iter().zip(&degrees) {
        assert!(*step <= longest[*degree], "{degree} with {step}");
    }
    for degree in [1, 3] {
        assert!(degrees.contains(&degree), "{degree}");
    }
}

/// A worker's highest degree of inputs limits the choice in `user_mistakes`; here columns that are kept do not fit other degrees.
#[test]
fn columns_that_are_kept_do_not_outlive_their_degree() {
    let coupling = "method=weighted index=1 degree=automatic macro_step=1e-3";
    let kept = oscillator_with(&format!("{coupling} jacobian=reuse"), &[]);
    let anew = oscillator_with(coupling, &[]);
    let trajectory = run(&kept, Place::InProcess);
    let degrees = degrees(&trajectory);
    let changes = degrees.windows(2).filter(|pair| pair[0] != pair[1]).count() as u64;
    let with_columns = trajectory.statistics.corrections.steps_with_columns;
    assert!(with_columns > changes, "{with_columns} {changes}");
    assert!(20 * with_columns < degrees.len() as u64, "{with_columns}");
    let [kept, anew] = [kept, anew].map(|scene| Errors::against_closed_form(&scene));
    assert!(kept.x < 1.05 * anew.x, "{kept:?} {anew:?}");
}

#[test]
fn degrees_are_columns_and_counted() {
    const CRANK: &str = include_str!("../../../scenes/slider-crank.toml");
    let coupling = "method=weighted index=1 a=2 b=2.6 degree=automatic exchanged_degree=automatic tolerance=1e-4 macro_step=1e-3";
    let trajectory = run(
        &with_settings(CRANK, coupling, &["scene.t_end=0.2"]),
        Place::InProcess,
    );
    let counted = trajectory.statistics.degrees.unwrap();
    for (name, counted) in [
        ("degree", counted.multipliers),
        ("exchanged_degree", counted.exchanged),
    ] {
        let column = &trajectory.column(name)[1..];
        for (degree, steps) in counted.unwrap().into_iter().enumerate() {
            let found = column
                .iter()
                .filter(|value| **value == degree as f64)
                .count();
            assert_eq!(found as u64, steps, "{name} {degree}");
        }
    }
}
