//! Built-in models and their solvers, as the models describe themselves.

use std::fmt::Write as _;

use linchpin_proto::v1::{Marker, MarkerKind, Model, Parameter, SolverKind, Variable};

use super::{cell, code, prose};

/// A solver and the models that have it.
struct Solver {
    kind: SolverKind,
    models: Vec<String>,
}

pub fn page() -> String {
    let mut models: Vec<Model> = linchpin_models::models()
        .iter()
        .map(|model| model.describe())
        .collect();
    models.sort_by(|a, b| a.name.cmp(&b.name));
    let solvers = solvers(&models);
    let mut text = super::head("Built-in models");
    text += "
`linchpin worker` serves these models, and a scene names them in `subsystem.model`. A parameter without a default must
be given. An input without a default must be driven by a joint or a connection; one with a default keeps it where
nothing drives it.

The first solver of a model is its default. [Solvers](#solvers) and their options stand at the end, since many models
have the same ones.
";
    for model in &models {
        text += &section(model, &solvers);
    }
    text += "\n## Solvers\n";
    for solver in &solvers {
        text += &solver_section(solver, &solvers);
    }
    text
}

/// Different solvers of all models, those of equal names beside each other.
fn solvers(models: &[Model]) -> Vec<Solver> {
    let mut solvers: Vec<Solver> = Vec::new();
    for model in models {
        for kind in &model.solvers {
            match solvers.iter_mut().find(|solver| solver.kind == *kind) {
                Some(solver) => solver.models.push(model.name.clone()),
                None => solvers.push(Solver {
                    kind: kind.clone(),
                    models: vec![model.name.clone()],
                }),
            }
        }
    }
    solvers.sort_by(|a, b| a.kind.name.cmp(&b.kind.name));
    solvers
}

fn section(model: &Model, solvers: &[Solver]) -> String {
    let mut text = format!(
        "\n## {}\n\n{}",
        model.name,
        prose(&sentence(&model.description))
    );
    text += &parameters("parameter", &model.parameters);
    text += &variables("input", &model.inputs);
    text += &variables("output", &model.outputs);
    text += &markers(&model.markers);
    text += "\nSolvers:\n\n";
    for kind in &model.solvers {
        let found = solvers.iter().find(|solver| solver.kind == *kind);
        let anchor = found.map_or_else(String::new, |solver| anchor(&title(solver, solvers)));
        let _ = writeln!(text, "- [`{}`](#{anchor})", kind.name);
    }
    let capabilities = model.capabilities.unwrap_or_default();
    if capabilities.directional_derivatives {
        text += "\nThe model offers directional derivatives.\n";
    }
    text
}

fn solver_section(solver: &Solver, solvers: &[Solver]) -> String {
    let names: Vec<String> = solver
        .models
        .iter()
        .map(|name| format!("`{name}`"))
        .collect();
    format!(
        "\n### {}\n\n{}\n{}{}",
        title(solver, solvers),
        prose(&sentence(&solver.kind.description)),
        prose(&format!("Models: {}.", names.join(", "))),
        parameters("option", &solver.kind.options)
    )
}

/// A description as a sentence.
fn sentence(description: &str) -> String {
    format!("{}.", capital(description).trim_end_matches('.'))
}

/// The text with a capital at its start.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters).collect()
}

/// The name, and the first model where solvers of one name differ.
fn title(solver: &Solver, solvers: &[Solver]) -> String {
    let name = &solver.kind.name;
    let namesakes = solvers.iter().filter(|other| other.kind.name == *name);
    match (namesakes.count(), solver.models.first()) {
        (2.., Some(model)) => format!("solver {name} of {model}"),
        _ => format!("solver {name}"),
    }
}

fn anchor(title: &str) -> String {
    title.to_lowercase().replace(' ', "-")
}

fn parameters(what: &str, parameters: &[Parameter]) -> String {
    let rows = parameters.iter().map(|parameter| {
        [
            code(&parameter.name),
            cell(&parameter.unit),
            number(parameter.default),
            cell(&parameter.description),
        ]
    });
    table([what, "unit", "default", "meaning"], rows.collect())
}

fn variables(what: &str, variables: &[Variable]) -> String {
    if what == "output" {
        let rows = variables.iter().map(|variable| {
            [
                code(&variable.name),
                cell(&variable.unit),
                cell(&variable.description),
            ]
        });
        return table([what, "unit", "meaning"], rows.collect());
    }
    let rows = variables.iter().map(|variable| {
        [
            code(&variable.name),
            cell(&variable.unit),
            number(variable.default),
            cell(&variable.description),
        ]
    });
    table([what, "unit", "default", "meaning"], rows.collect())
}

fn markers(markers: &[Marker]) -> String {
    let rows = markers.iter().map(|marker| {
        let kind = match marker.kind() {
            MarkerKind::Scalar => "scalar",
            MarkerKind::Planar => "planar",
            MarkerKind::Spatial => "spatial",
            MarkerKind::Unspecified => "",
        };
        let names = |names: &[String]| {
            let names: Vec<String> = names.iter().map(|name| code(name)).collect();
            names.join(", ")
        };
        [
            code(&marker.name),
            kind.to_owned(),
            names(&marker.position),
            names(&marker.load),
        ]
    });
    table(
        ["marker", "kind", "position", "takes loads by"],
        rows.collect(),
    )
}

/// A table; nothing if there are no rows.
fn table<const N: usize>(heads: [&str; N], rows: Vec<[String; N]>) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let mut text = format!(
        "\n{}s:\n\n| {} |\n|{}\n",
        capital(heads[0]),
        heads.join(" | "),
        "---|".repeat(N)
    );
    for row in rows {
        let _ = writeln!(text, "| {} |", row.join(" | "));
    }
    text
}

fn number(value: Option<f64>) -> String {
    match value {
        Some(value) if value != 0.0 && !(1e-3..1e6).contains(&value.abs()) => format!("{value:e}"),
        Some(value) => value.to_string(),
        None => String::new(),
    }
}
