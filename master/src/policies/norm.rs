//! Sizes of changes of coupling variables that have unlike units.

use serde::{Deserialize, Serialize};
use std::ops::Range;

use crate::accuracy::{Change, MOST_LEFT};
use crate::layout::Layout;

/// How changes are compared. A scene does not change these numbers; run.json shows them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Settings {
    /// Where new columns leave more than this share of a change, the change is noise. Smaller takes what columns miss for noise and stops
    /// passes that would help; larger corrects noise.
    pub noise: f64,
    /// Noise may be so many times as much another time.
    pub scatter: f64,
    /// Share of its weight that a change keeps from one macro step to the next. At 1 the largest change of the whole run counts, at 0
    /// only the last one, which may pass through zero.
    pub memory: f64,
    /// Share that noise keeps from step to step. At 1 one noisy step hides all later ones.
    pub fading: f64,
    /// Changes below this share of the variables themselves are rounding.
    pub rounding: f64,
}

/// Those of every run.
pub(crate) const SETTINGS: Settings = Settings {
    noise: 0.03,
    scatter: 3.0,
    memory: 0.9,
    fading: 0.99,
    rounding: 1e-12,
};

/// Compares a change of the coupling variables with the changes that the last macro steps made.
///
/// The variables are taken in groups of one unit: the forces of a joint, its moments, every exchanged output, every
/// attitude. The norm is the largest of the Euclidean norms of the groups, each relative to the size of that group's
/// changes in the last macro steps; so no unit and no scale of a joint counts more than another. Changes that are
/// noise, as those of forces that are next to nothing, count as [`MOST_LEFT`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Norm {
    groups: Vec<Group>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Group {
    variables: Range<usize>,
    /// Largest change of the last macro steps, older ones counting less.
    usual: f64,
    /// The same before the present step.
    past: f64,
    /// Share of a usual change that is the noise of the solvers, if that is most of it.
    noise: f64,
}

impl Norm {
    /// For the coupling variables of `layout`.
    pub fn new(layout: &Layout) -> Self {
        let mut starts: Vec<usize> = Vec::new();
        let mut last = None;
        for (number, row) in layout.rows.iter().enumerate() {
            let joint = &layout.joints[row.joint].joint;
            let unit = (row.joint, joint.condition(row.condition).is_length());
            if last != Some(unit) {
                starts.push(number);
            }
            last = Some(unit);
        }
        starts.extend(layout.exchanged.iter().map(|exchanged| exchanged.first));
        let ends = starts.iter().copied().skip(1).chain([layout.variables()]);
        let group = |(start, end): (&usize, usize)| Group {
            variables: *start..end,
            usual: 0.0,
            past: 0.0,
            noise: 0.0,
        };
        Self {
            groups: starts.iter().zip(ends).map(group).collect(),
        }
    }

    /// Takes note of the change that a macro step makes; the last attempt at the step counts.
    pub fn note(&mut self, change: &[f64]) {
        for group in &mut self.groups {
            let size = norm(&change[group.variables.clone()]);
            group.usual = size.max(SETTINGS.memory * group.past);
        }
    }

    /// Takes note of what a correction with new columns has left.
    pub fn note_left(&mut self, left: &[f64]) {
        for group in &mut self.groups {
            let share = norm(&left[group.variables.clone()]) / group.usual;
            if share > SETTINGS.noise {
                group.noise = SETTINGS.scatter * share;
            }
        }
    }

    /// What changed in the last step is not what changes usually.
    pub fn forget(&mut self) {
        for group in &mut self.groups {
            group.past = 0.0;
        }
    }

    /// The macro step is taken.
    pub fn move_on(&mut self) {
        for group in &mut self.groups {
            group.past = group.usual;
            group.noise *= SETTINGS.fading;
        }
    }

    /// Size of `change`, of variables that are now `values`.
    pub fn of(&self, change: &[f64], values: &[f64]) -> Change {
        let mut largest = Change::default();
        for group in &self.groups {
            let [size, value] = [change, values].map(|all| norm(&all[group.variables.clone()]));
            if size <= SETTINGS.rounding * value {
                continue;
            }
            let usual = group.usual * (group.noise / MOST_LEFT).max(1.0);
            largest.of_usual = largest
                .of_usual
                .max(size / usual.max(SETTINGS.rounding * value));
            let of_size = size / value.max(group.usual);
            if of_size > largest.of_size {
                largest.of_size = of_size;
                largest.variable = group.variables.start;
            }
        }
        largest
    }
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}
