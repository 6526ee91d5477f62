//! The macro points of a run, known in advance or found step by step.

use super::grid::{MacroGrid, MacroStep, ROUNDING};
use serde::{Deserialize, Serialize};

/// Where a run stands and which macro step it takes from there. No other place adds macro steps up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TimePlan {
    rule: Rule,
    t_end: f64,
    done: usize,
    t: f64,
    step: Option<MacroStep>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
enum Rule {
    /// All macro points are known, from the one on that was reached after so many steps.
    Grid(MacroGrid, usize),
    /// Every step has the length that is wished for, as far as the end allows.
    Free,
    /// The lengths of the steps are given.
    Given(Vec<f64>),
}

/// Most steps before the end that are made equal.
const MOST_EQUAL: f64 = 20.0;

impl TimePlan {
    /// Steps of one length, see [`MacroGrid`].
    pub fn equidistant(t_start: f64, t_end: f64, macro_step: f64) -> Self {
        let grid = MacroGrid::new(t_start, t_end, macro_step);
        let first = grid.step(0);
        Self::new(Rule::Grid(grid, 0), t_start, t_end, first)
    }

    /// Steps whose lengths are found on the way, the first `macro_step` long. The last point is `t_end` exactly; when the end is near the rest
    /// of the time is divided into equal steps, so that no step is longer than wished for or shorter than half of that.
    pub fn variable(t_start: f64, t_end: f64, macro_step: f64) -> Self {
        let first = free_step(t_start, t_end, macro_step);
        Self::new(Rule::Free, t_start, t_end, first)
    }

    /// Steps of the given lengths, as a run with variable steps has found them.
    pub fn given(t_start: f64, t_end: f64, lengths: Vec<f64>) -> Self {
        let first = lengths
            .first()
            .and_then(|&length| given_step(t_start, t_end, length));
        Self::new(Rule::Given(lengths), t_start, t_end, first)
    }

    fn new(rule: Rule, t_start: f64, t_end: f64, step: Option<MacroStep>) -> Self {
        Self {
            rule,
            t_end,
            done: 0,
            t: t_start,
            step,
        }
    }

    /// Time of the present macro point in s.
    pub fn t(&self) -> f64 {
        self.t
    }

    /// Number of macro steps done.
    pub fn steps_done(&self) -> usize {
        self.done
    }

    /// Number of macro steps of the whole plan; those done so far if the steps vary.
    pub fn steps_planned(&self) -> usize {
        match &self.rule {
            Rule::Grid(grid, before) => before + grid.len(),
            Rule::Free => self.done,
            Rule::Given(lengths) => lengths.len(),
        }
    }

    /// The step from the present macro point; `None` at the end.
    pub fn step(&self) -> Option<MacroStep> {
        self.step
    }

    /// Takes a step that is shorter than the present one, from the same macro point, in its place.
    pub fn shorten(&mut self, length: f64) -> MacroStep {
        let step = step_within(self.t, self.t_end, length);
        self.step = Some(step);
        step
    }

    /// Lets `t`, which lies behind the present macro point, become a macro point itself: the shorter step that takes the place of the present one,
    /// if that would pass it. So that no step is tiny, two that would end little beyond it are made equal. Equidistant macro points are counted anew from a
    /// step that was shortened.
    pub fn meet(&mut self, t: f64) -> Option<MacroStep> {
        let step = self.step?;
        let rest = t - step.start;
        let share = rest / step.length;
        let is_met = share > 0.5 && (share - share.round()).abs() <= ROUNDING * share;
        if is_met || share >= 2.0 {
            return None;
        }
        let shorter = match share < 1.0 {
            true => MacroStep {
                length: rest,
                end: t,
                ..step
            },
            false => MacroStep {
                length: 0.5 * rest,
                end: step.start + 0.5 * rest,
                ..step
            },
        };
        if let Rule::Grid(grid, before) = &mut self.rule {
            *grid = MacroGrid::new(shorter.end, self.t_end, grid.macro_step());
            *before = self.done + 1;
        }
        self.step = Some(shorter);
        Some(shorter)
    }

