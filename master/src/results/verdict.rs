//! The verdict on an accepted macro step.

use crate::joint::ROUNDING;

/// How well the corrected step kept what its linearisation promised, or that the method promises nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The method has no corrector.
    Uncorrected,
    /// The condition is met up to 1 % of the correction: more corrector passes would change nothing of note.
    Good,
    /// Up to half of the correction is missing: a smaller macro step would help.
    Fair,
    /// The correction missed its aim: the result of this step is not to be trusted.
    Poor,
}

/// Defect up to which a step is good.
const GOOD: f64 = 0.01;

/// Defect up to which a step is fair.
const FAIR: f64 = 0.5;

/// Collects the largest defect `|g - (g_predicted + G change)|` over the rows, relative to the first correction of the step,
/// `max(|g_predicted|, |G change|)`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Defect {
    largest: f64,
}

impl Defect {
    /// Takes one row: what was promised, the size of the correction, what was found, the size of the motion.
    pub fn add(&mut self, promised: f64, scale: f64, found: f64, extent: f64) {
        let missing = (found - promised).abs() - ROUNDING * extent;
        let defect = if missing <= 0.0 { 0.0 } else { missing / scale };
        let defect = if defect.is_nan() {
            f64::INFINITY
        } else {
            defect
        };
        self.largest = self.largest.max(defect);
    }

    /// The verdict on the worst row.
    pub fn verdict(self) -> Verdict {
        match self.largest {
            defect if defect <= GOOD => Verdict::Good,
            defect if defect <= FAIR => Verdict::Fair,
            _ => Verdict::Poor,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(found: f64) -> Verdict {
        let mut defect = Defect::default();
        defect.add(0.0, 1e-3, 0.0, 1.0);
        defect.add(0.0, 1e-3, found, 1.0);
        defect.verdict()
    }

    #[test]
    fn verdicts_follow_the_worst_row() {
        assert_eq!(verdict(0.0), Verdict::Good);
        assert_eq!(verdict(-1e-12), Verdict::Good);
        assert_eq!(verdict(2e-5), Verdict::Fair);
        assert_eq!(verdict(-2e-3), Verdict::Poor);
        assert_eq!(verdict(f64::NAN), Verdict::Poor);
    }
}
