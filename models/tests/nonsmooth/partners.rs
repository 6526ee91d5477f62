//! Impacts with partners: rod and slider with the mobility of the crank collide as the whole mechanism does.

use linchpin_models::nonsmooth::impact::{self, AtJoints};
use linchpin_models::nonsmooth::matrix::dot;
use linchpin_models::nonsmooth::mechanics::{Mechanics, Settings};
use linchpin_models::nonsmooth::partners::Partners;
use linchpin_models::nonsmooth::system::MechanicalSystem;
use linchpin_models::nonsmooth::systems::notch::CornerLaw;
use linchpin_models::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism, RigidSliderCrank};
use linchpin_models::nonsmooth::systems::rod_slider::{RodSlider, RodWithSlider};
use linchpin_worker::Interface;

const ANGLES: [f64; 3] = [0.37, -0.19, 0.013];
const RATES: [f64; 3] = [150.0, -71.0, 3.1];
/// Two closed corners: towards the walls at these rates, with friction.
const CLOSED: [bool; 4] = [true, true, false, false];

fn law() -> CornerLaw {
    CornerLaw {
        normal_restitution: 0.43,
        tangential_restitution: 0.1,
        friction: 0.17,
    }
}

fn rod_slider(mechanism: &Mechanism) -> RodSlider {
    let [_, rod, slider] = mechanism.masses;
    let [_, of_rod, of_slider] = mechanism.inertias;
    let bodies = RodWithSlider {
        length: mechanism.lengths[1],
        masses: [rod, slider],
        inertias: [of_rod, of_slider],
        gravity: mechanism.gravity,
        notch: mechanism.notch,
    };
    RodSlider::new(bodies, Guide::Clearance(law()))
}

/// Direction in which the crank moves the pin, its inertia about its bearing, and its length.
fn crank(mechanism: &Mechanism) -> ([f64; 2], f64, f64) {
    let length = mechanism.lengths[0];
    let inertia = mechanism.inertias[0] + 0.25 * mechanism.masses[0] * length * length;
    let (sin, cos) = ANGLES[0].sin_cos();
    ([-sin, cos], inertia, length)
}

fn collide(
    system: impl MechanicalSystem + 'static,
    inputs: usize,
    [q, v]: [&[f64]; 2],
    at_joints: AtJoints<'_>,
) -> (Vec<f64>, Vec<f64>, f64) {
    let mut mechanics = Mechanics::new(Box::new(system), inputs, Settings::default());
    let mut behind = v.to_vec();
    let mut impulses = vec![0.0; mechanics.rows()];
    let work = impact::correct(
        &mut mechanics,
        &CLOSED,
        q,
        &mut behind,
        &mut impulses,
        at_joints,
    );
    (behind, impulses, work.unwrap())
}

/// The pin's place and velocity with the angles of rod and slider behind them.
fn split(mechanism: &Mechanism) -> [[f64; 4]; 2] {
    let (towards, _, length) = crank(mechanism);
    let (sin, cos) = ANGLES[0].sin_cos();
    let speed = length * RATES[0];
    [
        [length * cos, length * sin, ANGLES[1], ANGLES[2]],
        [speed * towards[0], speed * towards[1], RATES[1], RATES[2]],
    ]
}

/// Loads at the pin in axes that are neither those of the ground nor orthogonal; `Y` in the same.
fn interface(mechanism: &Mechanism) -> Interface {
    let (towards, inertia, length) = crank(mechanism);
    let axes = [[0.8, -0.6], [1.1, 0.5]];
    let along = axes.map(|axis| length * dot(&axis, &towards));
    let mobility = along.map(|one| along.map(|other| one * other / inertia));
    Interface {
        directions: axes.map(|[x, y]| vec![x, y, 0.0]).to_vec(),
        mobility: mobility.as_flattened().to_vec(),
    }
}

