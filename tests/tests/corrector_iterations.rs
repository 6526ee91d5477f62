//! Corrections that are repeated until they change nothing of note (`coupling.iterations`).

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::RunError;
use linchpin_master::scene::{Scene, parse};
use linchpin_master::setup::Options;
use linchpin_tests::runs::{Trajectory, run, try_run};
use linchpin_tests::scenes::{oscillator_with, with_settings};

const DOUBLE_PENDULUM: &str = include_str!("../../scenes/double-pendulum.toml");
const SLIDER_CRANK: &str = include_str!("../../scenes/slider-crank.toml");

/// Solvers that take equal steps in every run, so that nothing but the corrections changes the results.
const RK4: &str = "subsystem.*.solver={ kind = \"rk4\", step = 2.5e-4 }";

fn mechanism(text: &str, coupling: &str) -> Scene {
    with_settings(text, coupling, &[RK4, "scene.t_end=0.4"])
}

fn largest(trajectory: &Trajectory, column: &str) -> f64 {
    let values = trajectory.column(column).into_iter();
    values.fold(0.0, |largest, value| largest.max(value.abs()))
}

/// Index 3 asks for closed joints alone, so its residual on position level is what the corrections leave.
#[test]
fn the_residual_falls_with_a_pass_at_the_measured_rate() {
    let largest_residual = |more: &str| {
        let coupling = format!(
            "method=baumgarte index=3 beta=0 gamma=0 degree=0 macro_step=2e-2 jacobian=every-step {more}"
        );
        let run = run(&mechanism(DOUBLE_PENDULUM, &coupling), Place::InProcess);
        let residual = largest(&run, "hinge.residual.position.x");
        (residual, run.statistics.corrections.slowest_rate)
    };
    let (once, _) = largest_residual("");
    let (twice, rate) = largest_residual("iterations={most=1,tolerance=1e-14}");
    assert!(rate > 0.0 && rate < 0.01, "{rate}");
    assert!(twice < 3.0 * rate * once, "{once:e} {twice:e}, rate {rate}");
}

/// S1: the mechanisms change by less than 1 % up to H = 2e-2.
#[test]
fn mechanisms_hardly_change() {
    for (text, coupling) in [
        (
            DOUBLE_PENDULUM,
            "method=baumgarte beta=2e-3 gamma=1e-6 degree=0 macro_step=2e-2",
        ),
        (
            DOUBLE_PENDULUM,
            "method=weighted a=2 b=2.6 degree=1 macro_step=1e-2",
        ),
        (
            SLIDER_CRANK,
            "method=weighted index=2 a=1 degree=0 exchanged_degree=2 macro_step=1e-2",
        ),
    ] {
        let once = run(&mechanism(text, coupling), Place::InProcess);
        let iterated = format!("{coupling} iterations={{most=20}}");
        let often = run(&mechanism(text, &iterated), Place::InProcess);
        let corrections = often.statistics.corrections;
        assert_eq!(corrections.unconverged, 0, "{coupling}: {corrections:?}");
        assert!(corrections.passes > 0, "{coupling}");
        for column in ["link1.angle", "link2.angle"] {
            let (once, often) = (once.column(column), often.column(column));
            let size = once
                .iter()
                .fold(0.0_f64, |size, value| size.max(value.abs()));
            let change = once
                .iter()
                .zip(&often)
                .map(|(one, other)| (one - other).abs());
            let change = change.fold(0.0, f64::max) / size;
            assert!(
                change > 0.0 && change < 1e-2,
                "{coupling} {column}: {change:e}"
            );
        }
    }
}

#[test]
fn a_pass_changes_nothing_where_all_is_linear() {
    let columns = ["mass1.x", "mass2.x"];
    for coupling in [
        "index=1 beta=2H gamma=H^2 degree=0",
        "method=weighted index=1 a=2 b=2.6 degree=1",
        "index=2 beta=2e-1 degree=1",
    ] {
        let scene =
            |more: &str| oscillator_with(&format!("{coupling} {more}"), &["scene.t_end=0.3"]);
        let once = run(&scene("jacobian=every-step"), Place::InProcess);
        let often = run(&scene("iterations={most=5}"), Place::InProcess);
        let corrections = often.statistics.corrections;
        // The columns are differences: what their rounding leaves is now and then above the tolerance.
        let steps = often.statistics.macro_steps;
        assert!(
            20 * corrections.passes <= 21 * steps,
            "{coupling}: {corrections:?}"
        );
        assert!(
            corrections.slowest_rate < 1e-3,
            "{coupling}: {corrections:?}"
        );
        assert_eq!(corrections.unconverged, 0, "{coupling}: {corrections:?}");
        for column in columns {
            let size = largest(&once, column);
            let pairs = once.column(column).into_iter().zip(often.column(column));
            let change = pairs
                .map(|(one, other)| (one - other).abs())
                .fold(0.0, f64::max);
            assert!(
                change < 1e-9 * size,
                "{coupling} {column}: {change:e} of {size:e}"
            );
        }
    }
}

#[test]
fn passes_have_equal_bits_on_every_way_to_a_worker() {
    for method in [
        "method=weighted degree=1 macro_step=1e-2",
        "method=hermite macro_step=4e-2",
        "method=hermite jacobian=every-step macro_step=4e-2",
        "method=weighted degree=1 tolerance=1e-3",
    ] {
        let otherwise = match method.contains("tolerance") {
            true => "reject",
            false => "warn",
        };
        let iterations = format!("iterations={{most=3,tolerance=1e-10,otherwise=\"{otherwise}\"}}");
        let coupling = format!("{method} {iterations}");
        let scene = |others: &[&str]| {
            with_settings(
                DOUBLE_PENDULUM,
                &coupling,
                &[&["scene.t_end=0.3"], others].concat(),
            )
        };
        let expected = run(&scene(&[]), Place::InProcess);
        assert!(expected.statistics.corrections.passes > 0, "{coupling}");
        let unary = scene(&["subsystem.*.calls=unary"]);
        for (scene, place) in [
            (&scene(&[]), Place::Threads),
            (&unary, Place::InProcess),
            (&unary, Place::Threads),
        ] {
            assert!(run(scene, place).bits() == expected.bits(), "{coupling}");
        }
    }
}

