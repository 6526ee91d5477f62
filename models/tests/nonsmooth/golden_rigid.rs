//! The rigid slider-crank against golden data, with the conventions of the golden files: accelerations at the start
//! without contacts and carried over impacts.

use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::systems::notch::CornerLaw;
use linchpin_models::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism, RigidSliderCrank};

use super::golden::{Row, assert_near, rows, runs};
use super::stand::{AS_PRINTED, Stand};

const Q: [&str; 3] = ["theta1", "theta2", "theta3"];
const V: [&str; 3] = ["omega1", "omega2", "omega3"];
const CORNERS: [&str; 8] = [
    "lamN1", "lamT1", "lamN2", "lamT2", "lamN3", "lamT3", "lamN4", "lamT4",
];

/// Positions and velocities agree to 1e-9 of the largest, forces to 1e-7; numbers of impacts are the same.
fn compare(file: &str, system: &RigidSliderCrank, v: [f64; 3], forces: &[&str]) {
    let key = |row: &Row| (row.name.clone(), row.get("rho"), row.get("dt"));
    let runs = runs(rows(file), key);
    assert_eq!(runs.len(), 16, "{file}");
    for run in runs {
        let scheme = run[0].scheme();
        let settings = Settings {
            tolerance: 1e-13,
            ..AS_PRINTED
        };
        let mut stand = Stand::new(system.clone(), scheme, settings, [&[0.0; 3], &v]);
        let dt = run[0].get("dt");
        let mut done = 0;
        for row in &run {
            let number = (row.get("t") / dt).round() as usize;
            stand.steps(number - done, dt);
            done = number;
            assert_near(&run, row, &Q, stand.q(), 1e-9);
            assert_near(&run, row, &V, stand.v(), 1e-9);
            if number > 0 {
                let own = &stand.integrator.state.forces;
                assert_near(&run, row, forces, own, force_tolerance(scheme));
            }
        }
        let (log, last) = (stand.integrator.log, &run[run.len() - 1]);
        // The golden file counts the closings of Moreau's rule another way.
        if scheme != SchemeKind::Moreau {
            assert_eq!(log.impacts as f64, last.get("nimp_total"));
        }
        let (own, golden) = (log.penetration, last.get("max_pen"));
        assert!(
            (own - golden).abs() <= 1e-6 * golden + 1e-12,
            "{own} {golden}"
        );
    }
}

/// Without damping rounding stays in the forces.
fn force_tolerance(scheme: SchemeKind) -> f64 {
    match scheme {
        SchemeKind::GeneralizedAlpha { rho_inf: 1.0 } => 2e-6,
        _ => 1e-7,
    }
}

#[test]
fn table_1() {
    let law = CornerLaw {
        normal_restitution: 0.4,
        tangential_restitution: 0.0,
        friction: 0.01,
    };
    let system = RigidSliderCrank::new(Mechanism::table_1(), Guide::Clearance(law));
    compare("rigid_table1.csv", &system, [150.0, -75.0, 0.0], &CORNERS);
}

#[test]
fn table_2() {
    let law = CornerLaw {
        normal_restitution: 0.1,
        tangential_restitution: 0.0,
        friction: 0.1,
    };
    let system = RigidSliderCrank::new(Mechanism::table_2(), Guide::Clearance(law));
    compare("rigid_table2.csv", &system, [0.0; 3], &CORNERS);
}

#[test]
fn without_clearance() {
    for (file, friction) in [
        ("rigid_table1_bilateral_mu0.csv", 0.0),
        ("rigid_table1_bilateral_mu0.01.csv", 0.01),
    ] {
        let system = RigidSliderCrank::new(Mechanism::table_1(), Guide::Bilateral { friction });
        let forces = ["lamN1", "lamT1", "lamN2"];
        compare(file, &system, [150.0, -75.0, 0.0], &forces);
    }
}
