//! Orders of convergence on the free vibration, observed by halving the step.

use std::f64::consts::TAU;

use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::schemes::SchemeKind::{self, Bathe, Hets, Moreau};
use linchpin_models::nonsmooth::spectrum::Oscillator;

use super::super::stand::Stand;
use super::{NEWMARK, alpha, decaying, ed, optimal};

/// Error of `(q, v / omega)` after 1.3 periods from `q = 1`, `v = omega / 2`.
fn error(scheme: SchemeKind, steps: usize) -> f64 {
    let end = 1.3;
    let settings = Settings::default();
    let start: [&[f64]; 2] = [&[1.0], &[0.5 * TAU]];
    let mut stand = Stand::new(Oscillator::UNIT_PERIOD, scheme, settings, start);
    stand.steps(steps, end / steps as f64);
    let (sin, cos) = (TAU * end).sin_cos();
    let (q, v) = (stand.q()[0], stand.v()[0] / TAU);
    (q - cos - 0.5 * sin).hypot(v + sin - 0.5 * cos)
}

fn order(scheme: SchemeKind) -> f64 {
    (error(scheme, 160) / error(scheme, 320)).log2()
}

#[track_caller]
fn assert_order(scheme: SchemeKind, expected: f64) {
    let order = order(scheme);
    assert!((order - expected).abs() < 0.1, "{scheme:?}: order {order}");
}

#[test]
fn second_order() {
    for rho_inf in [0.0, 0.3, 0.8, 1.0] {
        assert_order(optimal(rho_inf), 2.0);
    }
    for (alpha_m, alpha_f) in [(-1.0, 0.5), (-1.0, -0.5), (0.0, 1.0 / 3.0)] {
        assert_order(alpha(alpha_m, alpha_f), 2.0);
    }
    for scheme in [NEWMARK, Bathe, Hets, Moreau] {
        assert_order(scheme, 2.0);
    }
}

/// "Third order for the linear model problem and `alpha_ar = 1/6`, second for arbitrary `alpha_ar`"; 4 without
/// dissipation.
#[test]
fn ed_alpha() {
    for rho_inf in [0.0, 0.3, 0.8] {
        assert_order(ed(rho_inf), 3.0);
    }
    assert_order(ed(1.0), 4.0);
    for rho_inf in [0.0, 0.5, 1.0] {
        for alpha_ar in [0.05, 0.1, 0.25, 0.5] {
            assert_order(decaying(rho_inf, alpha_ar), 2.0);
        }
    }
}
