//! Reads `[[subsystem]]`.

use std::collections::BTreeMap;
use std::path::PathBuf;

use linchpin_proto::v1::{self, value::Kind};

use super::resolved::{Calls, Security, Served, Subsystem};
use crate::connection::{NoAccess, WorkerAddress};
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::key::{Key, Takes, texts};
use crate::reading::reader::{Field, Problems, Section, choice, collect, given, is_name};
use crate::reading::written::Value;

pub(super) const KEYS: [Key; 9] = [
    Key::new("name", Takes::Name)
        .required("name = \"mass1\"")
        .means("letters, digits, `-`, `_`"),
    Key::new("model", Takes::Text)
        .default("required for built-in models")
        .means("for others: the only model of the worker"),
    Key::new("address", Takes::Text)
        .default("")
        .means("a worker that runs already: `\"https://HOST:PORT\"`, `\"http://HOST:PORT\"` on this machine, or `\"unix:/PATH\"`"),
    Key::new("command", Takes::List(&Takes::Text, COMMAND))
        .default("")
        .means(
            "a worker that the run starts; `{address}` in it is replaced, or `--listen ADDRESS` \
             appended",
        ),
    Key::new("fmu", Takes::Text).default("").means(
        "an FMU for co-simulation, from the folder of this file; the run serves it by a process of its own \
         ([FMUs](../guide/fmu.md))",
    ),
    Key::new("parameters", Takes::Open(&[]))
        .default("model's defaults")
        .means("`linchpin describe` lists them; a table inside stands for dotted names, see below"),
    Key::new(
        "free_velocities",
        Takes::List(
            &Takes::Text,
            "a list of parameters such as [\"vx0\", \"vy0\"]",
        ),
    )
    .default("none")
    .means(
        "parameters, initial velocities, that are chosen so that the joints meet on \
         velocity level, as near as possible to what is given; the run tells what it chose",
    ),
    Key::new("solver", Takes::Open(&SOLVER))
        .default("model's first")
        .means(
            "`{ kind = \"radau5\", rtol = 1e-8, atol = 1e-8 }`: its name, and options that \
             `linchpin describe` lists",
        ),
    Key::new("calls", Takes::Choice(&texts(&CALLS)))
        .default_first()
        .means("`\"unary\"`: never use the exchange stream"),
];
const SOLVER: [Key; 1] = [Key::new("kind", Takes::Text)
    .required("solver = { kind = \"exact\" }")
    .means("name of the solver")];
const CALLS: [(&str, Calls); 2] = [("automatic", Calls::Automatic), ("unary", Calls::Unary)];
const VALUE: &str = "a number, a text, true or false, or a list of numbers";
const FILLED_TABLE: &str = "a table with at least one key";
const COMMAND: &str = "a list of texts, the program first";

pub(super) fn read(
    section: &Section<'_>,
    security: Option<&Security>,
    problems: &mut Problems<'_>,
) -> Option<Subsystem> {
    let [
        name,
        model,
        address,
        command,
        fmu,
        parameters,
        free_velocities,
        solver,
        calls,
    ] = section.read(&KEYS, problems);
    let name = name.and_then(|field| field.name(problems));
    let is_named = model.is_some();
    let model = given(model, |field| match field.text(problems)? {
        "" => field.refuse("the name of a model", problems),
        model => Some(model.to_owned()),
    });
    let served = match (address, command, fmu) {
        (Some(address), None, None) => {
            read_address(&address, security, problems).map(Served::Address)
        }
        (None, Some(command), None) => read_command(&command, problems).map(Served::Command),
        (None, None, Some(fmu)) => read_fmu(&fmu, problems).map(Served::Fmu),
        (None, None, None) if is_named => Some(Served::BuiltIn),
        (None, None, None) => {
            let subsystem = section.key.clone();
            problems.report(section.spot, SceneErrorKind::NotServed { subsystem });
            None
        }
        (address, command, fmu) => {
            let all = [("address", address), ("command", command), ("fmu", fmu)];
            let both: Vec<_> = { all.into_iter() }
                .filter_map(|(key, field)| Some((key, field?)))
                .collect();
            if let [(one, field), (other, _), ..] = &both[..] {
                let kind = SceneErrorKind::ServedTwice {
                    subsystem: section.key.clone(),
                    keys: [one, other],
                };
                field.report(kind, problems);
            }
            None
        }
    };
    let parameters = given(parameters, |field| read_parameters(field, problems));
    let free_velocities = given(free_velocities, |field| {
        let fields = field.texts(problems)?;
        collect(&fields, |field| field.text(problems).map(str::to_owned))
    });
    let solver = given(solver, |field| read_solver(field, problems));
    let calls = choice(calls, &CALLS, problems);
    Some(Subsystem {
        name: name?.to_owned(),
        served: served?,
        model: model?,
        parameters: parameters?.unwrap_or_default(),
        free_velocities: free_velocities?.unwrap_or_default(),
        solver: solver?,
        calls: calls?,
    })
}

fn read_fmu(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<PathBuf> {
    match field.text(problems)? {
        text if text.is_empty() || text.contains('\0') => {
            field.refuse("the path of an FMU such as \"mass.fmu\"", problems)
        }
        path => Some(problems.written.folder().join(path)),
    }
}

fn read_address(
    field: &Field<'_>,
    security: Option<&Security>,
    problems: &mut Problems<'_>,
) -> Option<String> {
    let address = field.text(problems)?;
    let (key, own) = (field.key.clone(), address.to_owned());
    let Some(parsed) = WorkerAddress::parse(address) else {
        field.report(
            SceneErrorKind::InvalidAddress { key, address: own },
            problems,
        );
        return None;
    };
    // Without it there is another mistake, which is told.
    let security = security?;
    let has_certificates = security.certificates.is_some();
    let kind = match parsed.check(has_certificates, security.plain_text) {
        Ok(()) => return Some(own),
        Err(NoAccess::NoCertificates) => SceneErrorKind::NoCertificates { key, address: own },
        Err(NoAccess::PlainText) => SceneErrorKind::PlainText { key, address: own },
    };
    field.report(kind, problems);
    None
}

fn read_command(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Vec<String>> {
    let words: Option<Vec<&str>> = field
        .texts(problems)?
        .iter()
        .map(|word| word.text(problems))
        .collect();
    let words = words?;
    if words[0].is_empty() || words.iter().any(|word| word.contains('\0')) {
        return field.refuse(COMMAND, problems);
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
            let empty: Option<()> = field.refuse(FILLED_TABLE, problems);
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
    let [kind] = section.fields(&SOLVER, problems);
    let kind = kind.and_then(|field| field.text(problems));
    let options: Vec<_> = section
        .entries()
        .filter(|(key, _)| SOLVER.iter().all(|own| own.name != *key))
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
            Kind::Number(field.number(problems)?)
        }
        Value::List(_) => Kind::Numbers(v1::NumberList {
            values: field.numbers(problems)?,
        }),
        Value::Date(_) | Value::Table(_) => return field.refuse(VALUE, problems),
    };
    Some(v1::Value { kind: Some(kind) })
}
