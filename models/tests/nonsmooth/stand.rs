//! Runs of integrators without a master, over all schemes.

use linchpin_models::nonsmooth::contact::{ContactSettings, Jacobian, Weights};
use linchpin_models::nonsmooth::mechanics::{Level, Settings, StepError};
use linchpin_models::nonsmooth::mixed::Integrator;
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::state::Drive;
use linchpin_models::nonsmooth::system::MechanicalSystem;
use linchpin_worker::Inputs;

/// Conventions of S2 and of the golden files, where they differ from the default: accelerations at the start without
/// contacts and carried over impacts, contacts closed by their gaps alone.
pub const AS_PRINTED: Settings = Settings {
    level: Level::Velocity,
    has_consistent_start: false,
    restarts_after_impacts: false,
    holds_pressed_contacts: false,
    tolerance: 1e-13,
    most_iterations: 50,
    contact: ContactSettings {
        jacobian: Jacobian::Full,
        weights: Weights::Automatic,
        tolerance: 1e-13,
    },
};

/// A scheme and what is expected of it.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    pub kind: SchemeKind,
    /// Order of the motion where contacts do not change.
    pub order: f64,
    /// Order of contact forces there.
    pub force_order: f64,
}

impl Case {
    /// Whether forces go on to and fro after contacts changed: what no scheme damps stays.
    pub fn is_undamped(&self) -> bool {
        self.kind == SchemeKind::GeneralizedAlpha { rho_inf: 1.0 }
    }
}

const fn case(kind: SchemeKind, order: f64, force_order: f64) -> Case {
    Case {
        kind,
        order,
        force_order,
    }
}

const fn generalized_alpha(rho_inf: f64) -> Case {
    case(SchemeKind::GeneralizedAlpha { rho_inf }, 2.0, 2.0)
}

const fn ed_alpha(rho_inf: f64) -> Case {
    let alpha_ar = 1.0 / 6.0;
    case(SchemeKind::EdAlpha { rho_inf, alpha_ar }, 2.0, 1.0)
}

/// All schemes.
pub const SCHEMES: [Case; 9] = [
    generalized_alpha(1.0),
    generalized_alpha(0.8),
    generalized_alpha(0.5),
    generalized_alpha(0.0),
    case(SchemeKind::Bathe, 2.0, 2.0),
    ed_alpha(0.0),
    ed_alpha(0.5),
    case(SchemeKind::Hets, 2.0, 1.0),
    case(SchemeKind::Moreau, 1.0, 1.0),
];

/// Order that errors of two runs show, the second one with half the step.
pub fn order(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).log2()
}

/// A system that is ready to step.
pub struct Stand {
    pub integrator: Integrator,
    inputs: Inputs,
}

impl Stand {
    /// Without inputs.
    pub fn new(
        system: impl MechanicalSystem + 'static,
        scheme: SchemeKind,
        settings: Settings,
        start: [&[f64]; 2],
    ) -> Self {
        Self::driven(system, scheme, settings, start, Inputs::constant(&[]))
    }

    pub fn driven(
        system: impl MechanicalSystem + 'static,
        scheme: SchemeKind,
        settings: Settings,
        start: [&[f64]; 2],
        inputs: Inputs,
    ) -> Self {
        let stand = Self::try_driven(system, scheme, settings, start, inputs);
        stand.unwrap_or_else(|error| panic!("at the start: {error}"))
    }

    pub fn try_driven(
        system: impl MechanicalSystem + 'static,
        scheme: SchemeKind,
        settings: Settings,
        start: [&[f64]; 2],
        inputs: Inputs,
    ) -> Result<Self, StepError> {
        let number = inputs.len();
        let mut integrator =
            Integrator::new(Box::new(system), number, scheme, settings, start).unwrap();
        integrator.start(Drive {
            start: 0.0,
            inputs: &inputs,
        })?;
        Ok(Self { integrator, inputs })
    }

    pub fn try_step(&mut self, dt: f64) -> Result<(), StepError> {
        let drive = Drive {
            start: 0.0,
            inputs: &self.inputs,
        };
        self.integrator.step(drive, dt)
    }

    pub fn step(&mut self, dt: f64) {
        let stepped = self.try_step(dt);
        stepped.unwrap_or_else(|error| panic!("at t = {}: {error}", self.t()));
    }

    pub fn steps(&mut self, number: usize, dt: f64) {
        for _ in 0..number {
            self.step(dt);
        }
    }

    pub fn t(&self) -> f64 {
        self.integrator.state.tau
    }

    pub fn q(&self) -> &[f64] {
        &self.integrator.state.q
    }

    pub fn v(&self) -> &[f64] {
        &self.integrator.state.v
    }
}
