//! The report of a run: a summary to read and `run.json` to process.

mod contacts;
mod worst;

use std::fmt::Write;

use linchpin_master::results::{DegreeStatistics, MomentsOf, Statistics, StepStatistics, Warning};
use linchpin_master::scene::Scene;
use serde::Serialize;

use super::Recording;
use crate::animation::Motion;
use crate::error_norm::{ColumnError, ErrorMeter};
use worst::{Worst, write_more, write_residuals};

/// What a run tells.
pub struct RunReport {
    /// Counts, times, residuals; those up to where it stopped, and none if it has not started.
    pub statistics: Option<Statistics>,
    /// Errors against the closed form, if the scene has one.
    pub errors: Option<ErrorMeter>,
    /// Series and marks for the picture; absent before the first row.
    pub recording: Option<Recording>,
    /// Positions of the markers, if they were asked for.
    pub motion: Option<Motion>,
    /// Time of the whole run in s.
    pub wall_time: f64,
}

/// The numbers of a run in `run.json`.
#[derive(Serialize)]
struct Results<'a> {
    wall_time: f64,
    /// Absent if the run has not started.
    statistics: Option<&'a Statistics>,
    /// Ends of macro steps that were repeated with a shorter one before (s), of very many some.
    rejections: Vec<f64>,
    /// What speaks against the results.
    warnings: Vec<String>,
    errors: Vec<ColumnErrorJson<'a>>,
}

#[derive(Serialize)]
struct ColumnErrorJson<'a> {
    column: &'a str,
    /// Root mean square over that of the exact solution; absent if the exact solution is 0 and this is not.
    normalised: Option<f64>,
    largest: f64,
}

impl RunReport {
    /// The numbers for `run.json`.
    pub fn results(&self) -> impl Serialize {
        let errors = self.errors.iter().flat_map(ErrorMeter::errors);
        let recording = self.recording.iter();
        Results {
            rejections: recording.flat_map(|own| own.rejections.times()).collect(),
            wall_time: self.wall_time,
            statistics: self.statistics.as_ref(),
            warnings: self.warnings().iter().map(ToString::to_string).collect(),
            errors: errors.map(as_json).collect(),
        }
    }

    /// What speaks against the results.
    pub fn warnings(&self) -> Vec<Warning> {
        let statistics = self.statistics.as_ref();
        statistics.map_or_else(Vec::new, Statistics::warnings)
    }

    /// A summary of about a dozen lines.
    pub fn summary(&self, scene: &Scene, case: Option<&str>) -> String {
        let mut text = String::new();
        if let Some(statistics) = &self.statistics {
            // Writing to a string does not fail.
            let _ = self.write_summary(scene, case, statistics, &mut text);
        }
        text
    }

    fn write_summary(
        &self,
        scene: &Scene,
        case: Option<&str>,
        statistics: &Statistics,
        text: &mut String,
    ) -> std::fmt::Result {
        let case = case.map(|case| format!(" [{case}]")).unwrap_or_default();
        let t_end = scene.t_end;
        let speed = (t_end - scene.t_start) / self.wall_time;
        writeln!(
            text,
            "{}{case}: reached t = {t_end} s in {:.3} s ({speed:.3} x real time)",
            scene.name, self.wall_time
        )?;
        let errors = self.errors.iter().flat_map(ErrorMeter::errors);
        let errors = Worst::of(errors, |(_, error)| error.normalised());
        for (column, error) in errors.shown {
            writeln!(
                text,
                "  error of {column:<22} {:>10} relative (rms), {:>10.3e} largest",
                relative(error),
                error.largest()
            )?;
        }
        write_more(errors.more, "errors, all smaller", text)?;
        let velocities = Worst::of(&statistics.free_velocities, |own| {
            (own.found - own.given).abs()
        });
        for velocity in velocities.shown {
            let name = format!("{}.{}", velocity.subsystem, velocity.parameter);
            writeln!(
                text,
                "  start with {name:<21} {:>10.6} chosen, {} given",
                velocity.found, velocity.given
            )?;
        }
        write_more(velocities.more, "velocities, all changed by less", text)?;
        let fitted = Worst::of(&statistics.fitted_joints, |own| own.shift.max(own.turn));
        for own in fitted.shown {
            writeln!(
                text,
                "  joint {:<26} shifted by {:.1e} m, turned by {:.1e} rad at b, to meet the start",
                own.joint, own.shift, own.turn
            )?;
        }
        write_more(fitted.more, "joints, all fitted by less", text)?;
        write_residuals(&statistics.joints, text)?;
        let verdicts = &statistics.verdicts;
        writeln!(
            text,
            "  macro steps  {:>10}   good {}, fair {}, poor {}, without corrector {}",
            statistics.macro_steps,
            verdicts.good,
            verdicts.fair,
            verdicts.poor,
            verdicts.uncorrected
        )?;
        if let Some(errors) = &statistics.estimated_errors {
            writeln!(
                text,
                "  estimated     {:>9.2e}   of the motion the largest error of a step, {:.2e} all together",
                errors.largest, errors.accumulated
            )?;
        }
        if let Some(steps) = &statistics.steps {
            write_steps(steps, text)?;
        }
        if let Some(degrees) = &statistics.degrees {
            write_degrees(degrees, text)?;
        }
        if let Some(moments) = &statistics.moments {
            write_moments(moments, text)?;
        }
        writeln!(text, "  exchanges    {:>10}", statistics.exchanges)?;
        writeln!(
            text,
            "  integrations {:>10}   {} internal solver steps",
            statistics.integrations, statistics.solver_steps
        )?;
        write_causes(statistics, text)?;
        let subsystems = Worst::of(&statistics.subsystems, |own| own.time_in_solver);
        for subsystem in subsystems.shown {
            writeln!(
                text,
                "    {:<20} {} ({:.3} s in its solver)",
                subsystem.subsystem, subsystem.route, subsystem.time_in_solver
            )?;
        }
        write_more(
            subsystems.more,
            "subsystems, all with less time in their solvers",
            text,
        )?;
        contacts::write(scene, statistics, text)?;
        // Steps that vary follow the error, whatever they resolve.
        if statistics.steps.is_none() {
            write_unresolved(statistics, text)?;
        }
        let around = self.wall_time - statistics.time_total;
        let exchanging = statistics.time_total - statistics.time_solving;
        write!(
            text,
            "  time: exchanges {exchanging:.3} s, coupling equations {:.3} s, start, results and end {around:.3} s",
            statistics.time_solving
        )
    }
}

