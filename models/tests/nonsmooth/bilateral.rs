//! The rigid slider-crank without clearance: orders of convergence, and S2 Table 4.
//!
//! Reference without friction: one coordinate is left, and energy gives its velocity, `theta_1' = sqrt(2 (E - V) / m)`.

use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::system::MechanicalSystem;
use linchpin_models::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism, RigidSliderCrank};

use super::golden::rows;
use super::stand::{AS_PRINTED, SCHEMES, Stand, order};

const START: [&[f64]; 2] = [&[0.0; 3], &[150.0, -75.0, 0.0]];

fn system(friction: f64) -> RigidSliderCrank {
    RigidSliderCrank::new(Mechanism::table_1(), Guide::Bilateral { friction })
}

/// Angle of the rod for one of the crank, and its derivative.
fn rod(crank: f64) -> [f64; 2] {
    let [l1, l2] = Mechanism::table_1().lengths;
    let angle = (-l1 / l2 * crank.sin()).asin();
    [angle, -l1 * crank.cos() / (l2 * angle.cos())]
}

/// Angles of the rod at every multiple of 1e-4 s from there to 0.05 s.
fn reference() -> Vec<f64> {
    let system = system(0.0);
    let energy = system.energy(START[0], START[1]);
    let rate = |crank: f64| {
        let [angle, by_crank] = rod(crank);
        let q = [crank, angle, 0.0];
        let potential = system.energy(&q, &[0.0; 3]);
        let inertia = 2.0 * (system.energy(&q, &[1.0, by_crank, 0.0]) - potential);
        (2.0 * (energy - potential) / inertia).sqrt()
    };
    let (mut crank, steps) = (0.0, 50);
    let h = 1e-4 / f64::from(steps);
    let mut samples = Vec::new();
    for _ in 0..500 {
        for _ in 0..steps {
            let k1 = rate(crank);
            let k2 = rate(crank + 0.5 * h * k1);
            let k3 = rate(crank + 0.5 * h * k2);
            let k4 = rate(crank + h * k3);
            crank += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
        }
        samples.push(rod(crank)[0]);
    }
    samples
}

/// S2 eq. (92), sampled every 1e-4 s.
fn error_of_paper(scheme: SchemeKind, per_sample: usize, reference: &[f64]) -> f64 {
    let mut stand = Stand::new(system(0.0), scheme, AS_PRINTED, START);
    let dt = 1e-4 / per_sample as f64;
    let errors = reference.iter().map(|angle| {
        stand.steps(per_sample, dt);
        ((stand.q()[1] - angle) / angle).powi(2)
    });
    errors.sum::<f64>().sqrt()
}

#[test]
fn the_reference_by_energy_is_the_one_of_the_golden_file() {
    let reference = reference();
    for row in &rows("reference_bilateral_table1_mu0.csv")[1..] {
        let sample = (row.get("t") / 1e-4).round() as usize;
        let error = reference[sample - 1] - row.get("theta2");
        assert!(error.abs() < 1e-9, "{error:e}");
    }
}

#[test]
fn table_4_of_the_paper() {
    // Errors for dt = 1e-4, 1e-5, 1e-6 s. S2 prints one or two digits of most of them.
    let table = [
        (SchemeKind::Moreau, [13.1, 1.30, 0.130]),
        (SchemeKind::Hets, [0.184, 1.89e-3, 1.89e-5]),
        (
            SchemeKind::GeneralizedAlpha { rho_inf: 0.8 },
            [0.176, 1.76e-3, 1.76e-5],
        ),
        (SchemeKind::Bathe, [8.8e-2, 8.8e-4, 8.8e-6]),
        (
            SchemeKind::EdAlpha {
                rho_inf: 0.0,
                alpha_ar: 1.0 / 6.0,
            },
            [0.166, 1.66e-3, 1.66e-5],
        ),
    ];
    let reference = reference();
    for (scheme, errors) in table {
        for (per_sample, expected) in [1, 10, 100].into_iter().zip(errors) {
            let seen = error_of_paper(scheme, per_sample, &reference);
            assert!((seen / expected - 1.0).abs() < 0.01, "{scheme:?}: {seen:e}");
        }
    }
}

#[test]
fn motion_and_forces_have_their_orders() {
    for friction in [0.0, 0.01] {
        let file = format!("reference_bilateral_table1_mu{friction}.csv");
        let reference = rows(&file);
        for case in SCHEMES {
            let errors = [5e-5, 2.5e-5].map(|dt: f64| {
                let settings = Settings::default();
                let mut stand = Stand::new(system(friction), case.kind, settings, START);
                let mut errors = [0.0_f64; 2];
                for row in &reference[1..] {
                    stand.steps((1e-3 / dt).round() as usize, dt);
                    let force = stand.integrator.state.forces[0];
                    // The name of the column has a comma.
                    let golden = row.get("lambda_y(signed");
                    errors[0] = errors[0].max((stand.q()[1] - row.get("theta2")).abs());
                    errors[1] = errors[1].max((force - golden).abs());
                }
                errors
            });
            let expected = [case.order, case.force_order];
            for kind in 0..2 {
                let seen = order(errors[0][kind], errors[1][kind]);
                let is_undamped = kind == 1 && case.is_undamped();
                assert!(
                    is_undamped || seen > expected[kind] - 0.2,
                    "{case:?} {kind} {seen}"
                );
            }
        }
    }
}
