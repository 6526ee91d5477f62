//! JSON schemas of the files, for editors.

use linchpin_master::scene::{Default, Key, Range, Takes};
use serde_json::{Map, Value, json};

use super::keys::meaning;

/// The schema of a file with these tables.
pub fn schema(title: &str, keys: &[Key]) -> String {
    let mut schema = object("", keys, true);
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!(title);
    format!("{schema:#}\n")
}

/// A table; `closed` if it has no other keys.
fn object(name: &str, keys: &[Key], closed: bool) -> Value {
    let property = |key: &Key| {
        let mut value = value(key.name, &key.takes);
        let mut description = plain(&meaning(name, key));
        match (key.default, key.takes) {
            (Default::Number(number), _) => value["default"] = json!(number),
            (Default::First, Takes::Choice([first, ..])) => value["default"] = json!(first),
            (Default::Words(words), _) if !words.is_empty() => {
                description += &format!(" (default: {words})");
            }
            _ => {}
        }
        value["description"] = json!(description);
        (key.name.to_owned(), value)
    };
    let required = keys.iter().filter(|key| key.default == Default::None);
    let required: Vec<&str> = required.map(|key| key.name).collect();
    let mut object = json!({
        "type": "object",
        "properties": keys.iter().map(property).collect::<Map<_, _>>(),
        "required": required,
    });
    if closed {
        object["additionalProperties"] = json!(false);
    }
    object
}

fn value(name: &str, takes: &Takes) -> Value {
    match takes {
        Takes::Any => json!({}),
        Takes::Flag => json!({ "type": "boolean" }),
        Takes::Text => json!({ "type": "string" }),
        Takes::Name => json!({ "type": "string", "pattern": "^[A-Za-z0-9_-]+$" }),
        Takes::Choice(choices) => json!({ "enum": choices }),
        Takes::Number(range) => number(range),
        Takes::Formula(unit, range) => match unit.symbol().replace('^', "\\^") {
            symbol if symbol.is_empty() => number(range),
            symbol => {
                let multiple =
                    json!({ "type": "string", "pattern": format!("^[^H/]*{symbol}\\s*$") });
                json!({ "anyOf": [number(range), multiple] })
            }
        },
        Takes::Whole(least, usize::MAX) => json!({ "type": "integer", "minimum": least }),
        Takes::Whole(least, most) => {
            json!({ "type": "integer", "minimum": least, "maximum": most })
        }
        Takes::List(item, _) => json!({ "type": "array", "items": value(name, item) }),
        Takes::Table(keys) => object(name, &keys(), true),
        Takes::Tables(keys) => json!({ "type": "array", "items": object(name, &keys(), true) }),
        Takes::Open(keys) => object(name, keys, false),
        Takes::Either(all) => {
            json!({ "anyOf": all.iter().map(|takes| value(name, takes)).collect::<Vec<_>>() })
        }
    }
}

fn number(range: &Range) -> Value {
    let limits = [
        ("exclusiveMinimum", range.above),
        ("minimum", range.least),
        ("maximum", range.most),
    ];
    let mut number = json!({ "type": "number" });
    for (name, limit) in limits.into_iter().filter(|(_, limit)| limit.is_finite()) {
        number[name] = json!(limit);
    }
    number
}

/// Markdown without its links.
fn plain(text: &str) -> String {
    let mut parts = text.split("](");
    let mut plain = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        if let Some(start) = plain.rfind('[') {
            plain.remove(start);
        }
        plain += part.split_once(')').map_or("", |(_, rest)| rest);
    }
    plain
}
