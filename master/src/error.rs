//! Why a run ends without a result.

use linchpin_proto::contract::CallError;
use linchpin_proto::readable::{number, time};
use linchpin_proto::version::Incompatible;

use crate::connection::{ExitMessage, NotRecovered, StartError};
use crate::methods::Unreadable;
use crate::reading::SceneErrors;

/// Why a run could not start or had to stop.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The scene is wrong; some mistakes show only when the workers are asked.
    #[error(transparent)]
    Scene(#[from] SceneErrors),
    /// A run cannot go on from a state.
    #[error("cannot go on from this state: {0}")]
    Resume(#[from] Unreadable),
    /// A state belongs to another run.
    #[error("cannot go on from this state: {0}; go on with the scene that wrote it")]
    OtherRun(String),
    /// The state of a worker cannot leave its process.
    #[error(
        "subsystem \"{subsystem}\" at t = {t} s: its state cannot be exported: {source}", t = time(*t)
    )]
    NotExported {
        /// Name in the scene.
        subsystem: String,
        /// The macro point.
        t: f64,
        /// What the call said.
        source: Box<CallError>,
    },
    /// A worker cannot go on from a state.
    #[error("subsystem \"{subsystem}\" cannot go on from this state: {source}")]
    NotImported {
        /// Name in the scene.
        subsystem: String,
        /// What the call said.
        source: Box<CallError>,
    },
    /// A time that no macro step reaches.
    #[error("t = {t} s lies behind the end of the scene at {end} s: choose a later scene.t_end", t = time(*t), end = time(*end))]
    BehindTheEnd {
        /// The time.
        t: f64,
        /// The end.
        end: f64,
    },
    /// A worker could not be started or reached.
    #[error("subsystem \"{subsystem}\": {source}")]
    Start {
        /// Name in the scene.
        subsystem: String,
        /// Why.
        source: Box<StartError>,
    },
    /// A worker speaks another protocol.
    #[error("subsystem \"{subsystem}\": {source}")]
    Incompatible {
        /// Name in the scene.
        subsystem: String,
        /// Both versions.
        source: Incompatible,
    },
    /// A call to a worker failed.
    #[error(
        "subsystem \"{subsystem}\" at t = {t} s (H = {step} s): {source}{exit_message}{}",
        advice(.source), t = time(*t), step = number(*step)
    )]
    Worker {
        /// Name in the scene.
        subsystem: String,
        /// Start of the macro step.
        t: f64,
        /// Its length; 0 before the first step.
        step: f64,
        /// What the call said.
        source: Box<CallError>,
        /// What its process left behind, if known.
        exit_message: ExitMessage,
    },
    /// A worker was lost, and no other one could take its place.
    #[error(
        "{lost}\n  no other worker could take its place in {attempts} attempt{}: {because}",
        if *attempts == 1 { "" } else { "s" }
    )]
    NotRecovered {
        /// The loss.
        lost: Box<RunError>,
        /// How often it was tried.
        attempts: usize,
        /// What stood against the last attempt.
        because: Box<NotRecovered>,
    },
    /// A worker refuses what connected signals are at the start.
    #[error(
        "{0}\n  help: the signals that are connected are searched from their start values: give `start`, a value that the worker takes \
         near the solution, in a [[connection]]"
    )]
    SignalsAtStart(Box<RunError>),
    /// A worker sent a number that is none.
    #[error(
        "subsystem \"{subsystem}\" sent {value} for output \"{variable}\" in the macro step from t = {t} s \
         (H = {step} s)",
        t = time(*t), step = number(*step)
    )]
    NotFinite {
        /// Name in the scene.
        subsystem: String,
        /// Output of the model.
        variable: String,
        /// Infinite or NaN.
        value: f64,
        /// Start of the macro step.
        t: f64,
        /// Its length.
        step: f64,
    },
    /// A worker breaks the contract.
    #[error(
        "subsystem \"{subsystem}\" answered with {found} {what} instead of {expected} in the macro step from t = {t} s; \
         the worker does not keep to the contract linchpin.v1",
        t = time(*t)
    )]
    WrongCount {
        /// Name in the scene.
        subsystem: String,
        /// What was counted.
        what: &'static str,
        /// Number that came.
        found: usize,
        /// Number that was due.
        expected: usize,
        /// Start of the macro step.
        t: f64,
    },
    /// Somebody asked the run to stop.
    #[error("interrupted at t = {t} s", t = time(*t))]
    Interrupted {
        /// The macro point that was reached.
        t: f64,
    },
    /// The coupling has come apart.
    #[error(
        "the run diverged at t = {t} s (H = {step} s): joint \"{joint}\" is open by {opening}, the largest motion so far is \
         {motion}",
        t = time(*t), step = number(*step), opening = number(*opening), motion = number(*motion)
    )]
    Diverged {
        /// End of the macro step.
        t: f64,
        /// Its length.
        step: f64,
        /// Name in the scene.
        joint: String,
        /// `|g|` on position level.
        opening: f64,
        /// Largest position of a marker so far.
        motion: f64,
    },
    /// A value has grown beyond all measure.
    #[error(
        "the run diverged at t = {t} s (H = {step} s): {variable} = {value} has grown by more than {growth} since the first steps",
        t = time(*t), step = number(*step), value = number(*value), growth = number(*growth)
    )]
    Grown {
        /// End of the macro step.
        t: f64,
        /// Its length.
        step: f64,
        /// Name of the result column.
        variable: String,
        /// Its value.
        value: f64,
        /// Factor that was passed.
        growth: f64,
    },
    /// The corrections of a macro step do not come to an end.
    #[error(
        "the corrections do not converge at t = {t} s (H = {step} s): after {passes} passes {unknown} still changes by \
         {change} of its size, allowed is {tolerance}; each pass leaves {rate} of the change before; try {remedy}, \
         more passes (coupling.iterations.most), a larger coupling.iterations.tolerance, or \
         coupling.iterations.otherwise = \"warn\"",
        t = time(*t), step = number(*step), change = number(*change), tolerance = number(*tolerance), rate = number(*rate)
    )]
    NotConverged {
        /// Start of the macro step.
        t: f64,
        /// Its length.
        step: f64,
        /// Coupling variable that changes most.
        unknown: String,
        /// Its last change relative to its size.
        change: f64,
        /// What is allowed.
        tolerance: f64,
        /// Number of passes.
        passes: u32,
        /// Last change over the one before.
        rate: f64,
        /// What shortens the step.
        remedy: &'static str,
    },
    /// A failure that shorter macro steps have not cured.
    #[error(
        "{0}\n  help: this H is coupling.least_step, and longer macro steps have failed as well; a smaller coupling.least_step helps only if \
         the cause goes with H"
    )]
    NoShorterStep(Box<RunError>),
    /// A step near a singular position has failed, and so have others.
    #[error(
        "{0}\n  help: the mechanism is near a singular position, bars in line, where its joints do not determine their loads; another \
         coupling.macro_step, coupling.tolerance or coupling.degree may step across it"
    )]
    NearSingular(Box<RunError>),
    /// No step is short enough.
    #[error(
        "no macro step from t = {t} s is short enough: with H = {step} s, which is coupling.least_step, the error of {variable} is \
         estimated as {error} times what coupling.tolerance = {tolerance} allows; try a smaller coupling.least_step, a larger \
         coupling.tolerance, a larger coupling.absolute_tolerance if {variable} is small, or tighter solver tolerances",
        t = time(*t), step = number(*step), error = number(*error), tolerance = number(*tolerance)
    )]
    LeastStep {
        /// Start of the macro step.
        t: f64,
        /// Its length.
        step: f64,
        /// Error over what is allowed.
        error: f64,
        /// `coupling.tolerance`
        tolerance: f64,
        /// What has the error.
        variable: String,
    },
    /// The coupling conditions do not determine the coupling variables.
    #[error(
        "{unknown} is not determined at t = {t} s (H = {step} s): the coupling Jacobian is \
         singular on {level} level; a joint is redundant, a coupled body does not react to its load, connected signals \
         depend on each other without delay with a gain of 1 around the loop, or H meets half a period of a subsystem \
         (aliasing): change coupling.macro_step, the joints or the connections",
        t = time(*t), step = number(*step)
    )]
    Singular {
        /// First coupling variable without a pivot.
        unknown: String,
        /// Level of the conditions.
        level: &'static str,
        /// Start of the macro step.
        t: f64,
        /// Its length.
        step: f64,
    },
}

