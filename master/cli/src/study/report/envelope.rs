//! What an error costs: the lower envelope of the settings of every method.

use serde::Serialize;

/// Subsystem integrations for an error.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Cost {
    /// How many.
    pub integrations: f64,
    /// How well that is known.
    pub bound: Bound,
}

/// How well a cost is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Bound {
    /// Interpolated between two runs.
    Interpolated,
    /// The first run that is as accurate has no larger macro step beside it: it costs no more than that run.
    AtMost,
    /// No run is as accurate: it costs more than the most accurate one.
    MoreThan,
}

/// The cost of a relative error for the runs of one setting, from the largest macro step to the smallest: integrations and
/// error, `None` for a run that did not reach its end. `None` without any run that did.
///
/// Between two neighbouring runs the logarithm of the cost is taken as linear in that of the error.
pub fn cost_of(runs: &[Option<(f64, f64)>], error: f64) -> Option<Cost> {
    let mut before: Option<(f64, f64)> = None;
    let mut best: Option<(f64, f64)> = None;
    for run in runs {
        if let Some(run) = *run {
            if run.1 <= error {
                return Some(match before {
                    Some(before) => interpolated(before, run, error),
                    None => Cost {
                        integrations: run.0,
                        bound: Bound::AtMost,
                    },
                });
            }
            if best.is_none_or(|best| run.1 < best.1) {
                best = Some(run);
            }
        }
        before = *run;
    }
    best.map(|best| Cost {
        integrations: best.0,
        bound: Bound::MoreThan,
    })
}

fn interpolated(coarse: (f64, f64), fine: (f64, f64), error: f64) -> Cost {
    let share = (coarse.1 / error).ln() / (coarse.1 / fine.1.max(f64::MIN_POSITIVE)).ln();
    let logarithm = coarse.0.ln() + share * (fine.0 / coarse.0).ln();
    Cost {
        integrations: logarithm.exp(),
        bound: Bound::Interpolated,
    }
}

/// A setting with its cost.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cheapest {
    /// Name of the setting.
    pub setting: String,
    /// Its cost.
    pub cost: Cost,
}

/// The cheapest setting; one that reaches the error comes before all that do not.
pub fn cheapest(costs: impl Iterator<Item = (String, Option<Cost>)>) -> Option<Cheapest> {
    let known = costs.filter_map(|(setting, cost)| {
        let cost = cost?;
        Some(Cheapest { setting, cost })
    });
    let rank = |own: &Cheapest| (own.cost.bound == Bound::MoreThan, own.cost.integrations);
    known.min_by(|one, other| {
        let ((one_fails, one), (other_fails, other)) = (rank(one), rank(other));
        one_fails.cmp(&other_fails).then(one.total_cmp(&other))
    })
}

/// A ratio of costs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Ratio {
    /// Its value.
    pub value: f64,
    /// How well it is known.
    pub bound: Bound,
}

/// How many times the integrations of `other` are needed; `None` if nothing can be said.
pub fn ratio(own: Cost, other: Cost) -> Option<Ratio> {
    let value = own.integrations / other.integrations;
    let bound = match (own.bound, other.bound) {
        (Bound::Interpolated, Bound::Interpolated) => Bound::Interpolated,
        (Bound::Interpolated | Bound::AtMost, Bound::Interpolated | Bound::MoreThan) => {
            Bound::AtMost
        }
        (Bound::Interpolated | Bound::MoreThan, Bound::Interpolated | Bound::AtMost) => {
            Bound::MoreThan
        }
        _ => return None,
    };
    Some(Ratio { value, bound })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Between (100, 1e-2) and (1600, 1e-6) the cost grows by 2 for every factor 10 of the error.
    #[test]
    fn between_runs_the_logarithms_are_linear() {
        let runs = [
            None,
            Some((100.0, 1e-2)),
            Some((1600.0, 1e-6)),
            Some((3200.0, 3e-6)),
        ];
        let cost = |error| cost_of(&runs, error).unwrap();
        for (error, integrations) in [(1e-3, 200.0), (1e-4, 400.0), (1e-5, 800.0), (1e-6, 1600.0)] {
            let found = cost(error);
            assert_eq!(found.bound, Bound::Interpolated);
            assert!(
                (found.integrations / integrations - 1.0).abs() < 1e-12,
                "{found:?}"
            );
        }
        let bounded = |integrations, bound| Cost {
            integrations,
            bound,
        };
        assert_eq!(cost(2e-2), bounded(100.0, Bound::AtMost));
        assert_eq!(cost(1e-7), bounded(1600.0, Bound::MoreThan));
        assert_eq!(cost_of(&[None, None], 1e-3), None);
    }

    /// A run that diverged stands between: nothing is interpolated over it.
    #[test]
    fn a_gap_is_not_bridged() {
        let runs = [Some((100.0, 1e-2)), None, Some((1600.0, 1e-6))];
        let found = cost_of(&runs, 1e-4).unwrap();
        assert_eq!((found.integrations, found.bound), (1600.0, Bound::AtMost));
    }

    #[test]
    fn the_cheapest_setting_is_one_that_gets_there() {
        let cost = |integrations, bound| {
            Some(Cost {
                integrations,
                bound,
            })
        };
        let costs = [
            ("poor", cost(10.0, Bound::MoreThan)),
            ("good", cost(300.0, Bound::Interpolated)),
            ("better", cost(200.0, Bound::AtMost)),
            ("diverged", None),
        ];
        let named = costs.map(|(name, cost)| (name.to_owned(), cost));
        assert_eq!(cheapest(named.into_iter()).unwrap().setting, "better");
        let [own, other] = [(50.0, Bound::Interpolated), (5000.0, Bound::MoreThan)];
        let of = |(integrations, bound)| Cost {
            integrations,
            bound,
        };
        let (value, bound) = (0.01, Bound::AtMost);
        assert_eq!(ratio(of(own), of(other)), Some(Ratio { value, bound }));
        assert_eq!(ratio(of(other), of(other)), None);
    }
}
