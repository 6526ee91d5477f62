//! Runs of integrators without a master.

use linchpin_models::nonsmooth::contact::{ContactSettings, Jacobian, Weights};
use linchpin_models::nonsmooth::mechanics::{Level, Settings};
use linchpin_models::nonsmooth::mixed::Integrator;
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::state::Drive;
use linchpin_models::nonsmooth::system::MechanicalSystem;
use linchpin_worker::Inputs;

/// Conventions of S2 and of the golden files, where they differ from the default: accelerations at the start without contacts
/// and carried over impacts.
pub const AS_PRINTED: Settings = Settings {
    level: Level::Velocity,
    has_consistent_start: false,
    restarts_after_impacts: false,
    tolerance: 1e-13,
    most_iterations: 50,
    contact: ContactSettings {
        jacobian: Jacobian::Full,
        weights: Weights::Automatic,
        tolerance: 1e-13,
    },
};

/// A system with constant inputs (none) that is ready to step.
pub struct Stand {
    pub integrator: Integrator,
    inputs: Inputs,
}

impl Stand {
    pub fn new(
        system: impl MechanicalSystem + 'static,
        scheme: SchemeKind,
        settings: Settings,
        start: [&[f64]; 2],
    ) -> Self {
        let inputs = Inputs::constant(&[]);
        let mut integrator = Integrator::new(Box::new(system), 0, scheme, settings, start).unwrap();
        integrator
            .start(Drive {
                start: 0.0,
                inputs: &inputs,
            })
            .unwrap();
        Self { integrator, inputs }
    }

    pub fn step(&mut self, dt: f64) {
        let drive = Drive {
            start: 0.0,
            inputs: &self.inputs,
        };
        let stepped = self.integrator.step(drive, dt);
        stepped.unwrap_or_else(|error| panic!("at t = {}: {error}", self.integrator.state.tau));
    }

    pub fn steps(&mut self, number: usize, dt: f64) {
        for _ in 0..number {
            self.step(dt);
        }
    }

    pub fn q(&self) -> &[f64] {
        &self.integrator.state.q
    }

    pub fn v(&self) -> &[f64] {
        &self.integrator.state.v
    }
}
