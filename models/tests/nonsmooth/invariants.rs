//! What holds at every step of every system under all schemes: laws of contact, momentum at impacts, energy with its
//! losses.

use linchpin_models::nonsmooth::matrix::{BorderedBand, dot};
use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::system::{Contact, Side};
use linchpin_models::nonsmooth::systems::body_on_planes::{Body, BodyOnPlanes, Plane, corners_of};
use linchpin_models::nonsmooth::systems::notch::CornerLaw;
use linchpin_models::nonsmooth::systems::point_mass::{BouncingBall, SlidingMass};
use linchpin_models::nonsmooth::systems::woodpecker::{Toy, Woodpecker};

use super::slider::examples;
use super::stand::{Case, SCHEMES, Stand};
use super::woodpecker::START as WOODPECKER_START;

/// Rows and mass matrix at the present place.
struct Place {
    directions: Vec<f64>,
    mass: BorderedBand,
}

fn place(stand: &Stand) -> Place {
    let mechanics = &stand.integrator.mechanics;
    let mut directions = vec![0.0; mechanics.rows() * mechanics.order()];
    let mut mass = BorderedBand::zeros(mechanics.shape());
    mechanics.system.directions(stand.q(), &mut directions);
    mechanics.system.mass(stand.q(), &mut mass);
    Place { directions, mass }
}

/// The laws for one contact, with forces `x` and relative velocities `xi` of its rows; `size` of forces and velocities.
fn assert_law(contact: &Contact, x: &[f64], xi: &[f64], size: [f64; 2], what: &str) {
    let [force, speed] = size;
    if contact.side == Side::Unilateral {
        assert!(x[0] >= -1e-10 * force, "{what}: pulls with {:e}", x[0]);
        assert!(xi[0] >= -1e-9 * speed, "{what}: closes with {:e}", xi[0]);
        let both = (x[0] / force).min(xi[0] / speed);
        assert!(
            both <= 1e-8,
            "{what}: presses {:e} and opens {:e}",
            x[0],
            xi[0]
        );
    }
    assert_cone(contact, x, force, what);
    let slip = xi[1..].iter().map(|xi| xi * xi).sum::<f64>().sqrt();
    if slip > 1e-7 * speed {
        for (x_t, xi) in x[1..].iter().zip(&xi[1..]) {
            let error = x_t + contact.friction * x[0].abs() * xi / slip;
            assert!(
                error.abs() <= 1e-6 * force,
                "{what}: friction off by {error:e}"
            );
        }
    }
}

fn assert_cone(contact: &Contact, x: &[f64], force: f64, what: &str) {
    let friction = x[1..].iter().map(|x| x * x).sum::<f64>().sqrt();
    let excess = friction - contact.friction * x[0].abs();
    assert!(
        excess <= 1e-9 * force,
        "{what}: out of the cone by {excess:e}"
    );
}

/// Largest force, relative velocity and impulse of a run so far.
type Sizes = [f64; 3];

/// One step with all that holds in it.
fn step(stand: &mut Stand, case: &Case, dt: f64, sizes: &mut Sizes) {
    let what = format!("{:?} at {}", case.kind, stand.t());
    let contacts = stand.integrator.mechanics.contacts().to_vec();
    let first = |index: usize| stand.integrator.mechanics.first_row(index);
    let firsts: Vec<usize> = (0..contacts.len()).map(first).collect();
    let pressed = stand.integrator.state.forces.clone();
    let before: Vec<f64> = stand.integrator.gaps().to_vec();
    stand.step(dt);
    let after: Vec<f64> = stand.integrator.gaps().to_vec();
    let place = place(stand);
    let state = &stand.integrator.state;
    let n = state.v.len();
    let largest = |size: f64, values: &[f64]| values.iter().fold(size, |a: f64, b| a.max(b.abs()));
    let velocity = |row: usize, v: &[f64]| dot(&place.directions[row * n..][..n], v);
    let speed = |v: &[f64]| {
        let rows = place.directions.chunks_exact(n);
        let sizes = rows.map(|row| row.iter().zip(v).map(|(d, v)| (d * v).abs()).sum::<f64>());
        sizes.fold(1e-30, f64::max)
    };
    let impact = stand.integrator.velocities_before_impact();
    let [force, fastest, impulse] = sizes;
    *force = largest(*force, &state.forces);
    *fastest = fastest.max(speed(impact.unwrap_or(&state.v)));
    *impulse = largest(*impulse, &state.impulses);
    let (force, fastest, impulse) = (*force, *fastest, *impulse);
    for (index, contact) in contacts.iter().enumerate() {
        let rows = firsts[index]..firsts[index] + contact.rows();
        let x = &state.forces[rows.clone()];
        if impact.is_some() || case.kind == SchemeKind::Moreau {
            // Forces at another place, or those behind the impact.
            assert_cone(contact, x, force, &what);
            continue;
        }
        if contact.side == Side::Unilateral && before[index] > 0.0 && pressed[firsts[index]] <= 0.0
        {
            assert!(
                x.iter().all(|&x| x == 0.0),
                "{what}: an open contact presses"
            );
            continue;
        }
        let xi: Vec<f64> = rows.map(|row| velocity(row, &state.v)).collect();
        assert_law(contact, x, &xi, [force, fastest], &what);
    }
    let Some(v) = impact else {
        return;
    };
    let impulses = &state.impulses;
    let mut momentum = vec![0.0; n];
    place.mass.multiply_add(1.0, &state.v, &mut momentum);
    place.mass.multiply_add(-1.0, v, &mut momentum);
    let mut scale = vec![1e-30; n];
    for (row, impulse) in place.directions.chunks_exact(n).zip(impulses) {
        for i in 0..n {
            momentum[i] -= row[i] * impulse;
            scale[i] += (row[i] * impulse).abs();
        }
    }
    let mut momenta = vec![0.0; n];
    place.mass.multiply_add(1.0, v, &mut momenta);
    for i in 0..n {
        let allowed = 1e-11 * (scale[i] + largest(0.0, &momenta));
        assert!(
            momentum[i].abs() <= allowed,
            "{what}: momentum {momentum:?} {scale:?}"
        );
    }
    for (index, contact) in contacts.iter().enumerate() {
        let rows = firsts[index]..firsts[index] + contact.rows();
        let x = &impulses[rows.clone()];
        if x.iter().all(|&x| x == 0.0) && after[index] > 0.0 {
            continue;
        }
        let xi = rows.enumerate().map(|(k, row)| {
            let restitution = if k == 0 {
                contact.normal_restitution
            } else {
                contact.tangential_restitution
            };
            velocity(row, &state.v) + restitution * velocity(row, v)
        });
        let xi: Vec<f64> = xi.collect();
        assert_law(
            contact,
            x,
            &xi,
            [impulse, fastest],
            &format!("{what}, impact"),
        );
    }
}

