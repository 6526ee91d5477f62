//! The double four-bar: five bars in two loops, with a singular position.

use linchpin::connect::Place;
use linchpin_master::RunError;
use linchpin_master::results::Warning;
use linchpin_master::setup::Options;
use linchpin_tests::convergence::assert_least_orders;
use linchpin_tests::evidence::show;
use linchpin_tests::runs::{Trajectory, run, try_run};
use linchpin_tests::scenes::with_settings;

use super::{at_the_points_of, relative};

const SPLIT: &str = include_str!("../../../scenes/benchmarks/double-four-bar.toml");
const MONOLITH: &str = include_str!("../../../scenes/monolithic/double-four-bar.toml");

/// The largest relative errors of place and velocity of a tip, and of the energy, which is constant.
fn errors(found: &Trajectory) -> [f64; 3] {
    let exact = at_the_points_of(found, &with_settings(MONOLITH, "", &[TIP]));
    let of = |what: &str| {
        let tip = |own: &str| ["x", "y"].map(|axis| format!("{own}.tip_{what}{axis}"));
        let pairs = tip("v2").into_iter().zip(tip("bar"));
        pairs
            .map(|(own, other)| relative(&found.column(&own), &exact.column(&other)))
            .fold(0.0, f64::max)
    };
    let energies = energy(found);
    let [first, ..] = energies[..] else {
        panic!("no rows")
    };
    [
        // The axis of the ground is 2 m away from the first one.
        place_error(found, &exact),
        of("v"),
        relative(&energies, &vec![first; energies.len()]),
    ]
}

const TIP: &str = "output.variables=[\"bar.tip_x\", \"bar.tip_y\", \"bar.tip_vx\", \"bar.tip_vy\"]";

fn place_error(found: &Trajectory, exact: &Trajectory) -> f64 {
    let away: Vec<f64> = found.column("v2.tip_x").iter().map(|x| x - 2.0).collect();
    let x = relative(&away, &exact.column("bar.tip_x"));
    x.max(relative(
        &found.column("v2.tip_y"),
        &exact.column("bar.tip_y"),
    ))
}

fn energy(found: &Trajectory) -> Vec<f64> {
    let bars = ["v0", "v1", "v2", "h0", "h1"].map(|bar| found.column(&format!("{bar}.energy")));
    let rows = 0..found.rows.len();
    rows.map(|row| bars.iter().map(|bar| bar[row]).sum())
        .collect()
}

#[test]
fn orders_before_the_singular_position() {
    for (degree, steps) in [(2, [40, 50, 80]), (3, [5, 8, 10]), (4, [4, 5, 8])] {
        let steps = steps.map(|steps| 0.5 / f64::from(steps));
        let errors = steps.map(|h| {
            let coupling = format!(
                "degree={degree} macro_step={h:e} iterations={{most=6,tolerance=1e-10}} jacobian=every-step"
            );
            errors(&run(&with_settings(SPLIT, &coupling, &[]), Place::InProcess))
        });
        let order = 2.0 * f64::from(degree) + 1.0;
        assert_least_orders(
            &format!("degree {degree}"),
            &steps,
            &errors,
            [order - 0.3; 3],
        );
    }
}

/// The largest change of the energy in 10 s and the steps, and the warnings of the run; its error if it does not come to its end.
fn through_all_positions(coupling: &str) -> Result<(f64, usize, Vec<Warning>), RunError> {
    let scene = with_settings(SPLIT, coupling, &["scene.t_end=10"]);
    let found = try_run(&scene, Place::InProcess, &Options::default())?;
    let energies = energy(&found);
    let change = energies.iter().map(|energy| (energy - energies[0]).abs());
    let warnings = found.statistics.warnings();
    Ok((change.fold(0.0, f64::max), found.rows.len() - 1, warnings))
}

