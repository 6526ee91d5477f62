//! Reads `[[connection]]`.

use super::resolved::Connection;
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::names::Registry;
use crate::reading::reader::{Problems, Section};
use crate::reading::reference::read_variable;

const KEYS: [&str; 3] = ["name", "from", "to"];

pub(super) fn read(
    section: &Section<'_>,
    subsystems: &Registry<'_>,
    problems: &mut Problems<'_>,
) -> Option<Connection> {
    section.allow_only(&KEYS, problems);
    let name = section
        .require("name", "name = \"speed\"", problems)
        .and_then(|field| field.name(problems));
    let from = section
        .require("from", "from = \"crank.rate\"", problems)
        .and_then(|field| read_variable(&field, "SUBSYSTEM.OUTPUT", subsystems, problems));
    let to_field = section.require("to", "to = \"controller.speed\"", problems);
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
