//! What a run that has come to its end must not be silent about.

use std::fmt;

use super::redundancy::Redundancy;
use super::singular_passages::SingularPassages;
use super::statistics::Statistics;

/// Share of the macro steps that may be poor, where a scene does not say what is allowed.
const MOST_POOR: f64 = 0.01;

/// What the corrections of poor steps may miss together, of what the scene allows for one step: a run may be off by as much.
const MOST_MISSED: f64 = 10.0;

/// The largest error of one macro step that is not worth a word, as a share of the motion.
const OF_STEP: f64 = 0.01;

/// The same where the steps do not resolve a subsystem, so that no estimate can be trusted.
const OF_UNRESOLVED_STEP: f64 = 3e-4;

/// The same of all steps together.
const OF_RUN: f64 = 0.1;

/// Why the results of a run may be wrong.
#[derive(Debug, Clone, PartialEq)]
pub enum Warning {
    /// Joints demand the same.
    Redundant(Redundancy),
    /// Positions in which the joints do not determine their loads, and macro steps there that are not as accurate as others.
    Singular(SingularPassages),
    /// The corrections of many macro steps have missed their aim.
    Poor {
        /// So many.
        steps: u64,
        /// Of so many.
        of: u64,
        /// By how much together, of what the scene allows for one step, where it does.
        missed: Option<f64>,
    },
    /// A macro step is estimated to be off by much.
    ErrorOfStep {
        /// By this share of the motion.
        error: f64,
        /// This quantity.
        of: String,
        /// From this time on in s.
        t: f64,
    },
    /// Equal steps do not resolve what a subsystem does, and are estimated to be off already.
    Unresolved {
        /// By this share of the motion.
        error: f64,
        /// The subsystem.
        subsystem: String,
    },
    /// All macro steps together are estimated to be off by much.
    ErrorOfRun {
        /// By this share of the motion.
        error: f64,
    },
}

impl Statistics {
    /// What speaks against the results.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut warnings = Vec::new();
        if self.redundancy.conditions > 0 {
            warnings.push(Warning::Redundant(self.redundancy.clone()));
        }
        let singular = self.singular_positions;
        if singular.count > 0 || singular.unsolved_steps > 0 {
            warnings.push(Warning::Singular(singular));
        }
        let (steps, of) = (self.verdicts.poor, self.macro_steps);
        let missed = self.corrections.missed;
        let is_much = match missed {
            Some(missed) => missed > MOST_MISSED,
            None => steps as f64 > MOST_POOR * of as f64,
        };
        if is_much {
            warnings.push(Warning::Poor { steps, of, missed });
        }
        let Some(errors) = &self.estimated_errors else {
            return warnings;
        };
        if errors.largest > OF_STEP {
            warnings.push(Warning::ErrorOfStep {
                error: errors.largest,
                of: errors.of.clone(),
                t: errors.t,
            });
        }
        let mut all = self.subsystems.iter();
        let unresolved = all.find(|own| self.steps.is_none() && own.unresolved.is_some());
        if let Some(own) = unresolved.filter(|_| errors.largest > OF_UNRESOLVED_STEP) {
            warnings.push(Warning::Unresolved {
                error: errors.largest,
                subsystem: own.subsystem.clone(),
            });
        }
        if errors.accumulated > OF_RUN {
            warnings.push(Warning::ErrorOfRun {
                error: errors.accumulated,
            });
        }
        warnings
    }
}

impl Warning {
    /// Whether it speaks against the results; redundant joints leave the motion as it is.
    pub fn is_against_results(&self) -> bool {
        !matches!(self, Self::Redundant(_))
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Redundant(Redundancy { conditions, joints }) => {
                let what = if *conditions == 1 {
                    "condition"
                } else {
                    "conditions"
                };
                write!(
                    f,
                    "the joints {} have {conditions} redundant {what}: how they share their loads is not determined, and the \
                     multipliers of least norm are taken; the motion does not depend on that",
                    joints.join(", ")
                )
            }
            Self::Singular(SingularPassages {
                count,
                first,
                unsolved_steps,
            }) => {
                match (count, first) {
                    (1, Some(t)) => write!(
                        f,
                        "the mechanism passes a singular position at t = {t:.6} s"
                    )?,
                    (_, Some(t)) => write!(
                        f,
                        "the mechanism passes {count} singular positions, the first time at t = {t:.6} s"
                    )?,
                    (_, None) => write!(f, "the mechanism comes near a singular position")?,
                }
                write!(
                    f,
                    ": there the joints do not determine their loads, and macro steps are less accurate than others"
                )?;
                match unsolved_steps {
                    0 => Ok(()),
                    _ => write!(
                        f,
                        "; {unsolved_steps} of them miss coupling.tolerance, since shorter ones are no better"
                    ),
                }
            }
            Self::Poor {
                steps,
                of,
                missed: Some(missed),
            } => write!(
                f,
                "{steps} of {of} macro steps are poor: their corrections missed their aim, together by {missed:.1e} times what \
                 coupling.tolerance allows for one step; choose a smaller coupling.greatest_step, or another coupling.degree"
            ),
            Self::Poor {
                steps,
                of,
                missed: None,
            } => write!(
                f,
                "{steps} of {of} macro steps are poor: their corrections missed their aim, so that results there are not to be \
                 trusted; choose a shorter coupling.macro_step, a coupling.tolerance, or coupling.iterations"
            ),
            Self::ErrorOfStep { error, of, t } => write!(
                f,
                "the macro step at t = {t:.6} s is estimated to be off by {} of the motion ({of}); choose a shorter \
                 coupling.macro_step or a coupling.tolerance",
                Percent(*error)
            ),
            Self::Unresolved { error, subsystem } => write!(
                f,
                "the macro steps do not resolve the springs and dampers of {subsystem} (aliasing), and a step is estimated to be off \
                 by {} of the motion or more; choose a shorter coupling.macro_step or a coupling.tolerance",
                Percent(*error)
            ),
            Self::ErrorOfRun { error } => write!(
                f,
                "the errors of all macro steps are estimated as {} of the motion together; choose a shorter \
                 coupling.macro_step or a smaller coupling.tolerance",
                Percent(*error)
            ),
        }
    }
}

