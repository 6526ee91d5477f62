//! Refuses a scene whose joints are open or turned over at the start.

use linchpin_proto::readable;

use crate::error::RunError;
use crate::joint::{Level, Motion};
use crate::layout::Layout;
use crate::scene::Scene;
use crate::system::motion_of;

/// Joints that are open by less than this share of the motion are closed up to rounding.
const CLOSED: f64 = 1e-9;

/// Checks all joints on the levels that the method demands below the acceleration. `outputs` are the coupling outputs.
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
        if residual.abs() > CLOSED * condition.extent(level, &motion) {
            let message = format!(
                "the joint is open at t = {} s: {} is {}",
                readable::time(scene.t_start),
                layout.column_name(number, &format!("residual.{}", level.name())),
                readable::number(residual)
            );
            let help = "choose initial values of the two subsystems that meet the joint";
            let key = format!("joint.{}", scene.joints[row.joint].name);
            return Err(scene.error(&key, message, Some(help.into())).into());
        }
    }
    Ok(())
}
