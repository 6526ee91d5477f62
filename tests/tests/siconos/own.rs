//! Our own runs.

use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::mixed::Integrator;
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::state::Drive;
use linchpin_models::nonsmooth::system::MechanicalSystem;
use linchpin_worker::Inputs;

use crate::SLOWEST;

/// What a run tells.
#[derive(Debug)]
pub struct Own {
    /// Coordinates at the samples.
    pub samples: Vec<Vec<f64>>,
    /// Contact forces at the samples, of all rows.
    pub forces: Vec<Vec<f64>>,
    pub first_impact: Option<f64>,
    /// Impacts faster than [`SLOWEST`].
    pub impacts: usize,
    pub loss: f64,
}

/// A run from a start with steps of `dt`.
pub fn run(
    system: impl MechanicalSystem + 'static,
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
        forces: Vec::new(),
        first_impact: None,
        impacts: 0,
        loss: 0.0,
    };
    for step in 1..=steps {
        let before = integrator.log.impacts;
        integrator.step(drive, dt).unwrap();
        if integrator.log.impacts > before {
            own.impacts += usize::from(closing_speed(&mut integrator) > SLOWEST);
        }
        if step % (steps / samples) == 0 {
            own.samples.push(integrator.state.q.clone());
            own.forces.push(integrator.state.forces.clone());
        }
    }
    own.first_impact = integrator.log.first_impact;
    own.loss = energy - integrator.energy();
    own
}

/// Largest speed at which a contact closed that took an impulse in the last step.
fn closing_speed(integrator: &mut Integrator) -> f64 {
    let Some(before) = integrator.velocities_before_impact() else {
        return 0.0;
    };
    let before = before.to_vec();
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
        direction.iter().zip(&before).map(|(d, v)| -d * v).sum()
    };
    struck.map(speed).fold(0.0, f64::max)
}
