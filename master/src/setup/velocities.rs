//! Initial velocities that meet the joints, for scenes that leave some of them free.

use linchpin_proto::v1::{self, value::Kind};
use nalgebra::{DMatrix, DVector};

use super::initial::InitialState;
use crate::error::RunError;
use crate::joint::Level;
use crate::layout::{Coupled, Layout};
use crate::results::FreeVelocity;
use crate::scene::Scene;
use crate::system::motion_of;
use crate::workers::Workers;

/// Change of a parameter by which its influence is found; velocities enter `g'` linearly.
const UNIT: f64 = 1.0;

/// Positions that change by more than this share under a change of an initial velocity depend on it.
const UNCHANGED: f64 = 1e-9;

/// Singular values below this share of the largest are rounding.
const RANK: f64 = 1e-10;

/// Chooses the free velocities so that `g' = 0` holds at the start, as near as possible to those given: of all that meet the
/// joints, those with the smallest sum of squared changes. If no choice meets them all, the least squares of `g'` remain, and
/// the check of the closed joints refuses the scene.
pub(super) fn choose(
    scene: &Scene,
    coupled: &Coupled<'_>,
    models: &[v1::Model],
    requests: &mut [v1::InitializeRequest],
    workers: &mut Workers,
) -> Result<Vec<FreeVelocity>, RunError> {
    let mut free = free_velocities(scene, models, requests)?;
    if free.is_empty() {
        return Ok(Vec::new());
    }
    let layout = Layout::new(coupled, Level::Velocity)
        .map_err(|lacks| super::discover::refuse_marker(scene, lacks))?;
    let start = conditions(scene, coupled, &layout, workers)?;
    let mut influence = DMatrix::zeros(layout.rows.len(), free.len());
    for (column, (number, velocity)) in free.iter().enumerate() {
        let request = &mut requests[*number];
        set(request, &velocity.parameter, velocity.given + UNIT);
        workers.restart(scene, *number, models, request)?;
        let moved = conditions(scene, coupled, &layout, workers)?;
        set(request, &velocity.parameter, velocity.given);
        workers.restart(scene, *number, models, request)?;
        for (row, (moved, start)) in moved.iter().zip(&start).enumerate() {
            if (moved[0] - start[0]).abs() > UNCHANGED * (1.0 + start[0].abs()) {
                return Err(refuse_position(scene, velocity));
            }
            influence[(row, column)] = (moved[1] - start[1]) / UNIT;
        }
    }
    let open = DVector::from_iterator(start.len(), start.iter().map(|row| -row[1]));
    let svd = influence.svd(true, true);
    let rank = RANK * svd.singular_values.max();
    let changes = svd
        .solve(&open, rank)
        .unwrap_or_else(|_| DVector::zeros(free.len()));
    for ((number, velocity), change) in free.iter_mut().zip(&changes) {
        velocity.found = velocity.given + change;
        let request = &mut requests[*number];
        set(request, &velocity.parameter, velocity.found);
        workers.restart(scene, *number, models, request)?;
    }
    Ok(free.into_iter().map(|(_, velocity)| velocity).collect())
}

/// The free velocities of the scene, each with the place of its subsystem.
fn free_velocities(
    scene: &Scene,
    models: &[v1::Model],
    requests: &[v1::InitializeRequest],
) -> Result<Vec<(usize, FreeVelocity)>, RunError> {
    let mut free = Vec::new();
    for (number, subsystem) in scene.subsystems.iter().enumerate() {
        for parameter in &subsystem.free_velocities {
            let known = &models[number].parameters;
            let described = known.iter().find(|known| &known.name == parameter);
            let written = requests[number].parameters.get(parameter);
            let given = match written.map(|value| &value.kind) {
                Some(Some(Kind::Number(given))) => Some(*given),
                Some(_) => None,
                None => described.and_then(|described| described.default),
            };
            let given = given.ok_or_else(|| {
                let key = format!("subsystem.{}.free_velocities", subsystem.name);
                let known: Vec<&str> = known.iter().map(|known| known.name.as_str()).collect();
                let message = format!(
                    "\"{parameter}\" is no parameter of model \"{}\" with a number; it has: {}",
                    models[number].name,
                    known.join(", ")
                );
                scene.error(
                    &key,
                    message,
                    super::discover::did_you_mean(parameter, &known),
                )
            })?;
            let velocity = FreeVelocity {
                subsystem: subsystem.name.clone(),
                parameter: parameter.clone(),
                given,
                found: given,
            };
            free.push((number, velocity));
        }
    }
    Ok(free)
}

/// `g` and `g'` of every row at the start.
fn conditions(
    scene: &Scene,
    coupled: &Coupled<'_>,
    layout: &Layout,
    workers: &Workers,
) -> Result<Vec<[f64; 2]>, RunError> {
    let (_, outputs) = InitialState::read(scene, coupled, layout, workers, None)?;
    let conditions = layout.rows.iter().map(|row| {
        let motion = motion_of(layout, row.joint, |subsystem| &outputs[subsystem]);
        let condition = layout.joints[row.joint].joint.condition(row.condition);
        [Level::Position, Level::Velocity].map(|level| condition.value(level, &motion))
    });
    Ok(conditions.collect())
}

fn set(request: &mut v1::InitializeRequest, parameter: &str, value: f64) {
    let kind = Some(Kind::Number(value));
    let value = v1::Value { kind };
    request.parameters.insert(parameter.to_owned(), value);
}

fn refuse_position(scene: &Scene, velocity: &FreeVelocity) -> RunError {
    let FreeVelocity {
        subsystem,
        parameter,
        ..
    } = velocity;
    let message = format!("\"{parameter}\" is no initial velocity: the joints move with it");
    let help = "list parameters that are velocities at the start";
    let key = format!("subsystem.{subsystem}.free_velocities");
    scene.error(&key, message, Some(help.into())).into()
}
