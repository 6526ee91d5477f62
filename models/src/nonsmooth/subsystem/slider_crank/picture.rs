//! Markers that are only drawn: outline of the slider, its corners, walls of the notch, nodes of the rod.
//!
//! Clearance, tilt and deflection are drawn larger than they are by the magnification, or they could not be seen.

use crate::nonsmooth::systems::notch::Notch;
use crate::nonsmooth::systems::rigid_slider_crank::Guide;

/// Corners in the order in which a pencil draws the slider, closed.
const PENCIL: [usize; 5] = [0, 1, 3, 2, 0];
/// Outline and corners of the slider, ends of both walls.
const SLIDER: usize = PENCIL.len() + 4;
const WALLS: usize = 4;

/// Names of all that is drawn, in their order.
pub fn outlines(guide: Guide, elements: usize) -> impl Iterator<Item = String> {
    let numbered =
        |word: &'static str, count: usize| (1..=count).map(move |k| format!("{word}{k}"));
    let walls = if guide == Guide::Free { 0 } else { 2 };
    let nodes = if elements > 0 { elements + 1 } else { 0 };
    numbered("outline", PENCIL.len())
        .chain(numbered("corner", 4))
        .chain(numbered("upper", walls))
        .chain(numbered("lower", walls))
        .chain(numbered("rod", nodes))
}

/// Place of something that is drawn, as `(x, y, angle)`; `None` behind slider and walls: then it is the node of the rod with
/// the number behind.
pub fn place(
    number: usize,
    notch: &Notch,
    [l1, l2]: [f64; 2],
    [x, y, angle]: [f64; 3],
    magnification: f64,
) -> Result<[f64; 3], usize> {
    let (y, tilt) = (magnification * y, magnification * angle);
    if let Some(corner) = number
        .checked_sub(PENCIL.len())
        .or_else(|| PENCIL.get(number).copied())
        .filter(|&corner| corner < 4)
    {
        let [dx, dy] = notch.corner(corner, tilt);
        return Ok([x + dx, y + dy, tilt]);
    }
    let wall = number - SLIDER;
    if wall >= WALLS {
        return Err(wall - WALLS);
    }
    let beyond = 2.0 * notch.half_length;
    let ends = [l2 - l1 - beyond, l1 + l2 + beyond];
    let height = notch.half_height + magnification * notch.clearance;
    let side = if wall < 2 { height } else { -height };
    Ok([ends[wall % 2], side, 0.0])
}
