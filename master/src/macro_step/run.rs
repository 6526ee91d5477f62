//! What takes part in a macro step.

use super::correcting::{Correcting, Corrector};
use super::impacts::Impacts;
use super::jacobian::PointJacobian;
use crate::accuracy::{StepErrors, Tolerance};
use crate::error::RunError;
use crate::layout::Layout;
use crate::methods::CouplingMethod;
use crate::policies::degree::AutomaticDegrees;
use crate::policies::iteration::IterationControl;
use crate::policies::step_size::{Rule, StepSize};
use crate::time::TimePlan;
use crate::workers::Workers;

/// The workers, the method that couples them, and the policies that decide.
pub struct Run {
    pub layout: Layout,
    pub workers: Workers,
    pub method: Box<dyn CouplingMethod>,
    /// Present for methods that correct their prediction.
    pub corrector: Option<Corrector>,
    /// Present for methods that solve conditions at the macro points.
    pub point: Option<PointJacobian>,
    /// Present where subsystems find impacts that others take part in.
    pub impacts: Option<Impacts>,
    pub iteration: IterationControl,
    /// Present if the macro step or the degrees follow the error.
    pub step_size: Option<StepSize>,
    /// Present if degrees follow the estimates.
    pub degrees: Option<AutomaticDegrees>,
    /// What errors the steps are estimated to make.
    pub errors: StepErrors,
    /// What has become of the look-ahead over the present step, if not its answer.
    pub refusal: Option<RunError>,
    pub plan: TimePlan,
}

/// The policies that decide about a step from its error.
pub struct ErrorPolicies<'a> {
    /// About its length.
    pub step_size: Option<&'a mut StepSize>,
    /// About the degrees of its polynomials.
    pub degrees: Option<&'a mut AutomaticDegrees>,
    /// What is told of it.
    pub errors: &'a mut StepErrors,
}

impl ErrorPolicies<'_> {
    /// What error the scene allows of a step, where steps vary or did so.
    pub fn of_scene(&self) -> Option<&Tolerance> {
        let step_size = self.step_size.as_deref();
        let step_size = step_size.filter(|own| own.rule() != Rule::Equal);
        step_size.map(StepSize::tolerance)
    }

    /// What a step may be off by: what the scene allows, otherwise what is bearable.
    pub fn tolerance(&self) -> &Tolerance {
        self.of_scene().unwrap_or(self.errors.bearable())
    }
}

impl Run {
    /// All that takes part in corrections, for methods that correct their prediction, and what decides about the step.
    pub fn correcting(&mut self) -> Option<(Correcting<'_>, ErrorPolicies<'_>)> {
        let varies = self.step_size.as_ref().is_some_and(StepSize::varies);
        let correcting = Correcting {
            layout: &self.layout,
            workers: &mut self.workers,
            method: self.method.corrected()?,
            own: self.corrector.as_mut()?,
            point: self.point.as_mut(),
            impacts: self.impacts.as_mut(),
            varies,
        };
        let policies = ErrorPolicies {
            step_size: self.step_size.as_mut(),
            degrees: self.degrees.as_mut(),
            errors: &mut self.errors,
        };
        Some((correcting, policies))
    }
}
