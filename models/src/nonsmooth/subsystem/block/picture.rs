//! What a master sees of the block.

use crate::mechanics::describe::output;
use crate::mechanics::markers::PLANAR;
use crate::nonsmooth::subsystem::face::{Face, FaceContact, FaceMarker};
use crate::nonsmooth::subsystem::observed::{Motion, Observer, PointMotion};
use crate::nonsmooth::systems::body_on_planes::{Plane, turn};

const CORNERS: usize = 4;
/// Points of the outline; the last one is the first, so that it is closed.
const OUTLINE: usize = CORNERS + 1;

/// Names, units and numbers of everything. Markers: the centre, the outline, the corners, the plane.
pub fn face() -> Face {
    let centre = FaceMarker {
        load: PLANAR.loads("centre").map(|input| input.name).collect(),
        has_rates: true,
        ..FaceMarker::drawn("centre")
    };
    let numbered = |word: &'static str, count: usize| {
        (1..=count).map(move |number| FaceMarker::drawn(&format!("{word}{number}")))
    };
    let mut markers = vec![centre];
    markers.extend(numbered("block", OUTLINE));
    markers.extend(numbered("corner", CORNERS));
    markers.extend(numbered("plane", 2));
    let contact = |number: usize| FaceContact::at_point(&format!("corner{number}"));
    Face {
        contacts: (1..=CORNERS).map(contact).collect(),
        inputs: PLANAR.loads("centre").collect(),
        own: vec![
            output("way", "m", "place of the centre along the plane"),
            output("speed", "m/s", "its rate"),
            output("tilt", "rad", "angle of the block against the plane"),
        ],
        markers,
        ..Face::default()
    }
}

/// What the outputs are made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Picture {
    /// Angle of the plane (rad).
    pub slope: f64,
    /// Corners in axes of the block from its centre (m).
    pub corners: [[f64; 2]; CORNERS],
    /// Ends of the plane as it is drawn, along it (m).
    pub plane_ends: [f64; 2],
}

impl Picture {
    /// Share along the plane.
    fn along(&self, of: &[f64]) -> f64 {
        let tangent = Plane::rising(self.slope).tangent();
        tangent.iter().zip(of).map(|(t, of)| t * of).sum()
    }

    /// A corner, with the angle of the block.
    fn corner(&self, number: usize, q: &[f64]) -> PointMotion {
        let [x, y] = turn(q[2], self.corners[number % CORNERS]);
        [[q[0] + x, q[1] + y, q[2]], [0.0; 3], [0.0; 3]]
    }
}

impl Observer for Picture {
    fn own_output(&self, output: usize, motion: Motion<'_>) -> f64 {
        match output {
            0 => self.along(motion.q),
            1 => self.along(motion.v),
            _ => motion.q[2] - self.slope,
        }
    }

    fn marker(&self, marker: usize, motion: Motion<'_>) -> PointMotion {
        let Motion { q, v, a } = motion;
        match marker {
            0 => [q, v, a].map(|of| [of[0], of[1], of[2]]),
            1..=OUTLINE => self.corner(marker - 1, q),
            _ => match marker - OUTLINE - 1 {
                corner @ 0..CORNERS => self.corner(corner, q),
                end => {
                    let way = self.plane_ends[(end - CORNERS).min(1)];
                    let [x, y] = Plane::rising(self.slope).tangent().map(|t| t * way);
                    [[x, y, self.slope], [0.0; 3], [0.0; 3]]
                }
            },
        }
    }
}
