//! The line from a hinge in the ground to the tip of a crank.

/// Distance (m) and angle from the x axis (rad).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TipLine {
    pub distance: f64,
    pub angle: f64,
}

impl TipLine {
    /// From the hinge at `hinge` (m, from the crank's hinge) to the tip of a crank of this length (m) and angle (rad).
    ///
    /// The angle is continuous however often the crank turns. It is counted from a direction that the line
    /// is never at a right angle to: the crank's own if the hinge lies inside the tip's circle, otherwise the one from
    /// the hinge to the crank's hinge.
    pub fn new(hinge: [f64; 2], length: f64, angle: f64) -> Self {
        let [x, y] = hinge;
        let (sin, cos) = angle.sin_cos();
        let line = [length * cos - x, length * sin - y];
        let base = if x.hypot(y) < length {
            angle
        } else {
            (-y).atan2(-x)
        };
        let (sin, cos) = base.sin_cos();
        let across = cos * line[1] - sin * line[0];
        let along = cos * line[0] + sin * line[1];
        Self {
            distance: line[0].hypot(line[1]),
            angle: base + across.atan2(along),
        }
    }
}
