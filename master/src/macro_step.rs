//! One macro step, from `T_N` to `T_{N+1}`.
//!
//! What the workers foresee at the end of the step came with the exchange before. So a step is corrected before any worker takes it,
//! and one exchange both advances over it and looks ahead over the following one. Where steps vary, a step that is rejected is tried
//! again, shorter, by another look-ahead from the same macro point: but for what the rejection decides, columns, degrees and histories that
//! start anew at a jump, nothing that lasts is changed before a step is accepted.
//!
//! * `advance`: the exchange;
//! * `correcting`: prediction, look-ahead and correction, and what they teach;
//! * `foreseeing`: how far the step goes, which its error is compared with;
//! * `jacobian`: conditions and the workers' responses, linearised;
//! * `impacts`: impulses through the joints;
//! * `impulses`: what of them goes to partners;
//! * `error`: the error of a step, and with it the degrees of the next one;
//! * `unresolved`: signals that the step does not resolve;
//! * `singular`: positions that do not determine the multipliers;
//! * `rejection`: what may stand against a step;
//! * `run`: what takes part.

mod advance;
mod correcting;
mod error;
mod foreseeing;
mod impacts;
mod impulses;
mod jacobian;
mod rejection;
mod run;
mod singular;
mod unresolved;

pub(crate) use advance::reach;
pub(crate) use correcting::{Corrector, State as CorrectorState};
pub(crate) use impacts::{Colliding, Impacts};
pub(crate) use jacobian::{Jacobian, PointJacobian};
pub(crate) use run::Run;

use crate::accuracy::Estimate;
use crate::error::RunError;
use crate::policies::iteration::IterationControl;
use crate::policies::singular_positions::Approach;
use crate::results::{Outcome, Passes, Verdict};
use crate::time::MacroStep;
use advance::advance;
use correcting::check_finite;
use rejection::Rejection;

/// From `T_N` to `T_{N+1}`, in a step that is not longer than `first`.
pub(crate) fn macro_step(run: &mut Run, first: MacroStep) -> Result<Outcome, RunError> {
    let mut outcome = Outcome::of_step(first);
    let accepted = loop {
        match attempt(run, &mut outcome, first.length) {
            Ok(accepted) => break accepted,
            Err(rejection) => repeat(run, rejection, &mut outcome)?,
        }
    };
    let step = outcome.step;
    outcome.has_impact = accepted.has_impact;
    outcome.is_unsolved = accepted.is_unsolved;
    let wish = accept(run, step, accepted);
    let following = run.plan.following(wish);
    advance(run, step, following)?;
    run.plan.move_on(following);
    check(run, step, &mut outcome)?;
    Ok(outcome)
}

/// What an accepted step leaves behind.
struct Accepted {
    /// How its corrections went.
    iteration: IterationControl,
    /// Its error, and the one that it would have had with the degrees of the next one, where the length or the degrees follow it.
    estimates: Option<[Estimate; 2]>,
    /// Its error relative to what is bearable; not known without a corrector, and where an exchanged variable has jumped.
    error: Option<Estimate>,
    /// Whether an exchanged variable has jumped.
    has_jumped: bool,
    /// Whether there was an impact in it.
    has_impact: bool,
    /// Whether it is taken with an error that is larger than allowed, near a singular position.
    is_unsolved: bool,
}

/// Corrects the step as often as it takes. Where steps vary its error must be small enough at the first correction: later ones change
/// what the error belongs to, and cost exchanges.
///
/// A step that was `longest` (s) at the first attempt is no more shortened for the error of an impact in it where it has become so much shorter
/// that it is the impact's own.
fn attempt(run: &mut Run, outcome: &mut Outcome, longest: f64) -> Result<Accepted, Rejection> {
    let step = outcome.step;
    let mut iteration = run.iteration;
    let mut estimates = None;
    let refusal = run.refusal.take();
    let Some((mut own, mut policies)) = run.correcting() else {
        run.method.predict(step.length);
        return Ok(Accepted {
            iteration,
            estimates,
            error: None,
            has_jumped: false,
            has_impact: false,
            is_unsolved: false,
        });
    };
    if let Some(error) = refusal {
        return Err(error.into());
    }
    let has_impact = own.meets_impacts();
    if has_impact {
        own.couple_impacts(step, &mut iteration, policies.degrees.as_deref_mut())?;
    }
    outcome.solving += own.correct(step)?;
    let (mut has_jumped, mut is_unsolved) = (has_impact, false);
    let step_size = policies.step_size.as_deref();
    if let Some(step_size) = step_size {
        let found = own.error(step, step_size.tolerance(), [None, None]);
        let next = own.choose_degrees(policies.degrees.as_deref_mut(), step, step_size, &found);
        let may_be_shorter = !has_impact || step_size.may_follow_impact(step, longest);
        if may_be_shorter && step_size.is_too_long(step, &found) {
            return Err(Rejection::by_error(
                own.layout,
                step,
                step_size,
                [found, next],
            ));
        }
        is_unsolved = step_size.is_best_of(step);
        has_jumped |= step_size.is_jump(step, &found);
        estimates = Some([found, next]);
    }
    own.foresee(policies.errors);
    let error = own.likely_error(step, policies.errors);
    let tolerance = policies.tolerance();
    own.begin(&mut iteration, step, tolerance);
    // A step with an impact has taken two more exchanges, and has new columns.
    let may_pass = !has_impact || iteration.has_rule();
    while let Some(with_columns) = iteration.next_pass().filter(|_| may_pass) {
        own.look_again(step, with_columns)?;
        outcome.solving += own.correct(step)?;
        iteration.note_pass(own.size_of_change(step, tolerance), with_columns);
    }
    match iteration.check() {
        // The best attempt near a singular position is taken if its corrections come nearer.
        Err(because) if !is_unsolved || because.rate >= 1.0 => {
            return Err(Rejection::not_converged(own.layout, step, because));
        }
        _ => {}
    }
    Ok(Accepted {
        iteration,
        estimates,
        error: Some(error).filter(|_| !has_jumped),
        has_jumped,
        has_impact,
        is_unsolved,
    })
}

