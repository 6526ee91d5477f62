//! Puts settings into the tree of a file: overrides, and those of cases and studies.

use std::sync::Arc;

use toml::de::DeValue;

use super::coupling;
use super::step_control::MACRO_STEP;
use crate::reading::error::{SceneError, SceneErrors};
use crate::reading::error_kind::{Names, SceneErrorKind};
use crate::reading::nearest::nearest;
use crate::reading::overrides::Override;
use crate::reading::place::{Source, Spot};
use crate::reading::written::{Entry, Node, Table, Value, Written};

/// The longest key of a scene has six parts, in a nested table of parameters; a longer one than this is a mistake.
const MOST_PARTS: usize = 8;
/// Tables that stand in a list, one for each `[[...]]`.
const LISTS: [&str; 4] = ["subsystem", "joint", "connection", "case"];
/// Written before an override where it is shown as a place.
const OPTION: &str = "--set ";

/// One key to be set, parsed, with the place of key and value.
#[derive(Clone, Debug)]
pub(super) struct Assignment {
    pub(super) key: String,
    pub(super) key_spot: Spot,
    pub(super) node: Node,
}

impl Written {
    /// Puts overrides into the tree; returns the mistakes in them.
    pub(super) fn apply_overrides(&mut self, overrides: &[Override]) -> Vec<SceneError> {
        let mut errors = Vec::new();
        let mut assignments = Vec::new();
        for given in overrides {
            match self.assignment(given) {
                Ok(assignment) => assignments.push(assignment),
                Err(mistakes) => errors.extend(mistakes),
            }
        }
        errors.extend(self.assign(&assignments));
        errors
    }

    /// Puts parsed values into the tree; returns the mistakes in their keys.
    pub(super) fn assign(&mut self, assignments: &[Assignment]) -> Vec<SceneError> {
        self.set_aside_other_methods(assignments);
        let mut errors = Vec::new();
        for assignment in assignments {
            let parts: Vec<&str> = assignment.key.split('.').collect();
            let done = check_parts(&assignment.key, &parts)
                .and_then(|()| set(&mut self.root, &parts, assignment));
            if let Err(kind) = done {
                errors.push(SceneError::new(self.place(&assignment.key_spot), kind));
            }
        }
        errors
    }

    /// Puts values of another file into the tree; returns the mistakes in their keys.
    pub(super) fn assign_from(
        &mut self,
        source: &Arc<Source>,
        assignments: &[Assignment],
    ) -> Vec<SceneError> {
        let place = self.sources.len();
        self.sources.push(Arc::clone(source));
        let moved = |assignment: &Assignment| Assignment {
            key: assignment.key.clone(),
            key_spot: assignment.key_spot.in_source(place),
            node: assignment.node.in_source(place),
        };
        let moved: Vec<Assignment> = assignments.iter().map(moved).collect();
        self.assign(&moved)
    }

    /// Removes what the tree says about the coupling, but for the macro step.
    pub(super) fn set_coupling_aside(&mut self) {
        if let Value::Table(root) = &mut self.root.value
            && let Some(Value::Table(table)) = root.get_mut("coupling").map(|e| &mut e.node.value)
        {
            table.retain(|key, _| key == MACRO_STEP.name);
        }
    }

    /// The file as it was read.
    pub(super) fn without_overrides(self) -> Option<Self> {
        let file = self.sources.first()?;
        let origin = file.path()?.display().to_string();
        Self::parse(file.text(), &origin, self.document).ok()
    }

    fn assignment(&mut self, given: &Override) -> Result<Assignment, SceneErrors> {
        let source = self.sources.len();
        self.sources
            .push(Arc::new(Source::over_ride(format!("{OPTION}{given}"))));
        let key_end = OPTION.len() + given.key.len();
        let value_start = key_end + 1;
        let value_spot = Spot::new(source, value_start..value_start + given.value.len());
        let node = match DeValue::parse(&given.value) {
            Ok(parsed) => Node::from_toml(&parsed, source, value_start),
            Err(_) if is_bare(&given.value) => Node {
                spot: value_spot,
                value: Value::Text(given.value.clone()),
            },
            Err(mistake) => {
                let kind = SceneErrorKind::OverrideValue {
                    value: given.value.clone(),
                    reason: mistake.message().to_owned(),
                };
                return Err(SceneError::new(self.place(&value_spot), kind).into());
            }
        };
        Ok(Assignment {
            key: given.key.clone(),
            key_spot: Spot::new(source, OPTION.len()..key_end),
            node,
        })
    }

