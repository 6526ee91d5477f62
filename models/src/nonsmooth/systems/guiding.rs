//! Rows of the contacts between slider and notch, by the motion of the slider.

use crate::nonsmooth::systems::notch::{CORNERS, Notch, ROWS};
use crate::nonsmooth::systems::rigid_slider_crank::Guide;

/// One row: its derivatives by place and angle of the slider.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GuidingRow {
    /// By `x` and `y` of the slider's centre; constant.
    pub by_place: [f64; 2],
    /// By its angle (m).
    pub by_angle: f64,
    /// Twice by its angle (m).
    pub by_angle_twice: f64,
}

/// The rows of a guide at an angle of the slider: of every contact the normal one, then the tangent.
pub fn rows(guide: Guide, notch: &Notch, angle: f64) -> impl Iterator<Item = GuidingRow> {
    let mut rows = [GuidingRow::default(); ROWS];
    let count = match guide {
        Guide::Clearance(_) => {
            let by_height = Notch::by_height();
            let normal = [
                notch.normal_by_angle(angle),
                notch.normal_by_angle_twice(angle),
            ];
            let tangent = [
                notch.tangent_by_angle(angle),
                notch.tangent_by_angle_twice(angle),
            ];
            for corner in 0..CORNERS {
                rows[2 * corner] = GuidingRow {
                    by_place: [0.0, by_height[corner]],
                    by_angle: normal[0][corner],
                    by_angle_twice: normal[1][corner],
                };
                rows[2 * corner + 1] = GuidingRow {
                    by_place: [1.0, 0.0],
                    by_angle: tangent[0][corner],
                    by_angle_twice: tangent[1][corner],
                };
            }
            ROWS
        }
        Guide::Bilateral { .. } => {
            rows[0].by_place = [0.0, 1.0];
            rows[1].by_place = [1.0, 0.0];
            rows[2].by_angle = 1.0;
            3
        }
        Guide::Free => 0,
    };
    rows.into_iter().take(count)
}
