//! Consistent coupling variables at the first macro point.

use super::consistency;
use super::initial::InitialState;
use super::settle::{Multipliers, look, settle};
use crate::error::RunError;
use crate::joint::Level;
use crate::layout::{Coupled, Layout};
use crate::scene::Scene;
use crate::workers::Workers;

/// Takes exchanged variables from the subsystems, and the multipliers from the scene where it gives them all; otherwise
/// solves `g'' = 0` at `t_start`, which is linear in them because loads enter the equations of motion linearly (for the
/// oscillator: S1 eq. 3). Where signals are connected, `w - y(w) = 0` is solved for them, together with `g'' = 0`, by
/// Newton's method.
pub(super) fn find(
    scene: &Scene,
    coupled: &Coupled<'_>,
    layout: &Layout,
    workers: &Workers,
    accept_open_joints: bool,
) -> Result<InitialState, RunError> {
    let given = given_multipliers(scene, layout)?;
    let solve_for = match given {
        Some(_) => Multipliers::Held,
        None => Multipliers::Free,
    };
    let given = given.as_deref();
    let (mut state, outputs) = InitialState::read(scene, coupled, layout, workers, given)?;
    if !accept_open_joints {
        consistency::check(scene, layout, &outputs)?;
    }
    let accelerating = Layout::new(coupled, Level::Acceleration);
    if solve_for == Multipliers::Free {
        let layout =
            { accelerating.as_ref() }.map_err(|lacks| ask_for_multiplier(scene, lacks.joint))?;
        settle((scene, coupled), layout, workers, &mut state, solve_for)?;
        return Ok(state);
    }
    if !scene.connections.is_empty() {
        settle((scene, coupled), layout, workers, &mut state, solve_for)?;
    }
    if let Some(layout) = accelerating.ok().filter(|_| !scene.joints.is_empty()) {
        look((scene, coupled), &layout, workers, &mut state)?;
    }
    Ok(state)
}

/// Exchanged variables as the subsystems show them without loads of joints; connected signals meet `w - y(w) = 0`.
pub(super) fn unloaded(
    scene: &Scene,
    coupled: &Coupled<'_>,
    layout: &Layout,
    workers: &Workers,
    accept_open_joints: bool,
) -> Result<InitialState, RunError> {
    let (mut state, outputs) = InitialState::read(scene, coupled, layout, workers, None)?;
    if !accept_open_joints {
        consistency::check(scene, layout, &outputs)?;
    }
    if !scene.connections.is_empty() {
        let held = Multipliers::Held;
        settle((scene, coupled), layout, workers, &mut state, held)?;
    }
    Ok(state)
}

/// The multipliers that the scene gives: those of all joints, or none.
fn given_multipliers(scene: &Scene, layout: &Layout) -> Result<Option<Vec<f64>>, RunError> {
    if scene.joints.iter().all(|joint| joint.multiplier.is_none()) {
        return Ok((scene.joints.is_empty()).then(Vec::new));
    }
    let mut given = Vec::new();
    for (joint, bound) in scene.joints.iter().zip(&layout.joints) {
        let Some(multiplier) = &joint.multiplier else {
            let message = "this joint has no initial multiplier, but another one does";
            let help = "give the multipliers of all joints, or none: then all are computed";
            let key = format!("joint.{}", joint.name);
            return Err(scene.error(&key, message, Some(help.into())).into());
        };
        let expected = bound.joint.len();
        if multiplier.len() != expected {
            let message = format!(
                "{} multipliers, this joint has {expected}",
                multiplier.len()
            );
            let key = format!("joint.{}.multiplier", joint.name);
            return Err(scene.error(&key, message, None).into());
        }
        given.extend_from_slice(multiplier);
    }
    Ok(Some(given))
}

fn ask_for_multiplier(scene: &Scene, joint: usize) -> RunError {
    let joint = &scene.joints[joint].name;
    let message =
        "the initial multiplier cannot be computed: a marker of this joint offers no acceleration";
    let help = format!("give it: `multiplier = ...` in joint \"{joint}\"");
    scene
        .error(&format!("joint.{joint}"), message, Some(help))
        .into()
}
