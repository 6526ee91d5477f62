//! The bouncing ball, all schemes, against closed forms. Free flight is exact for all of them, so that the state before
//! the first impact has no error and the impact is noticed up to one step late.

use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::systems::point_mass::BouncingBall;
use linchpin_proto::polynomial::Polynomial;
use linchpin_worker::Inputs;

use super::stand::{SCHEMES, Stand, order};

const MASS: f64 = 0.37;
const GRAVITY: f64 = 9.79;
const HEIGHT: f64 = 0.737;
const SPEED: f64 = 0.31;

fn ball(scheme: SchemeKind, restitution: f64, q: f64, v: f64) -> Stand {
    let system = BouncingBall::new(MASS, GRAVITY, restitution);
    Stand::new(system, scheme, Settings::default(), [&[q], &[v]])
}

/// Time and speed of the first impact.
fn first_impact() -> (f64, f64) {
    let speed = (SPEED * SPEED + 2.0 * GRAVITY * HEIGHT).sqrt();
    ((SPEED + speed) / GRAVITY, speed)
}

/// Steps until an impact.
fn fall(stand: &mut Stand, dt: f64) {
    let impacts = stand.integrator.log.impacts;
    while stand.integrator.log.impacts == impacts {
        stand.step(dt);
    }
}

#[test]
fn the_first_impact_comes_in_its_step_and_reverses_the_speed() {
    let (time, speed) = first_impact();
    let restitution = 0.63;
    for case in SCHEMES {
        for dt in [1.3e-3, 1.7e-4] {
            let mut stand = ball(case.kind, restitution, HEIGHT, SPEED);
            fall(&mut stand, dt);
            let late = stand.integrator.log.first_impact.unwrap() - time;
            // Moreau's rule looks at the middle of the step.
            let shift = if case.kind == SchemeKind::Moreau {
                0.51 * dt
            } else {
                0.0
            };
            let is_in_step = late >= -1e-12 && late <= dt + shift;
            assert!(is_in_step, "{case:?}: {late:e}");
            let own = stand.v()[0];
            let allowed = restitution * GRAVITY * dt + 1e-12;
            assert!((own - restitution * speed).abs() <= allowed, "{case:?}");
            assert!(stand.integrator.log.penetration <= speed * dt * 1.01);
        }
    }
}