    /// The step after the present one, with the length that is wished for where steps vary; `None` if the present one reaches the end.
    pub fn following(&self, wish: f64) -> Option<MacroStep> {
        let next = self.done + 1;
        let start = self.step?.end;
        match &self.rule {
            Rule::Grid(grid, before) => grid.step(next - before),
            Rule::Free => free_step(
                start,
                self.t_end,
                equal_length(self.step?, self.t_end, wish),
            ),
            Rule::Given(lengths) => given_step(start, self.t_end, *lengths.get(next)?),
        }
    }

    /// Moves on to the end of the present step; `following` is the one from there.
    pub fn move_on(&mut self, following: Option<MacroStep>) {
        if let Some(step) = self.step {
            self.t = step.end;
            self.done += 1;
        }
        self.step = following;
    }

    /// Whether the last macro point is reached.
    pub fn is_finished(&self) -> bool {
        self.step.is_none()
    }
}

/// A step from `start`, if that is not the end.
fn free_step(start: f64, t_end: f64, wish: f64) -> Option<MacroStep> {
    (start < t_end).then(|| step_within(start, t_end, wish))
}

/// A step of this length from `start`, if that is not the end.
fn given_step(start: f64, t_end: f64, length: f64) -> Option<MacroStep> {
    let share = (t_end - start) / length;
    let (length, end) = if (share - 1.0).abs() <= ROUNDING {
        (length, t_end)
    } else if share < 1.0 {
        (t_end - start, t_end)
    } else {
        (length, start + length)
    };
    (start < t_end).then_some(MacroStep { start, length, end })
}

/// The length of the steps after `step` that are no longer than wished for and end together, where few are left: columns and histories of
/// equal steps are worth more than long ones.
fn equal_length(step: MacroStep, t_end: f64, wish: f64) -> f64 {
    let rest = t_end - step.end;
    let steps = (rest / wish * (1.0 - ROUNDING)).ceil();
    if !(1.0..=MOST_EQUAL).contains(&steps) {
        return wish;
    }
    let equal = rest / steps;
    match (equal - step.length).abs() <= ROUNDING * step.length {
        true => step.length,
        false => equal,
    }
}

