//! The checks, one file each.

mod attitude;
mod description;
mod directions;
mod energy;
mod evaluate;
mod exchange;
mod exported_states;
mod half_steps;
mod instants;
mod integrals;
mod joint_loads;
mod load_shapes;
mod mobility;
mod outputs;
mod parallel;
mod perturbed;
mod position;
mod refusals;
mod repeats;
mod replay;
mod response;
mod signals;
mod velocity;

use super::bench::Bench;
use super::verdict::{Stop, Verdict};

/// What a check is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct About {
    /// Its name.
    pub name: &'static str,
    /// What must hold.
    pub title: &'static str,
    /// The relation, with the symbols of the contract.
    pub equation: &'static str,
    /// How closely it must hold, and why.
    pub tolerance: &'static str,
    /// What the author of a worker should look at if it does not.
    pub look_at: &'static str,
}

/// One check.
pub trait Check {
    /// What it is about.
    fn about(&self) -> About;

    /// Carries it out.
    ///
    /// # Errors
    /// [`Stop`] if it does not apply, or cannot go on.
    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop>;
}

/// All checks, those first that others build on.
pub fn all() -> Vec<Box<dyn Check>> {
    vec![
        Box::new(description::Description),
        Box::new(response::Response),
        Box::new(attitude::Attitude),
        Box::new(outputs::OutputLists),
        Box::new(evaluate::Evaluate),
        Box::new(replay::Replay),
        Box::new(exported_states::ExportedStates),
        Box::new(mobility::MobilityMatrix),
        Box::new(velocity::Velocity),
        Box::new(position::Position),
        Box::new(load_shapes::LoadShapes),
        Box::new(half_steps::HalfSteps),
        Box::new(signals::Signals),
        Box::new(energy::Energy),
        Box::new(perturbed::PerturbedSteps),
        Box::new(directions::Directions),
        Box::new(instants::Instants),
        Box::new(integrals::Integrals),
        Box::new(joint_loads::JointLoads),
        Box::new(exchange::Exchange),
        Box::new(repeats::Repeats),
        Box::new(refusals::Refusals),
        Box::new(parallel::Parallel),
    ]
}
