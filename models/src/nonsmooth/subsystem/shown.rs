//! Markers that are for pictures: fixed points, and points on a body whose motion across a guide is magnified.

use super::face::FaceMarker;
use super::observed::PointMotion;
use crate::nonsmooth::systems::notch::{CORNERS, Notch};

/// Where a marker for pictures is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shown {
    /// At a fixed place (m).
    At([f64; 2]),
    /// On the body of another marker.
    On {
        /// Number of that marker, one that the system itself moves.
        marker: usize,
        /// The point in the axes of that marker (m).
        point: [f64; 2],
        /// How many times larger its height y and its angle are shown.
        magnification: f64,
    },
}

impl Shown {
    /// Where the marker is shown; `marker` is the motion of the system's own ones. Rates are not known.
    pub fn motion(self, marker: impl Fn(usize) -> PointMotion) -> PointMotion {
        let pose = match self {
            Self::At([x, y]) => [x, y, 0.0],
            Self::On {
                marker: body,
                point: [along, up],
                magnification,
            } => {
                let [[x, y, angle], ..] = marker(body);
                let (height, angle) = (magnification * y, magnification * angle);
                let (sin, cos) = angle.sin_cos();
                [
                    x + along * cos - up * sin,
                    height + along * sin + up * cos,
                    angle,
                ]
            }
        };
        [pose, [0.0; 3], [0.0; 3]]
    }
}

/// A slider in its notch as markers for pictures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliderPicture {
    /// Slider and notch.
    pub notch: Notch,
    /// Number of the marker at the centre of the slider.
    pub centre: usize,
    /// How many times larger clearance, height and angle are shown.
    pub magnification: f64,
    /// Ends of the walls in x (m).
    pub walls: [f64; 2],
}

/// Corners in the order in which a pencil draws the slider, back to where it began.
const OUTLINE: [usize; CORNERS + 1] = [0, 1, 3, 2, 0];

impl SliderPicture {
    /// The outline of the slider, `slider1` to `slider5`.
    pub fn slider(&self) -> impl Iterator<Item = FaceMarker> + '_ {
        let corners = OUTLINE.into_iter().zip(1..);
        corners.map(|(corner, number)| self.on_slider(format!("slider{number}"), corner))
    }

    /// The corners by the names of their contacts, `corner1` to `corner4`.
    pub fn corners(&self) -> impl Iterator<Item = FaceMarker> + '_ {
        (0..CORNERS).map(|corner| self.on_slider(format!("corner{}", corner + 1), corner))
    }

    /// The walls, `upper1`, `upper2` and `lower1`, `lower2`, with this clearance (m) on each side.
    pub fn walls(&self, clearance: f64) -> impl Iterator<Item = FaceMarker> + '_ {
        let height = self.notch.half_height + self.magnification * clearance;
        let walls = [("upper", height), ("lower", -height)].into_iter();
        walls.flat_map(move |(name, y)| {
            let ends = self.walls.into_iter().zip(1..);
            ends.map(move |(x, number)| {
                FaceMarker::for_pictures(format!("{name}{number}"), Shown::At([x, y]))
            })
        })
    }

    fn on_slider(&self, name: String, corner: usize) -> FaceMarker {
        let shown = Shown::On {
            marker: self.centre,
            point: self.notch.corner(corner),
            magnification: self.magnification,
        };
        FaceMarker::for_pictures(name, shown)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOTCH: Notch = Notch {
        half_length: 0.05,
        half_height: 0.025,
        clearance: 1e-3,
    };

    /// A corner that touches its wall touches it in the picture as well, however much is magnified.
    #[test]
    fn contacts_close_in_the_picture_when_they_close() {
        for magnification in [1.0, 10.0] {
            let picture = SliderPicture {
                notch: NOTCH,
                centre: 0,
                magnification,
                walls: [0.1, 0.5],
            };
            // Tilted until corner 2 is at the upper wall.
            let angle = 5e-3;
            let reach = NOTCH.half_length * f64::sin(angle) + NOTCH.half_height * f64::cos(angle);
            let height = NOTCH.half_height + NOTCH.clearance - reach;
            let place = |marker: FaceMarker| {
                let motion = |_| [[0.3, height, angle], [0.0; 3], [0.0; 3]];
                marker.shown.map(|shown| shown.motion(motion)[0])
            };
            let corner = picture.corners().nth(1).and_then(place);
            let wall = picture.walls(NOTCH.clearance).next().and_then(place);
            let (Some([x, y, turn]), Some([_, upper, _])) = (corner, wall) else {
                panic!("markers for pictures");
            };
            assert!(x > 0.34 && x < 0.35 && turn == magnification * angle);
            // Second order of the magnified angle.
            assert!(
                (y - upper).abs() < 0.05 * (magnification * angle).powi(2),
                "{y} {upper}"
            );
        }
    }
}
