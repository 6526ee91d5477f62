//! The load of the oscillator that sets in at a time.

#![allow(clippy::unwrap_used)]

mod common;

use common::{A, EXACT, RADAU5, interval, oscillator, state};
use linchpin_models::oscillator::{LoadStep, OscillatorParameters};
use linchpin_models::reference::{LinkError, LinkedOscillators};
use linchpin_worker::Inputs;

const OWN: OscillatorParameters = OscillatorParameters {
    m: 1.7,
    c: 830.0,
    d: 11.0,
    x0: 0.37,
    v0: -2.9,
};

const LOAD: LoadStep = LoadStep {
    force: 310.0,
    from: 0.0837,
};

fn parameters(load: LoadStep) -> [(&'static str, f64); 7] {
    let OscillatorParameters { m, c, d, x0, v0 } = OWN;
    let LoadStep { force, from } = load;
    [
        ("m", m),
        ("c", c),
        ("d", d),
        ("x0", x0),
        ("v0", v0),
        ("load", force),
        ("load_from", from),
    ]
}

fn alone(load: LoadStep) -> LinkedOscillators {
    LinkedOscillators::loaded(&[OWN], &[], &[load]).unwrap()
}

/// One step across the time at which the load sets in, and steps that end there, before and after it.
#[test]
fn the_motion_is_that_of_the_closed_form() {
    let still = Inputs::constant(&[0.0; 3]);
    for (solver, tolerance) in [(EXACT, 1e-13), (RADAU5, 1e-6)] {
        for length in [0.05, LOAD.from, 0.11, 0.31] {
            let mut subsystem = oscillator(&parameters(LOAD), solver);
            subsystem.step(interval(0.0, length), &still).unwrap();
            subsystem.step(interval(length, 0.07), &still).unwrap();
            let t = length + 0.07;
            let exact = alone(LOAD).motion(t);
            let [x, v] = state(&mut subsystem);
            assert!(
                (x - exact.x).abs() < tolerance * OWN.x0,
                "{solver:?} {length}: {x} {}",
                exact.x
            );
            assert!(
                (v - exact.v).abs() < 10.0 * tolerance,
                "{solver:?} {length}: {v} {}",
                exact.v
            );
            let mut a = [0.0];
            subsystem.outputs(t, &[0.0; 3], &[A], &mut a).unwrap();
            assert!(
                (a[0] - exact.a).abs() < 1e3 * tolerance,
                "{solver:?} {length}"
            );
        }
    }
}

#[test]
fn a_direction_feels_no_load() {
    let still = Inputs::constant(&[0.0; 3]);
    let direction = Inputs::constant(&[1.0, 0.0, 0.0]);
    for solver in [EXACT, RADAU5] {
        let response = |load| {
            let mut subsystem = oscillator(&parameters(load), solver);
            let mut values = [0.0; 3];
            let over = interval(0.05, 0.06);
            subsystem
                .derivative(over, &still, &direction, &[0, 1, 2], &mut values)
                .unwrap();
            values
        };
        let none = LoadStep {
            force: 0.0,
            from: 0.0,
        };
        for (loaded, free) in response(LOAD).into_iter().zip(response(none)) {
            assert!(
                (loaded - free).abs() < 1e-5 * free.abs(),
                "{solver:?}: {loaded} {free}"
            );
        }
    }
}

/// Each mass for itself obeys its own equation of motion under its load and the forces in its links.
#[test]
fn links_pass_their_part_of_a_load_on() {
    let masses = [(1.0, 0.0, 3.0), (2.7, 310.0, 41.0), (0.83, 2300.0, 0.0)]
        .map(|(m, c, d)| OscillatorParameters { m, c, d, ..OWN });
    let (links, loads) = (
        [(0, 1), (2, 1)],
        [0.0, -71.0, 13.0].map(|force| LoadStep { force, from: 0.021 }),
    );
    let linked = LinkedOscillators::loaded(&masses, &links, &loads).unwrap();
    for t in [0.013, 0.021, 0.1, 0.37] {
        let motion = linked.motion(t);
        let lambda = [0, 1].map(|link| linked.multiplier(link, t, &motion).unwrap());
        let in_links = [lambda[0], -lambda[0] - lambda[1], lambda[1]];
        for ((own, load), link) in masses.iter().zip(loads).zip(in_links) {
            let force = if t >= load.from { load.force } else { 0.0 };
            let missing = own.m * motion.a + own.d * motion.v + own.c * motion.x - force - link;
            assert!(missing.abs() < 1e-10, "{t}: {missing:e}");
        }
    }
    let free = [OscillatorParameters { c: 0.0, ..OWN }];
    let refused = LinkedOscillators::loaded(&free, &[], &[LOAD]).unwrap_err();
    assert_eq!(
        refused,
        LinkError::NoSpring {
            mass: 0,
            force: LOAD.force
        }
    );
}
