//! Which degree the polynomials of a group of coupling variables have in the next macro step, where it follows the estimates.

use serde::{Deserialize, Serialize};

use crate::time::MOST_GROWTH;

/// When a degree changes. A scene does not change these numbers; run.json shows them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Settings {
    /// A higher degree has to allow steps that are longer by this factor. Nearer to 1 degrees change to and fro, larger ones stay too long.
    pub gain: f64,
    /// The same for polynomials that are found anew, in integrations until the end of the run.
    pub gain_anew: f64,
    /// Degree that is left for a lower one only at a jump. Multipliers of constant polynomials are means over the steps; polynomials of higher
    /// degree through them look rough, so that the errors of degree 0 would never let it go.
    pub lowest: usize,
}

/// Those of every run.
pub(crate) const SETTINGS: Settings = Settings {
    gain: 1.2,
    gain_anew: 1.25,
    lowest: 1,
};

/// What a degree is chosen for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// The step was accepted: the next one shall be as long as possible.
    LongestStep,
    /// The step was rejected: its repetition shall be as long as possible.
    Repetition,
    /// The lengths of the steps are given.
    SmallestError,
}

/// The error that a step would have had with polynomials of some degree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prospect {
    /// Error over what is allowed.
    pub scaled: f64,
    /// The power of the step with which it falls.
    pub order: usize,
}

/// What is known about the degrees that may follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prospects {
    /// Number of past points since the variables have jumped, the end of the step not counted.
    pub smooth_points: usize,
    /// With one degree less; absent like the others where the past is too short to tell.
    pub lower: Option<Prospect>,
    /// With the present degree.
    pub present: Option<Prospect>,
    /// With one degree more.
    pub higher: Option<Prospect>,
}

/// The degree of a group and how it got there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct DegreeChoice {
    degree: usize,
    /// For how many steps without a break one degree less, and one more, would have been clearly better.
    lower: usize,
    higher: usize,
    /// Whether the degree still grows with the number of points after a jump.
    is_rising: bool,
}

impl Prospect {
    /// Whether this degree allows a step that is longer than with the other one by `gain`. Where both allow more growth than a step
    /// has, and where the step is given, what counts is the error.
    pub(super) fn is_better(self, other: Self, gain: f64, purpose: Purpose) -> bool {
        let most = match purpose {
            Purpose::SmallestError => 1.0,
            Purpose::LongestStep | Purpose::Repetition => MOST_GROWTH,
        };
        let wanted = gain * other.length();
        match purpose {
            Purpose::LongestStep | Purpose::Repetition if wanted <= most => self.length() >= wanted,
            _ => self.error_at(gain * most) < other.error_at(most),
        }
    }

    /// Length of a step with just the allowed error, over that of the step it is told from.
    fn length(self) -> f64 {
        self.scaled.powf(-1.0 / self.order as f64)
    }

    fn error_at(self, length: f64) -> f64 {
        self.scaled * length.powi(self.order as i32)
    }
}

impl DegreeChoice {
    /// Begins with this degree, which is reached as soon as there are enough points.
    pub fn new(degree: usize) -> Self {
        Self {
            degree,
            lower: 0,
            higher: 0,
            is_rising: false,
        }
    }

    /// The variables have jumped: begins anew with constant polynomials.
    pub fn after_jump() -> Self {
        Self {
            is_rising: true,
            ..Self::new(0)
        }
    }

    /// The present degree.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Takes this degree.
    pub fn take(&mut self, degree: usize) {
        *self = Self::new(degree);
    }

    /// Takes the degree that follows, at most `highest`.
    ///
    /// It changes by one where the other degree has been clearly better over as many steps as the polynomial has nodes: errors that
    /// oscillate pass through zero, those of different degrees at different times. For the repetition of a step it falls at
    /// once; after a jump it grows with the number of points, until a lower one is better.
    pub fn follow(&mut self, prospects: &Prospects, highest: usize, purpose: Purpose) {
        let degree = self.degree;
        let next = self.next(prospects, highest, purpose);
        let waits_for_points = prospects.smooth_points <= degree || purpose == Purpose::Repetition;
        self.is_rising &= next > degree || (next == degree && waits_for_points);
        if next != degree {
            (self.lower, self.higher) = (0, 0);
        }
        self.degree = next;
    }

