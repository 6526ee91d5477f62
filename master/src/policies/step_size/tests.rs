//! The controller of the step size, without a run.

use proptest::prelude::*;

use super::*;
use crate::accuracy::Suspect;
use crate::joint::Level;
use crate::layout::{Coupled, Layout};
use crate::system::Outputs;

struct Nothing;

impl Outputs for Nothing {
    fn of(&self, _subsystem: usize) -> &[f64] {
        &[]
    }
}

const FIRST: f64 = 3e-3;

fn controller() -> StepSize {
    let control = StepControl {
        tolerance: 1e-6,
        absolute_tolerance: Some(1e-9),
        least_step: 1e-8,
        greatest_step: 1.0,
    };
    let coupled = Coupled {
        subsystems: Vec::new(),
        forms: Vec::new(),
        joints: &[],
        connections: &[],
    };
    let Ok(layout) = Layout::new(&coupled, Level::Position) else {
        unreachable!("nothing lacks nothing")
    };
    let tolerance = Tolerance::new(1e-6, [1e-9; 2], &layout, Vec::new(), &Nothing);
    StepSize::new(Rule::Free, control, [FIRST, 1e3], tolerance)
}

fn step(length: f64) -> MacroStep {
    MacroStep {
        start: 0.5,
        length,
        end: 0.5 + length,
    }
}

fn estimate(scaled: f64, order: usize, change: f64) -> Estimate {
    Estimate {
        is_of_step_alone: false,
        scaled,
        order,
        suspect: Suspect::None,
        change,
    }
}

fn error(found: Estimate) -> Cause {
    Cause::Error { found, next: found }
}

/// How far a length is from the next one of the grid, in parts of the distance between them.
fn off_the_grid(length: f64) -> f64 {
    let place = SETTINGS.lengths_per_octave * (length / FIRST).log2();
    (place - place.round()).abs()
}

proptest! {
    #[test]
    fn an_accepted_step_is_followed_by_one_of_the_grid_that_grows_by_two_at_most(
        scaled in 1e-12f64..1.0,
        order in 1usize..7,
        octaves in -10i32..5,
    ) {
        let length = FIRST * f64::from(octaves).exp2();
        let next = controller().accept(step(length), &estimate(scaled, order, 0.0), true, 0.0);
        prop_assert!(next <= 2.0 * length * (1.0 + 1e-12) && next >= 0.09 * length);
        prop_assert!(off_the_grid(next) < 1e-6, "{next}");
    }

    /// With the power that the estimate tells, the error of the repeated step would be allowed.
    #[test]
    fn a_rejected_step_is_repeated_with_an_error_that_is_allowed(
        scaled in 1.001f64..1e5,
        order in 1usize..7,
    ) {
        let found = estimate(scaled, order, 1.0);
        let repetition = controller().repeat(step(0.1), error(found), None).unwrap();
        let ratio = repetition.length / 0.1;
        prop_assert!((0.09..=SETTINGS.safety).contains(&ratio));
        let shrunk_as_far_as_allowed = ratio < 0.101;
        prop_assert!(scaled * ratio.powi(order as i32) <= 1.0 || shrunk_as_far_as_allowed);
        prop_assert!(!repetition.has_jumped);
    }
}

#[test]
fn a_step_after_a_rejected_one_does_not_grow() {
    let mut own = controller();
    let length = own
        .repeat(step(0.1), error(estimate(50.0, 3, 1.0)), None)
        .unwrap()
        .length;
    let next = own.accept(step(length), &estimate(1e-9, 3, 0.0), true, 0.0);
    assert!(next <= length);
    assert!(own.accept(step(next), &estimate(1e-9, 3, 0.0), true, 0.0) > next);
}

#[test]
fn a_change_that_does_not_fall_with_the_step_is_a_jump() {
    let mut own = controller();
    let mut repeat = |length: f64, change: f64| {
        let found = estimate(9.0, 2, change);
        own.repeat(step(length), error(found), None)
            .unwrap()
            .has_jumped
    };
    assert!(!repeat(0.08, 1.0));
    assert!(repeat(0.02, 0.9));
    let mut own = controller();
    let mut repeat = |length: f64, change: f64| {
        let found = estimate(9.0, 2, change);
        own.repeat(step(length), error(found), None)
            .unwrap()
            .has_jumped
    };
    assert!(!repeat(0.08, 1.0));
    assert!(!repeat(0.02, 0.25));
}

#[test]
fn after_a_failure_steps_stay_below_the_length_that_failed() {
    let mut own = controller();
    let failed = 0.4;
    let mut length = own
        .repeat(step(failed), Cause::Failed, None)
        .unwrap()
        .length;
    assert!(length <= SETTINGS.failed * failed);
    for _ in 0..SETTINGS.careful_steps {
        length = own.accept(step(length), &estimate(1e-9, 3, 0.0), true, 0.0);
        assert!(length <= failed / SETTINGS.most_growth, "{length}");
    }
    for _ in 0..3 {
        length = own.accept(step(length), &estimate(1e-9, 3, 0.0), true, 0.0);
    }
    assert!(length > failed / SETTINGS.most_growth, "{length}");
}

#[test]
fn the_least_step_is_not_repeated_and_every_rejection_is_counted() {
    let mut own = controller();
    assert_eq!(own.repeat(step(1e-8), Cause::Failed, None), None);
    own.repeat(step(1e-3), Cause::NotConverged(Some(0.5)), None);
    own.repeat(step(1e-3), error(estimate(2.0, 2, 1.0)), None);
    let counted = own.statistics().unwrap();
    assert_eq!(counted.rejected, 2);
    let causes = counted.rejected_by_cause;
    assert_eq!(
        (causes.error, causes.not_converged, causes.failed),
        (1, 1, 0)
    );
}
