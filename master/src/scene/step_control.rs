//! Reads the macro step of `[coupling]`, fixed or variable.

use super::resolved::StepControl;
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::formula::Steps;
use crate::reading::reader::{Field, POSITIVE, Problems, Range, Section};

/// The key that makes the macro step vary.
const TOLERANCE_KEY: &str = "tolerance";

/// Keys that only a variable macro step has.
pub(super) const KEYS: [&str; 3] = ["absolute_tolerance", "least_step", "greatest_step"];

const TOLERANCE: Range = Range {
    words: "from 1e-12, below which it is rounding, to 0.1",
    contains: |value| (1e-12..=0.1).contains(&value),
};

/// Absolute tolerance per relative one: a motion counts as at least 1e-3 m or rad in size.
const LEAST_SIZE: f64 = 1e-3;

/// First, shortest and longest macro step per simulated time.
const FIRST_SHARE: f64 = 1e-4;
const LEAST_SHARE: f64 = 1e-9;
const GREATEST_SHARE: f64 = 0.1;

/// The macro steps of a run.
pub(super) struct MacroSteps {
    /// The first one, or the only one, in s.
    pub(super) first: f64,
    /// Present if they vary.
    pub(super) control: Option<StepControl>,
}

impl MacroSteps {
    pub(super) fn range(&self) -> Steps {
        match self.control {
            Some(control) => Steps::Between(control.least_step, control.greatest_step),
            None => Steps::Fixed(self.first),
        }
    }
}

pub(super) fn read(
    section: &Section<'_>,
    duration: Option<f64>,
    problems: &mut Problems<'_>,
) -> Option<MacroSteps> {
    let Some(tolerance) = section.get(TOLERANCE_KEY) else {
        refuse_keys_of_variable_steps(section, problems);
        let first = section
            .require("macro_step", "macro_step = 1e-3", problems)
            .and_then(|field| read_step(&field, duration, problems))?;
        let control = None;
        return Some(MacroSteps { first, control });
    };
    let tolerance = tolerance.number(&TOLERANCE, problems);
    let absolute = given(section.get(KEYS[0]), |field| {
        field.number(&POSITIVE, problems)
    });
    let mut step = |key| {
        given(section.get(key), |field| {
            read_step(field, duration, problems)
        })
    };
    let (least, first, greatest) = (step(KEYS[1]), step("macro_step"), step(KEYS[2]));
    let (least, first, greatest) = (least?, first?, greatest?);
    check_order(
        section,
        ["least_step", "macro_step", "greatest_step"],
        [least, first, greatest],
        problems,
    )?;
    let duration = duration?;
    let shortest_given =
        |others: [Option<f64>; 2]| others.into_iter().flatten().fold(f64::INFINITY, f64::min);
    let longest_given = |others: [Option<f64>; 2]| others.into_iter().flatten().fold(0.0, f64::max);
    let least = least.unwrap_or((LEAST_SHARE * duration).min(shortest_given([first, greatest])));
    let greatest =
        greatest.unwrap_or((GREATEST_SHARE * duration).max(longest_given([first, Some(least)])));
    let tolerance = tolerance?;
    Some(MacroSteps {
        first: first.unwrap_or((FIRST_SHARE * duration).clamp(least, greatest)),
        control: Some(StepControl {
            tolerance,
            absolute_tolerance: absolute?.unwrap_or(LEAST_SIZE * tolerance),
            least_step: least,
            greatest_step: greatest,
        }),
    })
}

/// A macro step in s: greater than 0 and at most the simulated time.
pub(super) fn read_step(
    field: &Field<'_>,
    duration: Option<f64>,
    problems: &mut Problems<'_>,
) -> Option<f64> {
    let macro_step = field.number(&POSITIVE, problems)?;
    match duration {
        Some(duration) if macro_step > duration => {
            let kind = SceneErrorKind::StepTooLong {
                key: field.key.clone(),
                macro_step,
                duration,
            };
            field.report(kind, problems);
            None
        }
        _ => Some(macro_step),
    }
}

/// Absent is `Some(None)`; `None` is a mistake that has been reported.
fn given<'w>(
    field: Option<Field<'w>>,
    read: impl FnOnce(&Field<'w>) -> Option<f64>,
) -> Option<Option<f64>> {
    match field {
        Some(field) => read(&field).map(Some),
        None => Some(None),
    }
}

fn refuse_keys_of_variable_steps(section: &Section<'_>, problems: &mut Problems<'_>) {
    for field in KEYS.into_iter().filter_map(|key| section.get(key)) {
        let kind = SceneErrorKind::OnlyWithTolerance {
            key: field.key.clone(),
        };
        field.report(kind, problems);
    }
}

/// Of the steps that are given, none is longer than one behind it.
fn check_order(
    section: &Section<'_>,
    keys: [&'static str; 3],
    steps: [Option<f64>; 3],
    problems: &mut Problems<'_>,
) -> Option<()> {
    let given: Vec<(&str, f64)> = keys
        .into_iter()
        .zip(steps)
        .filter_map(|(key, step)| Some((key, step?)))
        .collect();
    let wrong = given.windows(2).find(|pair| pair[0].1 > pair[1].1);
    let Some([(shorter, least), (longer, most)]) =
        wrong.and_then(|pair| <[_; 2]>::try_from(pair).ok())
    else {
        return Some(());
    };
    section.get(longer)?.report(
        SceneErrorKind::StepsOutOfOrder {
            shorter: section.key_of(shorter),
            least,
            longer: section.key_of(longer),
            most,
        },
        problems,
    );
    None
}
