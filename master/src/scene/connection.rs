//! Reads `[[connection]]`.

use super::resolved::Connection;
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::key::{Key, Takes};
use crate::reading::names::Registry;
use crate::reading::reader::{Problems, Section};
use crate::reading::reference::read_variable;

pub(super) const KEYS: [Key; 3] = [
    Key::new("name", Takes::Name)
        .required("name = \"speed\"")
        .means("names the connection in messages"),
    Key::new("from", Takes::Text)
        .required("from = \"crank.rate\"")
        .means("`\"SUBSYSTEM.OUTPUT\"`"),
    Key::new("to", Takes::Text)
        .required("to = \"controller.speed\"")
        .means(
            "`\"SUBSYSTEM.INPUT\"` of another subsystem; an input takes one signal, an output \
             may go to several",
        ),
];

pub(super) fn read(
    section: &Section<'_>,
    subsystems: &Registry<'_>,
    problems: &mut Problems<'_>,
) -> Option<Connection> {
    let [name, from, to_field] = section.read(&KEYS, problems);
    let name = name.and_then(|field| field.name(problems));
    let from =
        from.and_then(|field| read_variable(&field, "SUBSYSTEM.OUTPUT", subsystems, problems));
    let to = to_field
        .as_ref()
        .and_then(|field| read_variable(field, "SUBSYSTEM.INPUT", subsystems, problems));
    let connection = Connection {
        name: name?.to_owned(),
        from: from?,
        to: to?,
    };
    if connection.from.0 == connection.to.0 {
        let kind = SceneErrorKind::ConnectedToItself {
            connection: connection.name,
            subsystem: subsystems.name(connection.from.0),
        };
        to_field?.report(kind, problems);
        return None;
    }
    Some(connection)
}
