//! Integrations over a macro step by cause, as the master asked for them.

use linchpin_proto::v1::ExchangeRequest;
use serde::{Deserialize, Serialize};

/// Number of integrations over a macro step by what they were for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Integrations {
    /// With extrapolated inputs.
    pub predictor: u64,
    /// With one input raised: columns of the coupling Jacobian.
    pub columns: u64,
    /// Tentative ones with corrected inputs, to correct them further.
    pub passes: u64,
    /// With extrapolated inputs, once more for impacts.
    pub impacts: u64,
    /// With corrected inputs, to stay.
    pub corrector: u64,
    /// For results at fixed times inside a macro step.
    pub samples: u64,
}

/// What a look-ahead is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause {
    /// The prediction of a macro step.
    Predictor,
    /// Another pass of the corrector.
    Pass,
    /// The same prediction with impacts that partners take part in.
    Impact,
}

impl Integrations {
    /// All together.
    pub fn sum(&self) -> u64 {
        let looks = self.predictor + self.columns + self.passes + self.impacts;
        looks + self.corrector + self.samples
    }

    /// Counts what a request asks for; a look-ahead of zero length evaluates and integrates nothing.
    pub(crate) fn count(&mut self, request: &ExchangeRequest, looks_ahead_for: Cause) {
        if let Some(advance) = &request.advance {
            self.corrector += 1;
            self.samples += advance.samples.len() as u64;
        }
        let Some(predict) = request.predict.as_ref().filter(|one| one.step > 0.0) else {
            return;
        };
        self.columns += predict.perturbed.len() as u64;
        match looks_ahead_for {
            Cause::Predictor => self.predictor += 1,
            Cause::Pass => self.passes += 1,
            Cause::Impact => self.impacts += 1,
        }
    }

    /// Adds those of another subsystem.
    pub(crate) fn add(&mut self, other: &Self) {
        self.predictor += other.predictor;
        self.columns += other.columns;
        self.passes += other.passes;
        self.impacts += other.impacts;
        self.corrector += other.corrector;
        self.samples += other.samples;
    }
}