/// Ten times through the position with all bars in line, with the bound of the library of benchmarks: 1e-5 J, in no more than 2,000 steps.
#[test]
fn energy_is_kept_through_singular_positions() {
    for coupling in ["tolerance=1e-8", "tolerance=1e-6 degree=2"] {
        let (change, steps, warnings) = through_all_positions(coupling).unwrap();
        println!("{coupling}: {change:.1e} J in {steps} steps");
        assert!(
            change < 1e-5 && steps < 2000,
            "{coupling}: {change:e} J, {steps} steps"
        );
        let is_told =
            |warning: &Warning| matches!(warning, Warning::Singular(own) if own.count > 4);
        assert!(warnings.iter().any(is_told), "{coupling}: {warnings:?}");
    }
}

/// A run that does not come across says where it is and why.
#[test]
fn a_run_that_ends_near_a_singular_position_says_so() {
    let error = through_all_positions("tolerance=1e-7 degree=2").unwrap_err();
    let is_named = matches!(error, RunError::NearSingular(_));
    assert!(
        is_named && error.to_string().contains("bars in line"),
        "{error}"
    );
}

const COMMAND: &str = "cargo test --release -p linchpin-tests --test benchmarks -- --ignored --nocapture table_of_double_four_bar";

/// What is left of the energy after ten passages.
#[test]
#[ignore = "prints a table of docs/evidence/benchmarks.md, and writes it with LINCHPIN_WRITE=1"]
fn table_of_double_four_bar() {
    let mut table = String::from(
        "| coupling | change of energy, J | macro steps | that miss the tolerance |\n|---|---|---|---|\n",
    );
    for coupling in [
        "tolerance=1e-5",
        "tolerance=1e-6",
        "tolerance=1e-7",
        "tolerance=1e-8",
        "tolerance=1e-6 degree=2",
        "tolerance=1e-7 degree=2",
        "tolerance=1e-8 jacobian=every-step",
        "macro_step=1e-2",
        "macro_step=5e-3",
        "macro_step=5e-3 degree=2",
    ] {
        table += &match through_all_positions(coupling) {
            Ok((change, steps, warnings)) => {
                let unsolved = warnings.iter().find_map(|warning| match warning {
                    Warning::Singular(own) => Some(own.unsolved_steps),
                    _ => None,
                });
                let unsolved = unsolved.unwrap_or_default();
                format!("| `{coupling}` | {change:.1e} | {steps} | {unsolved} |\n")
            }
            Err(RunError::NearSingular(_)) => {
                format!("| `{coupling}` | ends in the position, and says so | | |\n")
            }
            Err(error) => panic!("{coupling}: {error}"),
        };
    }
    show("benchmarks.md", "double-four-bar", COMMAND, &table);
}

/// Through the position with all bars in line, at 0.714 s. Near it the multipliers are hardly determined, so the errors
/// are not those of the method: they do not fall with H, but the mechanism goes on as parallel bars. A run with degree 4 that steps onto
/// the position may end there, and says that it diverges.
#[test]
fn it_passes_the_singular_position() {
    for degree in [2, 3, 4] {
        for h in [1e-2, 5e-3] {
            let coupling = format!("degree={degree} macro_step={h:e}");
            let scene = with_settings(SPLIT, &coupling, &["scene.t_end=1.2"]);
            let found = match try_run(&scene, Place::InProcess, &Options::default()) {
                Ok(trajectory) => errors(&trajectory),
                Err(RunError::Diverged { t, .. }) if degree == 4 => {
                    assert!((0.7..0.8).contains(&t), "degree {degree}, H = {h:e}: {t}");
                    continue;
                }
                Err(error) => panic!("degree {degree}, H = {h:e}: {error}"),
            };
            println!("degree {degree}, H = {h:e}: {found:?}");
            let [place, velocity, energy] = found;
            let is_close = place < 1e-5 && velocity < 1e-4 && energy < 1e-5;
            assert!(is_close, "degree {degree}, H = {h:e}: {found:?}");
        }
    }
}
