//! Hermite coupling of the oscillator of S1 Sect. 4.1 against the closed form: accuracy, orders, drift.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_tests::convergence::assert_all_orders;
use linchpin_tests::errors::of_hermite_oscillator as errors;
use linchpin_tests::runs::run;
use linchpin_tests::scenes::oscillator_with;

#[test]
fn orders_of_all_variants() {
    let cases = [
        ("variant=apv", [5.0, 5.0, 5.0]),
        ("variant=c0pv", [4.0, 4.0, 2.0]),
    ];
    assert_all_orders(&cases, &[1.6e-2, 8e-3, 4e-3], errors);
}

#[test]
fn errors_at_one_macro_step() {
    for (variant, most) in [("apv", 2e-9), ("c0pv", 4e-8)] {
        let [x, ..] = errors(&format!("variant={variant}"), 5e-3);
        assert!(x < most, "{variant}: {x:e}");
    }
}

/// The position condition is met anew in every step: what is left of it does not grow.
#[test]
fn no_drift() {
    for variant in ["apv", "c0pv"] {
        let scene = oscillator_with(
            &format!("method=hermite variant={variant} macro_step=5e-3"),
            &["scene.t_end=20"],
        );
        let trajectory = run(&scene, Place::InProcess);
        let open = |rows: &[f64]| rows.iter().fold(0.0f64, |most, g| most.max(g.abs()));
        let gaps = trajectory.column("link.residual.position");
        let largest = trajectory
            .column("mass1.x")
            .iter()
            .fold(0.0f64, |most, x| most.max(x.abs()));
        println!("{variant}: open by {:e} of {largest:e} m", open(&gaps));
        assert!(
            open(&gaps) < 1e-13 * largest,
            "{variant}: {:e}",
            open(&gaps)
        );
        assert!(open(&gaps[2000..]) <= open(&gaps[..2000]), "{variant}");
    }
}

/// A step that does not divide the time leaves two shorter ones: nothing of the step before is of another length.
#[test]
fn shortened_steps_keep_the_order() {
    let errors = [1.7e-2, 8.7e-3, 4.3e-3].map(|h| (h, errors("variant=apv", h)[0]));
    for (h, error) in errors {
        assert!(error < 9.0e2 * h.powi(5), "{h}: {error:e}");
    }
}

/// The oscillator's derivatives are those of its equation: no perturbed integration, and the same motion up to the rounding of
/// the differences.
#[test]
fn directional_derivatives_replace_perturbed_steps() {
    for coupling in [
        "method=hermite jacobian=every-step",
        "method=weighted index=1 a=2 b=2.6 degree=2",
    ] {
        let with = |increment: &str| {
            let coupling = format!("{coupling} macro_step=5e-3 increment={increment}");
            run(
                &oscillator_with(&coupling, &["scene.t_end=1"]),
                Place::InProcess,
            )
        };
        let (differences, derivatives) = (with("automatic"), with("derivatives"));
        assert!(differences.statistics.integrations_by_cause.columns > 0);
        let causes = derivatives.statistics.integrations_by_cause;
        assert_eq!(causes.columns, 0, "{coupling}: {causes:?}");
        assert_eq!(causes.sum(), derivatives.integrations, "{coupling}");
        let pairs = derivatives.column("mass1.x");
        let pairs = pairs.iter().zip(differences.column("mass1.x"));
        for (one, other) in pairs {
            assert!((one - other).abs() < 1e-9, "{coupling}: {one} {other}");
        }
    }
}

/// Under the load `s^j` an undamped spring brings the mass to `x_j` with the acceleration `a_j`; of a free mass `x_j` is `a_j H^2 / ((j + 1)(j + 2))`.
#[test]
fn a_macro_step_that_passes_by_a_spring_is_told() {
    let (m, h) = (0.7_f64, 1e-3_f64);
    let unresolved = |c: f64, method: &str| {
        let settings = [
            format!("subsystem.mass1.parameters.c={c:e}"),
            format!("subsystem.mass1.parameters.m={m}"),
            "subsystem.*.parameters.d=0".to_owned(),
            "scene.t_end=0.02".to_owned(),
        ];
        let settings = settings.each_ref().map(String::as_str);
        let scene = oscillator_with(&format!("method={method} macro_step={h:e}"), &settings);
        let statistics = run(&scene, Place::InProcess).statistics;
        [0, 1].map(|subsystem: usize| statistics.subsystems[subsystem].unresolved)
    };
    let expected = |c: f64| {
        let phi = (c / m).sqrt() * h;
        let (sin, cos) = phi.sin_cos();
        let free = [sin / phi, 2.0 * (1.0 - cos) / (phi * phi)];
        let levers = free.iter().zip([6.0, 12.0]);
        let ratios = levers.map(|(free, lever)| lever * (1.0 - free) / (phi * phi * free.abs()));
        ratios.fold(1.0, |worst: f64, ratio| worst.max(ratio).max(1.0 / ratio))
    };
    for c in [4e7, 2.2e7] {
        let [stiff, soft] = unresolved(c, "hermite");
        let (found, expected) = (stiff.unwrap(), expected(c));
        assert!(
            (found / expected - 1.0).abs() < 1e-5,
            "{c:e}: {found} {expected}"
        );
        assert_eq!(soft, None);
    }
    // A quarter of a period.
    assert_eq!(unresolved(1.7e6, "hermite"), [None; 2]);
    // Without accelerations nothing is known.
    assert_eq!(unresolved(4e7, "hermite variant=c0pv"), [None; 2]);
}