/// Hermite coupling demands closed joints on position level: what is left falls with every pass by the rate, down to rounding.
#[test]
fn passes_of_hermite_coupling_close_the_joints() {
    for jacobian in ["every-step", "reuse"] {
        let largest_residual = |passes: usize| {
            let coupling = format!(
                "method=hermite jacobian={jacobian} macro_step=5e-2 iterations={{most={passes},tolerance=1e-13}}"
            );
            let run = run(&mechanism(DOUBLE_PENDULUM, &coupling), Place::InProcess);
            let residual = largest(&run, "hinge.residual.position.x");
            (residual, run.statistics.corrections.slowest_rate)
        };
        let (once, rate) = largest_residual(1);
        let (twice, _) = largest_residual(2);
        let (often, _) = largest_residual(12);
        let context = format!("{jacobian}: {once:e} {twice:e} {often:e}, rate {rate}");
        assert!(rate > 0.0 && rate < 0.5, "{context}");
        assert!(twice < 3.0 * rate * once && twice < 0.3 * once, "{context}");
        assert!(often < 1e-11, "{context}");
    }
}

/// A rejected step leaves no trace, and every step that is taken has converged.
#[test]
fn a_step_that_does_not_converge_is_repeated_where_steps_vary() {
    let coupling = |least: &str| {
        format!(
            "method=weighted a=2 b=2.6 degree=1 tolerance=1e-2 macro_step=2e-2 {least} \
             iterations={{most=2,tolerance=1e-9,otherwise=\"reject\"}}"
        )
    };
    let scene = mechanism(DOUBLE_PENDULUM, &coupling(""));
    let found = run(&scene, Place::InProcess);
    let steps = found.statistics.steps.unwrap();
    assert!(steps.rejected_by_cause.not_converged > 0, "{steps:?}");
    assert_eq!(found.statistics.corrections.unconverged, 0);
    assert!(steps.rejected < found.rows.len() as u64 / 4, "{steps:?}");
    let options = Options {
        step_lengths: Some(found.column("step")[1..].to_vec()),
        ..Options::default()
    };
    let expected = try_run(&scene, Place::InProcess, &options).unwrap();
    assert!(found.bits() == expected.bits());
    let scene = mechanism(DOUBLE_PENDULUM, &coupling("least_step=1e-2"));
    let error = try_run(&scene, Place::InProcess, &Options::default()).unwrap_err();
    let shown = error.to_string();
    assert!(
        matches!(error, RunError::NotConverged { step: 1e-2, .. }),
        "{shown}"
    );
    for part in ["smaller coupling.least_step", "coupling.iterations.most"] {
        assert!(shown.contains(part), "{shown}");
    }
}

#[test]
fn a_fixed_step_cannot_be_rejected() {
    let setting = "iterations = { otherwise = \"reject\" }";
    let text = DOUBLE_PENDULUM.replacen("macro_step", &format!("{setting}\nmacro_step"), 1);
    let error = parse(&text, "scene.toml", &[]).unwrap_err().to_string();
    let line = text.lines().position(|line| line == setting).unwrap() + 1;
    for part in [
        "`coupling.iterations.otherwise`",
        "\"fail\" are allowed",
        "give coupling.tolerance",
        &format!("scene.toml:{line}:"),
    ] {
        assert!(error.contains(part), "{part}: {error}");
    }
}

#[test]
fn a_step_that_does_not_converge_is_counted_or_stops_the_run() {
    let coupling = |otherwise: &str| {
        format!(
            "method=baumgarte beta=2e-3 gamma=1e-6 degree=0 macro_step=2e-2 \
             iterations={{most=1,tolerance=1e-13,otherwise=\"{otherwise}\"}}"
        )
    };
    let warned = run(
        &mechanism(DOUBLE_PENDULUM, &coupling("warn")),
        Place::InProcess,
    );
    assert!(warned.statistics.corrections.unconverged > 0);
    let scene = mechanism(DOUBLE_PENDULUM, &coupling("fail"));
    let error = try_run(&scene, Place::InProcess, &Options::default()).unwrap_err();
    let RunError::NotConverged {
        t,
        step,
        passes,
        rate,
        ..
    } = error
    else {
        panic!("{error}");
    };
    assert!(
        t < 0.4 && step == 2e-2 && passes == 1 && rate < 0.1,
        "{t} {step} {passes} {rate}"
    );
    let shown = error.to_string();
    for part in [
        "hinge.lambda",
        "coupling.iterations.most",
        "smaller coupling.macro_step",
    ] {
        assert!(shown.contains(part), "{shown}");
    }
}

#[test]
fn mistakes_in_the_settings_are_told() {
    for (setting, part) in [
        ("iterations = { most = 0 }", "most"),
        ("iterations = { tolerance = -1.0 }", "tolerance"),
        ("iterations = { otherwise = \"repeat\" }", "warn"),
        ("iterations = { many = 3 }", "many"),
        ("iterations = 3", "iterations"),
        ("jacobian = \"seldom\"", "reuse"),
    ] {
        let text = DOUBLE_PENDULUM.replacen("macro_step", &format!("{setting}\nmacro_step"), 1);
        let error = parse(&text, "scene.toml", &[]).unwrap_err().to_string();
        assert!(error.contains(part), "{setting}: {error}");
    }
}
