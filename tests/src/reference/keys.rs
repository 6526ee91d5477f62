//! Tables of the keys of a file, as the reader declares them.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use linchpin_master::scene::{Default, Key, Range, Takes, methods_with};

/// What stands before a table, with the names of the tables that have these keys.
const MARK: &str = "<!-- keys of ";

/// A table with its dotted name.
struct Table {
    name: String,
    keys: Vec<Key>,
}

/// A page of the repository with the tables of these files written anew; every table of theirs must have its place.
pub fn page(page: &str, files: &[(&str, &[Key])]) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/reference");
    let text = fs::read_to_string(path.join(page)).unwrap_or_default();
    let mut tables = Vec::new();
    for (name, keys) in files {
        collect(name, "", keys, &mut tables);
    }
    let mut written = String::new();
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        let _ = writeln!(written, "{line}");
        let Some(names) = line.strip_prefix(MARK) else {
            continue;
        };
        let mut rows = String::new();
        for name in names.trim_end_matches(" -->").split(", ") {
            let place = tables.iter().position(|table| table.name == name);
            let table = tables.remove(place.unwrap_or_else(|| panic!("{page}: no table {name}")));
            let own = rows_of(&table);
            assert!(rows.is_empty() || rows == own, "{page}: {names} differ");
            rows = own;
        }
        written += &rows;
        let is_old = |line: &&str| line.is_empty() || line.starts_with('|');
        while lines.next_if(is_old).is_some() {}
        if lines.peek().is_some() {
            written.push('\n');
        }
    }
    let left: Vec<String> = tables.into_iter().map(|table| table.name).collect();
    assert!(left.is_empty(), "{page}: no `{MARK}NAME -->` of {left:?}");
    written
}

/// The tables at and below one with these keys, whose names begin with `prefix`.
fn collect(name: &str, prefix: &str, keys: &[Key], tables: &mut Vec<Table>) {
    tables.push(Table {
        name: name.to_owned(),
        keys: keys.to_vec(),
    });
    for key in keys {
        let name = format!("{prefix}{}", key.name);
        for takes in key.takes.alternatives() {
            let below = match takes {
                Takes::Table(keys) | Takes::Tables(keys) => keys(),
                Takes::Open(keys) => keys.to_vec(),
                _ => Vec::new(),
            };
            if !below.is_empty() {
                collect(&name, &format!("{name}."), &below, tables);
            }
        }
    }
}

/// The rows of a table, those that must be there first.
fn rows_of(table: &Table) -> String {
    let mut text = "\n| key | type | default | meaning |\n|---|---|---|---|\n".to_owned();
    let mut keys = table.keys.clone();
    keys.sort_by_key(|key| key.default != Default::None);
    for key in keys {
        let cells = [
            super::code(key.name),
            words(&key.takes),
            default(&key),
            meaning(&table.name, &key),
        ];
        let _ = writeln!(
            text,
            "| {} |",
            cells.map(|cell| super::cell(&cell)).join(" | ")
        );
    }
    text
}

/// What a key of a table is, after the methods that have it.
pub fn meaning(table: &str, key: &Key) -> String {
    assert!(
        !key.meaning.is_empty(),
        "{table}.{} means nothing",
        key.name
    );
    let methods = match table {
        "coupling" => methods_with(key.name),
        _ => Vec::new(),
    };
    match methods.is_empty() {
        true => key.meaning.to_owned(),
        false => format!("{}: {}", methods.join(", "), key.meaning),
    }
}

fn default(key: &Key) -> String {
    match (key.default, key.takes) {
        (Default::None, _) => "required".to_owned(),
        (Default::Number(value), _) => number(value),
        (Default::First, Takes::Choice([first, ..])) => format!("`\"{first}\"`"),
        (Default::First, _) => panic!("{} has no choices", key.name),
        (Default::Words(words), _) => words.to_owned(),
    }
}

fn words(takes: &Takes) -> String {
    match takes {
        Takes::Any => "any value".to_owned(),
        Takes::Flag => "`true` or `false`".to_owned(),
        Takes::Text => "text".to_owned(),
        Takes::Name => "name".to_owned(),
        Takes::Choice(choices) => {
            let choices: Vec<String> = choices.iter().map(|text| format!("`\"{text}\"`")).collect();
            choices.join(", ")
        }
        Takes::Number(range) => format!("number{}", limits(range)),
        Takes::Formula(unit, range) => match unit.symbol() {
            "" => format!("number{}", limits(range)),
            symbol => format!("number{} or `\"2{symbol}\"`", limits(range)),
        },
        Takes::Whole(least, usize::MAX) => format!("whole number >= {least}"),
        Takes::Whole(least, most) => format!("{least}..{most}"),
        Takes::List(item, _) => match item {
            Takes::Number(range) => format!("list of numbers{}", limits(range)),
            _ => "list of texts".to_owned(),
        },
        Takes::Table(_) | Takes::Open(_) => "table".to_owned(),
        Takes::Tables(_) => "tables".to_owned(),
        Takes::Either(all) => {
            let all: Vec<String> = all.iter().map(words).collect();
            all.join(" or ")
        }
    }
}

fn limits(range: &Range) -> String {
    let limit = |symbol, value: f64| match value.is_finite() {
        true => format!(" {symbol} {}", number(value)),
        false => String::new(),
    };
    if range.least.is_finite() && range.most.is_finite() {
        return format!(" from {} to {}", number(range.least), number(range.most));
    }
    let limits = [
        limit(">", range.above),
        limit(">=", range.least),
        limit("up to", range.most),
    ];
    limits.concat()
}

fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        1e-3..1e4 => value.to_string(),
        _ => format!("{value:e}"),
    }
}
