//! The references of linked pendulums against each other, the pendulum model and Newton's laws.

#![allow(clippy::unwrap_used)]

mod common;

use common::body::{Body, TIGHT, difference};
use linchpin_models::reference::{Chain, DoublePendulum, GroundHinge, Link, ReferenceError};

const LINK: Link = Link {
    m: 1.3,
    inertia: 0.17,
    length: 0.9,
};
const HINGE: GroundHinge = GroundHinge {
    spring: 21.0,
    damping: 0.83,
    rest_angle: 0.3,
};

fn chain(angles: &[f64], rates: &[f64], hinge: GroundHinge) -> Chain {
    Chain {
        link: LINK,
        hinge,
        gravity: 9.7,
        angles: angles.to_vec(),
        rates: rates.to_vec(),
    }
}

fn times(step: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|i| i as f64 * step).collect()
}

/// The figure of S1 Sect. 4.2 (seed notes, fact 7).
#[test]
fn the_double_pendulum_of_the_paper_starts_with_its_hinge_force() {
    let start = DoublePendulum::schweizer_lu()
        .motions(&[0.0])
        .unwrap()
        .remove(0);
    let [force] = start.hinge_forces[..] else {
        panic!()
    };
    assert!(
        difference(&force, &[-1.839375, -0.613125]) < 1e-14,
        "{force:?}"
    );
}

/// A coupled run of another program (golden run D03: weighted multipliers, degree 1, H = 1e-3, whose angles are
/// 4e-10 wrong).
#[test]
fn a_coupled_run_of_the_double_pendulum_is_near() {
    let motions = DoublePendulum::schweizer_lu()
        .motions(&[0.04, 0.06])
        .unwrap();
    let golden = [
        [0.781549340035, -0.793704360840],
        [0.778505888021, -0.804046168549],
    ];
    for (motion, golden) in motions.iter().zip(golden) {
        let error = difference(&motion.angles, &golden);
        assert!(error < 2e-9, "{error:e} at {}", motion.t);
    }
}

#[test]
fn without_a_damper_the_energy_stays() {
    let free = GroundHinge {
        damping: 0.0,
        ..HINGE
    };
    let double = DoublePendulum {
        hinge: GroundHinge {
            damping: 0.0,
            ..DoublePendulum::schweizer_lu().hinge
        },
        rates: [0.0, 6.0],
        ..DoublePendulum::schweizer_lu()
    };
    let five = chain(
        &[-1.1, 0.2, 1.4, -2.0, 0.1],
        &[1.0, 0.0, -3.0, 2.0, 0.0],
        free,
    );
    let times = times(0.1, 20);
    for motions in [double.motions(&times), five.motions(&times)] {
        let motions = motions.unwrap();
        let start = motions[0].energy;
        for motion in &motions {
            let error = (motion.energy - start).abs();
            assert!(
                error < 1e-9 * (1.0 + start.abs()),
                "{error:e} at {}",
                motion.t
            );
        }
    }
}

#[test]
fn a_chain_of_one_link_is_the_pendulum() {
    let parameters = [
        ("m", LINK.m),
        ("inertia", LINK.inertia),
        ("length", LINK.length),
        ("gravity", 9.7),
        ("spring", HINGE.spring),
        ("damping", HINGE.damping),
        ("rest_angle", HINGE.rest_angle),
        ("angle0", 1.1),
        ("rate0", -4.0),
    ];
    let mut body = Body::new("pendulum", &parameters, TIGHT);
    let times = times(0.13, 10);
    for motion in &chain(&[1.1], &[-4.0], HINGE).motions(&times).unwrap()[1..] {
        body.advance(0.13);
        let own = [motion.angles[0], motion.rates[0], motion.energy];
        let error = difference(&body.read_all(["angle", "rate", "energy"]), &own);
        assert!(error < 1e-9, "{error:e} at {}", motion.t);
        assert!(motion.hinge_forces.is_empty());
    }
}

#[test]
fn a_chain_of_two_links_is_the_double_pendulum() {
    let (angles, rates) = ([1.1, -2.0], [-4.0, 3.0]);
    let double = DoublePendulum {
        links: [LINK; 2],
        hinge: HINGE,
        gravity: 9.7,
        angles,
        rates,
    };
    let times = times(0.13, 10);
    let two = chain(&angles, &rates, HINGE).motions(&times).unwrap();
    for (a, b) in two.iter().zip(double.motions(&times).unwrap()) {
        assert!(difference(&a.angles, &b.angles) < 1e-9);
        assert!(difference(&a.rates, &b.rates) < 1e-9);
        assert!(difference(&a.hinge_forces[0], &b.hinge_forces[0]) < 1e-8);
        assert!((a.energy - b.energy).abs() < 1e-9);
    }
}