/// Looks ahead over a shorter step from the same macro point, if the rejection allows one.
fn repeat(run: &mut Run, rejection: Rejection, outcome: &mut Outcome) -> Result<(), RunError> {
    let correcting = run.correcting();
    let singular = correcting.and_then(|(own, _)| own.singular_position());
    let repetition = rejection.repetition(run.step_size.as_mut(), outcome.step, singular)?;
    if let Some((mut own, policies)) = run.correcting().filter(|_| repetition.has_jumped) {
        own.restart(policies.degrees);
    }
    outcome.step = run.plan.shorten(repetition.length);
    look_ahead(run, outcome.step, None)
}

/// A look-ahead from the present macro point over `step`, without an advance, with new columns or as they are needed. Where steps vary the
/// next attempt at the step learns what has become of it.
pub(crate) fn look_ahead(
    run: &mut Run,
    step: MacroStep,
    with_columns: Option<bool>,
) -> Result<(), RunError> {
    let mut iteration = run.iteration;
    let Some((mut own, _)) = run.correcting() else {
        return Ok(());
    };
    own.workers.forgo_advance();
    own.predict(step);
    let with_columns = with_columns.unwrap_or_else(|| own.decide_columns(&mut iteration, step));
    let requested = own.request_prediction(step, with_columns);
    let looked = requested.and_then(|()| own.look(step));
    let varies = own.varies;
    run.iteration = iteration;
    match looked {
        Err(error) if varies && error.may_vanish_with_a_shorter_step() => {
            run.refusal = Some(error);
            Ok(())
        }
        looked => looked,
    }
}

/// Takes the step; the length of the next one.
fn accept(run: &mut Run, step: MacroStep, accepted: Accepted) -> f64 {
    run.iteration = accepted.iteration;
    run.iteration.accept(step);
    if accepted.has_impact {
        run.iteration.pass_impact();
    }
    let mut columns = 0.0;
    let mut approach = Approach::default();
    if let Some((mut own, policies)) = run.correcting() {
        approach = own.note_position(step, accepted.has_impact, accepted.is_unsolved);
        let workers = &mut *own.workers;
        let layout = own.layout;
        own.method
            .lend(&mut |curves, _| workers.request_advance(layout, step, curves));
        if accepted.has_jumped {
            own.method.restart_exchanged();
        }
        if accepted.has_impact {
            own.method.restart();
        }
        own.accept(policies.degrees);
        columns = own.cost_of_columns();
        if let Some(error) = &accepted.error {
            policies.errors.accept(layout, step, error);
        }
    }
    run.iteration
        .approach_singular_position(approach.needs_columns);
    let wish = match (&mut run.step_size, accepted.estimates) {
        (Some(step_size), _) if accepted.has_impact => step_size.pass_break(step),
        (Some(step_size), _) if accepted.has_jumped => step_size.pass_jump(step),
        (Some(step_size), Some([found, next])) => {
            step_size.accept(step, &next, next == found, columns)
        }
        _ => step.length,
    };
    wish.max(approach.least)
}

/// What the workers have reached: tells the method, compares it with what was promised, and learns from the difference.
fn check(run: &mut Run, step: MacroStep, outcome: &mut Outcome) -> Result<(), RunError> {
    outcome.solving += reach(run, step)?;
    let mut iteration = run.iteration;
    match run.correcting() {
        Some((mut own, policies)) => {
            let is_limited = own.method.is_limited();
            outcome.verdict = own.judge();
            if is_limited {
                outcome.verdict = outcome.verdict.max(Verdict::Fair);
            }
            if iteration.learns() || own.method.tells_error() {
                let fresh = iteration.has_fresh_columns();
                let missed = own.learn(step, fresh, policies.tolerance());
                // Where the scene says what is allowed, corrections may miss a part of their aim that is less.
                let of_scene = missed.of_allowed.filter(|_| policies.of_scene().is_some());
                outcome.missed = of_scene.map(|missed| if missed > 1.0 { missed } else { 0.0 });
                outcome.verdict = match missed.of_allowed {
                    Some(missed) if missed > 1.0 => Verdict::Poor,
                    Some(_) if of_scene.is_some() => outcome.verdict.min(Verdict::Fair),
                    _ => outcome.verdict,
                };
                iteration.learn(missed);
            }
            if outcome.is_unsolved {
                outcome.verdict = Verdict::Poor;
            }
            outcome.passes = Passes {
                is_limited,
                ..iteration.passes()
            };
        }
        None => check_finite(run.method.ends(), &run.layout, step)?,
    }
    run.iteration = iteration;
    Ok(())
}
