//! Refuses a scene whose joints are open or turned over at the start.

use linchpin_proto::readable;

use crate::error::RunError;
use crate::joint::{Condition, Level, Motion};
use crate::layout::Layout;
use crate::scene::{CLOSED, MOST_TOLERATED, Scene};
use crate::system::motion_of;

/// Advice for a gap has so many times the tolerance that would just do.
const MARGIN: f64 = 2.0;

/// Checks all joints on the levels that the method demands below the acceleration, with what the scene tolerates of velocities. `outputs` are the
/// coupling outputs.
pub(super) fn check(scene: &Scene, layout: &Layout, outputs: &[Vec<f64>]) -> Result<(), RunError> {
    for number in 0..layout.rows.len() {
        check_row(scene, layout, outputs, number)?;
    }
    for (number, joint) in layout.joints.iter().enumerate() {
        let motion = motion_of(layout, number, |subsystem| &outputs[subsystem]);
        if let Some(turned) = joint
            .joint
            .aligned()
            .iter()
            .find(|axes| !agree(&motion, axes))
        {
            let [a, b] = turned.each_ref().map(|axis| axis.as_slice());
            let message = format!(
                "the joint is turned over at t = {} s: axis {a:?} of marker a and axis {b:?} of marker b do not point to the \
                 same side",
                scene.t_start
            );
            let help = "turn one of the bodies, reverse an axis of the joint, or change the attitude that it keeps";
            let key = format!("joint.{}", joint.name);
            return Err(scene.error(&key, message, Some(help.into())).into());
        }
    }
    Ok(())
}

/// Where the conditions hold, the axes are parallel, antiparallel, or, in a joint that keeps an attitude and is off it by a
/// third of a turn, at right angles up to rounding.
fn agree([a, b]: &Motion, axes: &[nalgebra::Vector3<f64>; 2]) -> bool {
    let [own, partner] = [a.pose.rotation * axes[0], b.pose.rotation * axes[1]];
    own.dot(&partner) > 0.5
}

fn check_row(
    scene: &Scene,
    layout: &Layout,
    outputs: &[Vec<f64>],
    number: usize,
) -> Result<(), RunError> {
    let row = layout.rows[number];
    let motion = motion_of(layout, row.joint, |subsystem| &outputs[subsystem]);
    let condition = layout.joints[row.joint].joint.condition(row.condition);
    let levels = layout.level.up_to().iter();
    for &level in levels.filter(|level| **level < Level::Acceleration) {
        let residual = condition.value(level, &motion);
        // On position level the geometry has been fitted.
        let tolerance = match level {
            Level::Position => CLOSED,
            Level::Velocity | Level::Acceleration => scene.coupling.start_tolerance,
        };
        let extent = condition.extent(level, &motion);
        if residual.abs() > tolerance * extent {
            let message = format!(
                "the joint is open at t = {} s: {} is {}",
                readable::time(scene.t_start),
                layout.column_name(number, &format!("residual.{}", level.name())),
                readable::number(residual)
            );
            let key = format!("joint.{}", scene.joints[row.joint].name);
            let help = help(scene, layout, row.joint, &motion);
            return Err(scene.error(&key, message, Some(help)).into());
        }
    }
    Ok(())
}

/// What to do about a joint that is open.
fn help(scene: &Scene, layout: &Layout, joint: usize, motion: &Motion) -> String {
    let initial = "choose initial values of the two subsystems that meet the joint";
    let law = &layout.joints[joint].joint;
    let has_geometry = law.conditions().all(|condition| condition.law().is_some());
    let levels = layout.level.up_to().iter();
    let open = levels
        .filter(|level| **level < Level::Acceleration)
        .flat_map(|&level| {
            let share = move |condition: &dyn Condition| {
                condition.value(level, motion).abs() / condition.extent(level, motion)
            };
            law.conditions().map(share)
        });
    let wanted = MARGIN * open.fold(0.0, f64::max);
    let is_more = wanted > scene.coupling.start_tolerance;
    match has_geometry && is_more && wanted <= MOST_TOLERATED {
        true => {
            format!("{initial}, or, if they are rounded, coupling.start_tolerance = {wanted:.0e}")
        }
        false => initial.to_owned(),
    }
}