impl RunError {
    /// Whether the connection to a worker broke, or its process was killed. Before the first macro step a run may simply begin again.
    pub fn is_broken_connection(&self) -> bool {
        let is_lost = |error: &CallError| matches!(error, CallError::Lost { .. });
        match self {
            Self::Worker { source, .. } | Self::NotImported { source, .. } => is_lost(source),
            Self::Start { source, .. } => match &**source {
                StartError::Call(error) => is_lost(error),
                StartError::Ended(exit_message) => exit_message.is_killed(),
                _ => false,
            },
            _ => false,
        }
    }

    /// Whether a shorter macro step from the same macro point may do without this failure of a look-ahead.
    pub(crate) fn may_vanish_with_a_shorter_step(&self) -> bool {
        match self {
            Self::Worker { source, .. } => source.is_recoverable(),
            Self::NotFinite { .. } | Self::Singular { .. } | Self::Grown { .. } => true,
            _ => false,
        }
    }
}

fn advice(error: &CallError) -> &'static str {
    match error {
        CallError::Deadline {
            alive: Some(false), ..
        } => "\n  help: look after the worker and its machine; run.deadline gives it more time",
        CallError::Deadline { .. } => {
            "\n  help: the worker hangs, or its step takes longer: run.deadline gives it more time"
        }
        _ => "",
    }
}
