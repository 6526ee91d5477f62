//! Whether a composition can start as the scene says: closed, with velocities that fit, and no condition twice.

use super::condition::{Condition, Row};
use super::constraints::Constraints;
use super::error::CompositionError;
use super::system::System;

/// Residual, relative to what it is the sum of, that is taken for rounding.
const ROUNDING: f64 = 1e-9;

/// Checks the start of a system.
///
/// # Errors
/// [`CompositionError`] for the joint or motion that is most in violation, or the first that is redundant.
pub fn check(system: &System) -> Result<(), CompositionError> {
    let conditions = system.conditions();
    let start = system.start();
    let t = system.t_start();
    let rows = conditions.iter();
    let rows: Vec<Row> = rows
        .map(|condition| condition.row(t, &start.bodies))
        .collect();
    let largest = start.bodies.iter().map(|body| body.pose.position.amax());
    let size = 1.0 + largest.fold(0.0, f64::max);
    if let Some((place, residual)) = worst(rows.iter().map(|row| row.residual), |_| size) {
        return Err(CompositionError::Open {
            field: conditions[place].place.clone(),
            residual,
            unit: conditions[place].units()[0],
        });
    }
    let twist = |place: usize| start.bodies[place].twist;
    let speed = |place: usize| {
        let [a, b] = rows[place].bodies.map(|body| {
            let twist = twist(body);
            twist.linear.norm() + twist.angular.norm()
        });
        1.0 + a + b
    };
    let rates = rows.iter().map(|row| row.along(twist) + row.drift);
    if let Some((place, residual)) = worst(rates, speed) {
        return Err(CompositionError::Moving {
            field: conditions[place].place.clone(),
            residual,
            unit: conditions[place].units()[1],
        });
    }
    let constraints = Constraints::new(&system.bodies, &start.bodies, rows);
    match constraints.first_redundant() {
        Some(place) => Err(redundant(&conditions, place)),
        None => Ok(()),
    }
}

/// The largest residual beyond rounding, the first of equal ones, with its place.
fn worst(
    residuals: impl Iterator<Item = f64>,
    size: impl Fn(usize) -> f64,
) -> Option<(usize, f64)> {
    let sized = residuals.map(f64::abs).enumerate();
    let beyond =
        sized.filter(|(place, residual)| residual.is_nan() || *residual > ROUNDING * size(*place));
    beyond.reduce(|worst, next| if next.1 > worst.1 { next } else { worst })
}

fn redundant(conditions: &[Condition], place: usize) -> CompositionError {
    let mut before: Vec<&str> = Vec::new();
    for condition in &conditions[..place] {
        let name = condition.place.trim_start_matches("parameters.");
        if condition.place != conditions[place].place && !before.contains(&name) {
            before.push(name);
        }
    }
    CompositionError::Redundant {
        field: conditions[place].place.clone(),
        conditions: if before.is_empty() {
            "its own".to_owned()
        } else {
            before.join(", ")
        },
    }
}
