//! Reads `[[connection]]`.

use super::resolved::Connection;
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::key::{FINITE, Key, Takes};
use crate::reading::names::Registry;
use crate::reading::reader::{Problems, Section};
use crate::reading::reference::read_variable;

pub(super) const KEYS: [Key; 4] = [
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
    Key::new("start", Takes::Number(FINITE))
        .default("the default of the input")
        .means(
            "where signals depend on each other without delay: the value with which the search for theirs at `t_start` \
             begins; connections from one output take one value",
        ),
];

pub(super) fn read(
    section: &Section<'_>,
    subsystems: &Registry<'_>,
    problems: &mut Problems<'_>,
) -> Option<Connection> {
    let [name, from, to_field, start] = section.read(&KEYS, problems);
    let name = name.and_then(|field| field.name(problems));
    let from =
        from.and_then(|field| read_variable(&field, "SUBSYSTEM.OUTPUT", subsystems, problems));
    let to = to_field
        .as_ref()
        .and_then(|field| read_variable(field, "SUBSYSTEM.INPUT", subsystems, problems));
    let start = match start {
        Some(field) => Some(field.number(problems)?),
        None => None,
    };
    let connection = Connection {
        name: name?.to_owned(),
        from: from?,
        to: to?,
        start,
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
