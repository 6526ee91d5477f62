//! The errors that macro steps are estimated to make, whatever chooses their lengths: of each step as a share of the motion, and of the run.

use serde::{Deserialize, Serialize};

use super::estimate::{Estimate, Suspect};
use super::tolerance::{self, Tolerance};
use crate::joint::Level;
use crate::layout::{Layout, What};
use crate::system::Outputs;
use crate::time::MacroStep;

/// The share of the motion by which a step may be off where nothing says what it is for.
const BEARABLE: f64 = 1e-2;

/// Displacements below this share of what the multipliers move within a step are rest.
const REST: f64 = 1e-6;

/// The errors of the accepted steps, each by what has it: positions, angles, or one exchanged variable. What is off is measured by the
/// motion, the largest displacement from the start.
pub struct StepErrors {
    bearable: Tolerance,
    told: Told,
}

/// Errors that the steps of a run are estimated to make, as shares of the motion: of the largest displacement from the start.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RunErrors {
    /// The largest one of a step.
    pub largest: f64,
    /// What has it.
    pub of: String,
    /// Start of that step in s.
    pub t: f64,
    /// Those of all steps together: a guide, as errors may cancel or grow.
    pub accumulated: f64,
}

/// What is remembered of the steps so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    bearable: tolerance::State,
    told: Told,
}

/// The errors so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Told {
    /// For each kind of motion.
    groups: Vec<Group>,
    /// The difference that lower degrees made in the last step, and in the present one, with the lengths of the steps.
    lower: [Lower; 2],
    /// That of the last step, as a share of the motion.
    last: Option<f64>,
    /// Whether a step was accepted, whose attempt tells the lever.
    knows_lever: bool,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
struct Lower {
    difference: f64,
    length: f64,
}

/// Errors in the unit of what has them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
struct Group {
    sum: f64,
    largest: f64,
    /// Start of the step with the largest one in s.
    t: f64,
    suspect: Suspect,
}

impl StepErrors {
    /// For the quantities of `layout` at a start with these `outputs`; `solvers` are the tolerances of the subsystems' solvers. They are known
    /// where the method has a corrector.
    pub fn new(are_known: bool, layout: &Layout, solvers: Vec<f64>, outputs: &dyn Outputs) -> Self {
        let bearable = Tolerance::of_motion(BEARABLE, layout, solvers, outputs);
        Self {
            told: Told {
                groups: vec![Group::default(); bearable.sizes()],
                lower: Default::default(),
                last: are_known.then_some(0.0),
                knows_lever: false,
            },
            bearable,
        }
    }

    /// What a step may be off by: a small share of the motion.
    pub fn bearable(&self) -> &Tolerance {
        &self.bearable
    }

    /// Takes what the workers foresee of the motion over the step.
    pub fn foresee(&mut self, outputs: &dyn Outputs) {
        self.bearable.foresee(outputs);
    }

    /// Whether the lever is not known by which angles are compared with lengths: every attempt at the first step tells it anew.
    pub fn needs_lever(&self) -> bool {
        !self.told.knows_lever
    }

    /// Takes the lever: from the largest effect of a unit force on lengths, and of a unit moment on angles, with `H^2/m` and `H^2/J` the root of
    /// their ratio is a radius of gyration; without moments the arm by which forces turn bodies. Lengths are at least what turning
    /// makes of it.
    pub fn take_lever(&mut self, lever: f64) {
        self.bearable.set_lever(lever);
    }

    /// Takes by how much the multipliers alone move a position over the step: motion that is tiny beside that is rounding.
    pub fn take_effect(&mut self, [subsystem, output]: [usize; 2], effect: f64) {
        self.bearable
            .foresee_size(subsystem, output, REST * effect.abs());
    }

    /// The difference that lower degrees made in the step before, as it would have been over `step` if it falls with this `order`.
    pub fn lower_before(&self, step: MacroStep, order: usize) -> f64 {
        let [last, _] = self.told.lower;
        match last.length > 0.0 {
            true => last.difference * (step.length / last.length).powi(order as i32),
            false => 0.0,
        }
    }

