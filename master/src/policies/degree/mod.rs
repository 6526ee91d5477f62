//! Degrees of the polynomials that follow the estimates: one for all multipliers, one for all exchanged variables.

mod anew;
mod choice;

use serde::{Deserialize, Serialize};
use std::ops::Range;

use crate::layout::Layout;
use crate::results::StepDegrees;
use crate::time::MOST_GROWTH;

pub use anew::{Anew, Cost, Nested, Outlook};
use choice::DegreeChoice;
pub(crate) use choice::SETTINGS;
pub use choice::{Prospect, Prospects, Purpose, Settings};

/// Variables whose polynomials have one degree.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Group {
    variables: Range<usize>,
    kind: Kind,
    /// The highest degree that all workers take.
    highest: usize,
    choice: DegreeChoice,
    /// What follows if the step is taken.
    next: DegreeChoice,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
enum Kind {
    /// Their degree is limited by the stability of the method.
    Multipliers,
    Exchanged,
}

/// The groups whose degrees follow the estimates.
pub struct AutomaticDegrees {
    /// The highest degree of the multipliers' polynomials that is stable with a step of this length (s).
    stable: Box<dyn Fn(f64) -> usize + Send>,
    /// Degrees of all steps, in place of a choice.
    given: Option<Vec<StepDegrees>>,
    state: State,
}

/// The degrees so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    groups: Vec<Group>,
    steps_done: usize,
}

impl Group {
    /// Whether they are the multipliers.
    pub fn are_multipliers(&self) -> bool {
        self.kind == Kind::Multipliers
    }

    /// The present degree.
    pub fn degree(&self) -> usize {
        self.choice.degree()
    }

    /// The first of them.
    pub fn first(&self) -> usize {
        self.variables.start
    }

    fn begin(&mut self, choice: DegreeChoice) {
        (self.choice, self.next) = (choice, choice);
    }

    fn highest(&self, stable: &dyn Fn(f64) -> usize, length: f64) -> usize {
        match self.kind {
            Kind::Multipliers => self.highest.min(stable(length)),
            Kind::Exchanged => self.highest,
        }
    }

    fn of_step(&self, degrees: StepDegrees) -> Option<usize> {
        match self.kind {
            Kind::Multipliers => degrees.multipliers,
            Kind::Exchanged => degrees.exchanged,
        }
    }
}

impl AutomaticDegrees {
    /// For the variables of `layout` for which `highest` tells the highest degree that all workers take; `None` if there are none.
    /// Multipliers begin with the degree `first` if there is one, otherwise with the highest. The first step has this length in s; `given`
    /// has the degrees of all steps if they are known.
    pub fn new(
        stable: Box<dyn Fn(f64) -> usize + Send>,
        layout: &Layout,
        highest: StepDegrees,
        first: Option<usize>,
        first_step: f64,
        given: Option<Vec<StepDegrees>>,
    ) -> Option<Self> {
        let rows = layout.rows.len();
        let group = |variables: Range<usize>, kind, highest: Option<usize>| {
            let mut group = Group {
                kind,
                highest: highest.filter(|_| !variables.is_empty())?,
                variables,
                choice: DegreeChoice::new(0),
                next: DegreeChoice::new(0),
            };
            let highest = group.highest(&stable, first_step);
            let first = first.filter(|_| group.are_multipliers());
            let degree = first.map_or(highest, |first| first.min(highest));
            group.begin(DegreeChoice::new(degree));
            Some(group)
        };
        let groups: Vec<Group> = [
            group(0..rows, Kind::Multipliers, highest.multipliers),
            group(rows..layout.variables(), Kind::Exchanged, highest.exchanged),
        ]
        .into_iter()
        .flatten()
        .collect();
        let mut own = Self {
            stable,
            given,
            state: State {
                groups,
                steps_done: 0,
            },
        };
        own.take_given();
        (!own.state.groups.is_empty()).then_some(own)
    }

    /// Chooses the degrees that follow a step of this length, from the outlook of a group; those of multipliers and of exchanged variables,
    /// as far as they change and are known to be better. The step-size control would take a step with some error so many times as long
    /// as `growth` tells.
    pub fn choose(
        &mut self,
        mut outlook: impl FnMut(&Group) -> Outlook,
        growth: impl Fn(Prospect) -> f64,
        length: f64,
        purpose: Purpose,
    ) -> [Option<usize>; 2] {
        let mut changed = [None, None];
        if self.given.is_some() {
            return changed;
        }
        let longest = match purpose {
            Purpose::LongestStep => MOST_GROWTH * length,
            Purpose::Repetition | Purpose::SmallestError => length,
        };
        for group in &mut self.state.groups {
            let outlook = outlook(group);
            let highest = group.highest(&self.stable, longest);
            group.next = group.choice;
            let is_known = match outlook {
                Outlook::Past(prospects) => {
                    group.next.follow(&prospects, highest, purpose);
                    group.next.degree() < prospects.smooth_points
                }
                Outlook::Anew(anew) => {
                    group.next.take(anew.choose(highest, purpose, &growth));
                    true
                }
            };
            let next = group.next.degree();
            if next == group.degree() {
                continue;
            }
            let [error, error_lower, error_higher] = outlook.errors();
            tracing::debug!(
                of = ?group.kind,
                from = group.degree(),
                to = next,
                highest,
                error,
                error_lower,
                error_higher,
                "degree changes"
            );
            if is_known {
                changed[group.kind as usize] = Some(next);
            }
        }
        changed
    }

    /// What is remembered, to be written.
    pub fn state(&self) -> State {
        self.state.clone()
    }

    /// Goes on from what was written.
    pub fn resume(&mut self, state: State) {
        self.state = state;
    }

    /// The variables of each group and the degree of their polynomials.
    pub fn present(&self) -> impl Iterator<Item = (Range<usize>, usize)> {
        let groups = self.state.groups.iter();
        groups.map(|group| (group.variables.clone(), group.degree()))
    }

    /// The multipliers jump in the present step.
    pub fn restart(&mut self) {
        let multipliers = self
            .state
            .groups
            .iter_mut()
            .filter(|group| group.are_multipliers());
        multipliers.for_each(|group| group.begin(DegreeChoice::after_jump()));
    }

    /// The step is repeated with the degrees that were chosen for it.
    pub fn repeat(&mut self) {
        self.take_next();
    }

    fn take_next(&mut self) {
        for group in &mut self.state.groups {
            group.choice = group.next;
        }
    }

    /// The step is taken; the next one gets the degrees that were chosen.
    pub fn accept(&mut self) {
        self.state.steps_done += 1;
        self.take_next();
        self.take_given();
    }

    fn take_given(&mut self) {
        let Some(given) = &self.given else { return };
        let Some(&degrees) = given.get(self.state.steps_done) else {
            return;
        };
        for group in &mut self.state.groups {
            if let Some(degree) = group.of_step(degrees) {
                group.begin(DegreeChoice::new(degree));
            }
        }
    }

    /// The degrees over the step that was taken last, where `over` tells that of a variable; 0 before the first one.
    pub fn of_last_step(&self, over: impl Fn(usize) -> usize) -> StepDegrees {
        let mut degrees = StepDegrees::default();
        for group in &self.state.groups {
            let degree = match self.state.steps_done {
                0 => 0,
                _ => over(group.variables.start),
            };
            match group.kind {
                Kind::Multipliers => degrees.multipliers = Some(degree),
                Kind::Exchanged => degrees.exchanged = Some(degree),
            }
        }
        degrees
    }
}
