//! Which degree polynomials that are found anew in every macro step have in the next one: that with which the rest of the run takes the
//! fewest integrations.

use super::choice::{Prospect, Prospects, Purpose, SETTINGS};

/// What the solutions with polynomials of the present degree `p` and of lower ones tell of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nested {
    /// The present degree.
    pub degree: usize,
    /// By how much the solution differs from that of one degree less, over what is allowed: the error of the latter.
    pub difference: f64,
    /// By how much that solution differs from the one of two degrees less.
    pub lower: f64,
    /// The largest ratio of the top coefficient of a multiplier to those before it.
    pub top_share: f64,
}

/// How many integrations a step takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Those of all subsystems over a step, without columns.
    pub of_step: f64,
    /// Those for one power of all inputs that are raised.
    pub of_power: f64,
    /// Whether columns are measured in every step; otherwise those of a length and a degree serve as long as both stay.
    pub every_step: bool,
    /// The time that is left behind the present step, in lengths of it.
    pub rest: f64,
    /// So many times as long the next step is at most.
    pub most_growth: f64,
}

/// What is known about the degrees that may follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outlook {
    /// Of polynomials through past values.
    Past(Prospects),
    /// Of polynomials that are found anew in every step.
    Anew(Anew),
}

impl Outlook {
    /// The error with the present degree, with one less and with one more, as far as they are known.
    pub fn errors(&self) -> [Option<f64>; 3] {
        let prospects = match self {
            Self::Past(known) => [known.present, known.lower, known.higher],
            Self::Anew(Anew { nested, .. }) => {
                let degree = nested.degree;
                [degree, degree - 1, degree + 1].map(|degree| Some(nested.prospect(degree)))
            }
        };
        prospects.map(|known| known.map(|known| known.scaled))
    }
}

/// From what a degree is chosen where polynomials are found anew.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anew {
    /// What the step tells.
    pub nested: Nested,
    /// The lowest and the highest degree that may follow.
    pub degrees: [usize; 2],
    /// What a step costs.
    pub cost: Cost,
}

impl Nested {
    /// By what factor the last degree has changed the difference; no more is heard than rounding leaves.
    fn fell(&self) -> f64 {
        fall(self.difference, self.lower)
    }

    /// By what factor a further degree changes it, at most. Where the coefficients of a multiplier do not fall as fast, which they do with the
    /// root of that factor, the step does not resolve it, and they tell the factor.
    fn falls(&self) -> f64 {
        self.fell().max(self.top_share)
    }

    /// The power of the step with which the lower difference falls.
    pub fn lower_order(&self) -> usize {
        2 * self.degree - 3
    }

    /// The error that the step most likely has. What a difference of lower degrees was `before` counts as well: it may pass through zero.
    ///
    /// Where a step resolves the motion, degree `p` divides the error by `4 (2p - 1)(2p + 1)` over a square of the frequency times the length, so
    /// that the factors of two degrees in a row are as `(2p - 3)/(2p + 1)`. Where it does not, nothing is known but what is kept in hand.
    pub fn likely(&self, before: f64) -> f64 {
        let p = self.degree as f64;
        let fell = fall(self.difference, self.lower.max(before));
        // Below two radians in a step.
        let is_resolved = fell * (2.0 * p - 3.0) * (2.0 * p - 1.0) < 1.0;
        match is_resolved {
            true => self.difference * fell * (2.0 * p - 3.0) / (2.0 * p + 1.0),
            false => self.prospect(self.degree).scaled,
        }
    }

    /// The error that the step would have had with polynomials of this degree, and the power of the step with which it falls.
    ///
    /// Every further degree changes the error by the same factor, and the last one has changed it by what the differences show; half of a
    /// degree is kept in hand.
    pub fn prospect(&self, degree: usize) -> Prospect {
        let more = degree as f64 - self.degree as f64;
        let share = match degree < self.degree {
            true => self.fell().powf(more + 0.5),
            false => self.falls().powf(more + 0.5),
        };
        Prospect {
            scaled: self.difference * share,
            order: 2 * degree + 1,
        }
    }
}

impl Anew {
    /// The degree of the next attempt or step, at most `highest`, where the step-size control would take a step with some error so many times
    /// as long as the present one as `growth` tells.
    pub fn choose(
        &self,
        highest: usize,
        purpose: Purpose,
        growth: impl Fn(Prospect) -> f64,
    ) -> usize {
        let [lowest, highest] = [self.degrees[0], self.degrees[1].min(highest)];
        let present = self.nested.degree.min(highest).max(lowest);
        match purpose {
            Purpose::SmallestError => return self.nested.most_accurate(present, [lowest, highest]),
            // There is nothing to gain yet, or any more.
            Purpose::LongestStep
                if self.cost.rest == 0.0
                    || growth(self.nested.prospect(present)) >= self.cost.most_growth =>
            {
                return present;
            }
            Purpose::LongestStep | Purpose::Repetition => {}
        }
        // A step that is repeated is left as well.
        let rest = self.cost.rest + f64::from(u8::from(purpose == Purpose::Repetition));
        let mut best = (
            present,
            self.integrations(present, rest, &growth) / SETTINGS.gain_anew,
        );
        for degree in (lowest..=highest).filter(|degree| *degree != present) {
            let own = self.integrations(degree, rest, &growth);
            if own < best.1 {
                best = (degree, own);
            }
        }
        best.0
    }

