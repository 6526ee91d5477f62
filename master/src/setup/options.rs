//! What a run is started with beside its scene.

use crate::connection::{Connection, StartError};
use crate::results::StepDegrees;
use crate::scene::{self, Scene};

/// Gives the connection to the worker of a subsystem.
pub type Connect<'a> =
    dyn FnMut(&Scene, &scene::Subsystem) -> Result<Box<dyn Connection>, StartError> + 'a;

/// What a study may ask for beyond the scene.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Options {
    /// Let a diverging run go on, for maps of stability.
    pub watch_nothing: bool,
    /// Start from joints that are open: a study of the macro-step map starts from unit states.
    pub accept_open_joints: bool,
    /// Multipliers at past macro points in place of a start, newest first; the polynomials then have their full degree
    /// from the first step on.
    pub established: Option<Vec<Vec<f64>>>,
    /// Macro steps of these lengths in s, as a run with variable steps has found them, in place of those of the scene.
    pub step_lengths: Option<Vec<f64>>,
    /// Degrees of the polynomials over every macro step, as a run in which they follow the estimates has found them.
    pub degrees: Option<Vec<StepDegrees>>,
    /// Record the positions of all markers, also of those that no joint holds, and what contacts do: a picture of the
    /// mechanism needs them.
    pub record_markers: bool,
}
