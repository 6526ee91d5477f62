//! Impulses of loads: velocities jump by what the same loads add to accelerations, and by nothing else.

#![allow(clippy::unwrap_used)]

mod common;

use common::body::{Body, TIGHT, solver};
use common::cases::{CASES, Case};
use linchpin_proto::v1::MarkerKind;

/// All models that take impulses, with each a solver.
fn taking() -> impl Iterator<Item = Case> {
    CASES.into_iter().filter(|case| {
        let capabilities = case.description().capabilities.unwrap();
        capabilities.impulses
    })
}

fn moving(case: Case) -> Body {
    let description = case.description();
    let tight = description.solvers.iter().any(|own| own.name == TIGHT.0);
    let solver = match (tight, description.solvers.first()) {
        (true, _) => TIGHT,
        (false, Some(first)) => solver(first),
        (false, None) => common::Solver("", &[]),
    };
    let mut body = Body::of(case, solver);
    body.drive_all(case.load);
    body.advance(3.1e-2);
    body
}

/// Every load of every marker: the jump of all velocities is the difference that the load makes to all accelerations, and no position
/// jumps.
#[test]
fn velocities_jump_by_what_a_load_adds_to_accelerations() {
    let mut checked = 0;
    for case in taking() {
        let markers = case.description().markers;
        // Positions of attitudes and their rates are no vectors of equal components.
        let told = |names: fn(&linchpin_proto::v1::Marker) -> Vec<String>| -> Vec<String> {
            markers.iter().flat_map(names).collect()
        };
        let positions = told(|marker| marker.position.clone());
        let velocities = told(|marker| match marker.acceleration.is_empty() {
            true => Vec::new(),
            false => marker.velocity.clone(),
        });
        let accelerations = told(|marker| marker.acceleration.clone());
        if accelerations.is_empty() {
            continue;
        }
        for (number, load) in markers.iter().flat_map(|marker| &marker.load).enumerate() {
            let mut body = moving(case);
            let before = body.read(&velocities);
            let places = body.read(&positions);
            let without = body.read(&accelerations);
            let own = body.input(load);
            let impulse = case.load * (0.7 - 0.13 * number as f64);
            body.drive(load, own + impulse);
            let with = body.read(&accelerations);
            body.drive(load, own);
            let mut impulses = vec![0.0; body.model.inputs.len()];
            let place = body.model.inputs.iter().position(|one| one.name == *load);
            impulses[place.unwrap()] = impulse;
            let (t, inputs) = (body.t, body.input_values());
            body.run.impulse(t, &inputs, &impulses).unwrap();
            let behind = body.read(&velocities);
            assert_eq!(body.read(&positions), places, "{case:?} {load}");
            let size = with
                .iter()
                .chain(&before)
                .fold(1.0f64, |a, b| a.max(b.abs()));
            for (place, name) in velocities.iter().enumerate() {
                let jump = behind[place] - before[place];
                let expected = with[place] - without[place];
                assert!(
                    (jump - expected).abs() < 1e-11 * size,
                    "{case:?} {load} {name}: {jump} {expected}"
                );
            }
            checked += 1;
        }
    }
    assert!(checked > 20, "{checked}");
}

/// A free link that is struck at its end: momentum and spin of a rigid body.
#[test]
fn a_free_link_takes_momentum_and_spin() {
    let parameters = [
        ("m", 1.3),
        ("inertia", 0.17),
        ("length", 0.9),
        ("gravity", 0.0),
    ];
    let mut body = Body::new("planar-body", &parameters, TIGHT);
    assert_eq!(body.model.markers[1].kind(), MarkerKind::Planar);
    let place = |name: &str| body.model.inputs.iter().position(|own| own.name == name);
    let (at, count) = (place("end_fy").unwrap(), body.model.inputs.len());
    let mut impulses = vec![0.0; count];
    impulses[at] = 0.37;
    body.run.impulse(0.0, &vec![0.0; count], &impulses).unwrap();
    let [vx, vy, rate] = body.read_all(["start_vx", "start_vy", "rate"]);
    let arm = 0.45;
    let spin = 0.37 * arm / 0.17;
    assert!((rate - spin).abs() < 1e-14, "{rate}");
    assert!(
        vx == 0.0 && (vy - (0.37 / 1.3 - arm * spin)).abs() < 1e-14,
        "{vx} {vy}"
    );
}

#[test]
fn who_has_contacts_of_its_own_takes_no_impulses() {
    for case in CASES {
        let capabilities = case.description().capabilities.unwrap();
        assert_ne!(capabilities.impulses, capabilities.impacts, "{case:?}");
    }
}
