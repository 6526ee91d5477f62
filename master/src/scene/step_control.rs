//! Reads the macro step of `[coupling]`, fixed or variable.

use super::resolved::StepControl;
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::formula::Steps;
use crate::reading::key::{FINITE, Key, POSITIVE, Range, Takes};
use crate::reading::reader::{Field, Problems, Section, given};

pub(super) const MACRO_STEP: Key = Key::new("macro_step", Takes::Number(POSITIVE))
    .required("macro_step = 1e-3")
    .default("required without `tolerance`")
    .means(
        "H, s; at most t_end - t_start, and not below 1e-9 of it. With `tolerance` the first step, by default 1e-4 \
         (t_end - t_start). Larger: fewer exchanges, larger errors; much smaller: \
         differences drown in rounding for index 3",
    );
/// The key that makes the macro step vary.
pub(super) const TOLERANCE: Key = Key::new(
    "tolerance",
    Takes::Number(Range {
        words: "from 1e-12, below which it is rounding, to 0.1",
        least: 1e-12,
        most: 0.1,
        ..FINITE
    }),
)
.default("fixed steps")
.means(
    "lets the macro step follow the error: error of positions relative to their size; \
     see [step control](../theory/step-control.md)",
);
/// Keys that only a variable macro step has.
pub(super) const VARIABLE: [Key; 3] = [
    Key::new("absolute_tolerance", Takes::Number(POSITIVE))
        .default("1e-3 `tolerance` times the size of the mechanism for lengths, 1e-3 `tolerance` for all else")
        .means(
            "with `tolerance`: error in m or rad that is allowed whatever the size; the size of a mechanism is its \
             largest position or arm at the start, 1 m if it has none",
        ),
    Key::new("least_step", Takes::Number(POSITIVE))
        .default("1e-9 (t_end - t_start)")
        .means(
            "with `tolerance`: shortest macro step, s; at most `macro_step`. A run that needs a \
             shorter one stops",
        ),
    Key::new("greatest_step", Takes::Number(POSITIVE))
        .default("(t_end - t_start)/10, or `macro_step` or `least_step` if that is more")
        .means("with `tolerance`: longest macro step, s; at least `macro_step`"),
];

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
    let [absolute, least, greatest] = section.fields(&VARIABLE, problems);
    let Some(tolerance) = section.get(&TOLERANCE) else {
        for field in [absolute, least, greatest].into_iter().flatten() {
            let key = field.key.clone();
            field.report(SceneErrorKind::OnlyWithTolerance { key }, problems);
        }
        let first = section
            .require(&MACRO_STEP, problems)
            .and_then(|field| read_equal_step(&field, duration, problems))?;
        let control = None;
        return Some(MacroSteps { first, control });
    };
    let tolerance = tolerance.number(problems);
    let absolute = given(absolute, |field| field.number(problems));
    let fields = [least, section.get(&MACRO_STEP), greatest];
    let steps =
        { fields.clone() }.map(|field| given(field, |field| read_step(field, duration, problems)));
    let [least, first, greatest] = steps;
    let (least, first, greatest) = (least?, first?, greatest?);
    check_order(fields, [least, first, greatest], problems)?;
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
            absolute_tolerance: absolute?,
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
    let macro_step = field.number(problems)?;
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

/// Most equal steps of a run, and most samples. More would take weeks and fill every disk, so that a unit is mistaken.
const MOST_STEPS: f64 = 1e9;

/// A step in s of which the whole simulated time consists: as [`read_step`], and not more than [`MOST_STEPS`] of them.
pub(super) fn read_equal_step(
    field: &Field<'_>,
    duration: Option<f64>,
    problems: &mut Problems<'_>,
) -> Option<f64> {
    let step = read_step(field, duration, problems)?;
    let steps = duration.map_or(0.0, |duration| (duration / step).round());
    if steps <= MOST_STEPS {
        return Some(step);
    }
    let kind = SceneErrorKind::TooManySteps {
        key: field.key.clone(),
        step,
        steps,
        most: MOST_STEPS,
        least: duration.unwrap_or_default() / MOST_STEPS,
    };
    field.report(kind, problems);
    None
}

/// Of the steps that are given, none is longer than one behind it.
fn check_order(
    fields: [Option<Field<'_>>; 3],
    steps: [Option<f64>; 3],
    problems: &mut Problems<'_>,
) -> Option<()> {
    let fields = fields.into_iter().flatten();
    let given: Vec<(Field<'_>, f64)> = fields.zip(steps.into_iter().flatten()).collect();
    let wrong = given.windows(2).find(|pair| pair[0].1 > pair[1].1);
    let Some([(shorter, least), (longer, most)]) = wrong else {
        return Some(());
    };
    let kind = SceneErrorKind::StepsOutOfOrder {
        shorter: shorter.key.clone(),
        least: *least,
        longer: longer.key.clone(),
        most: *most,
    };
    longer.report(kind, problems);
    None
}
