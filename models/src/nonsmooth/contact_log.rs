//! What contacts did, added up.

/// What contacts did since the start of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactLog {
    /// Impacts: steps that were corrected.
    pub impacts: u64,
    /// Time of the first one (s); `None` before.
    pub first_impact: Option<f64>,
    /// Sum of all normal impulses (N s).
    pub impulse: f64,
    /// Energy that impacts took (J); of an impulsive scheme what contacts took in steps with an impact.
    pub impact_loss: f64,
    /// Energy that friction took between impacts (J), by the trapezoidal rule; of an impulsive scheme what contacts
    /// took in the other steps.
    pub friction_loss: f64,
    /// Deepest penetration, `-g_N` (m).
    pub penetration: f64,
}

impl ContactLog {
    /// Numbers of a log.
    pub const NUMBERS: usize = 6;

    /// As plain numbers; no first impact is not a number.
    pub fn numbers(&self) -> [f64; Self::NUMBERS] {
        [
            self.impacts as f64,
            self.first_impact.unwrap_or(f64::NAN),
            self.impulse,
            self.impact_loss,
            self.friction_loss,
            self.penetration,
        ]
    }

    /// Takes over what [`ContactLog::numbers`] gave.
    pub fn take(&mut self, numbers: &[f64]) {
        let &[
            impacts,
            first,
            impulse,
            impact_loss,
            friction_loss,
            penetration,
        ] = numbers
        else {
            return;
        };
        *self = Self {
            impacts: impacts as u64,
            first_impact: Some(first).filter(|first| !first.is_nan()),
            impulse,
            impact_loss,
            friction_loss,
            penetration,
        };
    }
}
