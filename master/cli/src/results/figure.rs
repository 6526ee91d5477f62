//! The picture of a run: the panels that its scene asks for, or one for every quantity and unit; impacts and repeated steps.

use std::path::{Path, PathBuf};

use super::panels::Shown;
use super::{ChosenBy, Impacts, Recording, Rejections, Trace};
use crate::commands::CommandError;
use crate::plot::{
    Block, Chart, Curve, Format, MOST_CURVES, MarkKind, Portrait, QuantityPanels, Scale, TimeMarks,
    TimePanel, TimePanels,
};

/// Most panels of one quantity; more curves are left out with a word.
const MOST_PANELS: usize = 4;

/// Label of the time axis.
const TIME: &str = "t in s";

/// Where a picture goes.
pub struct Target<'a> {
    /// Path without the ending.
    pub stem: &'a Path,
    /// What is written.
    pub formats: &'a [Format],
}

/// Draws the runs of a scene's cases together, or its only run; `title` stands above it. The files that were written; none for runs
/// that show nothing, as those of a scene that couples and records nothing.
///
/// # Errors
/// [`CommandError::Plot`]
pub fn draw(
    title: &str,
    recordings: &[Recording],
    target: &Target<'_>,
) -> Result<Vec<PathBuf>, CommandError> {
    let by = recordings.first().map(|own| own.chosen_by);
    let title = titled(title, recordings);
    let written = if by == Some(ChosenBy::Scene) {
        let picture = of_scene(&title, recordings);
        picture.map(|picture| picture.write_as(target.stem, target.formats))
    } else {
        let picture = of_quantities(&title, recordings);
        picture.map(|picture| picture.write_as(target.stem, target.formats))
    };
    Ok(written.transpose()?.unwrap_or_default())
}

/// The title, with what ended a run early.
fn titled(title: &str, recordings: &[Recording]) -> String {
    let ended = recordings.iter().find_map(|own| own.reason.as_deref());
    let ended = ended.and_then(|reason| reason.lines().next());
    ended.map_or_else(|| title.to_owned(), |reason| format!("{title}: {reason}"))
}

/// The panels of the scene, over the time and over other quantities.
fn of_scene(title: &str, recordings: &[Recording]) -> Option<TimePanels> {
    let mut picture = TimePanels {
        title: Some(title.to_owned()),
        time_label: TIME.into(),
        marks: marks(recordings),
        ..TimePanels::default()
    };
    let shown = recordings.first().map_or(&[][..], |own| &own.shown);
    for (number, own) in shown.iter().enumerate() {
        let curves = curves(recordings, |_| Some(number), own);
        if curves.is_empty() {
            continue;
        }
        let y_label = own.label.clone();
        match &own.over {
            None => picture.panels.push(TimePanel {
                y_label,
                y_scale: own.scale,
                series: curves,
            }),
            Some(over) => picture.portraits.push(Portrait {
                x_label: over.clone(),
                y_label,
                paths: curves,
            }),
        }
    }
    let has_panels = !(picture.panels.is_empty() && picture.portraits.is_empty());
    has_panels.then_some(picture)
}

/// A block for every quantity and unit that one of the runs has.
fn of_quantities(title: &str, recordings: &[Recording]) -> Option<QuantityPanels> {
    let mut labels: Vec<&Shown> = Vec::new();
    for own in recordings.iter().flat_map(|own| &own.shown) {
        if !labels.iter().any(|known| known.label == own.label) {
            labels.push(own);
        }
    }
    let of_label = |own: &&Shown| {
        let place = |recording: &Recording| {
            let shown = &recording.shown;
            shown.iter().position(|other| other.label == own.label)
        };
        let curves = curves(recordings, place, own);
        (!curves.is_empty()).then(|| block(own, curves))
    };
    let blocks: Vec<Block> = labels.iter().filter_map(of_label).collect();
    (!blocks.is_empty()).then(|| QuantityPanels {
        title: title.to_owned(),
        time_label: TIME.into(),
        blocks,
        marks: marks(recordings),
    })
}

/// The panels of a quantity: of very many curves the first ones.
fn block(shown: &Shown, mut curves: Vec<Curve>) -> Block {
    let all = curves.len();
    curves.truncate(MOST_PANELS * MOST_CURVES);
    let drawn = curves.len();
    let mut block = Block::new(shown.label.clone(), shown.scale, curves);
    if drawn < all {
        block.note = Some(format!(
            "{drawn} of {all} curves of {}; linchpin plot --columns draws others",
            shown.label
        ));
    }
    block
}

fn marks(recordings: &[Recording]) -> Vec<TimeMarks> {
    let impacts = recordings.iter().map(|own| &own.impacts);
    let rejections = recordings.iter().map(|own| &own.rejections);
    vec![
        TimeMarks {
            kind: MarkKind::Impact,
            t: impacts.flat_map(Impacts::times).collect(),
        },
        TimeMarks {
            kind: MarkKind::Rejection,
            t: rejections.flat_map(Rejections::times).collect(),
        },
    ]
}

/// The curves of one panel; `place` is its number in a recording.
fn curves(
    recordings: &[Recording],
    place: impl Fn(&Recording) -> Option<usize>,
    shown: &Shown,
) -> Vec<Curve> {
    let mut curves = Vec::new();
    for recording in recordings {
        let panel = place(recording);
        let chosen = recording.traces.iter();
        let chosen = chosen.filter(|trace| Some(trace.panel) == panel);
        // Several cases: one curve of each, so that the picture stays readable, unless somebody chose the curves.
        let is_usual = recording.chosen_by == ChosenBy::Nobody && recordings.len() > 1;
        let most = if is_usual { 1 } else { usize::MAX };
        curves.extend(chosen.take(most).map(|trace| Curve {
            name: name(recording, trace, shown),
            points: points(recording, trace, shown),
        }));
    }
    curves
}

/// Name of a curve: with cases that of its case too, or alone if the panel has one curve of each.
fn name(recording: &Recording, trace: &Trace, shown: &Shown) -> String {
    match &recording.case {
        None => trace.name.clone(),
        Some(case) if shown.curves == 1 && recording.chosen_by == ChosenBy::Scene => case.clone(),
        Some(case) => format!("{}: {case}", trace.name),
    }
}

/// Points of a curve; multipliers that are means over their step are shown in its middle.
fn points(recording: &Recording, trace: &Trace, shown: &Shown) -> Vec<(f64, f64)> {
    let points = trace.points.items().iter();
    let delay = match (&shown.over, trace.shows_multipliers) {
        (None, true) => recording.multiplier_delay,
        _ => {
            return points
                .copied()
                .filter(|point| is_shown(shown, point))
                .collect();
        }
    };
    let delayed = |(t, y): &(f64, f64)| ((t - delay).max(recording.t_start), *y);
    points.map(delayed).collect()
}

/// The start has no macro step and no error, which a logarithmic axis would show as a gap.
fn is_shown(shown: &Shown, (_, y): &(f64, f64)) -> bool {
    shown.scale == Scale::Linear || *y != 0.0
}
