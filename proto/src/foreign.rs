//! Text of a peer, made fit to be shown: it goes to terminals, tables, SVG and HTML, and may be meant to do harm there.

use crate::v1::{DescribeReply, Failure, InstanceState, Model};

/// Longest name or unit, in bytes. Whoever has longer ones is not understood by their whole name any more.
pub const LONGEST_NAME: usize = 256;

/// Longest message or description, in bytes. A status travels in HTTP headers, and peers drop those beyond some 16 kB; the
/// message is in there twice, once with up to three bytes for one.
pub const LONGEST_TEXT: usize = 2048;

/// A text without control characters, which a terminal obeys, and without those that turn the direction of writing; both become
/// spaces. It has at most about `longest` bytes, and says how much is missing.
pub fn clean(text: &str, longest: usize) -> String {
    let short = shortened(text, longest);
    match short.contains(is_harmful) {
        true => short.replace(is_harmful, " "),
        false => short,
    }
}

/// The same with its lines.
pub fn clean_lines(text: &str, longest: usize) -> String {
    let short = shortened(text, longest);
    let lines: Vec<String> = short.lines().map(|line| clean(line, longest)).collect();
    lines.join("\n")
}

fn is_harmful(character: char) -> bool {
    let turns = matches!(character, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    character.is_control() || turns
}

pub(crate) fn shortened(text: &str, longest: usize) -> String {
    if text.len() <= longest {
        return text.to_owned();
    }
    let is_boundary = |end: &usize| text.is_char_boundary(*end);
    let end = (0..=longest).rev().find(is_boundary).unwrap_or_default();
    format!("{} ... ({} more bytes)", &text[..end], text.len() - end)
}

fn clean_name(name: &mut String) {
    *name = clean(name, LONGEST_NAME);
}

fn clean_text(text: &mut String) {
    *text = clean_lines(text, LONGEST_TEXT);
}

impl DescribeReply {
    /// Fit to be shown.
    #[must_use]
    pub fn cleaned(mut self) -> Self {
        clean_name(&mut self.worker);
        clean_name(&mut self.worker_version);
        self.models.iter_mut().for_each(clean_model);
        self
    }
}

fn clean_model(model: &mut Model) {
    clean_name(&mut model.name);
    clean_text(&mut model.description);
    for variable in model.inputs.iter_mut().chain(&mut model.outputs) {
        clean_name(&mut variable.name);
        clean_name(&mut variable.unit);
        clean_text(&mut variable.description);
    }
    let options = model.solvers.iter_mut().flat_map(|solver| {
        clean_name(&mut solver.name);
        clean_text(&mut solver.description);
        &mut solver.options
    });
    for parameter in model.parameters.iter_mut().chain(options) {
        clean_name(&mut parameter.name);
        clean_name(&mut parameter.unit);
        clean_text(&mut parameter.description);
    }
    for marker in &mut model.markers {
        clean_name(&mut marker.name);
        let lists = [
            &mut marker.position,
            &mut marker.velocity,
            &mut marker.acceleration,
            &mut marker.load,
        ];
        lists.into_iter().flatten().for_each(clean_name);
    }
    for variable in &mut model.states {
        clean_name(&mut variable.output);
        clean_name(&mut variable.initial);
    }
}

impl InstanceState {
    /// Fit to be shown.
    #[must_use]
    pub fn cleaned(mut self) -> Self {
        clean_name(&mut self.model);
        self
    }
}

impl Failure {
    /// Fit to be shown.
    #[must_use]
    pub fn cleaned(mut self) -> Self {
        clean_text(&mut self.message);
        // The sender may have cut it, and says so at its end.
        if let Some(field) = &mut self.field {
            *field = clean(field, 2 * LONGEST_NAME);
        }
        self.variable.iter_mut().for_each(clean_name);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::v1::{Marker, Parameter, Variable};

    const EVIL: &str = "x\u{1b}]0;owned\u{7}\u{202e}\u{9b}2J\r\n\0y";

    #[test]
    fn nothing_that_a_terminal_obeys_is_left() {
        assert_eq!(clean(EVIL, 99), "x ]0;owned   2J   y");
        assert_eq!(clean_lines("a\u{1b}[2J\nb\r\nc", 99), "a [2J\nb\nc");
        assert_eq!(clean("Masse \u{e9} \u{3b1}", 99), "Masse \u{e9} \u{3b1}");
        assert_eq!(clean("abc", 2), "ab ... (1 more bytes)");
        assert_eq!(clean("a\u{e9}", 2), "a ... (2 more bytes)");
    }

    #[test]
    fn every_text_of_a_description_is_cleaned() {
        let evil = || EVIL.to_owned();
        let variable = Variable {
            name: evil(),
            unit: evil(),
            description: evil(),
            ..Default::default()
        };
        let parameter = Parameter {
            name: evil(),
            unit: evil(),
            description: evil(),
            default: None,
        };
        let mut model = Model {
            name: evil(),
            description: evil(),
            inputs: vec![variable.clone()],
            outputs: vec![variable],
            parameters: vec![parameter.clone()],
            ..Default::default()
        };
        model.solvers.push(crate::v1::SolverKind {
            name: evil(),
            description: evil(),
            options: vec![parameter],
            without_impacts: false,
        });
        model.markers.push(Marker {
            name: evil(),
            position: vec![evil()],
            velocity: vec![evil()],
            acceleration: vec![evil()],
            load: vec![evil()],
            ..Default::default()
        });
        model.states.push(crate::v1::StateVariable {
            output: evil(),
            initial: evil(),
        });
        let reply = DescribeReply {
            worker: evil(),
            worker_version: evil(),
            models: vec![model],
            ..Default::default()
        };
        let shown = format!("{:?}", reply.cleaned());
        assert!(
            !shown.contains(r"\u{1b}") && !shown.contains(r"\u{202e}"),
            "{shown}"
        );
    }
}
