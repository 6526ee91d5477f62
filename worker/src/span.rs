//! How much a request lets a solver simulate.

use linchpin_proto::v1;

/// A request with the time that is simulated for it.
pub(crate) trait Span {
    /// The time (s), all integrations together; 0 if nothing is integrated.
    fn span(&self) -> f64;
}

impl Span for v1::ExchangeRequest {
    fn span(&self) -> f64 {
        let advance = self.advance.as_ref().map_or(0.0, |advance| {
            advance.step + advance.samples.iter().sum::<f64>()
        });
        advance + ahead(self.evaluate.as_ref()) + ahead(self.predict.as_ref())
    }
}

fn ahead(look: Option<&v1::Predict>) -> f64 {
    look.map_or(0.0, |look| {
        look.step * (1 + look.perturbed.len() + look.directions.len()) as f64
    })
}

impl Span for v1::StepRequest {
    fn span(&self) -> f64 {
        self.step
    }
}

impl Span for v1::PerturbedStepRequest {
    fn span(&self) -> f64 {
        self.step * (1 + self.perturbed.len() + self.directions.len()) as f64
    }
}

macro_rules! without_integration {
    ($($request:ident),*) => {
        $(impl Span for v1::$request {
            fn span(&self) -> f64 {
                0.0
            }
        })*
    };
}

without_integration!(
    SnapshotRequest,
    RestoreRequest,
    ExportStateRequest,
    ImportStateRequest,
    EvaluateRequest
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_integration_counts() {
        let look = |step, perturbed, directions| v1::Predict {
            step,
            perturbed: vec![v1::Signal::default(); perturbed],
            directions: vec![v1::Signal::default(); directions],
            ..v1::Predict::default()
        };
        let request = v1::ExchangeRequest {
            advance: Some(v1::Advance {
                step: 0.5,
                samples: vec![0.125, 0.25],
                ..v1::Advance::default()
            }),
            evaluate: Some(look(0.0, 7, 0)),
            predict: Some(look(0.25, 3, 1)),
            ..v1::ExchangeRequest::default()
        };
        assert_eq!(request.span(), 0.875 + 0.25 * 5.0);
    }
}
