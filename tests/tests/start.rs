//! The start of coupling polynomials of degree 1 and more: in step N the predictor has degree min(k, N), the corrector
//! min(k, N + 1).

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_tests::convergence::{LAMBDA_ROUNDING, STATE_ROUNDING, Study};
use linchpin_tests::errors::{Errors, closed_form};
use linchpin_tests::runs::try_run;
use linchpin_tests::scenes::oscillator_with;

const MACRO_STEPS: [f64; 5] = [2e-3, 1e-3, 5e-4, 2.5e-4, 1.25e-4];

const FIXED: &str = "index=1 beta=2e-1 gamma=1e-2";
const WEIGHTED: &str = "method=weighted index=1 a=2 b=2.6";

fn scene(coupling: &str, degree: usize, h: f64, t_end: f64) -> Scene {
    let coupling = format!("{coupling} degree={degree} macro_step={h:e}");
    oscillator_with(&coupling, &[&format!("scene.t_end={t_end:?}")])
}

/// Errors with multipliers before the start that are the exact ones at `past(p)`, p macro steps before it.
fn errors_with_past(scene: &Scene, past: impl Fn(usize) -> f64) -> Errors {
    let exact = closed_form(scene);
    let degree = scene.coupling.degree.highest();
    let values = (0..=degree).map(|p| vec![exact("link.lambda", past(p)).unwrap()]);
    let options = Options {
        established: Some(values.collect()),
        ..Options::default()
    };
    let trajectory = try_run(scene, Place::InProcess, &options).unwrap();
    Errors::of(&trajectory, exact)
}

fn assert_near(order: f64, expected: usize, what: &str, study: &Study) {
    assert!(
        (order - expected as f64).abs() < 0.1,
        "{what}: order {order:.2}, expected {expected}\n{study}"
    );
}

/// A corrector that is constant leaves errors of order 2 in the state and 1 in the multiplier after the first step.
#[test]
fn the_first_corrector_is_linear() {
    for degree in 0..=3 {
        let study = Study::new(&MACRO_STEPS, |h| {
            Errors::against_closed_form(&scene(WEIGHTED, degree, h, h))
        });
        let what = format!("degree {degree}");
        let state = study.order(|errors| errors.state, STATE_ROUNDING);
        assert_near(state, 2 + degree.min(1), &what, &study);
        let lambda = study.order(|errors| errors.lambda, LAMBDA_ROUNDING);
        assert_near(lambda, 1 + degree.min(1), &what, &study);
    }
}

/// So it is the start that takes one order from degree 3, and half an order from the root mean square of others.
#[test]
fn with_the_exact_past_every_degree_has_its_full_order() {
    for coupling in [FIXED, WEIGHTED] {
        for degree in 0..=3 {
            let study = Study::new(&MACRO_STEPS, |h| {
                errors_with_past(&scene(coupling, degree, h, 0.5), |p| -(p as f64) * h)
            });
            let what = format!("{coupling} degree {degree}");
            let lambda = study.order(|errors| errors.lambda, LAMBDA_ROUNDING);
            assert_near(lambda, degree + 1, &what, &study);
            if coupling == FIXED {
                let state = study.order(|errors| errors.state, STATE_ROUNDING);
                assert_near(state, degree + 1, &what, &study);
            }
        }
    }
}

/// What a start with the initial multiplier in place of the missing past would cost: growing degrees give order 3.
#[test]
fn a_constant_past_has_order_2() {
    for degree in 2..=3 {
        let constant = |h: f64| errors_with_past(&scene(FIXED, degree, h, 0.5), |_| 0.0);
        let growing = |h: f64| Errors::against_closed_form(&scene(FIXED, degree, h, 0.5));
        let what = format!("degree {degree}");
        let constant = Study::new(&MACRO_STEPS, constant);
        assert_near(constant.orders()[0], 2, &what, &constant);
        let growing = Study::new(&MACRO_STEPS, growing);
        assert_near(growing.orders()[0], 3, &what, &growing);
    }
}