/// Which conditions are served by what.
fn write_moments(moments: &MomentsOf, text: &mut String) -> std::fmt::Result {
    let kinds = [
        ("integrals over the step", &moments.integrals),
        ("instants inside it", &moments.instants),
    ];
    for (kind, names) in kinds {
        if !names.is_empty() {
            writeln!(text, "  moments from {kind}: {}", names.join(", "))?;
        }
    }
    Ok(())
}

/// Subsystems with springs or dampers that act within a macro step.
fn write_unresolved(statistics: &Statistics, text: &mut String) -> std::fmt::Result {
    let subsystems = statistics.subsystems.iter();
    let unresolved = subsystems.filter_map(|own| Some((&own.subsystem, own.unresolved?)));
    let unresolved = Worst::of(unresolved, |(_, factor)| *factor);
    for (subsystem, factor) in unresolved.shown {
        writeln!(
            text,
            "  not resolved {subsystem:<20} its responses over a macro step are off those of inertia by a factor of {factor:.1e} (aliasing): \
             choose a smaller coupling.macro_step, or coupling.tolerance"
        )?;
    }
    write_more(
        unresolved.more,
        "not resolved, all by smaller factors",
        text,
    )
}

/// What the integrations were for, and how often the corrector had to work twice.
fn write_causes(statistics: &Statistics, text: &mut String) -> std::fmt::Result {
    let causes = &statistics.integrations_by_cause;
    let corrections = &statistics.corrections;
    writeln!(
        text,
        "    predictor {}, columns {} (in {} macro steps), passes {}, corrector {}, samples {}",
        causes.predictor,
        causes.columns,
        corrections.steps_with_columns,
        causes.passes,
        causes.corrector,
        causes.samples
    )?;
    if corrections.steps_with_impacts > 0 {
        writeln!(
            text,
            "    in {} macro steps with impacts that partners took part in: {} more",
            corrections.steps_with_impacts, causes.impacts
        )?;
    }
    if causes.sum() != statistics.integrations {
        writeln!(
            text,
            "    the workers report {}, the master asked for {}: a worker counts otherwise or repeats its work",
            statistics.integrations,
            causes.sum()
        )?;
    }
    if corrections.unconverged > 0 {
        writeln!(
            text,
            "  not converged {:>9}   macro steps; slowest rate {:.2e}, most passes {}",
            corrections.unconverged, corrections.slowest_rate, corrections.most_passes
        )?;
    }
    if corrections.limited > 0 {
        writeln!(
            text,
            "  limited       {:>9}   macro steps do not resolve a multiplier: its top condition was relaxed",
            corrections.limited
        )?;
    }
    Ok(())
}

fn write_steps(steps: &StepStatistics, text: &mut String) -> std::fmt::Result {
    write!(text, "  rejected     {:>10}", steps.rejected)?;
    let causes = &steps.rejected_by_cause;
    for (count, cause) in [
        (causes.not_converged, "not converged"),
        (causes.failed, "failed"),
    ] {
        if count > 0 {
            write!(text, " ({count} {cause})")?;
        }
    }
    for (what, step) in [("shortest", steps.shortest), ("longest", steps.longest)] {
        if let Some(step) = step {
            write!(
                text,
                "   {what} step {:.3e} s at t = {:.6} s",
                step.length, step.t
            )?;
        }
    }
    writeln!(text)
}

/// How many macro steps had which degree.
fn write_degrees(degrees: &DegreeStatistics, text: &mut String) -> std::fmt::Result {
    let groups = [
        ("multipliers", degrees.multipliers),
        ("exchanged variables", degrees.exchanged),
    ];
    for (what, steps) in groups {
        let Some(steps) = steps else { continue };
        write!(text, "    degree of {what:<20}")?;
        for (degree, steps) in steps.iter().enumerate() {
            write!(text, "   {degree}: {steps}")?;
        }
        writeln!(text)?;
    }
    Ok(())
}

/// The relative error of a column for a reader; `-` if there is no size that it could be relative to.
fn relative(error: &ColumnError) -> String {
    let normalised = error.normalised();
    if normalised.is_finite() {
        format!("{normalised:.3e}")
    } else {
        "-".to_owned()
    }
}

fn as_json<'a>((column, error): (&'a str, &'a ColumnError)) -> ColumnErrorJson<'a> {
    ColumnErrorJson {
        column,
        normalised: Some(error.normalised()).filter(|norm| norm.is_finite()),
        largest: error.largest(),
    }
}
