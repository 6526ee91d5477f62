//! Iterations and refreshes, without a run.

use super::*;

fn step(number: u32) -> MacroStep {
    MacroStep {
        start: f64::from(number),
        length: 0.125,
        end: f64::from(number) + 0.125,
    }
}

/// A correction of this size, relative to usual ones and to the variables.
fn change(size: f64) -> Change {
    Change {
        of_allowed: None,
        of_usual: size,
        of_size: size,
        variable: 0,
    }
}

/// Steps with columns that leave `rate` of every correction, until the control asks for new ones; the passes of each.
fn passes_until_refresh(rate: f64) -> Vec<u32> {
    let mut control = IterationControl::new(Jacobian::Reuse, None, false);
    let mut passes = Vec::new();
    for number in 0..6 {
        let found = (number > 0).then_some(0.0);
        let found = found.filter(|_| !control.needs_new_columns());
        let with_columns = control.decide_columns(step(number), found);
        if with_columns && number > 0 {
            break;
        }
        let mut last = 1.0;
        control.begin(change(last), number > 1, false);
        while let Some(renews) = control.next_pass() {
            assert!(!renews, "slow, but not too slow");
            last *= rate;
            control.note_pass(change(last), false);
        }
        control.accept(step(number));
        control.learn(Missed {
            of_allowed: None,
            by_last: last * rate,
            by_first: rate,
        });
        passes.push(control.passes().count);
    }
    passes
}

#[test]
fn new_columns_need_no_pass_and_old_ones_as_many_as_their_rate_takes() {
    // What is left has to be below 1e-4: with 1e-5 after one correction, with 0.05 after three more.
    let good = passes_until_refresh(1e-5);
    assert_eq!(good, [0, 1, 0, 0, 0, 0]);
    let fair = passes_until_refresh(0.05);
    assert_eq!(fair[..2], [0, 3]);
    assert_eq!(fair.len(), 6, "they stay in use: {fair:?}");
}

#[test]
fn columns_that_converge_slowly_are_asked_for_afresh() {
    let slow = passes_until_refresh(0.4);
    assert_eq!(slow.len(), 2, "{slow:?}");
}

#[test]
fn a_rate_above_one_half_renews_columns_within_the_step() {
    let mut control = IterationControl::new(Jacobian::Reuse, None, false);
    control.decide_columns(step(0), Some(0.0));
    control.begin(change(1.0), false, false);
    assert_eq!(control.next_pass(), Some(false));
    control.note_pass(change(0.8), false);
    assert_eq!(control.next_pass(), Some(true));
    control.note_pass(change(1e-6), true);
    assert_eq!(control.next_pass(), None);
    assert!(control.passes().with_columns && control.has_fresh_columns());
}

#[test]
fn a_step_that_does_not_converge_is_told_by_the_rule_of_the_scene() {
    for (otherwise, is_told, rejects) in [
        (Otherwise::Warn, false, false),
        (Otherwise::Fail, true, false),
        (Otherwise::Reject, true, true),
    ] {
        let iterations = Iterations {
            most: 2,
            tolerance: 1e-9,
            otherwise,
        };
        let mut control = IterationControl::new(Jacobian::EveryStep, Some(iterations), true);
        control.decide_columns(step(0), None);
        control.begin(change(1e-2), false, false);
        let mut size = 1e-2;
        while control.next_pass().is_some() {
            size *= 0.1;
            control.note_pass(change(size), false);
        }
        assert_eq!(control.passes().count, 2);
        assert!(control.passes().is_unconverged);
        let told = control.check().err();
        assert_eq!(told.is_some(), is_told);
        let Some(unconverged) = told else { continue };
        assert_eq!((unconverged.passes, unconverged.rejects), (2, rejects));
        assert!((unconverged.rate - 0.1).abs() < 1e-12);
        assert_eq!(unconverged.share.is_some(), rejects);
    }
}

/// A macro step works on a copy: one that is dropped leaves nothing.
#[test]
fn what_is_known_is_written_and_read_back() {
    let mut control = IterationControl::new(Jacobian::Reuse, None, true);
    control.decide_columns(step(0), None);
    control.begin(change(1.0), false, true);
    assert_eq!(
        control.next_pass(),
        Some(false),
        "a step without a past is corrected twice"
    );
    control.note_pass(change(0.03), false);
    control.accept(step(0));
    let mut other = IterationControl::new(Jacobian::Reuse, None, true);
    other.resume(control.state());
    assert_eq!(other, control);
}
