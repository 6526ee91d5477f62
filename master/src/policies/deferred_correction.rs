//! What corrections with kept columns miss, foreseen from the last macro steps.

use serde::{Deserialize, Serialize};

/// How what is missed is foreseen. A scene does not change these numbers; run.json shows them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Settings {
    /// Most macro steps that are looked back at. More follow a curve closer and carry noise further.
    pub most_steps: usize,
    /// Share of what is known of an order that stays with every step. At 1 an order that served once is never left, at 0 the last step alone
    /// decides.
    pub memory: f64,
}

/// Those of every run.
pub(crate) const SETTINGS: Settings = Settings {
    most_steps: MOST,
    memory: 0.7,
};

/// Most macro steps that are looked back at.
const MOST: usize = 3;

/// The part of the solution that one correction with the matrix at hand misses, `D = w - (w predicted + J^-1 r)`, as a function of time.
///
/// With columns of an earlier step `D` is a share of the correction, and both are smooth where the motion is. So `D` of the present
/// step is extrapolated through those of the last steps: with nothing known it is 0, through one it is held, through two or three
/// it goes along a line or a parabola. Of these orders the one serves that would have told the last ones best.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct DeferredCorrection {
    /// Newest first.
    past: Vec<Vec<f64>>,
    known: usize,
    /// Number of past steps that the extrapolation goes through.
    order: usize,
    /// How wrong each order has been in the last steps, and how many orders have been judged.
    wrong: [f64; MOST + 1],
    judged: usize,
    foreseen: Vec<f64>,
    /// `D` of the present step, as far as it is known.
    missed: Vec<f64>,
}

/// Weights of the last steps, newest first, in the extrapolation through 0 to 3 of them.
const WEIGHTS: [[f64; MOST]; MOST + 1] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [2.0, -1.0, 0.0],
    [3.0, -3.0, 1.0],
];

impl DeferredCorrection {
    /// Of that many unknowns.
    pub fn new(unknowns: usize) -> Self {
        Self {
            past: vec![vec![0.0; unknowns]; MOST],
            known: 0,
            order: 0,
            wrong: [0.0; MOST + 1],
            judged: 0,
            foreseen: vec![0.0; unknowns],
            missed: vec![0.0; unknowns],
        }
    }

    /// The past says nothing of the present step.
    pub fn forget(&mut self) {
        self.known = 0;
        self.order = 0;
        self.judged = 0;
    }

    /// Completes the first correction of a step by what it will miss, if the step `continues` those before.
    pub fn complete_first(&mut self, change: &mut [f64], continues: bool) {
        self.extrapolate(if continues { self.order } else { 0 });
        self.missed.copy_from_slice(&self.foreseen);
        add(change, &self.foreseen);
    }

    /// The next correction of the same step has new columns: what earlier ones have missed says nothing of these.
    pub fn renew(&mut self) {
        self.forget();
        self.missed.fill(0.0);
    }

    /// Takes another correction of the same step.
    pub fn add_pass(&mut self, change: &[f64]) {
        add(&mut self.missed, change);
    }

    /// Takes what the corrections of a step have left, and gives the size of all that the first one would have missed; `size`
    /// measures a change of the unknowns.
    pub fn learn(&mut self, left: &[f64], mut size: impl FnMut(&[f64]) -> f64) -> f64 {
        add(&mut self.missed, left);
        for order in 0..=self.known {
            self.extrapolate(order);
            for (foreseen, missed) in self.foreseen.iter_mut().zip(&self.missed) {
                *foreseen -= missed;
            }
            let wrong = size(&self.foreseen);
            let before = &mut self.wrong[order];
            *before = match self.judged > order {
                true => wrong + SETTINGS.memory * (*before - wrong),
                false => wrong,
            };
        }
        self.judged = self.judged.max(self.known + 1);
        let best =
            (0..=self.known).min_by(|one, other| self.wrong[*one].total_cmp(&self.wrong[*other]));
        self.order = best.unwrap_or_default();
        self.past.rotate_right(1);
        self.past[0].copy_from_slice(&self.missed);
        if self.known == 0 {
            self.order = 1;
        }
        self.known = (self.known + 1).min(MOST);
        size(&self.missed)
    }

    fn extrapolate(&mut self, order: usize) {
        self.foreseen.fill(0.0);
        for (past, weight) in self.past.iter().zip(WEIGHTS[order]).take(order) {
            for (foreseen, past) in self.foreseen.iter_mut().zip(past) {
                *foreseen += weight * past;
            }
        }
    }
}

fn add(sums: &mut [f64], terms: &[f64]) {
    for (sum, term) in sums.iter_mut().zip(terms) {
        *sum += term;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(values: &[f64]) -> f64 {
        values.iter().map(|value| value * value).sum::<f64>().sqrt()
    }

    fn foreseen(deferred: &mut DeferredCorrection) -> [f64; 2] {
        let mut change = [0.5, -1.0];
        deferred.complete_first(&mut change, true);
        [change[0] - 0.5, change[1] + 1.0]
    }

    /// A step whose first correction misses `missed`, half of which a pass finds.
    fn step(deferred: &mut DeferredCorrection, missed: [f64; 2]) {
        let foreseen = foreseen(deferred);
        let half = [0, 1].map(|place| 0.5 * (missed[place] - foreseen[place]));
        deferred.add_pass(&half);
        let found = deferred.learn(&half, size);
        assert!((found - size(&missed)).abs() < 1e-12);
    }

    #[test]
    fn a_parabola_is_foreseen_once_it_is_known() {
        let missed = |t: f64| [1.0 - 2.0 * t + 0.5 * t * t, 3.0 * t];
        let mut deferred = DeferredCorrection::new(2);
        assert_eq!(foreseen(&mut deferred), [0.0, 0.0]);
        for number in 0..5 {
            step(&mut deferred, missed(f64::from(number)));
        }
        let [first, second] = foreseen(&mut deferred);
        let expected = missed(5.0);
        assert!((first - expected[0]).abs() < 1e-12 && (second - expected[1]).abs() < 1e-12);
        deferred.forget();
        assert_eq!(foreseen(&mut deferred), [0.0, 0.0]);
    }

    #[test]
    fn what_alternates_is_not_continued() {
        let mut deferred = DeferredCorrection::new(2);
        for number in 0..6 {
            let sign = if number % 2 == 0 { 1.0 } else { -1.0 };
            step(&mut deferred, [sign, -sign]);
        }
        assert_eq!(foreseen(&mut deferred), [0.0, 0.0]);
    }
}
