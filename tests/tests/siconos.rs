//! A second opinion: Siconos (INRIA's platform for nonsmooth dynamics, Debian's python3-siconos) on the same problems.
//!
//! `tests/siconos/run.py` runs its Moreau-Jean scheme with compiled callbacks. Both sides approximate the same motion:
//! they agree to the order of that scheme, which is 1. Where Siconos or a C compiler is missing the tests say so and
//! pass.

#![allow(clippy::unwrap_used)]

use std::path::Path;
use std::process::Command;

use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::mixed::Integrator;
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::state::Drive;
use linchpin_models::nonsmooth::system::MechanicalSystem;
use linchpin_models::nonsmooth::systems::notch::CornerLaw;
use linchpin_models::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism, RigidSliderCrank};
use linchpin_worker::Inputs;
use serde_json::Value;

/// Closing speeds that count as an impact (m/s): slower ones belong to the end of an accumulation of impacts.
const SLOWEST: f64 = 0.01;

/// Runs a problem; `None` where Siconos or a compiler is missing.
fn siconos(problem: &str, dt: f64, t_end: f64, samples: usize) -> Option<Value> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("siconos/run.py");
    let output = Command::new("/usr/bin/python3")
        .arg(script)
        .arg(problem)
        .args(["--dt", &dt.to_string(), "--t-end", &t_end.to_string()])
        .args(["--samples", &samples.to_string()])
        .args(["--threshold", &SLOWEST.to_string()])
        .output();
    let Ok(output) = output else {
        println!("skipped: /usr/bin/python3 is missing");
        return None;
    };
    let complaint = String::from_utf8_lossy(&output.stderr);
    match output.status.code() {
        Some(0) => Some(serde_json::from_slice(&output.stdout).unwrap()),
        Some(3) => {
            println!("skipped: {complaint}");
            None
        }
        code => panic!("siconos {problem} ended with {code:?}: {complaint}"),
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().unwrap();
    list.iter().map(|number| number.as_f64().unwrap()).collect()
}

/// What our own run tells.
struct Own {
    /// Coordinates at the samples.
    samples: Vec<Vec<f64>>,
    first_impact: f64,
    /// Impacts faster than [`SLOWEST`].
    impacts: usize,
    loss: f64,
}

fn own(
    system: impl MechanicalSystem + 'static,
    restitution: f64,
    start: [&[f64]; 2],
    dt: f64,
    t_end: f64,
    samples: usize,
) -> Own {
    let scheme = SchemeKind::GeneralizedAlpha { rho_inf: 0.8 };
    let inputs = Inputs::constant(&[]);
    let drive = Drive {
        start: 0.0,
        inputs: &inputs,
    };
    let mut integrator =
        Integrator::new(Box::new(system), 0, scheme, Settings::default(), start).unwrap();
    integrator.start(drive).unwrap();
    let energy = integrator.energy();
    let steps = (t_end / dt).round() as usize;
    let mut own = Own {
        samples: Vec::new(),
        first_impact: f64::NAN,
        impacts: 0,
        loss: 0.0,
    };
    for step in 1..=steps {
        let before = integrator.log.impacts;
        integrator.step(drive, dt).unwrap();
        if integrator.log.impacts > before {
            own.impacts += usize::from(leaving_speed(&mut integrator) > restitution * SLOWEST);
        }
        if step % (steps / samples) == 0 {
            own.samples.push(integrator.state.q.clone());
        }
    }
    own.first_impact = integrator.log.first_impact.unwrap_or(f64::NAN);
    own.loss = energy - integrator.energy();
    own
}

/// Largest speed at which a contact leaves that took an impulse: what the restitution left of its closing speed.
fn leaving_speed(integrator: &mut Integrator) -> f64 {
    let state = &integrator.state;
    let n = state.q.len();
    let contacts = integrator.mechanics.contacts();
    let mut directions = vec![0.0; n * state.impulses.len()];
    integrator
        .mechanics
        .system
        .directions(&state.q, &mut directions);
    let normals = (0..contacts.len()).map(|contact| integrator.mechanics.first_row(contact));
    let struck = normals.filter(|&row| state.impulses[row] > 0.0);
    let speed = |row: usize| -> f64 {
        let direction = &directions[row * n..][..n];
        direction.iter().zip(&state.v).map(|(d, v)| d * v).sum()
    };
    struck.map(speed).fold(0.0, f64::max)
}

fn largest_difference(samples: &Value, own: &Own) -> f64 {
    let theirs = samples.as_array().unwrap().iter().skip(1);
    let pairs = theirs.zip(&own.samples).flat_map(|(theirs, own)| {
        let theirs = numbers(&theirs["q"]);
        theirs
            .into_iter()
            .zip(own.clone())
            .map(|(a, b)| (a - b).abs())
            .collect::<Vec<_>>()
    });
    pairs.fold(0.0, f64::max)
}

/// Both tables: differences fall with the step of Siconos, first impact, number of impacts and loss of energy are the
/// same.
fn compare_slider_crank(
    problem: &str,
    mechanism: Mechanism,
    law: CornerLaw,
    start: [f64; 3],
    constant: f64,
) {
    let t_end = 0.05;
    let system = RigidSliderCrank::new(mechanism, Guide::Clearance(law));
    let own = own(
        system,
        law.normal_restitution,
        [&[0.0; 3], &start],
        1e-6,
        t_end,
        50,
    );
    // Siconos counts the torque as a potential.
    let loss = own.loss + mechanism.torque * own.samples[49][0];
    let mut differences = Vec::new();
    let mut losses = Vec::new();
    for dt in [1e-5, 5e-6] {
        let Some(run) = siconos(problem, dt, t_end, 50) else {
            return;
        };
        let first = run["first_impact"].as_f64().unwrap();
        assert!(
            (first - own.first_impact).abs() <= 1.5 * dt + 1e-6,
            "first impact {first}"
        );
        assert_eq!(
            run["impact_count"].as_u64().unwrap(),
            own.impacts as u64,
            "dt {dt}"
        );
        differences.push(largest_difference(&run["samples"], &own));
        losses.push(run["energy_loss"].as_f64().unwrap());
    }
    assert!(differences[0] < constant * 1e-5, "{differences:?}");
    let ratio = differences[0] / differences[1];
    assert!((1.8..2.2).contains(&ratio), "order 1: {differences:?}");
    let extrapolated = 2.0 * losses[1] - losses[0];
    assert!(
        (extrapolated - loss).abs() < 0.01 * loss,
        "energy: {losses:?}, extrapolated {extrapolated}, own {loss}"
    );
}

#[test]
fn slider_crank_of_table_1() {
    let law = CornerLaw {
        normal_restitution: 0.4,
        tangential_restitution: 0.0,
        friction: 0.01,
    };
    let start = [150.0, -75.0, 0.0];
    compare_slider_crank("slider-crank-1", Mechanism::table_1(), law, start, 650.0);
}

#[test]
fn slider_crank_of_table_2() {
    let law = CornerLaw {
        normal_restitution: 0.1,
        tangential_restitution: 0.0,
        friction: 0.1,
    };
    compare_slider_crank("slider-crank-2", Mechanism::table_2(), law, [0.0; 3], 2.5);
}