#[test]
fn an_impact_after_a_force_that_varies_has_the_order_of_the_scheme() {
    // m z'' = -m g + c1 t + c2 t^2.
    let (c1, c2) = (-0.83, 2.9);
    let z = |t: f64| {
        let force = c1 * t.powi(3) / 6.0 + c2 * t.powi(4) / 12.0;
        HEIGHT + SPEED * t - 0.5 * GRAVITY * t * t + force / MASS
    };
    let (mut low, mut high) = (0.2, 0.8);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if z(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    for case in SCHEMES {
        let error = |dt: f64| {
            let mut inputs = Inputs::constant(&[0.0]);
            let force = [0.0, 0.5, 1.0].map(|t| c1 * t + c2 * t * t);
            inputs.replace(0, Polynomial::through(&[0.0, 0.5, 1.0], &force).unwrap());
            let system = BouncingBall::new(MASS, GRAVITY, 0.63);
            let start: [&[f64]; 2] = [&[HEIGHT], &[SPEED]];
            let mut stand = Stand::driven(system, case.kind, Settings::default(), start, inputs);
            let mut before = stand.integrator.state.clone();
            while stand.integrator.log.impacts == 0 {
                before.copy_from(&stand.integrator.state);
                stand.step(dt);
            }
            // From the last state before it on: q + v s + a s^2/2 = 0.
            let t = before.tau;
            let a = -GRAVITY + (c1 * t + c2 * t * t) / MASS;
            let (q, v) = (before.q[0], before.v[0]);
            t + (-v - (v * v - 2.0 * a * q).sqrt()) / a - low
        };
        let [coarse, fine] = [4e-3, 2e-3].map(|dt| error(dt).abs());
        let seen = order(coarse, fine);
        assert!(seen > 1.8, "{case:?}: {coarse:e} {fine:e} {seen}");
    }
}

#[test]
fn bounces_end_at_the_time_of_zeno_and_the_ball_rests() {
    let (time, speed) = first_impact();
    let restitution = 0.63;
    let end = time + 2.0 * restitution * speed / (GRAVITY * (1.0 - restitution));
    for case in SCHEMES {
        let dt = 1e-4;
        let mut stand = ball(case.kind, restitution, HEIGHT, SPEED);
        let mut energy = stand.integrator.energy();
        for bounce in 1..=5 {
            fall(&mut stand, dt);
            let expected = restitution.powi(bounce) * speed;
            let error = (stand.v()[0] - expected).abs();
            assert!(error <= 2.0 * GRAVITY * dt, "{case:?} {bounce}: {error:e}");
            let now = stand.integrator.energy();
            assert!(now <= energy + 1e-12, "{case:?}: energy from nowhere");
            energy = now;
            // The height that it reaches.
            while stand.v()[0] > 0.0 {
                stand.step(dt);
            }
            let height = expected * expected / (2.0 * GRAVITY);
            assert!((stand.q()[0] - height).abs() <= 4.0 * expected * dt);
        }
        while stand.t() < 1.02 * end {
            stand.step(dt);
            let now = stand.integrator.energy();
            // Between bounces that are shorter than a step it can climb out of its penetration.
            let allowed = MASS * (GRAVITY * dt).powi(2);
            assert!(now <= energy + allowed, "{case:?}: {now:e} {energy:e}");
            energy = energy.min(now);
        }
        let place = stand.q()[0];
        stand.steps(1000, dt);
        let (log, state) = (stand.integrator.log, &stand.integrator.state);
        assert!(log.penetration <= speed * dt * 1.01, "{case:?}");
        assert!((stand.q()[0] - place).abs() <= 1e-12, "{case:?}");
        assert!(stand.v()[0].abs() <= 1e-12, "{case:?}");
        let excess = state.forces[0] / (MASS * GRAVITY) - 1.0;
        let is_rest = case.is_undamped() || excess.abs() < 1e-9;
        assert!(is_rest, "{case:?} {excess}");
        let balance = stand.integrator.energy() + log.impact_loss + log.friction_loss;
        let start = MASS * (GRAVITY * HEIGHT + 0.5 * SPEED * SPEED);
        assert!(
            (balance / start - 1.0).abs() < 1e-3 * dt / 1e-4,
            "{case:?}: {balance}"
        );
    }
}

#[test]
fn a_perfect_ball_keeps_its_energy_over_many_bounces() {
    for case in SCHEMES {
        let mut stand = ball(case.kind, 1.0, HEIGHT, SPEED);
        let start = stand.integrator.energy();
        for _ in 0..200 {
            fall(&mut stand, 1e-3);
        }
        let change = stand.integrator.energy() / start - 1.0;
        assert!(change.abs() < 1e-10, "{case:?}: {change:e}");
    }
}

#[test]
fn a_ball_of_clay_stays_where_it_falls() {
    for case in SCHEMES {
        let mut stand = ball(case.kind, 0.0, HEIGHT, SPEED);
        fall(&mut stand, 1e-3);
        let place = stand.q()[0];
        stand.steps(100, 1e-3);
        assert_eq!(stand.integrator.log.impacts, 1, "{case:?}");
        assert!((stand.q()[0] - place).abs() < 1e-14, "{case:?}");
    }
}

#[test]
fn a_contact_that_is_closed_at_the_start() {
    for case in SCHEMES {
        let mut rest = ball(case.kind, 0.63, 0.0, 0.0);
        rest.steps(100, 1e-3);
        assert_eq!(rest.integrator.log.impulse, 0.0, "{case:?}");
        assert!(rest.q()[0].abs() < 1e-15 && rest.v()[0].abs() < 1e-15);

        // It collides at once.
        let hit = ball(case.kind, 0.63, 0.0, -1.1);
        assert_eq!(hit.integrator.log.impacts, 1, "{case:?}");
        assert!((hit.v()[0] - 0.63 * 1.1).abs() < 1e-15, "{case:?}");

        // It leaves.
        let mut free = ball(case.kind, 0.63, 0.0, 1.1);
        assert!((free.integrator.state.a[0] + GRAVITY).abs() < 1e-12);
        free.steps(100, 1e-3);
        let expected = 1.1 * 0.1 - 0.5 * GRAVITY * 0.01;
        assert!((free.q()[0] - expected).abs() < 1e-12, "{case:?}");
    }
}
