//! Counts, times and residuals of a run.

use std::time::Duration;

use linchpin_proto::polynomial::MAX_NODES;
use linchpin_proto::v1;
use serde::{Deserialize, Serialize};

use super::{
    FittedJoint, FreeVelocity, Integrations, MomentsOf, Outcome, Passes, Redundancy, Row,
    SingularPassages, StepDegrees, Verdict,
};
use crate::accuracy::RunErrors;
use crate::layout::Layout;
use crate::time::MacroStep;

/// What a run cost and how well its joints held.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Macro steps done.
    pub macro_steps: u64,
    /// Turns between the master and a worker: one message each way on an exchange stream, several unary calls otherwise.
    pub exchanges: u64,
    /// Integrations over a macro step that the workers report, of all causes together.
    pub integrations: u64,
    /// Integrations over a macro step that the master asked for, by cause.
    pub integrations_by_cause: Integrations,
    /// How the macro steps were corrected.
    pub corrections: Corrections,
    /// Internal steps of the solvers.
    pub solver_steps: u64,
    /// Time in s of all macro steps in the master.
    pub time_total: f64,
    /// Of it: assembling and solving for the multipliers, in s.
    pub time_solving: f64,
    /// Time in s that the workers spent in their solvers, added up over all workers.
    pub time_in_solvers: f64,
    /// Lengths of variable macro steps; absent if they do not vary.
    pub steps: Option<StepStatistics>,
    /// Macro steps by the degree of their polynomials; absent where no degree follows the estimates.
    pub degrees: Option<DegreeStatistics>,
    /// Steps by verdict.
    pub verdicts: Verdicts,
    /// Estimated errors of the steps; absent where the method has no corrector.
    pub estimated_errors: Option<RunErrors>,
    /// Largest residuals of every joint.
    pub joints: Vec<JointResiduals>,
    /// What the moments of conditions over a step are made of; absent where there are none.
    pub moments: Option<MomentsOf>,
    /// Initial velocities that were chosen so that they meet the joints.
    pub free_velocities: Vec<FreeVelocity>,
    /// Joints whose geometry was fitted to the start.
    pub fitted_joints: Vec<FittedJoint>,
    /// Conditions of the joints that follow from others.
    pub redundancy: Redundancy,
    /// Singular positions that were passed.
    pub singular_positions: SingularPassages,
    /// The share of every subsystem.
    pub subsystems: Vec<SubsystemStatistics>,
}

/// How the macro steps were corrected.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Corrections {
    /// Macro steps for which columns of the coupling Jacobian were integrated; the others used columns of earlier ones.
    pub steps_with_columns: u64,
    /// Macro steps that were corrected more than once.
    pub steps_with_passes: u64,
    /// Corrections after the first one of a macro step.
    pub passes: u64,
    /// Most of them in one macro step.
    pub most_passes: u32,
    /// Largest share of a correction that the next one in the same macro step still changed: the slowest convergence.
    pub slowest_rate: f64,
    /// Macro steps whose last correction was larger than the tolerance of the scene.
    pub unconverged: u64,
    /// Macro steps in which a condition was relaxed, since they did not resolve its multiplier.
    pub limited: u64,
    /// Macro steps with an impact that partners at joints took part in.
    pub steps_with_impacts: u64,
    /// What the corrections of poor steps have missed together, of what the scene allows for one step; absent without its tolerance.
    pub missed: Option<f64>,
}

impl Corrections {
    fn count(&mut self, passes: &Passes) {
        self.steps_with_columns += u64::from(passes.with_columns);
        self.steps_with_passes += u64::from(passes.count > 0);
        self.passes += u64::from(passes.count);
        self.most_passes = self.most_passes.max(passes.count);
        self.slowest_rate = self.slowest_rate.max(passes.rate.unwrap_or(0.0));
        self.unconverged += u64::from(passes.is_unconverged);
        self.limited += u64::from(passes.is_limited);
    }
}

/// What became of variable macro steps.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct StepStatistics {
    /// Attempts that were repeated with a shorter step.
    pub rejected: u64,
    /// The same by cause.
    pub rejected_by_cause: Rejections,
    /// Steps of the least length in which an exchanged variable has jumped.
    pub jumps: u64,
    /// The shortest step that was accepted.
    pub shortest: Option<StepAt>,
    /// The longest one.
    pub longest: Option<StepAt>,
}

/// Attempts at a macro step that were repeated, by cause.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rejections {
    /// The estimated error was larger than allowed.
    pub error: u64,
    /// The corrections did not converge (`coupling.iterations`).
    pub not_converged: u64,
    /// A worker could not step so far, sent numbers that are none, or the coupling had no solution.
    pub failed: u64,
}

/// A macro step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StepAt {
    /// Its start in s.
    pub t: f64,
    /// Its length in s.
    pub length: f64,
}

impl StepStatistics {
    pub(crate) fn accept(&mut self, step: MacroStep) {
        let own = StepAt {
            t: step.start,
            length: step.length,
        };
        if self.shortest.is_none_or(|known| own.length < known.length) {
            self.shortest = Some(own);
        }
        if self.longest.is_none_or(|known| own.length > known.length) {
            self.longest = Some(own);
        }
    }
}

/// Number of degrees that polynomials of coupling variables may have, from 0 on.
const DEGREES: usize = MAX_NODES - 2;

/// Number of macro steps by the degree of the polynomials, from 0 on, with which they were corrected.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct DegreeStatistics {
    /// Those of multipliers, if they follow the estimates.
    pub multipliers: Option<[u64; DEGREES]>,
    /// Those of exchanged variables, if they follow the estimates.
    pub exchanged: Option<[u64; DEGREES]>,
}

