//! Fig. 6: the region of unconditional stability of generalised-alpha.

use linchpin_models::nonsmooth::spectrum::growth;
use linchpin_models::nonsmooth::spectrum::region::unrestricted_probe;

use super::{NO_RISE, rise, wide};

/// `(alpha_m, alpha_f)` and `rho_inf`.
const POINTS: [(&str, [f64; 2], f64); 5] = [
    ("A", [-1.0, 0.5], 1.0),
    ("B", [-1.0, 0.0], 0.0),
    ("C", [-1.0, -0.5], 1.0 / 3.0),
    ("D", [0.5, 0.5], 1.0),
    ("E", [0.0, 1.0 / 3.0], 0.5),
];

/// `|lambda_1,2|` and `|lambda_3|` of eqs. (103), (101).
fn moduli_at_infinity(alpha_m: f64, alpha_f: f64) -> [f64; 2] {
    let principal = (alpha_f - alpha_m - 1.0) / (alpha_f - alpha_m + 1.0);
    let third = alpha_f / (alpha_f - 1.0);
    [principal.abs(), third.abs()]
}

fn at_infinity(alpha_m: f64, alpha_f: f64) -> f64 {
    let [principal, third] = moduli_at_infinity(alpha_m, alpha_f);
    principal.max(third)
}

/// A grid that avoids the border of the region and the lines where a step has no solution.
fn grid() -> impl Iterator<Item = [f64; 2]> {
    let values = |from: f64| (0..25).map(move |i| from + 0.0803 * f64::from(i));
    values(-1.203).flat_map(move |alpha_m| values(-1.011).map(move |alpha_f| [alpha_m, alpha_f]))
}

#[test]
fn the_points_of_the_figure() {
    for (name, [alpha_m, alpha_f], rho_inf) in POINTS {
        let growth = growth(alpha_m, alpha_f);
        assert!(growth.is_stable(), "{name}: {growth:?}");
        assert!(
            (growth.at_infinity - rho_inf).abs() < 1e-3,
            "{name}: {growth:?}"
        );
        assert!((at_infinity(alpha_m, alpha_f) - rho_inf).abs() < 1e-12);
    }
}

#[test]
fn stable_where_eq_100_says() {
    let mut counts = [0, 0];
    for [alpha_m, alpha_f] in grid() {
        let expected = alpha_m <= alpha_f && alpha_f <= 0.5;
        let growth = growth(alpha_m, alpha_f);
        assert_eq!(
            growth.is_stable(),
            expected,
            "({alpha_m}, {alpha_f}): {growth:?}"
        );
        counts[usize::from(expected)] += 1;
    }
    assert!(counts[0] > 200 && counts[1] > 200, "{counts:?}");
}

#[test]
fn the_border_itself_is_sharp() {
    for place in [-0.8, -0.3, 0.1, 0.4] {
        assert!(growth(place, place).is_stable());
        assert!(!growth(place + 1e-3, place).is_stable());
        assert!(growth(place, 0.5).is_stable());
        assert!(!growth(place, 0.501).is_stable());
    }
    // No step has a solution: gamma = 0.
    assert!(!growth(0.5, 0.0).is_stable());
}

#[test]
fn high_frequencies_have_the_roots_of_eqs_101_and_103() {
    for [alpha_m, alpha_f] in grid().filter(|[alpha_m, alpha_f]| alpha_m <= alpha_f) {
        let expected = at_infinity(alpha_m, alpha_f);
        let found = growth(alpha_m, alpha_f).at_infinity;
        let difference = (found - expected).abs();
        assert!(
            difference < 2e-3 * expected.max(1.0),
            "({alpha_m}, {alpha_f}): {found} {expected}"
        );
    }
}

/// "Violation of |lambda_3| <= |lambda_1,2| will result in a cusp": where `alpha_f > 0`. With `alpha_f <= 0`, below
/// the dotted line and around C, there is none, though lambda_3, which is positive there, is the larger one.
#[test]
fn a_cusp_where_the_third_root_is_larger_and_negative() {
    let mut larger_without_cusp = 0;
    for [alpha_m, alpha_f] in grid() {
        let is_stable = alpha_m <= alpha_f && alpha_f <= 0.5;
        let [principal, third] = moduli_at_infinity(alpha_m, alpha_f);
        if !is_stable || (third - principal).abs() < 1e-2 {
            continue;
        }
        let mut probe = unrestricted_probe(alpha_m, alpha_f);
        let radii = wide()
            .into_iter()
            .map(|ratio| probe.spectrum(ratio).unwrap().radius);
        let rise = rise(&radii.collect::<Vec<f64>>());
        let expected = third > principal && alpha_f > 0.0;
        assert_eq!(rise > NO_RISE, expected, "({alpha_m}, {alpha_f}): {rise:e}");
        larger_without_cusp += usize::from(third > principal && !expected);
    }
    assert!(larger_without_cusp > 20, "{larger_without_cusp}");
}