#[test]
fn rod_and_slider_collide_as_the_whole_mechanism() {
    let mechanism = Mechanism::table_1();
    let whole = RigidSliderCrank::new(mechanism, Guide::Clearance(law()));
    let (rates, together, _) = collide(whole, 1, [&ANGLES, &RATES], AtJoints::Nothing);
    assert!(together[0] > 0.0 && together[1] != 0.0, "{together:?}");

    let [q, v] = split(&mechanism);
    let mut partners = Partners::new(interface(&mechanism)).unwrap();
    let at_joints = AtJoints::Partners(&mut partners);
    let (behind, impulses, _) = collide(rod_slider(&mechanism), 3, [&q, &v], at_joints);
    for (own, whole) in impulses.iter().zip(&together) {
        assert!((own - whole).abs() < 1e-14, "{impulses:?} {together:?}");
    }
    // The crank takes the opposite impulse, and the pin moves with both.
    let (towards, inertia, length) = crank(&mechanism);
    let loads = partners.loads();
    let crank_rate = RATES[0] - length * dot(&loads[..2], &towards) / inertia;
    let expected = [
        length * rates[0] * towards[0],
        length * rates[0] * towards[1],
        rates[1],
        rates[2],
    ];
    assert!((crank_rate - rates[0]).abs() < 1e-12 * rates[0].abs());
    for (own, expected) in behind.iter().zip(expected) {
        assert!((own - expected).abs() < 1e-11, "{behind:?} {expected:?}");
    }
}

/// The same impulses, given: the corners answer by their law, whatever the impulse at the joint is.
#[test]
fn given_impulses_leave_the_restitution_at_the_contacts() {
    let mechanism = Mechanism::table_1();
    let [q, v] = split(&mechanism);
    let system = rod_slider(&mechanism);
    let mut partners = Partners::new(interface(&mechanism)).unwrap();
    let at_joints = AtJoints::Partners(&mut partners);
    let (behind, ..) = collide(system.clone(), 3, [&q, &v], at_joints);
    let loads = partners.loads();
    let (again, ..) = collide(system.clone(), 3, [&q, &v], AtJoints::Loads(&loads));
    for (own, expected) in again.iter().zip(&behind) {
        assert!((own - expected).abs() < 1e-12, "{again:?} {behind:?}");
    }
    let other = [0.7 * loads[0], 1.2 * loads[1], 0.0];
    let (behind, ..) = collide(system.clone(), 3, [&q, &v], AtJoints::Loads(&other));
    let mut directions = vec![0.0; 8 * 4];
    system.directions(&q, &mut directions);
    let normal = &directions[..4];
    let ratio = -dot(normal, &behind) / dot(normal, &v);
    assert!((ratio - 0.43).abs() < 1e-12, "{ratio}");
}

/// What contacts and joints take or bring is all that changes the energy.
#[test]
fn the_work_at_the_joints_closes_the_balance() {
    let mechanism = Mechanism::table_1();
    let [q, v] = split(&mechanism);
    let system = rod_slider(&mechanism);
    let mut partners = Partners::new(interface(&mechanism)).unwrap();
    let at_joints = AtJoints::Partners(&mut partners);
    let (behind, impulses, work) = collide(system.clone(), 3, [&q, &v], at_joints);
    let mut directions = vec![0.0; 8 * 4];
    system.directions(&q, &mut directions);
    let rows = directions.chunks_exact(4).zip(&impulses);
    let by_contacts: f64 = rows
        .map(|(row, impulse)| 0.5 * impulse * (dot(row, &v) + dot(row, &behind)))
        .sum();
    let change = system.energy(&q, &behind) - system.energy(&q, &v);
    assert!(by_contacts < -1e-3 && work.abs() > 1e-3);
    assert!(
        (change - by_contacts - work).abs() < 1e-13,
        "{change} {by_contacts} {work}"
    );
}

/// A partner that does not move is a bearing of the pin.
#[test]
fn partners_that_do_not_move_hold_the_pin() {
    let mechanism = Mechanism::table_1();
    let [q, v] = split(&mechanism);
    let fixed = Interface {
        mobility: vec![0.0; 4],
        ..interface(&mechanism)
    };
    let mut partners = Partners::new(fixed).unwrap();
    let at_joints = AtJoints::Partners(&mut partners);
    let (behind, ..) = collide(rod_slider(&mechanism), 3, [&q, &v], at_joints);
    for axis in 0..2 {
        assert!((behind[axis] - v[axis]).abs() < 1e-12, "{behind:?}");
    }
    assert!(Partners::new(Interface::default()).is_none());
}