/// Each link obeys Newton's law under its weight and the forces in its two hinges.
#[test]
fn hinge_forces_accelerate_the_links() {
    let step = 1e-3;
    let own = chain(&[-1.1, 0.2, 1.4, -2.0], &[1.0, 0.0, -3.0, 2.0], HINGE);
    let times: Vec<_> = (0..5).map(|i| 0.2 + step * f64::from(i)).collect();
    let motions = own.motions(&times).unwrap();
    let centres = |angles: &[f64], axis: fn(f64) -> f64| -> Vec<f64> {
        let inner = |i: usize| angles[..i].iter().map(|&angle| axis(angle)).sum::<f64>();
        let centre = |i: usize| LINK.length * (inner(i) + 0.5 * axis(angles[i]));
        (0..angles.len()).map(centre).collect()
    };
    for (axis, weight) in [(f64::cos as fn(f64) -> f64, 0.0), (f64::sin, -LINK.m * 9.7)] {
        let points: Vec<_> = motions
            .iter()
            .map(|motion| centres(&motion.angles, axis))
            .collect();
        let direction = usize::from(weight != 0.0);
        for link in 1..4 {
            let at = |point: usize| points[point][link];
            let second = -at(0) + 16.0 * at(1) - 30.0 * at(2) + 16.0 * at(3) - at(4);
            let acceleration = second / (12.0 * step * step);
            let forces = &motions[2].hinge_forces;
            let outer = forces.get(link).map_or(0.0, |force| force[direction]);
            let force = weight + outer - forces[link - 1][direction];
            let error = (LINK.m * acceleration - force).abs();
            assert!(error < 1e-6, "link {link}: {error:e} of {force}");
        }
    }
}

/// The damper takes `damping rate^2`.
#[test]
fn the_damper_takes_its_power() {
    let step = 1e-3;
    let times: Vec<_> = (0..5).map(|i| 0.2 + step * f64::from(i)).collect();
    let motions = chain(&[1.1, -2.0, 0.4], &[-4.0, 3.0, 0.0], HINGE)
        .motions(&times)
        .unwrap();
    let e = |i: usize| motions[i].energy;
    let power = (e(0) - 8.0 * e(1) + 8.0 * e(3) - e(4)) / (12.0 * step);
    let expected = -HINGE.damping * motions[2].rates[0].powi(2);
    assert!((power / expected - 1.0).abs() < 1e-7, "{power} {expected}");
}

#[test]
fn mistakes_are_named() {
    let refused = |chain: Chain, times: &[f64]| chain.motions(times).unwrap_err().to_string();
    let good = || chain(&[0.1, 0.2], &[0.0, 0.0], HINGE);
    assert!(matches!(
        good().motions(&[0.0, 0.5, 0.4]),
        Err(ReferenceError::Time { place: 2, .. })
    ));
    assert!(refused(good(), &[-1.0]).contains("-1"));
    assert!(refused(chain(&[], &[], HINGE), &[0.0]).contains("no link"));
    assert!(refused(chain(&[0.1], &[0.0, 1.0], HINGE), &[0.0]).contains("1 angles but 2 rates"));
    for (chain, field) in [
        (
            Chain {
                link: Link { m: 0.0, ..LINK },
                ..good()
            },
            "m = 0",
        ),
        (
            Chain {
                link: Link {
                    inertia: -1.0,
                    ..LINK
                },
                ..good()
            },
            "inertia = -1",
        ),
        (
            Chain {
                link: Link {
                    length: f64::NAN,
                    ..LINK
                },
                ..good()
            },
            "length = NaN",
        ),
        (
            Chain {
                hinge: GroundHinge {
                    spring: -2.0,
                    ..HINGE
                },
                ..good()
            },
            "spring = -2",
        ),
        (
            Chain {
                gravity: f64::INFINITY,
                ..good()
            },
            "gravity = inf",
        ),
    ] {
        let message = refused(chain, &[0.0]);
        assert!(
            message.contains(field) && message.contains("must be"),
            "{message}"
        );
    }
}