    fn next(&mut self, prospects: &Prospects, highest: usize, purpose: Purpose) -> usize {
        let degree = self.degree;
        let Some(present) = prospects.present.filter(|_| degree <= highest) else {
            return degree.min(highest);
        };
        let is_better = |other: Option<Prospect>, gain| {
            other.is_some_and(|other| other.is_better(present, gain, purpose))
        };
        let lower = prospects.lower.filter(|_| degree > SETTINGS.lowest);
        let is_lower_better = is_better(lower, 1.0);
        if purpose == Purpose::Repetition {
            return degree - usize::from(is_lower_better);
        }
        if self.is_rising && !is_lower_better {
            return (degree + 1).min(prospects.smooth_points).min(highest);
        }
        let higher = prospects.higher.filter(|_| degree < highest);
        let count = |steps: usize, other| {
            if is_better(other, SETTINGS.gain) {
                steps + 1
            } else {
                0
            }
        };
        self.lower = count(self.lower, lower);
        self.higher = count(self.higher, higher);
        match (self.lower > degree, self.higher > degree) {
            (true, true) if self.higher > self.lower => degree + 1,
            (true, _) => degree - 1,
            (false, true) => degree + 1,
            (false, false) => degree,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const PURPOSES: [Purpose; 3] = [
        Purpose::LongestStep,
        Purpose::Repetition,
        Purpose::SmallestError,
    ];

    fn prospects(degree: usize, smooth_points: usize, scaled: [f64; 3]) -> Prospects {
        let known = |degree: usize, scaled: f64| {
            (degree < smooth_points).then_some(Prospect {
                scaled,
                order: degree + 3,
            })
        };
        let [lower, present, higher] = scaled;
        Prospects {
            smooth_points,
            lower: degree
                .checked_sub(1)
                .and_then(|degree| known(degree, lower)),
            present: known(degree, present),
            higher: known(degree + 1, higher),
        }
    }

    #[test]
    fn the_longer_step_counts_where_it_is_within_reach() {
        let of = |scaled, order| Prospect { scaled, order };
        let longer = of(0.5f64.powi(4), 4);
        assert!(longer.is_better(of(0.7f64.powi(3), 3), SETTINGS.gain, Purpose::LongestStep));
        assert!(!longer.is_better(of(0.58f64.powi(3), 3), SETTINGS.gain, Purpose::LongestStep));
        // Both may grow as much as a step does: 1e-6 allows 100 times the step and 1e-9 only 31 times, but with less error.
        assert!(of(1e-9, 6).is_better(of(1e-6, 3), SETTINGS.gain, Purpose::LongestStep));
        assert!(!of(1e-6, 3).is_better(of(1e-9, 6), SETTINGS.gain, Purpose::LongestStep));
        // Of steps whose length is given only the error counts.
        assert!(of(0.2, 5).is_better(of(0.6, 3), SETTINGS.gain, Purpose::SmallestError));
        assert!(!of(0.5, 5).is_better(of(0.6, 3), SETTINGS.gain, Purpose::SmallestError));
        assert!(!of(0.0, 5).is_better(of(0.0, 3), 1.0, Purpose::SmallestError));
    }

    #[test]
    fn a_higher_degree_has_to_be_better_for_as_many_steps_as_there_are_nodes() {
        for degree in 0..3usize {
            let mut choice = DegreeChoice::new(degree);
            let better = prospects(degree, 4, [2.0, 0.9, 0.1]);
            let worse = prospects(degree, 4, [2.0, 0.9, 0.8]);
            for _ in 0..degree {
                choice.follow(&better, 3, Purpose::LongestStep);
            }
            assert_eq!(choice.degree(), degree);
            choice.follow(&worse, 3, Purpose::LongestStep);
            for _ in 0..degree {
                choice.follow(&better, 3, Purpose::LongestStep);
                assert_eq!(choice.degree(), degree);
            }
            choice.follow(&better, 3, Purpose::LongestStep);
            assert_eq!(choice.degree(), degree + 1);
        }
    }

    #[test]
    fn after_a_jump_the_degree_grows_with_the_points() {
        let mut choice = DegreeChoice::after_jump();
        let mut degrees = vec![choice.degree()];
        for points in 0..6 {
            let degree = choice.degree();
            let good = prospects(degree, points, [0.9, 0.5, 0.1]);
            // Attempts at a step before it is accepted.
            choice.follow(&good, 3, Purpose::Repetition);
            choice.follow(&good, 3, Purpose::LongestStep);
            degrees.push(choice.degree());
        }
        assert_eq!(degrees, [0, 0, 1, 2, 3, 3, 3]);
        let mut stays = DegreeChoice::after_jump();
        for points in 0..6 {
            let degree = stays.degree();
            let errors = [0.9, 0.5, 0.4].map(|error| if degree < 1 { error } else { 1.0 - error });
            stays.follow(&prospects(degree, points, errors), 3, Purpose::LongestStep);
        }
        assert!(stays.degree() < 2);
    }

    proptest! {
        #[test]
        fn the_degree_changes_by_one_and_stays_below_its_limit(
            start in 0usize..=3,
            steps in proptest::collection::vec((1e-6f64..10.0, 1e-6f64..10.0, 1e-6f64..10.0, 0usize..=4, 0usize..3, 0usize..=3), 1..60),
        ) {
            let mut choice = DegreeChoice::new(start);
            for (lower, present, higher, points, purpose, highest) in steps {
                let before = choice;
                let degree = choice.degree();
                let known = prospects(degree, points, [lower, present, higher]);
                let purpose = PURPOSES[purpose];
                choice.follow(&known, highest, purpose);
                let next = choice.degree();
                prop_assert!(next <= highest);
                if degree <= highest {
                    prop_assert!(next.abs_diff(degree) <= 1);
                }
                if next > degree {
                    prop_assert!(purpose != Purpose::Repetition && next <= points);
                }
                if purpose == Purpose::Repetition && degree <= highest {
                    let lower_is_longer = known.present.zip(known.lower).is_some_and(|(present, lower)| lower.length() >= present.length());
                    prop_assert!(next == degree || lower_is_longer || present < 1.0);
                }
                // The same prospects lead to the same choice.
                let mut again = before;
                again.follow(&known, highest, purpose);
                prop_assert_eq!(again, choice);
            }
        }

        #[test]
        fn equal_prospects_lead_to_a_degree_that_stays(errors in proptest::array::uniform4(1e-8f64..3.0), start in 0usize..=3, purpose in 0usize..3) {
            let mut choice = DegreeChoice::new(start);
            let error = |degree: usize| errors.get(degree).copied().unwrap_or(1.0);
            let mut degrees = Vec::new();
            for _ in 0..40 {
                let degree = choice.degree();
                let scaled = [error(degree.wrapping_sub(1)), error(degree), error(degree + 1)];
                choice.follow(&prospects(degree, 4, scaled), 3, PURPOSES[purpose]);
                degrees.push(choice.degree());
            }
            prop_assert!(degrees[20..].iter().all(|degree| *degree == degrees[20]), "{:?}", degrees);
        }
    }
}