    /// Takes the difference that lower degrees make in the present attempt at a step.
    pub fn note_lower(&mut self, step: MacroStep, difference: f64) {
        let length = step.length;
        self.told.lower[1] = Lower { difference, length };
    }

    /// Takes the error of a step that is accepted, told relative to what is bearable.
    pub fn accept(&mut self, layout: &Layout, step: MacroStep, estimate: &Estimate) {
        if self.told.last.is_none() {
            return;
        }
        self.told.last = Some(BEARABLE * estimate.scaled);
        self.told.knows_lever = true;
        self.told.lower[0] = self.told.lower[1];
        let Some((group, size)) = self.bearable.size_of(layout, estimate.suspect) else {
            return;
        };
        let group = &mut self.told.groups[group];
        let error = BEARABLE * estimate.scaled * size;
        // What a joint is open by stays open over many steps and counts once.
        if !matches!(estimate.suspect, Suspect::Opening(_)) {
            group.sum += error;
        }
        if error > group.largest {
            (group.largest, group.t, group.suspect) = (error, step.start, estimate.suspect);
        }
    }

    /// Takes the motion at a macro point that is reached.
    pub fn observe(&mut self, outputs: &dyn Outputs) {
        self.bearable.observe(outputs);
    }

    /// The error of the last step as a share of the motion; not known where the method has no corrector.
    pub fn of_last_step(&self) -> Option<f64> {
        self.told.last
    }

    /// The errors of all steps as shares of the whole motion.
    pub fn of_run(&self, layout: &Layout) -> Option<RunErrors> {
        self.told.last?;
        let mut errors = RunErrors::default();
        for (number, group) in self.told.groups.iter().enumerate() {
            let share = |error: f64| match self.bearable.size(number) {
                0.0 => 0.0,
                size => error / size,
            };
            let accumulated = share(group.sum).max(share(group.largest));
            errors.accumulated = errors.accumulated.max(accumulated);
            if share(group.largest) > errors.largest {
                errors.largest = share(group.largest);
                errors.t = group.t;
                errors.of = group.suspect.name(layout);
            }
        }
        Some(errors)
    }

    /// What is remembered, to be written.
    pub fn state(&self) -> State {
        State {
            bearable: self.bearable.state(),
            told: self.told.clone(),
        }
    }

    /// Goes on from what was written.
    pub fn resume(&mut self, state: State) {
        self.bearable.resume(state.bearable);
        self.told = state.told;
    }
}

impl Tolerance {
    /// The group of quantities that what is suspected belongs to, and its size.
    fn size_of(&self, layout: &Layout, suspect: Suspect) -> Option<(usize, f64)> {
        let group = match suspect {
            Suspect::None => None,
            Suspect::Output { subsystem, output } => self
                .group_of_output(subsystem, output)
                .or_else(|| self.group_of_rate(layout, subsystem, output)),
            Suspect::Opening(row) => self.group_of_opening(layout, row),
            Suspect::Variable(variable) => {
                let exchanged = layout
                    .exchanged
                    .iter()
                    .find(|one| (one.first..one.first + one.size()).contains(&variable))?;
                match exchanged.what {
                    What::Output(output) => self.group_of_output(exchanged.subsystem, output),
                    // What is allowed of it is told of 1 rad.
                    What::Attitude { places, .. } => {
                        let mut groups = places
                            .iter()
                            .map(|&place| self.group_of_output(exchanged.subsystem, place));
                        return groups.find_map(|group| Some((group?, 1.0)));
                    }
                }
            }
        };
        group.map(|group| (group, self.size(group)))
    }

    /// The group of the position that a velocity at a joint belongs to.
    fn group_of_rate(&self, layout: &Layout, subsystem: usize, rate: usize) -> Option<usize> {
        let ends = layout.joints.iter().flat_map(|joint| &joint.ends);
        let mut own = ends.filter(|end| end.subsystem == subsystem);
        own.find_map(|end| {
            let number = end
                .places(Level::Velocity)
                .position(|place| place == rate)?;
            let are_lengths = end.coordinates();
            let is_length = number < are_lengths.len();
            let like = end
                .positions()
                .find(|place| are_lengths.contains(place) == is_length)?;
            self.group_of_output(subsystem, like)
        })
    }
}
