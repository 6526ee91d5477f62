//! Hard cases: contacts whose forces are not determined, perfect and no restitution, steps at and beyond limits of
//! stability.

use linchpin_models::nonsmooth::mechanics::{Settings, StepError};
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::systems::body_on_planes::{Body, BodyOnPlanes, Plane, corners_of};
use linchpin_models::nonsmooth::systems::masses::{End, Masses};
use linchpin_models::nonsmooth::systems::notch::{CornerLaw, Notch};
use linchpin_models::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism, RigidSliderCrank};
use linchpin_worker::Inputs;

use super::stand::{SCHEMES, Stand};

const V: [f64; 3] = [150.0, -75.0, 0.0];

fn slider(scheme: SchemeKind, clearance: Option<f64>, friction: f64) -> Stand {
    let table = Mechanism::table_1();
    let law = CornerLaw {
        normal_restitution: 0.4,
        tangential_restitution: 0.0,
        friction,
    };
    let (clearance, guide) = match clearance {
        Some(clearance) => (clearance, Guide::Clearance(law)),
        None => (0.0, Guide::Bilateral { friction }),
    };
    let mechanism = Mechanism {
        notch: Notch {
            clearance,
            ..table.notch
        },
        ..table
    };
    let system = RigidSliderCrank::new(mechanism, guide);
    Stand::new(system, scheme, Settings::default(), [&[0.0; 3], &V])
}

#[test]
fn four_closed_corners_guide_like_a_constraint() {
    // No clearance: the corners can press against each other with any force.
    for friction in [0.0, 0.01] {
        for case in SCHEMES {
            let dt = 4e-5;
            let [mut corners, mut constraint] =
                [Some(0.0), None].map(|clearance| slider(case.kind, clearance, friction));
            corners.steps(500, dt);
            constraint.steps(500, dt);
            // Moreau's rule has errors of order 1, and they differ.
            let allowed = if case.kind == SchemeKind::Moreau {
                1e-3
            } else {
                5e-6
            };
            for (a, b) in corners.q().iter().zip(constraint.q()) {
                assert!((a - b).abs() < allowed, "{case:?}: {a} {b}");
            }
            let log = corners.integrator.log;
            assert!(log.penetration < 1e-4, "{case:?}: {}", log.penetration);
            let [_, _, _, listed] = corners.integrator.mechanics.counters.contact_problems;
            assert_eq!(listed, 0, "{case:?}");
        }
    }
}

#[test]
fn a_block_without_friction_and_loss_keeps_its_energy() {
    let half = [0.23, 0.11];
    for case in SCHEMES {
        let law = CornerLaw {
            normal_restitution: 1.0,
            tangential_restitution: 0.0,
            friction: 0.0,
        };
        let body = Body::rectangle(1.37, half, 9.79);
        let system = BodyOnPlanes::on_plane(body, &corners_of(half), Plane::rising(0.0), law);
        let start: [&[f64]; 2] = [&[0.0, 0.61, 0.43], &[0.3, 0.0, 3.1]];
        let mut stand = Stand::new(system, case.kind, Settings::default(), start);
        let before = stand.integrator.energy();
        let v = stand.v()[0];
        stand.steps(5000, 1e-3);
        let change = stand.integrator.energy() / before - 1.0;
        let impacts = stand.integrator.log.impacts;
        assert!(change.abs() < 1e-11 && impacts > 10, "{case:?}: {change:e}");
        assert!(
            (stand.v()[0] - v).abs() < 1e-12,
            "{case:?}: no force along x"
        );
    }
}

#[test]
fn explicit_schemes_end_at_their_limit_and_say_so() {
    // The last mass and its stiff spring: omega^2 = k_0 + k_3 = 1e6 + 1.
    let omega = (1e6_f64 + 1.0).sqrt();
    for case in SCHEMES {
        let run = |share: f64, steps: usize| {
            let system = Masses::of_paper(End::Spring(1e6));
            let none = Inputs::constant(&[]);
            let start: [&[f64]; 2] = [&[0.0, 0.0, 1e-5], &[0.0; 3]];
            let settings = Settings::default();
            let mut stand = Stand::try_driven(system, case.kind, settings, start, none)?;
            let mut largest: f64 = 0.0;
            for _ in 0..steps {
                stand.try_step(share / omega)?;
                largest = largest.max(stand.q()[2].abs());
            }
            Ok(largest)
        };
        let is_explicit = matches!(case.kind, SchemeKind::Hets | SchemeKind::Moreau);
        // Static deflection: 1e-5 m.
        let below: Result<f64, StepError> = run(1.99, 5000);
        assert!(below.unwrap() < 1e-3, "{case:?}");
        let beyond = run(2.02, 5000);
        if is_explicit {
            let is_told = matches!(beyond, Err(StepError::Unstable { .. }));
            assert!(is_told, "{case:?} {beyond:?}");
        } else {
            assert!(beyond.unwrap() < 1e-4, "{case:?}");
            assert!(run(100.0, 5000).unwrap() < 1e-3, "{case:?}");
        }
    }
}
