//! Runs of the slider-crank.

use std::time::Instant;

use linchpin_models::nonsmooth::mechanics::{Counters, Settings};
use linchpin_models::nonsmooth::mixed::Integrator;
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::state::Drive;
use linchpin_models::nonsmooth::systems::notch::CornerLaw;
use linchpin_models::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism, RigidSliderCrank};
use linchpin_worker::Inputs;

/// The schemes in the order of the paper's tables, with their names there.
pub const SCHEMES: [(&str, SchemeKind); 5] = [
    ("Moreau", SchemeKind::Moreau),
    ("HETS", SchemeKind::Hets),
    (
        "generalised-alpha (0.8)",
        SchemeKind::GeneralizedAlpha { rho_inf: 0.8 },
    ),
    ("Bathe", SchemeKind::Bathe),
    (
        "ED-alpha (0)",
        SchemeKind::EdAlpha {
            rho_inf: 0.0,
            alpha_ar: 1.0 / 6.0,
        },
    ),
];

/// End of all runs (s).
pub const T_END: f64 = 0.05;

/// Accuracy of the iteration of a step: below the errors that are compared.
pub const SETTINGS: Settings = Settings {
    tolerance: 1e-10,
    ..linchpin_models::nonsmooth::mechanics::DEFAULT
};

/// Corners with clearance, Table 1.
pub fn unilateral() -> Guide {
    Guide::Clearance(CornerLaw {
        normal_restitution: 0.4,
        tangential_restitution: 0.0,
        friction: 0.01,
    })
}

/// A finished run.
pub struct Run {
    /// Angles of crank, rod and slider at the samples.
    pub samples: Vec<[f64; 3]>,
    /// Seconds for a step.
    pub seconds_per_step: f64,
    /// What was done.
    pub counters: Counters,
}

/// Runs Table 1 with this guide; samples every `interval` (s).
pub fn run(guide: Guide, scheme: SchemeKind, settings: Settings, dt: f64, interval: f64) -> Run {
    let system = RigidSliderCrank::new(Mechanism::table_1(), guide);
    let start: [&[f64]; 2] = [&[0.0; 3], &[150.0, -75.0, 0.0]];
    let inputs = Inputs::constant(&[]);
    let drive = Drive {
        start: 0.0,
        inputs: &inputs,
    };
    let mut integrator = Integrator::new(Box::new(system), 0, scheme, settings, start).unwrap();
    integrator.start(drive).unwrap();
    let steps = (T_END / dt).round() as usize;
    let stride = (interval / dt).round() as usize;
    let mut samples = Vec::new();
    let began = Instant::now();
    for step in 1..=steps {
        integrator.step(drive, dt).unwrap();
        if step % stride == 0 {
            let q = &integrator.state.q;
            samples.push([q[0], q[1], q[2]]);
        }
    }
    Run {
        samples,
        seconds_per_step: began.elapsed().as_secs_f64() / steps as f64,
        counters: integrator.mechanics.counters,
    }
}

/// The norm of S2 eq. (92) for the inclination of the rod.
pub fn error(samples: &[[f64; 3]], reference: impl Iterator<Item = f64>) -> f64 {
    let errors = samples.iter().zip(reference);
    let squares = errors.map(|(own, exact)| ((own[1] - exact) / exact).powi(2));
    squares.sum::<f64>().sqrt()
}