/// A share in percent, with three digits.
struct Percent(f64);

impl fmt::Display for Percent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = 100.0 * self.0;
        if !(1e-2..1e4).contains(&percent) {
            return write!(f, "{percent:.2e} %");
        }
        // How many digits stand before the point.
        let whole = percent.log10().floor() as i32 + 1;
        write!(f, "{percent:.*} %", usize::try_from(3 - whole).unwrap_or(0))
    }
}

#[cfg(test)]
mod tests {
    use super::super::RunErrors;
    use super::super::statistics::Verdicts;
    use super::*;

    fn statistics(poor: u64, errors: Option<[f64; 2]>) -> Statistics {
        Statistics {
            macro_steps: 1000,
            verdicts: Verdicts {
                poor,
                good: 1000 - poor,
                ..Verdicts::default()
            },
            estimated_errors: errors.map(|[largest, accumulated]| RunErrors {
                largest,
                accumulated,
                of: "a.x".to_owned(),
                t: 0.25,
            }),
            ..Statistics::default()
        }
    }

    #[test]
    fn where_a_scene_says_what_is_allowed_poor_steps_count_by_what_they_miss() {
        let told = |poor: u64, missed: f64| {
            let mut statistics = statistics(poor, None);
            statistics.corrections.missed = Some(missed);
            let texts = statistics.warnings().into_iter();
            texts.map(|one| one.to_string()).collect::<Vec<_>>()
        };
        assert!(told(300, 9.0).is_empty());
        let texts = told(1, 1.5e3);
        assert_eq!(texts.len(), 1);
        assert!(
            texts[0].contains("1 of 1000") && texts[0].contains("1.5e3 times"),
            "{texts:?}"
        );
    }

    #[test]
    fn a_sound_run_is_not_warned_of() {
        assert!(statistics(0, None).warnings().is_empty());
        assert!(statistics(10, Some([1e-3, 0.05])).warnings().is_empty());
    }

    #[test]
    fn singular_positions_are_told_with_the_steps_that_they_spoil() {
        let told = |count: u64, unsolved_steps: u64| {
            let singular_positions = SingularPassages {
                count,
                first: (count > 0).then_some(0.71),
                unsolved_steps,
            };
            let warnings = Statistics {
                singular_positions,
                ..statistics(0, None)
            }
            .warnings();
            warnings.first().map(Warning::to_string)
        };
        assert_eq!(told(0, 0), None);
        let once = told(1, 0).unwrap();
        assert!(
            once.contains("a singular position at t = 0.710000 s") && !once.contains("tolerance"),
            "{once}"
        );
        let often = told(3, 2).unwrap();
        assert!(
            often.contains("3 singular positions, the first time at t = 0.710000 s"),
            "{often}"
        );
        assert!(
            often.contains("2 of them miss coupling.tolerance"),
            "{often}"
        );
        let near = told(0, 1).unwrap();
        assert!(near.contains("comes near a singular position"), "{near}");
    }

    #[test]
    fn what_is_wrong_is_told_with_place_and_value() {
        let all = statistics(11, Some([0.02, 0.3])).warnings();
        let texts: Vec<String> = all.iter().map(Warning::to_string).collect();
        let [poor, of_step, of_run] = &texts[..] else {
            panic!("{texts:?}");
        };
        assert!(poor.contains("11 of 1000"), "{poor}");
        assert!(
            of_step.contains("t = 0.250000 s")
                && of_step.contains("2.00 %")
                && of_step.contains("a.x"),
            "{of_step}"
        );
        assert!(of_run.contains("30.0 %"), "{of_run}");
    }
}
