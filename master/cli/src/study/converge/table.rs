//! The numbers of a convergence study: as CSV and as text.

use std::fmt::Write as _;

use linchpin_master::results::Statistics;
use serde::Serialize;

use super::{CaseRuns, Ending, Quantity, StudyRun, least_squares, neighbouring};

/// One run as a row of `converge.csv`; what is not known is an empty field.
#[derive(Debug, Default, Serialize)]
struct Record<'a> {
    case: &'a str,
    macro_step: f64,
    outcome: &'a str,
    nrms_position: Option<f64>,
    nrms_velocity: Option<f64>,
    nrms_state: Option<f64>,
    nrms_lambda: Option<f64>,
    nrms_lambda_mid_step: Option<f64>,
    order_position: Option<f64>,
    order_velocity: Option<f64>,
    order_state: Option<f64>,
    order_lambda: Option<f64>,
    order_lambda_mid_step: Option<f64>,
    residual_position: Option<f64>,
    residual_velocity: Option<f64>,
    residual_acceleration: Option<f64>,
    integrations: Option<u64>,
    exchanges: Option<u64>,
    solver_steps: Option<u64>,
}

/// A row of `converge.csv` for each run.
pub fn rows(cases: &[CaseRuns]) -> impl Iterator<Item = impl Serialize> {
    cases.iter().flat_map(records)
}

fn records(case: &CaseRuns) -> Vec<Record<'_>> {
    let orders = Quantity::ALL.map(|quantity| neighbouring(&case.runs, quantity));
    let record = |(number, run): (usize, &StudyRun)| {
        let errors = Quantity::ALL.map(|quantity| run.error(quantity));
        let [position, velocity, state, lambda, lambda_mid_step] =
            orders.each_ref().map(|orders| orders[number]);
        let statistics = run.ending.statistics();
        let residual =
            |level| statistics.and_then(|statistics| largest_residual(statistics, level));
        Record {
            case: &case.case,
            macro_step: run.macro_step,
            outcome: outcome(&run.ending),
            nrms_position: errors[0],
            nrms_velocity: errors[1],
            nrms_state: errors[2],
            nrms_lambda: errors[3],
            nrms_lambda_mid_step: errors[4],
            order_position: position,
            order_velocity: velocity,
            order_state: state,
            order_lambda: lambda,
            order_lambda_mid_step: lambda_mid_step,
            residual_position: residual("position"),
            residual_velocity: residual("velocity"),
            residual_acceleration: residual("acceleration"),
            integrations: statistics.map(|statistics| statistics.integrations),
            exchanges: statistics.map(|statistics| statistics.exchanges),
            solver_steps: statistics.map(|statistics| statistics.solver_steps),
        }
    };
    case.runs.iter().enumerate().map(record).collect()
}

fn outcome(ending: &Ending) -> &'static str {
    match ending {
        Ending::Done { .. } => "done",
        Ending::Stopped(_) | Ending::Refused(_) => "diverged",
        Ending::Missing => "missing",
    }
}

fn largest_residual(statistics: &Statistics, level: &str) -> Option<f64> {
    let joints = statistics.joints.iter();
    let residuals = joints
        .filter(|joint| joint.level == level)
        .map(|joint| joint.largest);
    residuals.reduce(f64::max)
}

/// The study as a table for people: errors, each with its order, and the orders over all macro steps.
pub fn summary(cases: &[CaseRuns]) -> String {
    let mut text = String::new();
    for case in cases {
        // Writing to a String cannot fail.
        let _ = write_case(&mut text, case);
    }
    text
}

fn write_case(text: &mut String, case: &CaseRuns) -> std::fmt::Result {
    let quantities: Vec<Quantity> = Quantity::ALL
        .into_iter()
        .filter(|&quantity| case.runs.iter().any(|run| run.error(quantity).is_some()))
        .collect();
    let orders: Vec<_> = quantities
        .iter()
        .map(|&quantity| neighbouring(&case.runs, quantity))
        .collect();
    writeln!(text, "\n{}", case.case)?;
    write!(text, "{:>10}", "H in s")?;
    for quantity in &quantities {
        write!(text, "{:>16} order", quantity.name())?;
    }
    writeln!(text, "{:>14}", "integrations")?;
    for (number, run) in case.runs.iter().enumerate() {
        write!(text, "{:>10}", format!("{:.3e}", run.macro_step))?;
        match &run.ending {
            ending @ (Ending::Stopped(_) | Ending::Refused(_) | Ending::Missing) => {
                writeln!(text, "  {}", outcome(ending))?;
            }
            Ending::Done { statistics, .. } => {
                for (&quantity, orders) in quantities.iter().zip(&orders) {
                    let error = run.error(quantity).map(|error| format!("{error:.3e}"));
                    let order = orders[number].map(|order| format!("{order:.2}"));
                    let (error, order) = (error.unwrap_or_default(), order.unwrap_or_default());
                    write!(text, "{error:>16}{order:>6}")?;
                }
                writeln!(text, "{:>14}", statistics.integrations)?;
            }
        }
    }
    write!(text, "{:>10}", "all H")?;
    for &quantity in &quantities {
        let order = least_squares(&case.runs, quantity).map(|order| format!("{order:.2}"));
        write!(text, "{:>22}", order.unwrap_or_default())?;
    }
    writeln!(text)
}
