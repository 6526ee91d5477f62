//! Reads `[output]`: what is recorded and drawn.

use super::resolved::{Output, Over, Panel};
use super::step_control::read_equal_step;
use crate::reading::key::{Key, POSITIVE, Takes};
use crate::reading::names::{Registry, report_repeated};
use crate::reading::reader::{Field, Problems, Section, collect, given};
use crate::reading::reference::read_variable;

pub(super) const KEYS: [Key; 4] = [
    Key::new("every", Takes::Whole(1, usize::MAX))
        .default_number(1.0)
        .means(
            "rows every so many macro steps, or samples; the first and the last are always \
             there",
        ),
    Key::new("interval", Takes::Number(POSITIVE))
        .default("rows at macro points")
        .means(
            "rows at t_start + n `interval` (s), at most 1e9 of them, whatever the macro steps are, and at t_end. \
             Each is a shorter integration of every subsystem with the inputs of its macro \
             step, so the steps stay as they are, bit by bit; multipliers are read from their \
             curves, with penalty from the springs, and with explicit are those that are held",
        ),
    Key::new(
        "variables",
        Takes::List(&Takes::Text, "a list of outputs such as [\"mass1.v\"]"),
    )
    .default("none")
    .means("outputs as `\"SUBSYSTEM.OUTPUT\"` beyond those that the coupling needs"),
    Key::new("panel", Takes::Tables(|| PANEL.to_vec()))
        .default("motion, residuals, multipliers; without joints all outputs")
        .means("what the picture of a run shows: `[[output.panel]]`, see below"),
];
const PANEL: [Key; 4] = [
    Key::new("label", Takes::Text)
        .required("label = \"angle in rad\"")
        .means("label of the y axis, with the unit"),
    Key::new(
        "columns",
        Takes::List(
            &Takes::Text,
            "a list of result columns such as [\"link.lambda\", \"a.energy + b.energy\"]",
        ),
    )
    .required("columns = [\"link1.angle\"]")
    .means(
        "the curves: result columns, or sums of them such as `\"link1.energy + \
         link2.energy\"`",
    ),
    OVER,
    Key::new("over_label", Takes::Text)
        .default("`over`")
        .means("label of the x axis, with the unit; only with `over`"),
];
const OVER: Key = Key::new("over", Takes::Text)
    .required("over = \"link1.angle\"")
    .default("time")
    .means("what the curves are shown over: a result column, or a sum of them");

pub(super) fn read(
    field: Option<Field<'_>>,
    subsystems: &Registry<'_>,
    duration: Option<f64>,
    problems: &mut Problems<'_>,
) -> Option<Output> {
    let [every, interval, variables, panels] = match field {
        Some(field) => field.section(problems)?.read(&KEYS, problems),
        None => [const { None }; 4],
    };
    let every = every.map_or(Some(1), |field| field.whole(problems));
    let interval = given(interval, |field| read_equal_step(field, duration, problems));
    let variables = given(variables, |field| {
        let items = field.items(problems)?;
        report_repeated(&items, "recorded output", problems);
        collect(&items, |item| {
            read_variable(item, "SUBSYSTEM.OUTPUT", subsystems, problems)?;
            item.text(problems).map(str::to_owned)
        })
    });
    let panels = given(panels, |field| {
        collect(&field.items(problems)?, |item| read_panel(item, problems))
    });
    Some(Output {
        every: every?,
        interval: interval?,
        variables: variables?,
        panels: panels?.unwrap_or_default(),
    })
}

fn read_panel(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Panel> {
    let section = field.section(problems)?;
    let [label, columns, over, over_label] = section.read(&PANEL, problems);
    let label = label.and_then(|field| field.text(problems));
    let columns = columns.and_then(|field| field.texts(problems));
    let curves = columns.and_then(|fields| collect(&fields, |field| read_sum(field, problems)));
    let over = read_over(&section, over, over_label, problems);
    Some(Panel {
        label: label?.to_owned(),
        curves: curves?,
        over: over?,
    })
}

/// The outer option is that of a mistake.
fn read_over(
    section: &Section<'_>,
    over: Option<Field<'_>>,
    label: Option<Field<'_>>,
    problems: &mut Problems<'_>,
) -> Option<Option<Over>> {
    let label = given(label, |field| field.text(problems))?;
    let column = match label {
        Some(_) => Some(section.require(&OVER, problems)?),
        None => over,
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
