//! From the inertial frame to the picture: a parallel projection with equal scales in all directions.

use nalgebra::Vector3;
use serde::Serialize;

use super::stage::Stage;

/// Width of the picture in pixels.
const WIDTH: f64 = 960.0;

/// Least and greatest height.
const HEIGHTS: (f64, f64) = (200.0, 640.0);

/// Room for the numbers at the scales: left and right, above and below.
const MARGINS: (f64, f64) = (70.0, 48.0);

/// Direction of view on a scene in space (rad): about z from the x axis, and above the plane of x and y.
const AZIMUTH: f64 = -1.05;
const ELEVATION: f64 = 0.35;

/// Places in the picture: pixels to the right are `middle.0 + scale right . (p - centre)`, pixels downwards
/// `middle.1 - scale up . (p - centre)`, for a point `p` (m) in inertial axes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct View {
    /// Width and height in pixels.
    pub size: (f64, f64),
    /// Where `centre` is, in pixels.
    pub middle: (f64, f64),
    /// Pixels per metre.
    pub scale: f64,
    /// The point that stays in the middle (m).
    pub centre: [f64; 3],
    /// Unit vector to the right of the picture.
    pub right: [f64; 3],
    /// Unit vector upwards in the picture.
    pub up: [f64; 3],
    /// The direction of view, if it can be turned.
    pub turn: Option<Turn>,
}

/// Where a scene in space is seen from (rad).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct Turn {
    azimuth: f64,
    elevation: f64,
}

impl View {
    /// The view that shows all of a stage; one on a scene in space shows it from all sides at the same scale.
    pub fn on(stage: &Stage) -> Self {
        let span = stage.high - stage.low;
        let room = (WIDTH - 2.0 * MARGINS.0, HEIGHTS.1 - 2.0 * MARGINS.1);
        let centre = (0.5 * (stage.low + stage.high)).into();
        if stage.is_space {
            let turn = Turn {
                azimuth: AZIMUTH,
                elevation: ELEVATION,
            };
            let (right, up) = turn.axes();
            return Self {
                size: (WIDTH, HEIGHTS.1),
                middle: (0.5 * WIDTH, 0.5 * HEIGHTS.1),
                scale: (HEIGHTS.1 - MARGINS.1) / span.norm(),
                centre,
                right,
                up,
                turn: Some(turn),
            };
        }
        let scale = (room.0 / span.x).min(room.1 / span.y);
        let height = (scale * span.y + 2.0 * MARGINS.1).clamp(HEIGHTS.0, HEIGHTS.1);
        Self {
            size: (WIDTH, height.round()),
            middle: (0.5 * WIDTH, 0.5 * height.round()),
            scale,
            centre,
            right: [1.0, 0.0, 0.0],
            up: [0.0, 1.0, 0.0],
            turn: None,
        }
    }

    /// Place of a point in the picture in pixels.
    pub fn place(&self, point: &Vector3<f64>) -> (f64, f64) {
        let offset = point - Vector3::from(self.centre);
        (
            self.middle.0 + self.scale * Vector3::from(self.right).dot(&offset),
            self.middle.1 - self.scale * Vector3::from(self.up).dot(&offset),
        )
    }
}

impl Turn {
    /// Unit vectors to the right and upwards; z is never to the side.
    fn axes(self) -> ([f64; 3], [f64; 3]) {
        let (sin_a, cos_a) = self.azimuth.sin_cos();
        let (sin_e, cos_e) = self.elevation.sin_cos();
        (
            [-sin_a, cos_a, 0.0],
            [-sin_e * cos_a, -sin_e * sin_a, cos_e],
        )
    }
}
