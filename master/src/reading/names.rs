//! The names that a scene gives to its subsystems, joints and cases.

use std::collections::BTreeMap;

use super::error_kind::SceneErrorKind;
use super::reader::{Field, Problems, Section};

/// Names in use, and who has them.
pub(crate) struct Registry<'w> {
    owner: &'static str,
    positions: BTreeMap<&'w str, usize>,
    fields: Vec<Option<Field<'w>>>,
}

impl<'w> Registry<'w> {
    /// Collects the names of a list of tables and reports those that are given twice or taken by `others`.
    pub(crate) fn collect(
        owner: &'static str,
        sections: &[Section<'w>],
        others: Option<&Registry<'w>>,
        problems: &mut Problems<'_>,
    ) -> Self {
        let mut registry = Self {
            owner,
            positions: BTreeMap::new(),
            fields: Vec::new(),
        };
        for (position, section) in sections.iter().enumerate() {
            let field = section.find("name");
            if let Some((field, name)) = field.as_ref().and_then(|f| Some((f, f.peek_text()?))) {
                let taken = registry.owner_of(name).or_else(|| others?.owner_of(name));
                match taken {
                    Some((taken_by, first)) => {
                        report_duplicate(field, name, taken_by, first, problems);
                    }
                    None => {
                        registry.positions.insert(name, position);
                    }
                }
            }
            registry.fields.push(field);
        }
        registry
    }

    /// Adds a name that no table gives, behind the others, unless it is taken.
    pub(crate) fn imply(&mut self, name: &'static str) -> bool {
        if self.position(name).is_some() {
            return false;
        }
        self.positions.insert(name, self.fields.len());
        self.fields.push(None);
        true
    }

    fn owner_of(&self, name: &str) -> Option<(&'static str, &Field<'w>)> {
        let position = self.position(name)?;
        Some((self.owner, self.fields.get(position)?.as_ref()?))
    }

    pub(crate) fn position(&self, name: &str) -> Option<usize> {
        self.positions.get(name).copied()
    }

    /// The name at a position that [`Registry::position`] gave.
    pub(crate) fn name(&self, position: usize) -> String {
        self.positions
            .iter()
            .find(|(_, taken)| **taken == position)
            .map(|(name, _)| (*name).to_owned())
            .unwrap_or_default()
    }

    pub(crate) fn names(&self) -> impl Iterator<Item = &'w str> {
        self.positions.keys().copied()
    }
}

/// Reports every text that an earlier field has as well.
pub(crate) fn report_repeated(
    fields: &[Field<'_>],
    taken_by: &'static str,
    problems: &mut Problems<'_>,
) {
    for (place, field) in fields.iter().enumerate() {
        let mut earlier = fields[..place].iter();
        if let Some(name) = field.peek_text()
            && let Some(first) = earlier.find(|earlier| earlier.peek_text() == Some(name))
        {
            report_duplicate(field, name, taken_by, first, problems);
        }
    }
}

fn report_duplicate(
    field: &Field<'_>,
    name: &str,
    taken_by: &'static str,
    first: &Field<'_>,
    problems: &mut Problems<'_>,
) {
    let line = problems.written.place(&first.node.spot);
    let kind = SceneErrorKind::DuplicateName {
        key: field.key.clone(),
        name: name.to_owned(),
        taken_by,
        line: line.filter(|p| !p.is_override()).map(|p| p.line),
    };
    field.report(kind, problems);
}
