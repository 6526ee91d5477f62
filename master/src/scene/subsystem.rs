//! Reads `[[subsystem]]`.

use std::collections::BTreeMap;

use linchpin_proto::v1::{self, value::Kind};
use tonic::transport::Uri;

use super::resolved::{Calls, Served, Subsystem};
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::lists::collect;
use crate::reading::reader::{FINITE, Field, Problems, Section, is_name};
use crate::reading::written::Value;

const KEYS: [&str; 8] = [
    "name",
    "model",
    "address",
    "command",
    "parameters",
    "free_velocities",
    "solver",
    "calls",
];
const CALLS: [(&str, Calls); 2] = [("automatic", Calls::Automatic), ("unary", Calls::Unary)];
const VALUE: &str = "a number, a text, true or false, or a list of numbers";
const VELOCITIES: &str = "a list of parameters such as [\"vx0\", \"vy0\"]";
const FILLED_TABLE: &str = "a table with at least one key";
const COMMAND: &str = "a list of texts, the program first";

pub(super) fn read(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Subsystem> {
    section.allow_only(&KEYS, problems);
    let name = section
        .require("name", "name = \"mass1\"", problems)
        .and_then(|field| field.name(problems));
    let model = match section.get("model") {
        Some(field) => read_model(&field, problems).map(Some),
        None => Some(None),
    };
    let served = read_served(section, problems);
    let parameters = match section.get("parameters") {
        Some(field) => read_parameters(&field, problems),
        None => Some(BTreeMap::new()),
    };
    let free_velocities = match section.get("free_velocities") {
        Some(field) => read_texts(&field, problems),
        None => Some(Vec::new()),
    };
    let solver = match section.get("solver") {
        Some(field) => read_solver(&field, problems).map(Some),
        None => Some(None),
    };
    let calls = section
        .get("calls")
        .map_or(Some(Calls::Automatic), |field| {
            field.choice(&CALLS, problems)
        });
    Some(Subsystem {
        name: name?.to_owned(),
        served: served?,
        model: model?,
        parameters: parameters?,
        free_velocities: free_velocities?,
        solver: solver?,
        calls: calls?,
    })
}

fn read_texts(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Vec<String>> {
    let fields = field.texts(VELOCITIES, problems)?;
    collect(&fields, |field| field.text(problems).map(str::to_owned))
}

fn read_model(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<String> {
    let model = field.text(problems)?;
    if model.is_empty() {
        return field.wrong_type("the name of a model", problems);
    }
    Some(model.to_owned())
}

fn read_served(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Served> {
    match (section.get("address"), section.get("command")) {
        (Some(address), None) => read_address(&address, problems).map(Served::Address),
        (None, Some(command)) => {
            let words = read_command(&command, problems)?;
            Some(Served::Command(words))
        }
        (None, None) if section.get("model").is_some() => Some(Served::BuiltIn),
        (None, None) => {
            let subsystem = section.key.clone();
            problems.report(section.spot, SceneErrorKind::NotServed { subsystem });
            None
        }
        (Some(address), Some(_)) => {
            let subsystem = section.key.clone();
            address.report(SceneErrorKind::ServedTwice { subsystem }, problems);
            None
        }
    }
}

fn read_address(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<String> {
    let address = field.text(problems)?;
    if is_worker_address(address) {
        return Some(address.to_owned());
    }
    let (key, address) = (field.key.clone(), address.to_owned());
    let kind = if address.starts_with("https://") {
        SceneErrorKind::TlsNotSupported { key, address }
    } else {
        SceneErrorKind::InvalidAddress { key, address }
    };
    field.report(kind, problems);
    None
}

/// Whether a text is the address of a worker: `http://HOST:PORT` or `unix:/PATH`.
pub fn is_worker_address(text: &str) -> bool {
    is_network_address(text) || is_socket_path(text)
}

fn is_network_address(address: &str) -> bool {
    address.parse::<Uri>().is_ok_and(|uri| {
        let has_host = uri.host().is_some_and(|host| !host.is_empty());
        let no_more = uri.path_and_query().is_none_or(|path| path == "/");
        uri.scheme_str() == Some("http") && has_host && no_more
    })
}

fn is_socket_path(address: &str) -> bool {
    address
        .strip_prefix("unix:/")
        .is_some_and(|path| !path.trim_matches('/').is_empty() && !path.contains('\0'))
}

fn read_command(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Vec<String>> {
    let words: Option<Vec<&str>> = field
        .texts(COMMAND, problems)?
        .iter()
        .map(|word| word.text(problems))
        .collect();
    let words = words?;
    if words[0].is_empty() || words.iter().any(|word| word.contains('\0')) {
        return field.wrong_type(COMMAND, problems);
    }
    Some(words.into_iter().map(str::to_owned).collect())
}

/// A table in the parameters stands for parameters with dotted names: `m` in `[subsystem.parameters.body.crank]` is
/// `body.crank.m`.
fn read_parameters(
    field: &Field<'_>,
    problems: &mut Problems<'_>,
) -> Option<BTreeMap<String, v1::Value>> {
    let mut parameters = BTreeMap::new();
    let section = field.section(problems)?;
    read_parameter_table(&section, "", &mut parameters, problems).then_some(parameters)
}

/// Adds the parameters of a table whose dotted name is `prefix`; false if there is a mistake in it.
fn read_parameter_table(
    section: &Section<'_>,
    prefix: &str,
    parameters: &mut BTreeMap<String, v1::Value>,
    problems: &mut Problems<'_>,
) -> bool {
    let mut is_sound = true;
    for (key, entry) in section.table {
        let field = section.field(key, entry);
        let is_table = matches!(entry.node.value, Value::Table(_));
        // A name of its own may be whatever the model calls its parameter; the parts of a dotted one may not.
        if (is_table || !prefix.is_empty()) && !is_name(key) {
            section.report_invalid_key(key, entry, problems);
            is_sound = false;
            continue;
        }
        let name = format!("{prefix}{key}");
        is_sound &= if is_table {
            read_inner_table(&field, &name, parameters, problems)
        } else {
            read_parameter(&field, name, parameters, problems)
        };
    }
    is_sound
}

fn read_inner_table(
    field: &Field<'_>,
    name: &str,
    parameters: &mut BTreeMap<String, v1::Value>,
    problems: &mut Problems<'_>,
) -> bool {
    match field.section(problems) {
        Some(section) if section.table.is_empty() => {
            let empty: Option<()> = field.wrong_type(FILLED_TABLE, problems);
            empty.is_some()
        }
        Some(section) => read_parameter_table(&section, &format!("{name}."), parameters, problems),
        None => false,
    }
}

fn read_parameter(
    field: &Field<'_>,
    name: String,
    parameters: &mut BTreeMap<String, v1::Value>,
    problems: &mut Problems<'_>,
) -> bool {
    let Some(value) = read_value(field, problems) else {
        return false;
    };
    // A quoted name with dots at the top may be the same as one that tables spell.
    if parameters.contains_key(&name) {
        let kind = SceneErrorKind::DuplicateName {
            key: field.key.clone(),
            name,
            taken_by: "parameter",
            line: None,
        };
        field.report(kind, problems);
        return false;
    }
    parameters.insert(name, value);
    true
}

fn read_solver(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<v1::Solver> {
    let section = field.section(problems)?;
    let kind = section
        .require("kind", "solver = { kind = \"exact\" }", problems)
        .and_then(|field| field.text(problems));
    let options: Vec<_> = section
        .fields()
        .filter(|(key, _)| *key != "kind")
        .map(|(key, field)| Some((key.to_owned(), read_value(&field, problems)?)))
        .collect();
    Some(v1::Solver {
        kind: kind?.to_owned(),
        options: options.into_iter().collect::<Option<_>>()?,
    })
}

fn read_value(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<v1::Value> {
    let kind = match &field.node.value {
        Value::Text(text) => Kind::Text(text.clone()),
        Value::Flag(flag) => Kind::Flag(*flag),
        Value::Integer(_) | Value::Float(_) | Value::Oversized(_) => {
            Kind::Number(field.number(&FINITE, problems)?)
        }
        Value::List(_) => {
            let values: Vec<_> = field
                .items(VALUE, problems)?
                .iter()
                .map(|item| item.number(&FINITE, problems))
                .collect();
            Kind::Numbers(v1::NumberList {
                values: values.into_iter().collect::<Option<_>>()?,
            })
        }
        Value::Date(_) | Value::Table(_) => return field.wrong_type(VALUE, problems),
    };
    Some(v1::Value { kind: Some(kind) })
}