    /// Integrations over the `rest` of the run with polynomials of this degree.
    fn integrations(&self, degree: usize, rest: f64, growth: impl Fn(Prospect) -> f64) -> f64 {
        let growth = growth(self.nested.prospect(degree));
        let cost = self.cost;
        let of_columns = cost.of_power * (degree + 1) as f64;
        let steps = rest / growth;
        match cost.every_step {
            true => steps * (cost.of_step + of_columns),
            false if degree == self.nested.degree && growth == 1.0 => steps * cost.of_step,
            false => steps * cost.of_step + of_columns,
        }
    }
}

impl Nested {
    /// The degree next to the present one that is more accurate by a margin, where the length of the step is given.
    fn most_accurate(&self, present: usize, [lowest, highest]: [usize; 2]) -> usize {
        let own = self.prospect(present);
        let is_better = |degree: usize, gain: f64| {
            self.prospect(degree)
                .is_better(own, gain, Purpose::SmallestError)
        };
        if present > lowest && is_better(present - 1, 1.0) {
            return present - 1;
        }
        match present < highest && is_better(present + 1, SETTINGS.gain) {
            true => present + 1,
            false => present,
        }
    }
}

/// The ratio of a difference to that of lower degrees, from rounding to 1; 1 where there is none, or it is no number.
fn fall(difference: f64, lower: f64) -> f64 {
    match difference / lower {
        fell if lower.is_finite() && fell < 1.0 => fell.max(f64::EPSILON),
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// As a step-size control without margins and limits would.
    fn growth(prospect: Prospect) -> f64 {
        prospect.scaled.powf(-1.0 / prospect.order as f64)
    }

    fn cost(rest: f64) -> Cost {
        Cost {
            of_step: 4.0,
            of_power: 2.0,
            every_step: false,
            rest,
            most_growth: f64::INFINITY,
        }
    }

    fn choose(nested: Nested, degrees: [usize; 2], cost: Cost, purpose: Purpose) -> usize {
        Anew {
            nested,
            degrees,
            cost,
        }
        .choose(5, purpose, growth)
    }

    const ALL: [usize; 2] = [2, 5];

    #[test]
    fn a_higher_degree_has_to_pay_its_columns_before_the_run_ends() {
        // Degree 3 is off by as much as is allowed; every further degree by a thousandth of that.
        let nested = Nested {
            degree: 3,
            difference: 1e3f64.sqrt(),
            lower: 1e3f64.powf(1.5),
            top_share: 0.0,
        };
        assert!((nested.prospect(3).scaled - 1.0).abs() < 1e-12);
        let own = |rest| choose(nested, ALL, cost(rest), Purpose::LongestStep);
        assert_eq!(own(1.0), 3);
        assert_eq!(own(100.0), 5);
        assert_eq!(choose(nested, [2, 4], cost(100.0), Purpose::LongestStep), 4);
    }

    #[test]
    fn where_a_further_degree_changes_nothing_the_degree_falls_with_the_columns() {
        let nested = Nested {
            degree: 5,
            difference: 0.5,
            lower: 0.5,
            top_share: 1.0,
        };
        let every = Cost {
            every_step: true,
            ..cost(100.0)
        };
        let anew = Anew {
            nested,
            degrees: ALL,
            cost: every,
        };
        assert_eq!(anew.choose(5, Purpose::LongestStep, |_| 1.0), 2);
        assert_eq!(anew.choose(5, Purpose::Repetition, |_| 0.5), 2);
    }

    /// Differences may vanish: the motion is met by any degree, or rounding is all that is left.
    #[test]
    fn no_difference_is_no_error_of_any_degree() {
        for lower in [0.0, 1.0, f64::INFINITY] {
            let nested = Nested {
                degree: 4,
                difference: 0.0,
                lower,
                top_share: 0.0,
            };
            for degree in 2..=5 {
                assert_eq!(nested.prospect(degree).scaled, 0.0, "{lower} {degree}");
            }
            assert_eq!(nested.likely(0.0), 0.0);
        }
    }

    proptest! {
        #[test]
        fn degrees_stay_within_limits(
            degree in 2usize..=5,
            difference in 1e-9f64..1e9,
            falls in 1e-6f64..1.0,
            rest in 0f64..1e4,
            highest in 2usize..=5,
        ) {
            let nested = Nested { degree, difference, lower: difference / falls, top_share: 0.0 };
            for purpose in [Purpose::LongestStep, Purpose::Repetition, Purpose::SmallestError] {
                let found = choose(nested, [2, highest], cost(rest), purpose);
                prop_assert!((2..=highest).contains(&found));
            }
        }

        /// Fewer integrations than with any other degree, but for the margin that keeps the present one.
        #[test]
        fn no_other_degree_takes_fewer_integrations(
            degree in 2usize..=5,
            difference in 1e-6f64..1e3,
            falls in 1e-6f64..0.9,
            rest in 1f64..1e4,
        ) {
            let nested = Nested { degree, difference, lower: difference / falls, top_share: 0.0 };
            let found = choose(nested, ALL, cost(rest), Purpose::LongestStep);
            let integrations = |degree: usize| {
                4.0 * rest / growth(nested.prospect(degree)) + 2.0 * (degree + 1) as f64
            };
            for other in 2..=5 {
                prop_assert!(integrations(found) <= SETTINGS.gain_anew * integrations(other) * (1.0 + 1e-12));
            }
        }
    }
}
