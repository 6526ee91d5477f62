//! Spectral radii of the macro-step maps of random linear oscillator pairs.

use std::f64::consts::LN_10;

use linchpin::connect::{Connector, Place};
use linchpin_master::probe::{MacroStepMap, ProbeError, macro_step_map};
use linchpin_models::oscillator::OscillatorParameters;

use crate::masses::scene_text;
use crate::scenes::with_settings;

/// Radii up to this are stable.
pub const STABLE: f64 = 1.0 + 1e-9;

/// Two oscillators in a rigid link, and the macro step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Masses a and b.
    pub masses: [OscillatorParameters; 2],
    /// Macro step (s).
    pub macro_step: f64,
}

/// Endless pairs, log-uniform and the same for the same seed: masses 1e-2..1e2 kg, stiffness 0 (one in ten) or 1e-1..1e8 N/m,
/// damping 0 (one in ten) or 1e-2..1e5 N s/m, macro step 1e-4..3e-2 s.
#[derive(Debug, Clone)]
pub struct Pairs {
    state: u64,
}

impl Pairs {
    /// The sequence of this seed.
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// Uniform in 0..1: SplitMix64.
    fn uniform(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) as f64 / 2f64.powi(64)
    }

    /// Log-uniform between powers of ten.
    fn log_uniform(&mut self, [from, to]: [f64; 2]) -> f64 {
        ((from + (to - from) * self.uniform()) * LN_10).exp()
    }

    fn zero_or(&mut self, exponents: [f64; 2]) -> f64 {
        match self.uniform() < 0.1 {
            true => 0.0,
            false => self.log_uniform(exponents),
        }
    }
}

impl Iterator for Pairs {
    type Item = Pair;

    fn next(&mut self) -> Option<Pair> {
        let mut mass = || OscillatorParameters {
            m: self.log_uniform([-2.0, 2.0]),
            c: self.zero_or([-1.0, 8.0]),
            d: self.zero_or([-2.0, 5.0]),
            x0: 0.0,
            v0: 0.0,
        };
        Some(Pair {
            masses: [mass(), mass()],
            macro_step: self.log_uniform([-4.0, 3e-2_f64.log10()]),
        })
    }
}

impl Pair {
    /// The map of one macro step with settings of the coupling such as `"method=weighted index=1 degree=1"`.
    ///
    /// # Errors
    /// What the probe cannot do.
    pub fn map(&self, coupling: &str) -> Result<MacroStepMap, ProbeError> {
        let text = scene_text(&self.masses, &[(0, 1)], &[0, 1]);
        let coupling = format!("{coupling} macro_step={:e}", self.macro_step);
        let scene = with_settings(&text, &coupling, &["scene.t_end=1"]);
        let connector = Connector::new(Place::InProcess);
        macro_step_map(&scene, &mut |scene, subsystem| {
            connector.connect(scene, subsystem)
        })
    }
}
