//! Figs. 11 and 12 and what Sect. 2.7 says about ED-alpha.

use linchpin_models::nonsmooth::schemes::SchemeKind::Bathe;
use linchpin_models::nonsmooth::spectrum::region::INFINITE;

use super::{
    NEWMARK, NO_RISE, damping_ratio, decaying, ed, optimal, period_error, radii, radius, rise,
    sweep, wide,
};

const RHO_INF: [f64; 5] = [0.0, 0.2, 0.5, 0.8, 1.0];
const ALPHA_AR: [f64; 7] = [0.02, 0.05, 0.1, 1.0 / 6.0, 0.25, 0.5, 1.0];

/// Eq. (84): `alpha` alone gives the radius for infinite frequency; unconditionally stable.
#[test]
fn rho_inf_is_that_of_alpha_whatever_alpha_ar() {
    for rho_inf in RHO_INF {
        for alpha_ar in ALPHA_AR {
            let scheme = decaying(rho_inf, alpha_ar);
            let at_infinity = radius(scheme, INFINITE);
            assert!(
                (at_infinity - rho_inf).abs() < 1e-3,
                "{scheme:?}: {at_infinity}"
            );
            let most = radii(scheme, &wide()).into_iter().fold(0.0, f64::max);
            assert!(most <= 1.0 + 1e-9, "{scheme:?}: {most}");
        }
        assert!(rise(&radii(ed(rho_inf), &wide())) < NO_RISE, "{rho_inf}");
    }
}

/// "Only controls the cut-off": where the radius has fallen by half of the way, `dt / T` becomes smaller with
/// `alpha_ar`.
#[test]
fn alpha_ar_places_the_cut_off() {
    let ratios = sweep(-2.0, 2.0, 401);
    let cut_offs = ALPHA_AR.map(|alpha_ar| {
        let radii = radii(decaying(0.0, alpha_ar), &ratios);
        ratios[radii.iter().position(|radius| *radius < 0.5).unwrap()]
    });
    assert!(
        cut_offs.windows(2).all(|pair| pair[1] < pair[0]),
        "{cut_offs:?}"
    );
}

/// "For `alpha_ar = 0` or `alpha = 0` we recover a conserving scheme": the former is refused, and its limit is
/// Newmark's rule.
#[test]
fn both_ends_conserve() {
    for alpha_ar in ALPHA_AR {
        let radii = radii(decaying(1.0, alpha_ar), &wide());
        assert!(radii.iter().all(|radius| (radius - 1.0).abs() < 1e-7));
    }
    for ratio in sweep(-2.0, 1.0, 7) {
        assert!((radius(decaying(0.0, 1e-7), ratio) - 1.0).abs() < 1e-5);
        let [limit, newmark] =
            [decaying(0.0, 1e-7), NEWMARK].map(|scheme| period_error(scheme, ratio));
        assert!(
            (limit - newmark).abs() < 1e-4 * newmark.max(0.1),
            "{ratio}: {limit} {newmark}"
        );
    }
}

/// Fig. 11: "the minimum period elongation is obtained for `alpha_ar = 1/6`", that is the smallest error for small
/// steps: beyond 1/6 the period is shortened instead. For `dt / T` = 0.3 and `rho_inf = 0` the minimum is near 0.2.
#[test]
fn a_sixth_has_the_smallest_period_error() {
    for rho_inf in RHO_INF {
        let error = |alpha_ar, ratio| period_error(decaying(rho_inf, alpha_ar), ratio);
        for ratio in [0.01, 0.02, 0.05, 0.1] {
            let best = error(1.0 / 6.0, ratio);
            for other in [0.05, 0.1, 0.14, 0.19, 0.25, 0.5] {
                let found = error(other, ratio);
                assert!(best.abs() < 0.5 * found.abs(), "{rho_inf} {other} {ratio}");
                assert_eq!(found > 0.0, other < 1.0 / 6.0, "{rho_inf} {other} {ratio}");
            }
            assert!(best > 0.0);
        }
    }
    let error = |alpha_ar| period_error(decaying(0.0, alpha_ar), 0.3);
    assert!(error(0.2).abs() < 0.3 * error(1.0 / 6.0));
}

/// Fig. 11: against Bathe's method the period error is smaller by far, the damping of low frequencies larger.
#[test]
fn against_bathe() {
    for ratio in sweep(-2.0, -0.7, 14) {
        let share = period_error(ed(0.0), ratio) / period_error(Bathe, ratio);
        assert!(0.0 < share && share < 0.15, "{ratio}: {share}");
    }
    let share = damping_ratio(ed(0.0), 0.1) / damping_ratio(Bathe, 0.1);
    assert!((4.0..4.1).contains(&share), "{share}");
}

/// Fig. 12: with the same `rho_inf` ED-alpha has the smaller period error. It damps low frequencies less up to
/// `rho_inf` of about 0.7, and more above.
#[test]
fn against_generalised_alpha() {
    for rho_inf in [0.0, 0.2, 0.5, 0.8] {
        let (own, other) = (ed(rho_inf), optimal(rho_inf));
        for ratio in sweep(-2.0, -0.7, 14) {
            let (error, of_other) = (period_error(own, ratio), period_error(other, ratio));
            assert!(0.0 < error && error < 0.07 * of_other, "{rho_inf} {ratio}");
            let (damping, of_other) = (damping_ratio(own, ratio), damping_ratio(other, ratio));
            assert_eq!(damping < of_other, rho_inf < 0.7, "{rho_inf} {ratio}");
        }
    }
    let share = |rho_inf| damping_ratio(ed(rho_inf), 0.1) / damping_ratio(optimal(rho_inf), 0.1);
    let shares = [0.0, 0.5, 0.8].map(share);
    for (found, expected) in shares.into_iter().zip([0.060, 0.294, 2.354]) {
        assert!((found - expected).abs() < 1e-3, "{shares:?}");
    }
}