/// Runs until `end`; the largest deviation of energy and losses, as a share of `size`. A constant torque acts on the
/// first coordinate.
fn balance(mut stand: Stand, case: &Case, end: f64, dt: f64, [size, torque]: [f64; 2]) -> f64 {
    let start = stand.integrator.energy();
    let mut sizes = [1e-30; 3];
    let mut worst: f64 = 0.0;
    for _ in 0..(end / dt).round() as usize {
        step(&mut stand, case, dt, &mut sizes);
        let log = stand.integrator.log;
        let sum = stand.integrator.energy() + log.impact_loss + log.friction_loss;
        let sum = sum - torque * stand.q()[0];
        worst = worst.max((sum - start).abs());
    }
    worst / size
}

/// All schemes with two steps: the deviation of the energy is at most `allowed` times the step (1/s), for the mixed
/// schemes and for Moreau's rule. Where contacts do not change it is of higher order.
fn check(
    build: impl Fn(SchemeKind) -> Stand,
    end: f64,
    dts: [f64; 2],
    size: [f64; 2],
    [mixed, moreau]: [f64; 2],
) {
    for case in SCHEMES {
        let allowed = if case.kind == SchemeKind::Moreau {
            moreau
        } else {
            mixed
        };
        for dt in dts {
            let deviation = balance(build(case.kind), &case, end, dt, size);
            assert!(deviation <= allowed * dt, "{case:?} {dt}: {deviation:e}");
        }
    }
}

const GRAVITY: f64 = 9.79;

#[test]
fn of_a_bouncing_ball() {
    let build = |scheme| {
        let system = BouncingBall::new(0.37, GRAVITY, 0.63);
        Stand::new(system, scheme, Settings::default(), [&[0.737], &[0.31]])
    };
    check(
        build,
        3.0,
        [4e-3, 5e-4],
        [0.37 * GRAVITY * 0.737, 0.0],
        [0.03, 1e-9],
    );
}

#[test]
fn of_a_tumbling_block() {
    let half = [0.23, 0.11];
    let build = |scheme| {
        let law = CornerLaw {
            normal_restitution: 0.37,
            tangential_restitution: 0.11,
            friction: 0.41,
        };
        let body = Body::rectangle(1.37, half, GRAVITY);
        let system = BodyOnPlanes::on_plane(body, &corners_of(half), Plane::rising(0.31), law);
        let start: [&[f64]; 2] = [&[0.1, 0.51, 0.73], &[0.7, -0.2, 2.9]];
        Stand::new(system, scheme, Settings::default(), start)
    };
    check(
        build,
        1.5,
        [1e-3, 1.25e-4],
        [1.37 * GRAVITY * 0.5, 0.0],
        [0.3, 0.3],
    );
}

#[test]
fn of_a_mass_that_slides_and_stops() {
    let build = |scheme| {
        let gravity = [1.3, 0.7, -GRAVITY];
        let system = SlidingMass::new(1.37, gravity, 0.31);
        let start: [&[f64]; 2] = [&[0.0, 0.0, 0.11], &[-0.83, 1.59, 0.4]];
        Stand::new(system, scheme, Settings::default(), start)
    };
    check(
        build,
        1.7,
        [2e-3, 2.5e-4],
        [1.37 * GRAVITY * 0.11, 0.0],
        [2.0, 0.6],
    );
}

#[test]
fn of_the_slider_crank() {
    let allowed = [[100.0, 1600.0], [2.0, 4.0]];
    for ((example, allowed), torque) in examples().into_iter().zip(allowed).zip([0.0, 1.0]) {
        let start: [&[f64]; 2] = [&[0.0; 3], &example.v];
        let build = |scheme| {
            let system = example.system.clone();
            Stand::new(system, scheme, Settings::default(), start)
        };
        check(build, 0.05, [8e-5, 1e-5], [1.0, torque], allowed);
    }
}

#[test]
fn of_the_woodpecker() {
    let build = |scheme| {
        let system = Woodpecker::new(Toy::of_glocker());
        Stand::new(system, scheme, Settings::default(), WOODPECKER_START)
    };
    // The potential energy of one cycle.
    check(
        build,
        0.15,
        [4e-5, 5e-6],
        [4.8e-3 * 9.81 * 0.0195, 0.0],
        [5.0, 5.0],
    );
}
