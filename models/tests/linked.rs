//! The closed form of linked oscillators.

#![allow(clippy::unwrap_used)]

use linchpin_models::oscillator::OscillatorParameters;
use linchpin_models::reference::{LinkError, LinkedOscillators};
use proptest::prelude::*;

fn mass(m: f64, c: f64, d: f64) -> OscillatorParameters {
    OscillatorParameters {
        m,
        c,
        d,
        x0: 0.0,
        v0: 100.0,
    }
}

#[test]
fn two_masses_start_with_the_multiplier_of_the_paper() {
    // S1 eq. (3); the scene of its Sect. 4.1 gives 1000/3.
    let default = [mass(1.0, 1e3, 10.0), mass(2.0, 1e3, 10.0)];
    let linked = LinkedOscillators::new(&default, &[(0, 1)]).unwrap();
    let start = linked.motion(0.0);
    assert!((linked.multiplier(0, 0.0, &start).unwrap() - 1e3 / 3.0).abs() < 1e-10);
    assert_eq!(linked.multiplier(1, 0.0, &start), None);

    let [m1, m2, c1, c2, d1, d2, x0, v0] = [0.7, 2.9, 130.0, 11.0, 0.3, 4.1, 0.13, -1.9];
    let masses =
        [(m1, c1, d1), (m2, c2, d2)].map(|(m, c, d)| OscillatorParameters { m, c, d, x0, v0 });
    let linked = LinkedOscillators::new(&masses, &[(0, 1)]).unwrap();
    let expected = m1 * m2 / (m1 + m2) * ((c1 / m1 - c2 / m2) * x0 + (d1 / m1 - d2 / m2) * v0);
    let lambda = linked.multiplier(0, 0.0, &linked.motion(0.0)).unwrap();
    assert!(
        (lambda / expected - 1.0).abs() < 1e-13,
        "{lambda} {expected}"
    );
}

#[test]
fn a_link_the_other_way_round_has_the_opposite_multiplier() {
    let masses = [mass(1.0, 1e3, 10.0), mass(2.0, 1e3, 10.0)];
    let forth = LinkedOscillators::new(&masses, &[(0, 1)]).unwrap();
    let back = LinkedOscillators::new(&masses, &[(1, 0)]).unwrap();
    let motion = forth.motion(0.137);
    assert_eq!(
        forth.multiplier(0, 0.137, &motion).map(|lambda| -lambda),
        back.multiplier(0, 0.137, &motion)
    );
}

#[test]
fn links_that_are_no_tree_are_refused() {
    let masses = [
        mass(1.0, 1.0, 0.0),
        mass(2.0, 1.0, 0.0),
        mass(3.0, 1.0, 0.0),
    ];
    let refused = |links: &[(usize, usize)]| LinkedOscillators::new(&masses, links).unwrap_err();
    assert_eq!(refused(&[(0, 1)]), LinkError::NotConnected { mass: 2 });
    assert_eq!(
        refused(&[(0, 1), (1, 2), (2, 0)]),
        LinkError::Loop { link: 2 }
    );
    assert_eq!(refused(&[(0, 1), (1, 0)]), LinkError::Loop { link: 1 });
    assert_eq!(refused(&[(1, 1)]), LinkError::Loop { link: 0 });
    assert_eq!(
        refused(&[(0, 3)]),
        LinkError::UnknownMass {
            link: 0,
            mass: 3,
            masses: 3
        }
    );
}

#[test]
fn masses_that_cannot_be_linked_are_refused() {
    let good = mass(1.0, 1.0, 0.0);
    let refused = |other| LinkedOscillators::new(&[good, other], &[(0, 1)]).unwrap_err();
    assert_eq!(LinkedOscillators::new(&[], &[]), Err(LinkError::NoMass));
    let elsewhere = refused(OscillatorParameters { x0: 0.1, ..good });
    assert_eq!(
        elsewhere,
        LinkError::DifferentStart {
            mass: 1,
            field: "x0",
            value: 0.1,
            first: 0.0
        }
    );
    let faster = refused(OscillatorParameters { v0: 99.0, ..good });
    assert_eq!(
        faster,
        LinkError::DifferentStart {
            mass: 1,
            field: "v0",
            value: 99.0,
            first: 100.0
        }
    );
    for (field, other) in [
        ("m", OscillatorParameters { m: 0.0, ..good }),
        ("c", OscillatorParameters { c: -1.0, ..good }),
        (
            "d",
            OscillatorParameters {
                d: f64::INFINITY,
                ..good
            },
        ),
        (
            "v0",
            OscillatorParameters {
                v0: f64::NAN,
                ..good
            },
        ),
    ] {
        let error = refused(other);
        assert!(
            matches!(error, LinkError::OutOfRange { mass: 1, field: named, .. } if named == field),
            "{error}"
        );
    }
}

proptest! {
    /// Every mass is in balance, for any tree and any direction of its links.
    #[test]
    fn every_mass_is_in_balance(
        masses in proptest::collection::vec((0.1f64..5.0, 0f64..1e4, 0f64..50.0), 1..7),
        parents in proptest::collection::vec((any::<prop::sample::Index>(), any::<bool>()), 6),
        t in 0f64..1.0,
    ) {
        let masses: Vec<_> = masses.into_iter().map(|(m, c, d)| mass(m, c, d)).collect();
        let links: Vec<_> = (1..masses.len())
            .map(|child| {
                let (parent, is_forth) = (parents[child - 1].0.index(child), parents[child - 1].1);
                if is_forth { (parent, child) } else { (child, parent) }
            })
            .collect();
        let linked = LinkedOscillators::new(&masses, &links).unwrap();
        let motion = linked.motion(t);
        for (own, parameters) in masses.iter().enumerate() {
            let spring = -parameters.c * motion.x - parameters.d * motion.v;
            let force = links.iter().enumerate().fold(spring, |force, (link, &(a, b))| {
                let lambda = linked.multiplier(link, t, &motion).unwrap();
                force + if a == own { lambda } else if b == own { -lambda } else { 0.0 }
            });
            let size = 1.0 + 1e4 * motion.x.abs() + 50.0 * motion.v.abs();
            prop_assert!((force - parameters.m * motion.a).abs() < 1e-12 * size * masses.len() as f64);
        }
    }
}