    fn set_aside_other_methods(&mut self, assignments: &[Assignment]) {
        let chosen = assignments.iter().rev().find_map(|assignment| {
            match (assignment.key.as_str(), &assignment.node.value) {
                (coupling::METHOD_KEY, Value::Text(method)) => Some(method),
                _ => None,
            }
        });
        let (Some(method), Value::Table(root)) = (chosen, &mut self.root.value) else {
            return;
        };
        if let Some(Value::Table(table)) = root.get_mut("coupling").map(|e| &mut e.node.value) {
            let before = match table.get("method").map(|entry| &entry.node.value) {
                Some(Value::Text(before)) => Some(before.clone()),
                _ => None,
            };
            table.retain(|key, _| !coupling::is_set_aside(key, before.as_deref(), method));
        }
    }
}

/// True for text that cannot be meant as quoted text, a list or a table.
fn is_bare(value: &str) -> bool {
    !value.starts_with(['"', '\'', '[', '{'])
}

fn check_parts(key: &str, parts: &[&str]) -> Result<(), SceneErrorKind> {
    let well_formed =
        (2..=MOST_PARTS).contains(&parts.len()) && parts.iter().all(|part| !part.is_empty());
    let in_list = LISTS.contains(&parts[0]);
    if well_formed && (!in_list || parts.len() > 2) {
        Ok(())
    } else {
        Err(SceneErrorKind::OverrideKey {
            key: key.to_owned(),
        })
    }
}

fn set(root: &mut Node, parts: &[&str], assignment: &Assignment) -> Result<(), SceneErrorKind> {
    let Value::Table(table) = &mut root.value else {
        return Err(unreachable_key(assignment, root));
    };
    if LISTS.contains(&parts[0]) && !table.contains_key(parts[0]) {
        return Err(unknown_entry(assignment, parts[1], &[]));
    }
    set_in_table(table, parts, assignment)
}

fn set_in_node(
    node: &mut Node,
    parts: &[&str],
    assignment: &Assignment,
) -> Result<(), SceneErrorKind> {
    if parts.is_empty() {
        *node = assignment.node.clone();
        return Ok(());
    }
    match &mut node.value {
        Value::Table(table) => set_in_table(table, parts, assignment),
        Value::List(items) if items.iter().any(|item| item.name().is_some()) => {
            set_in_list(items, parts, assignment)
        }
        _ => Err(unreachable_key(assignment, node)),
    }
}

fn set_in_table(
    table: &mut Table,
    parts: &[&str],
    assignment: &Assignment,
) -> Result<(), SceneErrorKind> {
    if parts[0] == "*" {
        return Err(SceneErrorKind::OverrideKey {
            key: assignment.key.clone(),
        });
    }
    let empty = || Entry {
        key_spot: assignment.key_spot.clone(),
        node: Node {
            spot: assignment.node.spot.clone(),
            value: Value::Table(Table::new()),
        },
    };
    let entry = table.entry(parts[0].to_owned()).or_insert_with(empty);
    if parts.len() == 1 {
        entry.key_spot = assignment.key_spot.clone();
    }
    set_in_node(&mut entry.node, &parts[1..], assignment)
}

fn set_in_list(
    items: &mut [Node],
    parts: &[&str],
    assignment: &Assignment,
) -> Result<(), SceneErrorKind> {
    let names: Vec<String> = items
        .iter()
        .filter_map(|item| item.name().map(str::to_owned))
        .collect();
    if parts[0] != "*" && !names.iter().any(|name| name == parts[0]) {
        return Err(unknown_entry(assignment, parts[0], &names));
    }
    items
        .iter_mut()
        .filter(|item| parts[0] == "*" || item.is_named(parts[0]))
        .try_for_each(|item| set_in_node(item, &parts[1..], assignment))
}

fn unreachable_key(assignment: &Assignment, blocking: &Node) -> SceneErrorKind {
    SceneErrorKind::OverrideBlocked {
        key: assignment.key.clone(),
        blocking: blocking.value.to_string(),
    }
}

fn unknown_entry(assignment: &Assignment, name: &str, known: &[String]) -> SceneErrorKind {
    SceneErrorKind::UnknownName {
        key: assignment.key.clone(),
        name: name.to_owned(),
        nearest: nearest(name, known.iter().map(String::as_str)),
        known: Names::from(known),
    }
}
