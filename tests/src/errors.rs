//! Errors of a run against an exact solution.

use linchpin::closed_form::ClosedForm;
use linchpin::connect::Place;
use linchpin::error_norm::ColumnError;
use linchpin_master::scene::Scene;

use crate::runs::{Trajectory, run};
use crate::scenes::hermite_oscillator;

/// Errors of a run, each the root mean square over the macro points divided by that of the exact values (NRMS).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Position of the first subsystem.
    pub x: f64,
    /// Positions and velocities of all subsystems as one vector.
    pub state: f64,
    /// Multipliers of all joints as one vector.
    pub lambda: f64,
}

impl Errors {
    /// Errors of `trajectory`; `exact` gives the value of a column at a time, if there is one.
    pub fn of(trajectory: &Trajectory, exact: impl Fn(&str, f64) -> Option<f64>) -> Self {
        let errors: Vec<(&str, ColumnError)> = trajectory
            .columns
            .iter()
            .enumerate()
            .filter_map(|(place, name)| {
                Some((
                    name.as_str(),
                    column_error(trajectory, place, |t| exact(name, t))?,
                ))
            })
            .collect();
        let of_kinds = |kinds: &'static [&str]| {
            let is_wanted = move |name: &str| kinds.iter().any(|kind| name.ends_with(kind));
            errors
                .iter()
                .filter(move |(name, _)| is_wanted(name))
                .map(|(_, error)| *error)
        };
        Self {
            x: of_kinds(&[".x"]).next().unwrap().normalised(),
            state: ColumnError::together(of_kinds(&[".x", ".v"])).normalised(),
            lambda: ColumnError::together(of_kinds(&[".lambda"])).normalised(),
        }
    }

    /// Errors of a run of `scene`, which has a closed form and must reach its end.
    pub fn against_closed_form(scene: &Scene) -> Self {
        Self::of(&run(scene, Place::InProcess), closed_form(scene))
    }
}

fn column_error(
    trajectory: &Trajectory,
    place: usize,
    exact: impl Fn(f64) -> Option<f64>,
) -> Option<ColumnError> {
    let mut error = ColumnError::default();
    for row in &trajectory.rows {
        error.add(row[place], exact(row[0])?);
    }
    Some(error)
}

/// Exact value of a column at a time, for a scene that has a closed form.
pub fn closed_form(scene: &Scene) -> impl Fn(&str, f64) -> Option<f64> {
    let closed_form = ClosedForm::of(scene).unwrap();
    move |column, t| closed_form.value(closed_form.quantity(column)?, t)
}

/// Errors of position, state and multiplier of the scene [`hermite_oscillator`] against its closed form.
pub fn of_hermite_oscillator(coupling: &str, h: f64) -> [f64; 3] {
    let Errors { x, state, lambda } = Errors::against_closed_form(&hermite_oscillator(coupling, h));
    [x, state, lambda]
}
