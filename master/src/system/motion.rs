//! Motion of the joints' markers in the outputs of the subsystems.

use crate::joint::{Level, Motion};
use crate::layout::Layout;

/// What joint number `joint` reads of the motion of its two markers; levels that the layout does not have stay 0 and are
/// not read.
pub fn motion_of<'a>(
    layout: &Layout,
    joint: usize,
    outputs: impl Fn(usize) -> &'a [f64],
) -> Motion {
    motion_up_to(Level::Acceleration, layout, joint, outputs)
}

/// The same up to a level.
pub(super) fn motion_up_to<'a>(
    highest: Level,
    layout: &Layout,
    joint: usize,
    outputs: impl Fn(usize) -> &'a [f64],
) -> Motion {
    let ends = &layout.joints[joint].ends;
    ends.each_ref()
        .map(|end| end.motion_up_to(highest, outputs(end.subsystem)))
}
