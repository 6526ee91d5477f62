//! Markers that are only drawn: outline of the slider, its corners, walls of the notch, nodes of the rod.
//!
//! Clearance, tilt and deflection are drawn larger than they are by the magnification, or they could not be seen.

use crate::nonsmooth::systems::notch::Notch;
use crate::nonsmooth::systems::rigid_slider_crank::Guide;

/// Something that is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drawn {
    /// A corner of the slider.
    Corner(usize),
    /// An end of a wall: 1 for the upper wall, -1 for the lower one; its left or its right end.
    Wall(i8, usize),
    /// A node of the rod.
    Node(usize),
}

/// Corners in the order in which a pencil draws the slider, closed.
const PENCIL: [usize; 5] = [0, 1, 3, 2, 0];

/// All that is drawn, with the names of the markers.
pub fn drawn(guide: Guide, elements: usize) -> Vec<(String, Drawn)> {
    let mut all = Vec::new();
    let mut add = |word: &str, number: usize, drawn| all.push((format!("{word}{number}"), drawn));
    for (place, corner) in PENCIL.into_iter().enumerate() {
        add("slider", place + 1, Drawn::Corner(corner));
    }
    if matches!(guide, Guide::Clearance(_)) {
        (0..4).for_each(|corner| add("corner", corner + 1, Drawn::Corner(corner)));
    }
    if guide != Guide::Free {
        (0..2).for_each(|end| add("upper", end + 1, Drawn::Wall(1, end)));
        (0..2).for_each(|end| add("lower", end + 1, Drawn::Wall(-1, end)));
    }
    if elements > 0 {
        (0..=elements).for_each(|node| add("rod", node + 1, Drawn::Node(node)));
    }
    all
}

/// Slider and notch as they are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Picture {
    /// Slider and notch.
    pub notch: Notch,
    /// Lengths of crank and rod (m).
    pub lengths: [f64; 2],
    /// Of clearance and tilt.
    pub magnification: f64,
    /// Of the deflection of the rod.
    pub bending: f64,
    /// Whether the walls are where the slider touches them: without clearance it slides on them.
    pub has_clearance: bool,
}

impl Picture {
    /// Of a mechanism.
    pub fn new(
        notch: Notch,
        lengths: [f64; 2],
        [magnification, bending]: [f64; 2],
        guide: Guide,
    ) -> Self {
        Self {
            notch,
            lengths,
            magnification,
            bending,
            has_clearance: matches!(guide, Guide::Clearance(_)),
        }
    }

    /// Place of a corner or a wall, as `(x, y, angle)`, with the centre of the slider; that of a node is the rod's to
    /// say.
    pub fn place(&self, drawn: Drawn, [x, y, angle]: [f64; 3]) -> [f64; 3] {
        match drawn {
            Drawn::Corner(corner) => {
                let tilt = self.magnification * angle;
                let [dx, dy] = self.notch.corner(corner, tilt);
                [x + dx, self.magnification * y + dy, tilt]
            }
            Drawn::Wall(side, end) => {
                let [l1, l2] = self.lengths;
                let beyond = 2.0 * self.notch.half_length;
                let ends = [l2 - l1 - beyond, l1 + l2 + beyond];
                let clearance = if self.has_clearance {
                    self.notch.clearance
                } else {
                    0.0
                };
                let height = self.notch.half_height + self.magnification * clearance;
                [ends[end], f64::from(side) * height, 0.0]
            }
            Drawn::Node(_) => [x, y, angle],
        }
    }
}
