//! Fig. 10 and Sect. 2.6.1: Newmark, generalised-alpha with `rho_inf = 0`, Bathe.

use linchpin_models::nonsmooth::schemes::SchemeKind::{Bathe, Hets, Moreau};

use super::{NEWMARK, NO_RISE, ed, optimal, period_error, radii, radius, rise, sweep, wide};

/// To the digits of the notes on the paper.
#[test]
fn period_errors_of_a_tenth_of_the_period() {
    let expected = [
        (NEWMARK, 3.2e-2, 5e-4),
        (optimal(0.0), 1.23e-1, 5e-4),
        (Bathe, 1.62e-2, 5e-5),
        (ed(0.0), 5.7e-4, 5e-6),
        (Hets, -1.7e-2, 5e-4),
        (Moreau, -1.7e-2, 5e-4),
    ];
    for (scheme, expected, last_digit) in expected {
        let found = period_error(scheme, 0.1);
        assert!(
            (found - expected).abs() < last_digit,
            "{scheme:?}: {found:e}"
        );
    }
}

/// "The Bathe method preserves the low-frequency oscillation better than the similar generalised-alpha method."
#[test]
fn bathe_preserves_low_frequencies() {
    for ratio in sweep(-2.0, -0.5, 16) {
        let [bathe, alpha] = [Bathe, optimal(0.0)].map(|scheme| 1.0 - radius(scheme, ratio));
        assert!(bathe < 0.2 * alpha, "{ratio}: {bathe:e} against {alpha:e}");
    }
    let [bathe, alpha] = [Bathe, optimal(0.0)].map(|scheme| 1.0 - radius(scheme, 0.1));
    assert!(bathe < 0.02 * alpha, "{bathe:e} against {alpha:e}");
}

/// "Both avoid high-frequency vibrations", and Bathe's method is stable without parameters.
#[test]
fn both_annihilate_high_frequencies() {
    for scheme in [Bathe, optimal(0.0)] {
        let radii = radii(scheme, &wide());
        assert!(radii[radii.len() - 1] < 1e-3 && rise(&radii) < NO_RISE);
        assert!(radii.iter().all(|radius| *radius <= 1.0));
        assert!(radius(scheme, 100.0) < 0.02);
    }
    assert!(
        radii(NEWMARK, &wide())
            .iter()
            .all(|radius| (radius - 1.0).abs() < 1e-6)
    );
}

/// "Better behaviour for the period error than generalised-alpha and the classic Newmark method", up to `dt / T` = 1.3;
/// beyond, Newmark's is smaller.
#[test]
fn bathe_has_the_smallest_period_error() {
    for ratio in sweep(-2.0, 0.1, 43) {
        let bathe = period_error(Bathe, ratio);
        let newmark = period_error(NEWMARK, ratio);
        let alpha = period_error(optimal(0.0), ratio);
        assert!(0.0 < bathe && bathe < newmark && newmark < alpha, "{ratio}");
    }
    for ratio in [1.35, 3.0, 100.0] {
        assert!(period_error(Bathe, ratio) > period_error(NEWMARK, ratio));
    }
}
