//! Degrees of the polynomials that follow the estimates: one for all multipliers, one for all exchanged variables.

use std::ops::Range;

use super::degree_choice::{DegreeChoice, MOST_GROWTH, Prospect, Prospects, Purpose};
use crate::layout::Layout;
use crate::results::StepDegrees;
use crate::scene::{Method, highest_stable_degree};
use crate::signal::History;

/// Variables whose polynomials have one degree.
#[derive(Debug, Clone)]
pub struct Group {
    variables: Range<usize>,
    kind: Kind,
    /// The highest degree that all workers take.
    highest: usize,
    choice: DegreeChoice,
    /// What follows if the step is taken.
    next: DegreeChoice,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Their degree is limited by the stability of the method.
    Multipliers,
    Exchanged,
}

/// The groups whose degrees follow the estimates.
#[derive(Debug, Clone)]
pub struct AutomaticDegrees {
    method: Method,
    groups: Vec<Group>,
    /// Degrees of all steps, in place of a choice.
    given: Option<Vec<StepDegrees>>,
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

    /// Number of points since they have jumped.
    pub fn smooth_points(&self, history: &History) -> usize {
        history.smooth_points(self.variables.start)
    }

    fn begin(&mut self, choice: DegreeChoice) {
        (self.choice, self.next) = (choice, choice);
    }

    fn highest(&self, method: Method, length: f64) -> usize {
        match self.kind {
            Kind::Multipliers => self.highest.min(highest_stable_degree(method, length)),
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
    /// For the variables of `layout` for which `highest` tells the highest degree that all workers take; `None` if there are none. The
    /// first step has this length in s; `given` has the degrees of all steps if they are known.
    pub fn new(
        method: Method,
        layout: &Layout,
        highest: StepDegrees,
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
            let highest = group.highest(method, first_step);
            group.begin(DegreeChoice::new(highest));
            Some(group)
        };
        let groups: Vec<Group> = [
            group(0..rows, Kind::Multipliers, highest.multipliers),
            group(rows..layout.variables(), Kind::Exchanged, highest.exchanged),
        ]
        .into_iter()
        .flatten()
        .collect();
        (!groups.is_empty()).then_some(Self {
            method,
            groups,
            given,
            steps_done: 0,
        })
    }

    /// At the first macro point. The degree grows with the number of points to the highest one, as a fixed one does.
    pub fn begin(&mut self, history: &mut History) {
        self.take_given();
        self.apply(history);
    }

    /// Chooses the degrees that follow a step of this length, from what the degrees of a group promise; those of multipliers and of
    /// exchanged variables, as far as they change and are known to be better.
    pub fn choose(
        &mut self,
        mut prospects: impl FnMut(&Group) -> Prospects,
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
        for group in &mut self.groups {
            let prospects = prospects(group);
            let highest = group.highest(self.method, longest);
            group.next = group.choice;
            group.next.follow(&prospects, highest, purpose);
            let next = group.next.degree();
            if next != group.degree() {
                let error = |prospect: Option<Prospect>| prospect.map(|prospect| prospect.scaled);
                tracing::debug!(
                    of = ?group.kind,
                    from = group.degree(),
                    to = next,
                    highest,
                    error = error(prospects.present),
                    error_lower = error(prospects.lower),
                    error_higher = error(prospects.higher),
                    "degree changes"
                );
            }
            if next != group.degree() && next < prospects.smooth_points {
                changed[group.kind as usize] = Some(next);
            }
        }
        changed
    }

    /// The multipliers jump in the present step.
    pub fn restart(&mut self, history: &mut History) {
        let multipliers = self
            .groups
            .iter_mut()
            .filter(|group| group.are_multipliers());
        multipliers.for_each(|group| group.begin(DegreeChoice::after_jump()));
        self.apply(history);
    }

    /// The step is repeated with the degrees that were chosen for it.
    pub fn repeat(&mut self, history: &mut History) {
        self.take_next();
        self.apply(history);
    }

    fn take_next(&mut self) {
        for group in &mut self.groups {
            group.choice = group.next;
        }
    }

    /// Gives the polynomials their degrees.
    fn apply(&self, history: &mut History) {
        for group in &self.groups {
            history.set_degree(group.variables.clone(), group.degree());
        }
    }

    /// The step is taken; the next one gets the degrees that were chosen.
    pub fn move_on(&mut self, history: &mut History) {
        self.steps_done += 1;
        self.take_next();
        self.take_given();
        self.apply(history);
    }

    fn take_given(&mut self) {
        let Some(given) = &self.given else { return };
        let Some(&degrees) = given.get(self.steps_done) else {
            return;
        };
        for group in &mut self.groups {
            if let Some(degree) = group.of_step(degrees) {
                group.begin(DegreeChoice::new(degree));
            }
        }
    }

    /// The degrees over the step that was taken last, from the history `before` it; 0 before the first one.
    pub fn of_last_step(&self, before: &History) -> StepDegrees {
        let mut degrees = StepDegrees::default();
        for group in &self.groups {
            let degree = match self.steps_done {
                0 => 0,
                _ => before.interpolated_degree(group.variables.start),
            };
            match group.kind {
                Kind::Multipliers => degrees.multipliers = Some(degree),
                Kind::Exchanged => degrees.exchanged = Some(degree),
            }
        }
        degrees
    }
}
