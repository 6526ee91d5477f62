//! Reads `[run]`: how a run treats its workers, and what it does against their loss and its own.

use super::resolved::RunSettings;
use crate::reading::key::{FINITE, Key, Range, Takes};
use crate::reading::reader::{Field, Problems, given};

pub(super) const KEYS: [Key; 7] = [
    Key::new("deadline", Takes::Number(TIME_LIMIT))
        .default_number(DEADLINE)
        .means("longest time for one answer of a worker, s"),
    Key::new("start_timeout", Takes::Number(TIME_LIMIT))
        .default_number(START_TIMEOUT)
        .means("longest time for a worker to start or to be reached, s"),
    Key::new("recoveries", Takes::Whole(0, MOST_RECOVERIES))
        .default_number(RECOVERIES as f64)
        .means(
            "how often a worker that is lost in an exchange is started or reached anew, before that ends the run; 0: its loss \
             ends the run",
        ),
    Key::new("export_every", Takes::Whole(1, usize::MAX))
        .default_number(EXPORT_EVERY as f64)
        .means(
            "macro steps after which the state of a worker is exported, if it can be: a worker that takes its place repeats \
             that many at most, and all from `t_start` on where it cannot be",
        ),
    Key::new("checkpoint_every", Takes::Number(PAUSE))
        .default_number(CHECKPOINT_EVERY)
        .means(
            "time between two checkpoints, from which `linchpin run --resume` goes on, s; 0: after every macro step",
        ),
    Key::new("checkpoint_steps", Takes::Whole(1, usize::MAX))
        .default("none")
        .means("macro steps between two checkpoints, whatever time that takes, in place of `checkpoint_every`"),
    Key::new("most_poor", Takes::Number(SHARE))
        .default_number(MOST_POOR)
        .means(
            "share of the macro steps that may be poor: `linchpin run` ends with exit code 1 where it is more, behind its \
             results; 1: never",
        ),
];
const DEADLINE: f64 = 30.0;
const START_TIMEOUT: f64 = 10.0;
const RECOVERIES: usize = 3;
const MOST_RECOVERIES: usize = 1000;
/// An export is a call of its own, which takes as long as some macro steps of the smallest scenes: so it costs a percent of them.
const EXPORT_EVERY: usize = 1000;
const CHECKPOINT_EVERY: f64 = 30.0;
/// Where most steps miss their aim the results are those of another mechanism.
const MOST_POOR: f64 = 0.5;
const SHARE: Range = Range {
    words: "from 0 to 1",
    least: 0.0,
    most: 1.0,
    ..FINITE
};
/// Longer than any sensible wait, and short enough for every clock.
const TIME_LIMIT: Range = Range {
    words: "greater than 0 s and at most 1e6 s",
    above: 0.0,
    most: 1e6,
    ..FINITE
};
const PAUSE: Range = Range {
    words: "from 0 s to 1e6 s",
    least: 0.0,
    most: 1e6,
    ..FINITE
};

impl std::default::Default for RunSettings {
    fn default() -> Self {
        Self {
            deadline: DEADLINE,
            start_timeout: START_TIMEOUT,
            recoveries: RECOVERIES,
            export_every: EXPORT_EVERY,
            checkpoint_every: CHECKPOINT_EVERY,
            checkpoint_steps: None,
            most_poor: MOST_POOR,
        }
    }
}

pub(super) fn read(field: Option<Field<'_>>, problems: &mut Problems<'_>) -> Option<RunSettings> {
    let [
        deadline,
        start_timeout,
        recoveries,
        export_every,
        checkpoint_every,
        checkpoint_steps,
        most_poor,
    ] = match field {
        Some(field) => field.section(problems)?.read(&KEYS, problems),
        None => [const { None }; 7],
    };
    let mut number = |field: Option<Field<'_>>, default| {
        field.map_or(Some(default), |field| field.number(problems))
    };
    let default = RunSettings::default();
    let deadline = number(deadline, default.deadline);
    let start_timeout = number(start_timeout, default.start_timeout);
    let checkpoint_every = number(checkpoint_every, default.checkpoint_every);
    let most_poor = number(most_poor, default.most_poor);
    let mut whole = |field: Option<Field<'_>>, default| {
        field.map_or(Some(default), |field| field.whole(problems))
    };
    let recoveries = whole(recoveries, default.recoveries);
    let export_every = whole(export_every, default.export_every);
    let checkpoint_steps = given(checkpoint_steps, |field| field.whole(problems));
    Some(RunSettings {
        deadline: deadline?,
        start_timeout: start_timeout?,
        recoveries: recoveries?,
        export_every: export_every?,
        checkpoint_every: checkpoint_every?,
        checkpoint_steps: checkpoint_steps?,
        most_poor: most_poor?,
    })
}
