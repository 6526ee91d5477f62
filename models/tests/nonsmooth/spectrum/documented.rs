//! Numbers of docs/evidence/nonsmooth-spectra.md that no other test has.

use linchpin_models::nonsmooth::schemes::SchemeKind::{self, Bathe};

use super::{alpha, damping_ratio, decaying, ed, optimal, period_error, radii, radius, sweep};

/// To the last of two digits.
#[track_caller]
fn assert_digits(found: f64, documented: f64) {
    let share = (found / documented - 1.0).abs();
    assert!(share < 0.05, "{found:e} instead of {documented:e}");
}

/// Where the radius is least, and how large it is there.
fn least(scheme: SchemeKind) -> (f64, f64) {
    let ratios = sweep(-2.0, 2.0, 401);
    let radii = radii(scheme, &ratios);
    let pairs = ratios.into_iter().zip(radii);
    pairs
        .min_by(|one, other| one.1.total_cmp(&other.1))
        .unwrap()
}

#[test]
fn cusps() {
    assert_digits(least(alpha(0.0, 0.4)).0, 7.8);
    assert_digits(least(alpha(0.0, 0.5)).0, 2.1);
    let (ratio, radius) = least(alpha(-1.0, 0.5));
    assert_digits(ratio, 0.7);
    assert_digits(radius, 0.30);
}

#[test]
fn point_c_before_and_behind() {
    for (scheme, damping, error) in [
        (alpha(-1.0, -0.5), 4.5e-2, 9.8e-2),
        (optimal(1.0 / 3.0), 1.1e-2, 6.2e-2),
    ] {
        assert_digits(damping_ratio(scheme, 0.1), damping);
        assert_digits(period_error(scheme, 0.1), error);
    }
}

#[test]
fn damping_of_a_tenth_of_the_period() {
    assert_digits(1.0 - radius(optimal(0.0), 0.1), 3.0e-2);
    assert_digits(1.0 - radius(Bathe, 0.1), 5.1e-4);
    assert_digits(damping_ratio(Bathe, 0.1), 8.2e-4);
    for (rho_inf, errors, dampings) in [
        (0.0, [5.7e-4, 1.23e-1], [3.3e-3, 5.5e-2]),
        (0.5, [2.5e-4, 4.7e-2], [1.1e-3, 3.8e-3]),
        (0.8, [2.2e-4, 3.4e-2], [3.7e-4, 1.6e-4]),
    ] {
        for (place, scheme) in [ed(rho_inf), optimal(rho_inf)].into_iter().enumerate() {
            assert_digits(period_error(scheme, 0.1), errors[place]);
            assert_digits(damping_ratio(scheme, 0.1), dampings[place]);
        }
    }
    let share = period_error(Bathe, 0.1) / period_error(ed(0.0), 0.1);
    assert_digits(share, 28.0);
}

#[test]
fn a_period_without_error_far_from_a_sixth() {
    let error = |alpha_ar| period_error(decaying(0.0, alpha_ar), 0.3);
    assert!(error(0.205) > 0.0 && error(0.215) < 0.0);
}
