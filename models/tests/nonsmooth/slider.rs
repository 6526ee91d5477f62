//! The rigid slider-crank with clearance against the event-driven reference, all schemes.

use linchpin_models::nonsmooth::matrix::dot;
use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::systems::notch::CornerLaw;
use linchpin_models::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism, RigidSliderCrank};

use super::golden::rows;
use super::stand::{SCHEMES, Stand, order};

/// One of the two cases of S2.
pub struct Example {
    pub system: RigidSliderCrank,
    pub v: [f64; 3],
    /// Corner that closes first; its neighbour closes with it.
    corner: usize,
    /// Time, `g_N'` before, and coefficient of the first impact.
    pub first: [f64; 3],
    /// Angles of crank and rod at 0.05 s.
    end: [f64; 2],
    /// Fastest approach of all impacts.
    fastest: f64,
}

/// Tables 1 and 2 of S2.
pub fn examples() -> [Example; 2] {
    let example = |number: usize| {
        let law = [
            CornerLaw {
                normal_restitution: 0.4,
                tangential_restitution: 0.0,
                friction: 0.01,
            },
            CornerLaw {
                normal_restitution: 0.1,
                tangential_restitution: 0.0,
                friction: 0.1,
            },
        ][number - 1];
        let mechanism = [Mechanism::table_1(), Mechanism::table_2()][number - 1];
        let log = rows(&format!("event_table{number}_log.csv"));
        let speed = |row: &super::golden::Row| row.first_of("gdotN_minus");
        let fastest = log.iter().map(|row| speed(row).abs());
        let trajectory = rows(&format!("event_table{number}.csv"));
        let last = &trajectory[trajectory.len() - 1];
        Example {
            system: RigidSliderCrank::new(mechanism, Guide::Clearance(law)),
            v: [[150.0, -75.0, 0.0], [0.0; 3]][number - 1],
            corner: [0, 2][number - 1],
            first: [log[0].get("t"), speed(&log[0]), law.normal_restitution],
            end: [last.get("theta1"), last.get("theta2")],
            fastest: fastest.fold(0.0, f64::max),
        }
    };
    [1, 2].map(example)
}

fn stand(example: &Example, scheme: SchemeKind) -> Stand {
    let start: [&[f64]; 2] = [&[0.0; 3], &example.v];
    Stand::new(example.system.clone(), scheme, Settings::default(), start)
}

/// Gap of a corner and its first two derivatives.
fn gap(stand: &mut Stand, corner: usize) -> [f64; 3] {
    let state = stand.integrator.state.clone();
    let gap = stand.integrator.gaps()[corner];
    let system = &stand.integrator.mechanics.system;
    let (mut directions, mut rates) = ([0.0; 24], [0.0; 8]);
    system.directions(&state.q, &mut directions);
    system.direction_rates(&state.q, &state.v, &mut rates);
    let row = &directions[6 * corner..][..3];
    [
        gap,
        dot(row, &state.v),
        dot(row, &state.a) + rates[2 * corner],
    ]
}

/// Time and `g_N'` of the first impact by the state before it, whose order is that of the scheme.
fn first_impact(stand: &mut Stand, corner: usize, dt: f64) -> [f64; 2] {
    let mut before = gap(stand, corner);
    while stand.integrator.log.impacts == 0 {
        before = gap(stand, corner);
        stand.step(dt);
    }
    let [g, rate, curvature] = before;
    let root = (rate * rate - 2.0 * curvature * g).sqrt();
    [stand.t() - dt + 2.0 * g / (root - rate), -root]
}

#[test]
fn the_first_impact_has_the_order_of_the_scheme() {
    // Errors of the speed over dt^2 (m/s^3) and, of Moreau's rule, over dt (m/s^2).
    let allowed = [[3e5, 140.0], [400.0, 0.3]];
    for (example, [fast, slow]) in examples().into_iter().zip(allowed) {
        let [time, speed, restitution] = example.first;
        for case in SCHEMES {
            let times = [4e-5, 2e-5].map(|dt| {
                let mut stand = stand(&example, case.kind);
                let [t, v] = first_impact(&mut stand, example.corner, dt);
                let [_, behind, _] = gap(&mut stand, example.corner);
                let before = match stand.integrator.velocities_before_impact() {
                    Some(before) => {
                        let before = before.to_vec();
                        stand.integrator.state.v.copy_from_slice(&before);
                        gap(&mut stand, example.corner)[1]
                    }
                    None => v,
                };
                let ratio = -behind / before;
                let allowed = if case.kind == SchemeKind::Moreau {
                    0.02
                } else {
                    1e-9
                };
                assert!((ratio - restitution).abs() < allowed, "{case:?}: {ratio}");
                // Linear in time over a part of a step.
                let allowed = if case.kind == SchemeKind::Moreau {
                    slow * dt
                } else {
                    fast * dt * dt
                };
                let error = (v - speed).abs();
                assert!(error <= allowed, "{case:?}: {error:e}");
                (t - time).abs()
            });
            let seen = order(times[0], times[1]);
            assert!(seen > case.order - 0.05, "{case:?}: {times:?} {seen}");
        }
    }
}

#[test]
fn the_motion_until_the_end_tends_to_the_reference() {
    // Errors over dt (rad/s): those of the mixed schemes and of Moreau's rule.
    let allowed = [[3.5, 340.0], [0.04, 2.5]];
    for (example, [mixed, moreau]) in examples().into_iter().zip(allowed) {
        for case in SCHEMES {
            let allowed = if case.kind == SchemeKind::Moreau {
                moreau
            } else {
                mixed
            };
            for dt in [2e-5, 5e-6] {
                let mut stand = stand(&example, case.kind);
                stand.steps((0.05_f64 / dt).round() as usize, dt);
                let log = stand.integrator.log;
                assert!(log.penetration <= 1.05 * example.fastest * dt, "{case:?}");
                let errors = example.end.iter().zip(stand.q());
                let error = errors.map(|(end, q)| (end - q).abs()).fold(0.0, f64::max);
                assert!(error <= allowed * dt, "{case:?} {dt}: {error:e}");
            }
        }
    }
}
