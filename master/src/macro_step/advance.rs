//! The exchange of a macro step: advance over it, look-ahead over the following one.

use std::time::{Duration, Instant};

use super::jacobian::PointJacobian;
use super::rejection::singular;
use super::run::Run;
use crate::error::RunError;
use crate::methods::{Order, Reached};
use crate::time::MacroStep;
use crate::workers::Ahead;

/// Lets all workers advance over `step`, and look ahead over the `following` one in the same exchange.
pub fn advance(
    run: &mut Run,
    step: MacroStep,
    following: Option<MacroStep>,
) -> Result<(), RunError> {
    let mut iteration = run.iteration;
    let Some((mut own, _)) = run.correcting() else {
        return advance_alone(run, step);
    };
    match following {
        Some(following) => {
            own.method.expect_rate(iteration.rate());
            own.predict(following);
            let with_columns = own.decide_columns(&mut iteration, following);
            own.request_prediction(following, with_columns)?;
        }
        None => own.forgo_look(),
    }
    let refusal = match own.varies {
        true => own.workers.try_advance(step)?,
        false => own.workers.exchange(step).map(|()| None)?,
    };
    run.refusal = refusal;
    run.iteration = iteration;
    Ok(())
}

/// Lets all workers advance over `step`, at once or one after the other, and evaluates the conditions at its end if the method wants them.
fn advance_alone(run: &mut Run, step: MacroStep) -> Result<(), RunError> {
    let Run {
        layout,
        workers,
        method,
        point,
        ..
    } = run;
    if let Some(point) = point {
        point.request(workers, layout, &**method, step.end);
    }
    match method.order() {
        Order::Jacobi => {
            method.lend(&mut |curves, _| workers.request_advance(layout, step, curves));
            workers.exchange(step)?;
        }
        Order::GaussSeidel => {
            workers.find_samples(step);
            for number in 0..workers.subsystems.len() {
                method.lend(&mut |curves, _| {
                    workers.request_advance_of(layout, number, step, curves);
                });
                workers.exchange_with(number, step)?;
                method.advanced(layout, number, &workers.now());
            }
        }
    }
    method.accept();
    Ok(())
}

/// Tells the method that the workers stand at the end of `step`. The time that it took to solve the conditions there.
pub fn reach(run: &mut Run, step: MacroStep) -> Result<Duration, RunError> {
    let started = Instant::now();
    let Run {
        layout,
        workers,
        method,
        point,
        ..
    } = run;
    if let (Some(point), Some(held)) = (point.as_mut(), method.held()) {
        point.linearise(layout, &workers.looked(Ahead::Now), held);
    }
    let reached = Reached {
        layout,
        outputs: &workers.now(),
        point: point.as_mut().map(PointJacobian::system_mut),
    };
    let solved = method.reached(reached);
    solved.map_err(|row| singular(row, layout, step))?;
    Ok(started.elapsed())
}
