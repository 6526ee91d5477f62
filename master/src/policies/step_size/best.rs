//! Attempts at a step near a singular position, where shorter ones need not be better.

use serde::{Deserialize, Serialize};

use super::settings::SETTINGS;
use crate::accuracy::SingularPosition;

/// The attempts at the present step so far.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Attempts {
    /// Length in s and scaled error of the best one.
    best: Option<(f64, f64)>,
    /// Attempts since then.
    in_vain: u32,
    /// The first length, once that of a step across the position is tried.
    first: Option<f64>,
    /// The length that is taken whatever its error is.
    taken: Option<f64>,
    /// How many such have come to nothing.
    failed: u32,
}

/// How a step near a singular position is repeated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Again {
    /// Shorter, as anywhere else.
    Shorter,
    /// With this length in s.
    With(f64),
    /// Not at all.
    Never,
}

impl Attempts {
    /// Takes an attempt of this `length` in s, which is rejected, with its scaled error if it has one. A length across the position is tried once,
    /// and the best attempt is taken where shorter ones are in vain or not allowed; where it comes to nothing, somewhat shorter ones.
    pub fn reject(&mut self, length: f64, error: Option<f64>, near: SingularPosition) -> Again {
        if let Some(taken) = &mut self.taken {
            self.failed += 1;
            *taken *= SETTINGS.safety;
            return match self.failed > SETTINGS.most_in_vain {
                true => Again::Never,
                false => Again::With(*taken),
            };
        }
        match (self.best, error) {
            (Some((_, best)), error) if error.is_none_or(|error| error >= best) => {
                self.in_vain += 1;
            }
            (_, Some(error)) => (self.best, self.in_vain) = (Some((length, error)), 0),
            (_, None) => {}
        }
        if let (None, Some(across)) = (self.first, near.across)
            && (near.least..SETTINGS.most_growth * length).contains(&across)
        {
            self.first = Some(length);
            return Again::With(across);
        }
        let is_shortest = self.shortest(length) * SETTINGS.safety < near.least;
        let best = self.best.map(|(length, _)| length);
        self.taken = best.filter(|_| is_shortest || self.in_vain >= SETTINGS.most_in_vain);
        self.taken.map_or(Again::Shorter, Again::With)
    }

    /// What a length in s has to become shorter than after an attempt with it.
    pub fn shortest(&self, length: f64) -> f64 {
        self.first.map_or(length, |first| first.min(length))
    }

    /// Whether a step of this length is taken whatever its error is.
    pub fn takes(&self, length: f64) -> bool {
        self.taken == Some(length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEAR: SingularPosition = SingularPosition {
        across: None,
        least: 1e-3,
    };

    #[test]
    fn the_best_attempt_is_taken_where_shorter_ones_are_in_vain() {
        let mut own = Attempts::default();
        assert_eq!(own.reject(1.0, Some(30.0), NEAR), Again::Shorter);
        assert_eq!(own.reject(0.5, Some(4.0), NEAR), Again::Shorter);
        assert_eq!(own.reject(0.25, Some(6.0), NEAR), Again::Shorter);
        assert_eq!(own.reject(0.125, None, NEAR), Again::Shorter);
        assert_eq!(own.reject(0.06, Some(5.0), NEAR), Again::With(0.5));
        assert!(own.takes(0.5) && !own.takes(0.06));
        // It fails after all: no step is tried for ever.
        for length in [0.5, 0.45, 0.405] {
            assert_eq!(own.reject(length, None, NEAR), Again::With(0.9 * length));
            assert!(own.takes(0.9 * length));
        }
        assert_eq!(own.reject(0.3645, None, NEAR), Again::Never);
    }

    #[test]
    fn a_step_across_the_position_is_tried_once() {
        let near = SingularPosition {
            across: Some(1.3),
            ..NEAR
        };
        let mut own = Attempts::default();
        assert_eq!(own.reject(1.0, Some(30.0), near), Again::With(1.3));
        assert_eq!(own.reject(1.3, Some(2.0), near), Again::Shorter);
        assert_eq!(own.shortest(1.3), 1.0);
        assert_eq!(own.reject(0.5, Some(3.0), near), Again::Shorter);
        assert_eq!(own.shortest(0.5), 0.5);
    }

    #[test]
    fn the_best_attempt_is_taken_where_none_may_be_shorter() {
        let mut own = Attempts::default();
        assert_eq!(own.reject(1.05e-3, None, NEAR), Again::Shorter);
        assert_eq!(own.reject(1.05e-3, Some(2.0), NEAR), Again::With(1.05e-3));
    }
}