impl DegreeStatistics {
    fn count(&mut self, degrees: StepDegrees) {
        let groups = [
            (&mut self.multipliers, degrees.multipliers),
            (&mut self.exchanged, degrees.exchanged),
        ];
        for (steps, degree) in groups {
            if let Some(degree) = degree {
                steps.get_or_insert_default()[degree] += 1;
            }
        }
    }
}

/// Number of macro steps by verdict.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Verdicts {
    /// [`Verdict::Uncorrected`]
    pub uncorrected: u64,
    /// [`Verdict::Good`]
    pub good: u64,
    /// [`Verdict::Fair`]
    pub fair: u64,
    /// [`Verdict::Poor`]
    pub poor: u64,
}

/// Largest residual of one condition of a joint over the run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JointResiduals {
    /// Name in the scene.
    pub joint: String,
    /// Which of its conditions, e.g. `x`; empty if it has only one.
    pub part: String,
    /// Level of the condition.
    pub level: String,
    /// Largest absolute value.
    pub largest: f64,
}

/// What one subsystem did.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SubsystemStatistics {
    /// Name in the scene.
    pub subsystem: String,
    /// Which way the exchange took.
    pub route: String,
    /// Exchanges with its worker.
    pub exchanges: u64,
    /// Integrations over a macro step that its worker reports.
    pub integrations: u64,
    /// Integrations over a macro step that the master asked for, by cause.
    pub integrations_by_cause: Integrations,
    /// Internal steps of its solver.
    pub solver_steps: u64,
    /// Time in its solver in s.
    pub time_in_solver: f64,
    /// By what factor its responses to loads over a macro step differed most from those of inertia alone, if that is so much that the step does
    /// not resolve its springs and dampers.
    pub unresolved: Option<f64>,
    /// What its contacts did; absent where a solver has none.
    pub contacts: Option<ContactStatistics>,
    /// How often another worker took the place of a lost one.
    pub recoveries: Recoveries,
}

/// Workers that took the place of lost ones.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Recoveries {
    /// How many.
    pub workers: u64,
    /// Macro steps that they repeated to stand where the lost ones stood.
    pub repeated_steps: u64,
    /// Time in s that this took, without pauses before it.
    pub time: f64,
}

impl Recoveries {
    pub(crate) fn count(&mut self, time: Duration) {
        self.workers += 1;
        self.time += time.as_secs_f64();
    }
}

/// What the contacts inside a subsystem did.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ContactStatistics {
    /// Internal steps in which a contact closed anew.
    pub impacts: u64,
    /// Time of the first one in s; absent if there was none.
    pub first_impact: Option<f64>,
    /// Sum of all normal impulses in N s.
    pub impulse: f64,
    /// Deepest penetration in m.
    pub penetration: f64,
    /// Largest residual of a contact problem in m/s.
    pub residual: f64,
    /// Contact problems.
    pub problems: u64,
    /// Of them: solved by a fallback.
    pub robust: u64,
    /// Of them: with several solutions.
    pub ambiguous: u64,
    /// Of them: a contact jams.
    pub jams: u64,
    /// Whether its partners at joints take part in its impacts.
    pub crosses_joints: bool,
}

impl From<v1::Contacts> for ContactStatistics {
    fn from(contacts: v1::Contacts) -> Self {
        Self {
            impacts: contacts.impacts,
            first_impact: contacts.first_impact,
            impulse: contacts.impulse,
            penetration: contacts.penetration,
            residual: contacts.residual,
            problems: contacts.problems,
            robust: contacts.robust,
            ambiguous: contacts.ambiguous,
            jams: contacts.jams,
            crosses_joints: false,
        }
    }
}

impl Statistics {
    /// Nothing done yet.
    pub(crate) fn new(layout: &Layout) -> Self {
        let mut statistics = Self {
            moments: MomentsOf::of(layout),
            ..Self::default()
        };
        for row in &layout.rows {
            let joint = &layout.joints[row.joint];
            let levels = layout.level.up_to().iter();
            statistics.joints.extend(levels.map(|level| JointResiduals {
                joint: joint.name.clone(),
                part: joint.joint.name(row.condition).to_owned(),
                level: level.name().to_owned(),
                largest: 0.0,
            }));
        }
        statistics
    }

    pub(crate) fn count(
        &mut self,
        outcome: &Outcome,
        degrees: StepDegrees,
        time: Duration,
        row: &Row,
    ) {
        self.macro_steps += 1;
        self.time_total += time.as_secs_f64();
        self.time_solving += outcome.solving.as_secs_f64();
        self.corrections.count(&outcome.passes);
        self.corrections.steps_with_impacts += u64::from(outcome.has_impact);
        if let Some(missed) = outcome.missed {
            *self.corrections.missed.get_or_insert_default() += missed;
        }
        if degrees != StepDegrees::default() {
            self.degrees.get_or_insert_default().count(degrees);
        }
        let verdicts = &mut self.verdicts;
        *match outcome.verdict {
            Verdict::Uncorrected => &mut verdicts.uncorrected,
            Verdict::Good => &mut verdicts.good,
            Verdict::Fair => &mut verdicts.fair,
            Verdict::Poor => &mut verdicts.poor,
        } += 1;
        let residuals = (0..row.rows()).flat_map(|number| row.residuals(number));
        for (joint, residual) in self.joints.iter_mut().zip(residuals) {
            joint.largest = joint.largest.max(residual.abs());
        }
    }

    pub(crate) fn add_subsystem(&mut self, own: SubsystemStatistics) {
        self.exchanges += own.exchanges;
        self.integrations += own.integrations;
        self.integrations_by_cause.add(&own.integrations_by_cause);
        self.solver_steps += own.solver_steps;
        self.time_in_solvers += own.time_in_solver;
        self.subsystems.push(own);
    }
}
