//! Figs. 7 to 9 and what Sect. 2.4.1 and Appendix A say about generalised-alpha.

use linchpin_models::nonsmooth::spectrum::region::INFINITE;

use super::{
    NEWMARK, NO_RISE, alpha, damping_ratio, optimal, period_error, radii, radius, rise, wide,
};

const HHT: [f64; 8] = [0.0, 0.1, 0.2, 0.3, 1.0 / 3.0, 0.35, 0.4, 0.5];

/// Fig. 7: with `alpha_m = 0`, `alpha_f` from 0 to 1/2 is stable, and beyond point E, 1/3, there is a cusp.
#[test]
fn hht_has_a_cusp_beyond_a_third() {
    for alpha_f in HHT {
        let radii = radii(alpha(0.0, alpha_f), &wide());
        let (largest, rise) = (radii.iter().copied().fold(0.0, f64::max), rise(&radii));
        assert!(largest <= 1.0 + 1e-9, "{alpha_f}: {largest}");
        let has_cusp = alpha_f > 1.0 / 3.0;
        assert_eq!(rise > NO_RISE, has_cusp, "{alpha_f}: rises by {rise:e}");
    }
    // Dissipation of high frequencies is strongest at E.
    let at_infinity = HHT.map(|alpha_f| radius(alpha(0.0, alpha_f), INFINITE));
    let least = at_infinity.iter().copied().fold(1.0, f64::min);
    assert!(
        (least - 0.5).abs() < 1e-3 && least == at_infinity[4],
        "{at_infinity:?}"
    );
}

/// Fig. 8: the radius falls smoothly from 1 to `rho_inf`, which is reached, and `rho_inf = 1` is without
/// dissipation.
#[test]
fn optimal_parameters_reach_rho_inf_smoothly() {
    for rho_inf in [0.0, 0.2, 0.5, 0.8, 0.9] {
        let radii = radii(optimal(rho_inf), &wide());
        let (first, last) = (radii[0], *radii.last().unwrap());
        assert!(first > 1.0 - 1e-4 && first <= 1.0, "{rho_inf}: {first}");
        assert!((last - rho_inf).abs() < 1e-3, "{rho_inf}: {last}");
        assert!(rise(&radii) < NO_RISE, "{rho_inf}");
    }
    let without = radii(optimal(1.0), &wide());
    assert!(without.iter().all(|radius| (radius - 1.0).abs() < 1e-6));
}

/// Eq. (26): D to B on the dotted line, and Newmark's trapezoidal rule shares its spectrum with `rho_inf = 1`.
#[test]
fn ends_of_the_dotted_line() {
    for ratio in [0.05, 0.3, 2.0] {
        for (rho_inf, [alpha_m, alpha_f]) in [(1.0, [0.5, 0.5]), (0.0, [-1.0, 0.0])] {
            let difference =
                radius(optimal(rho_inf), ratio) - radius(alpha(alpha_m, alpha_f), ratio);
            assert!(difference.abs() < 1e-12);
        }
        let difference = period_error(optimal(1.0), ratio) - period_error(NEWMARK, ratio);
        assert!(difference.abs() < 1e-9, "{difference:e}");
    }
}

/// Fig. 9: A has a cusp. The point of the dotted line with its `rho_inf`, 1, is D, which has none, and no
/// dissipation either.
///
/// C is smooth already, other than the text suggests. Its counterpart with the same `rho_inf`, 1/3, is (-1/4, 1/4),
/// which damps low frequencies less.
#[test]
fn on_the_dotted_line_the_transition_is_smooth() {
    let [a, c] = [alpha(-1.0, 0.5), alpha(-1.0, -0.5)];
    let [moved_a, moved_c] = [optimal(1.0), optimal(1.0 / 3.0)];
    let at_infinity = [a, moved_a, c, moved_c].map(|scheme| radius(scheme, INFINITE));
    for (found, expected) in at_infinity
        .into_iter()
        .zip([1.0, 1.0, 1.0 / 3.0, 1.0 / 3.0])
    {
        assert!((found - expected).abs() < 1e-3, "{at_infinity:?}");
    }
    let rises = [a, moved_a, c, moved_c].map(|scheme| rise(&radii(scheme, &wide())));
    assert!(rises[0] > 0.5, "{rises:?}");
    assert!(rises[1..].iter().all(|rise| *rise < NO_RISE), "{rises:?}");
    assert!(damping_ratio(moved_c, 0.1) < 0.5 * damping_ratio(c, 0.1));
    // The same equivalent in the notation of Fig. 9.
    assert!((radius(moved_c, 0.3) - radius(alpha(-0.25, 0.25), 0.3)).abs() < 1e-12);
}

/// "An optimal combination of high-frequency and low-frequency dissipation": of all parameters with the same
/// `rho_inf` those of eq. (26) damp a low frequency least.
#[test]
fn optimal_parameters_damp_low_frequencies_least() {
    let mut compared = 0;
    for rho_inf in [0.0, 0.3, 0.5, 0.8] {
        let best = damping_ratio(optimal(rho_inf), 0.02);
        let (alpha_m, alpha_f) = (
            (2.0 * rho_inf - 1.0) / (rho_inf + 1.0),
            rho_inf / (rho_inf + 1.0),
        );
        for distance in [0.05, 0.2, 0.5] {
            // |lambda_1,2| = rho_inf: alpha_f - alpha_m stays; |lambda_3| is smaller or has the other sign.
            let along = alpha(alpha_m - distance, alpha_f - distance);
            // |lambda_3| = rho_inf: alpha_f stays; |lambda_1,2| is smaller.
            let across = alpha(alpha_m - distance.min(0.5 * (1.0 - rho_inf)), alpha_f);
            for other in [along, across] {
                let reached = radius(other, INFINITE);
                if reached > rho_inf + 1e-3 {
                    continue;
                }
                compared += 1;
                let damping = damping_ratio(other, 0.02);
                assert!(damping > best, "{other:?}: {damping:e} against {best:e}");
            }
        }
    }
    assert!(compared > 15, "{compared}");
}

/// "For gamma = 0.5 there is no numerical dissipation, for gamma > 0.5 it increases": gamma = 1/2 + alpha_f -
/// alpha_m.
#[test]
fn dissipation_grows_with_gamma() {
    for alpha_m in [-0.5, 0.0, 0.5] {
        assert!(damping_ratio(alpha(alpha_m, alpha_m), 0.1).abs() < 1e-12);
    }
    let dampings = [0.0, 0.1, 0.2, 0.3].map(|alpha_m| damping_ratio(alpha(-alpha_m, 0.0), 0.1));
    assert!(
        dampings.windows(2).all(|pair| pair[1] > pair[0]),
        "{dampings:?}"
    );
}