/// A step from `start`, shorter than wished for if the end is near.
fn step_within(start: f64, t_end: f64, wish: f64) -> MacroStep {
    let rest = t_end - start;
    let share = rest / wish;
    let (length, end) = if (share - 1.0).abs() <= ROUNDING {
        (wish, t_end)
    } else if share < 1.0 {
        (rest, t_end)
    } else if share < 2.0 {
        (0.5 * rest, start + 0.5 * rest)
    } else {
        (wish, start + wish)
    };
    MacroStep { start, length, end }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn lengths(mut plan: TimePlan, wishes: impl IntoIterator<Item = f64>) -> Vec<f64> {
        let mut lengths = Vec::new();
        let mut wishes = wishes.into_iter();
        while let Some(step) = plan.step() {
            lengths.push(step.length);
            let wish = wishes.next().unwrap_or(step.length);
            let following = plan.following(wish);
            plan.move_on(following);
        }
        lengths
    }

    #[test]
    fn the_end_leaves_no_tiny_step() {
        assert_eq!(
            lengths(TimePlan::variable(0.0, 1.0625, 0.5), []),
            [0.5, 0.28125, 0.28125]
        );
        assert_eq!(lengths(TimePlan::variable(0.0, 1.0, 0.5), []), [0.5, 0.5]);
        assert_eq!(
            lengths(TimePlan::variable(0.0, 1.0, 0.125), [0.25, 0.5]),
            [0.125, 0.21875, 0.328125, 0.328125]
        );
        let equal = lengths(TimePlan::variable(0.0, 1.0, 0.1), [0.37, 0.37, 0.37]);
        assert_eq!(equal.len(), 4);
        assert!(
            equal[1..].iter().all(|length| *length == equal[1]),
            "{equal:?}"
        );
    }

    #[test]
    fn a_step_that_is_repeated_is_counted_once() {
        let mut plan = TimePlan::variable(1.0, 2.0, 0.25);
        let repeated = plan.shorten(0.125);
        assert_eq!(Some(repeated), plan.step());
        plan.move_on(plan.following(0.125));
        assert_eq!((plan.t(), plan.steps_done()), (1.125, 1));
        assert_eq!(plan.step().map(|step| step.start), Some(1.125));
    }

    /// The macro points of a plan that meets these times, which are ascending.
    fn met(mut plan: TimePlan, times: &[f64]) -> Vec<f64> {
        let mut points = Vec::new();
        for &t in times {
            while plan.t() < t - 1e-9 {
                plan.meet(t);
                let wish = plan.step().unwrap().length;
                plan.move_on(plan.following(wish));
                points.push(plan.t());
            }
        }
        points
    }

    #[test]
    fn times_at_macro_points_change_nothing() {
        let plan = TimePlan::equidistant(0.0, 1.0, 0.1);
        let given = lengths(plan.clone(), []);
        let times: Vec<f64> = (1..=5).map(|n| 0.2 * f64::from(n)).collect();
        let points = met(plan, &times);
        let grid = MacroGrid::new(0.0, 1.0, 0.1);
        let of_grid: Vec<f64> = (1..=10).map(|n| grid.point(n)).collect();
        assert_eq!(points, of_grid);
        assert_eq!(given, [0.1; 10]);
    }

    #[test]
    fn times_between_macro_points_shorten_the_steps_before_them() {
        let plan = TimePlan::equidistant(0.0, 4.0, 1.0);
        assert_eq!(
            met(plan, &[1.25, 1.5, 4.0]),
            [0.625, 1.25, 1.5, 2.5, 3.25, 4.0]
        );
    }

    proptest! {
        #[test]
        fn any_time_is_met(h in 1e-2f64..1.0, gaps in proptest::collection::vec(1e-3f64..1.0, 1..20), is_grid: bool) {
            let mut t = 0.0;
            let times: Vec<f64> = gaps.iter().map(|gap| { t += gap; t }).collect();
            let plan = match is_grid {
                true => TimePlan::equidistant(0.0, t.max(h), h),
                false => TimePlan::variable(0.0, t.max(h), h),
            };
            let points = met(plan, &times);
            for time in times {
                prop_assert!(points.iter().any(|point| (point - time).abs() <= 1e-8));
            }
            prop_assert!(points.windows(2).all(|two| two[1] > two[0] && two[1] - two[0] <= h * (1.0 + 1e-6)));
        }

        #[test]
        fn any_plan_ends_exactly(start in -10f64..10.0, span in 1e-3f64..10.0, wishes in proptest::collection::vec(1e-3f64..1.0, 1..40)) {
            let end = start + span;
            let wish = |share: f64| share * span;
            let mut plan = TimePlan::variable(start, end, wish(wishes[0]));
            let mut wishes = wishes.iter().copied().cycle();
            let mut wished = wish(wishes.next().unwrap_or(1.0));
            let mut t = start;
            while let Some(step) = plan.step() {
                prop_assert_eq!(step.start, t);
                prop_assert!(step.length <= wished * (1.0 + 1e-8) && step.length > 0.49 * wished.min(end - t));
                t = step.end;
                wished = wish(wishes.next().unwrap_or(1.0));
                plan.move_on(plan.following(wished));
            }
            prop_assert_eq!(t, end);
            prop_assert!(plan.is_finished());
        }

        #[test]
        fn given_lengths_make_the_same_plan(span in 1e-3f64..10.0, shares in proptest::collection::vec(1e-2f64..1.0, 1..40)) {
            let wishes = shares.iter().map(|share| share * span);
            let found = lengths(TimePlan::variable(0.0, span, shares[0] * span), wishes);
            prop_assert_eq!(&lengths(TimePlan::given(0.0, span, found.clone()), []), &found);
        }

        #[test]
        fn given_lengths_are_taken_as_they_are(shares in proptest::collection::vec(1e-2f64..1.0, 1..40)) {
            let span = shares.iter().sum();
            let given = lengths(TimePlan::given(0.0, span, shares.clone()), []);
            prop_assert_eq!(given.len(), shares.len());
            for (given, share) in given.iter().zip(&shares) {
                prop_assert!((given - share).abs() < 1e-9);
            }
        }
    }
}
