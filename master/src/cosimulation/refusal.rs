//! What a worker has against the scene, as mistakes in the scene with their places.

use linchpin_proto::contract::CallError;
use linchpin_proto::v1;

use super::{Subsystem, at_start};
use crate::error::RunError;
use crate::scene::nearest::nearest;
use crate::scene::{Scene, SceneErrors};

/// Mistakes that were found in several subsystems.
#[derive(Default)]
pub(super) struct Refusals(Option<SceneErrors>);

impl Refusals {
    /// Keeps a mistake in the scene, to be told together with others; any other error is returned.
    pub(super) fn collect(&mut self, error: RunError) -> Result<(), RunError> {
        let RunError::Scene(errors) = error else {
            return Err(error);
        };
        self.0 = Some(match self.0.take() {
            Some(earlier) => earlier.and(errors),
            None => errors,
        });
        Ok(())
    }

    /// Fails if there is any mistake.
    pub(super) fn finish(self) -> Result<(), RunError> {
        self.0.map_or(Ok(()), |errors| Err(errors.into()))
    }
}

/// The error for a subsystem that could not be initialised.
pub(super) fn refuse_setup(
    scene: &Scene,
    number: usize,
    model: &v1::Model,
    subsystem: &Subsystem,
    error: CallError,
) -> RunError {
    match error {
        CallError::Failed(failure) if failure.severity() == v1::Severity::Misuse => {
            let written = &scene.subsystems[number];
            let field = failure.field.as_deref().unwrap_or_default();
            let kind = written.solver.as_ref().map(|solver| solver.kind.as_str());
            let help = nearest_field(field, kind, model);
            let key = format!("subsystem.{}.{field}", written.name);
            scene.error(&key, failure.message, help).into()
        }
        error => subsystem.failed(error, at_start(scene.t_start)),
    }
}

/// The name in the model that a misspelt one was probably meant to be.
fn nearest_field(field: &str, kind: Option<&str>, model: &v1::Model) -> Option<String> {
    let (name, known) = match field.split_once('.')? {
        ("parameters", name) => (name, names(&model.parameters)),
        ("solver", "kind") => (
            kind?,
            model.solvers.iter().map(|s| s.name.as_str()).collect(),
        ),
        ("solver", name) => {
            let solver = model
                .solvers
                .iter()
                .find(|s| Some(s.name.as_str()) == kind)?;
            (name, names(&solver.options))
        }
        _ => return None,
    };
    if known.contains(&name) {
        return None;
    }
    nearest(name, known).map(|near| format!("did you mean `{near}`?"))
}

fn names(parameters: &[v1::Parameter]) -> Vec<&str> {
    parameters.iter().map(|p| p.name.as_str()).collect()
}
