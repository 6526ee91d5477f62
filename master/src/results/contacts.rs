//! Contacts inside subsystems, as far as names of outputs tell of them: a marker `NAME` of a model with an output
//! `normal_NAME` is a contact.

use linchpin_proto::v1;

/// Output with the number of impacts of a subsystem in the last macro step.
const IMPACTS: &str = "impacts";

/// A marker that is a contact, and the result columns of what it does.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RecordedContact {
    /// Place of the marker in [`Mechanism::markers`](super::Mechanism::markers).
    pub marker: usize,
    /// Place of the column with its normal force between impacts (N), `normal_NAME`.
    pub force: usize,
    /// Place of the column with its normal impulses in the last macro step (N s), `impulse_NAME`, if the model has it.
    pub impulse: Option<usize>,
    /// Place of the column with the number of impacts of its subsystem, `impacts`, if the model has it.
    pub impacts: Option<usize>,
}

fn force(marker: &str) -> String {
    format!("normal_{marker}")
}

fn impulse(marker: &str) -> String {
    format!("impulse_{marker}")
}

/// The outputs of `model` that tell of its contacts.
pub(crate) fn outputs(model: &v1::Model) -> Vec<String> {
    let has = |name: &String| model.outputs.iter().any(|output| output.name == *name);
    let markers = model.markers.iter().map(|marker| marker.name.as_str());
    let mut outputs: Vec<String> = markers
        .filter(|marker| has(&force(marker)))
        .flat_map(|marker| [force(marker), impulse(marker)])
        .collect();
    if !outputs.is_empty() {
        outputs.push(IMPACTS.to_owned());
    }
    outputs.retain(has);
    outputs
}

/// The marker at `place` as a contact, if the result `columns` say that it is one.
pub(super) fn of_marker(
    columns: &[String],
    subsystem: &str,
    place: usize,
    marker: &str,
) -> Option<RecordedContact> {
    let column = |output: &str| {
        let name = format!("{subsystem}.{output}");
        columns.iter().position(|column| *column == name)
    };
    Some(RecordedContact {
        marker: place,
        force: column(&force(marker))?,
        impulse: column(&impulse(marker)),
        impacts: column(IMPACTS),
    })
}
