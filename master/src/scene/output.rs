//! Reads `[output]`: what is recorded and drawn.

use super::resolved::{Output, Over, Panel};
use super::step_control::read_step;
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::lists::collect;
use crate::reading::names::Registry;
use crate::reading::reader::{Field, Problems, Section};
use crate::reading::reference::read_variable;

const VARIABLES: &str = "a list of outputs such as [\"mass1.v\"]";
const COLUMNS: &str = "a list of result columns such as [\"link.lambda\", \"a.energy + b.energy\"]";

pub(super) fn read(
    root: &Section<'_>,
    subsystems: &Registry<'_>,
    duration: Option<f64>,
    problems: &mut Problems<'_>,
) -> Option<Output> {
    let Some(field) = root.get("output") else {
        return Some(Output {
            every: 1,
            interval: None,
            variables: None,
            panels: Vec::new(),
        });
    };
    let section = field.section(problems)?;
    section.allow_only(&["every", "interval", "variables", "panel"], problems);
    let every = section
        .get("every")
        .map_or(Some(1), |field| field.whole(1, usize::MAX, problems));
    let interval = match section.get("interval") {
        Some(field) => read_step(&field, duration, problems).map(Some),
        None => Some(None),
    };
    let variables = match section.get("variables") {
        Some(field) => field
            .items(VARIABLES, problems)
            .and_then(|items| {
                check_repeated(&items, problems);
                collect(&items, |item| {
                    read_variable(item, "SUBSYSTEM.OUTPUT", subsystems, problems)?;
                    item.text(problems).map(str::to_owned)
                })
            })
            .map(Some),
        None => Some(None),
    };
    let panels = match section.get("panel") {
        Some(field) => field
            .items("tables headed [[output.panel]]", problems)
            .and_then(|items| collect(&items, |item| read_panel(item, problems))),
        None => Some(Vec::new()),
    };
    Some(Output {
        every: every?,
        interval: interval?,
        variables: variables?,
        panels: panels?,
    })
}

fn read_panel(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Panel> {
    let section = field.section(problems)?;
    section.allow_only(&["label", "columns", "over", "over_label"], problems);
    let label = section
        .require("label", "label = \"angle in rad\"", problems)
        .and_then(|field| field.text(problems));
    let columns = section
        .require("columns", "columns = [\"link1.angle\"]", problems)
        .and_then(|field| field.texts(COLUMNS, problems));
    let curves = columns.and_then(|fields| collect(&fields, |field| read_sum(field, problems)));
    let over = read_over(&section, problems);
    Some(Panel {
        label: label?.to_owned(),
        curves: curves?,
        over: over?,
    })
}

/// The outer option is that of a mistake.
fn read_over(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Option<Over>> {
    let label = match section.get("over_label") {
        Some(field) => Some(field.text(problems)?),
        None => None,
    };
    let column = match label {
        Some(_) => Some(section.require("over", "over = \"link1.angle\"", problems)?),
        None => section.get("over"),
    };
    let Some(column) = column else {
        return Some(None);
    };
    let column = read_sum(&column, problems)?;
    let label = label.map_or_else(|| column.join(" + "), str::to_owned);
    Some(Some(Over { column, label }))
}

fn read_sum(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Vec<String>> {
    let terms = field.text(problems)?.split('+');
    Some(terms.map(|term| term.trim().to_owned()).collect())
}

fn check_repeated(items: &[Field<'_>], problems: &mut Problems<'_>) {
    for (i, item) in items.iter().enumerate() {
        let earlier = items[..i].iter().find(|earlier| {
            earlier.peek_text().is_some() && earlier.peek_text() == item.peek_text()
        });
        if let (Some(earlier), Some(name)) = (earlier, item.peek_text()) {
            let kind = SceneErrorKind::DuplicateName {
                key: item.key.clone(),
                name: name.to_owned(),
                taken_by: "recorded output",
                line: problems
                    .written
                    .place(&earlier.node.spot)
                    .map(|place| place.line),
            };
            item.report(kind, problems);
        }
    }
}
