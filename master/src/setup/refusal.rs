//! What a worker has against the scene, as mistakes in the scene with their places.

use linchpin_proto::contract::CallError;
use linchpin_proto::v1;

use crate::error::RunError;
use crate::reading::nearest::nearest;
use crate::scene::{Scene, SceneErrors};
use crate::time::at_start;
use crate::workers::{Subsystem, Workers};

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

impl Workers {
    /// Starts the instance of a subsystem anew.
    pub(super) fn restart(
        &mut self,
        scene: &Scene,
        number: usize,
        models: &[v1::Model],
        request: &v1::InitializeRequest,
    ) -> Result<(), RunError> {
        let subsystem = &mut self.subsystems[number];
        let restarted = subsystem.restart(request.clone());
        let refuse = |error| refuse_setup(scene, number, &models[number], subsystem, error);
        restarted.map_err(refuse)
    }
}

/// The name in the model that a misspelt one was probably meant to be.
fn nearest_field(field: &str, kind: Option<&str>, model: &v1::Model) -> Option<String> {
    let (name, known) = match field.split_once('.')? {
        ("parameters", name) if name.contains('.') => {
            let near = nearest_nested(name, &names(&model.parameters))?;
            return Some(format!("did you mean `{near}`?"));
        }
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

/// The same for a parameter in nested tables, `table.entry.key`: names of entries are up to the scene.
fn nearest_nested(name: &str, known: &[&str]) -> Option<String> {
    let [table, entry, key] = nested(name)?;
    let known: Vec<[&str; 3]> = known.iter().filter_map(|known| nested(known)).collect();
    let own = known.iter().filter(|[other, ..]| *other == table);
    let keys: Vec<&str> = own.map(|&[.., key]| key).collect();
    if keys.is_empty() {
        let tables = known.iter().map(|&[table, ..]| table);
        return nearest(table, tables).map(|near| format!("{near}.{entry}.{key}"));
    }
    if keys.contains(&key) {
        return None;
    }
    nearest(key, keys).map(|near| format!("{table}.{entry}.{near}"))
}

fn nested(name: &str) -> Option<[&str; 3]> {
    let parts: Vec<&str> = name.split('.').collect();
    parts.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nested_parameters_are_compared_by_table_and_key() {
        let parameter = |name: &str| v1::Parameter {
            name: name.to_owned(),
            ..Default::default()
        };
        let known = [
            "gravity",
            "body.NAME.inertia",
            "body.NAME.m",
            "joint.NAME.kind",
        ];
        let model = v1::Model {
            parameters: known.map(parameter).to_vec(),
            ..v1::Model::default()
        };
        for (field, near) in [
            ("parameters.gravty", Some("gravity")),
            ("parameters.body.link.inertja", Some("body.link.inertia")),
            ("parameters.jiont.hinge.kind", Some("joint.hinge.kind")),
            ("parameters.joint.hinge.kind", None),
            ("parameters.body.link.colour", None),
            ("parameters.joint.hinge", None),
            ("parameters.body.link.position[1]", None),
        ] {
            let expected = near.map(|near| format!("did you mean `{near}`?"));
            assert_eq!(nearest_field(field, None, &model), expected, "{field}");
        }
    }
}
