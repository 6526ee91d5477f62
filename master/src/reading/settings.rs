//! All settings of a file by their dotted keys.

use std::collections::BTreeMap;

use super::written::{Node, Value, Written};

impl Written {
    /// Every value that is no table by its dotted key; an entry of a list of tables goes by its name, or by its number from 1.
    pub(crate) fn settings(&self) -> BTreeMap<String, String> {
        let mut settings = BTreeMap::new();
        collect(&self.root, "", &mut settings);
        settings
    }
}

fn collect(node: &Node, key: &str, settings: &mut BTreeMap<String, String>) {
    let below = |name: &str| match key {
        "" => name.to_owned(),
        key => format!("{key}.{name}"),
    };
    match &node.value {
        Value::Table(table) => {
            for (name, entry) in table {
                collect(&entry.node, &below(name), settings);
            }
        }
        Value::List(items) if items.iter().any(is_table) => {
            for (number, item) in items.iter().enumerate() {
                let number = (number + 1).to_string();
                collect(item, &below(item.name().unwrap_or(&number)), settings);
            }
        }
        _ => {
            settings.insert(key.to_owned(), text(node));
        }
    }
}

fn is_table(node: &Node) -> bool {
    matches!(node.value, Value::Table(_))
}

/// The value on one line; a whole number and the same number with a point have the same text.
fn text(node: &Node) -> String {
    match &node.value {
        Value::Integer(number) => number.to_string(),
        Value::Float(number) if (1e-4..1e7).contains(&number.abs()) || *number == 0.0 => {
            number.to_string()
        }
        Value::Float(number) => format!("{number:e}"),
        Value::Text(text) => text.clone(),
        Value::List(items) => {
            let items: Vec<String> = items.iter().map(text).collect();
            format!("[{}]", items.join(", "))
        }
        _ => node.to_toml().to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_go_by_dotted_keys_and_names() {
        let file = "[scene]\nt_end = 1.0\n[coupling]\nmacro_step = 1e-5\n\
                    [[subsystem]]\nname = \"a\"\nparameters = { m = 2.50, path = [1, 2.0] }\n\
                    [[output.panel]]\nlabel = \"x\"\ncolumns = [\"a.x\"]\n";
        let written = Written::parse(file, "scene.toml", "scene file").unwrap();
        let expected = [
            ("coupling.macro_step", "1e-5"),
            ("output.panel.1.columns", "[a.x]"),
            ("output.panel.1.label", "x"),
            ("scene.t_end", "1"),
            ("subsystem.a.name", "a"),
            ("subsystem.a.parameters.m", "2.5"),
            ("subsystem.a.parameters.path", "[1, 2]"),
        ];
        let expected = expected.map(|(key, value)| (key.to_owned(), value.to_owned()));
        assert_eq!(written.settings(), BTreeMap::from(expected));
    }
}
