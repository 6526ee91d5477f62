//! Where the mechanism moves.

use linchpin_master::results::RecordedJoint;
use linchpin_proto::joint_load::{Marker as _, Pose};
use nalgebra::Vector3;

use super::motion::{Form, Frame, Marker, Motion};

/// The box that the whole run takes, and the lanes of what moves on a line.
///
/// Markers in the plane move in z = 0. A subsystem with scalar markers moves along x on a lane of its own, because what
/// is rigidly linked would lie on one another; the distance between lanes means nothing.
pub(super) struct Stage {
    /// Lowest corner (m).
    pub low: Vector3<f64>,
    /// Highest corner (m).
    pub high: Vector3<f64>,
    /// Largest side of the box of all motions (m), never 0.
    pub size: f64,
    /// Something moves in space.
    pub is_space: bool,
    /// Something moves in more than one direction.
    pub has_heights: bool,
    lanes: Vec<Option<f64>>,
    /// Distance between lanes (m).
    pub lane_distance: f64,
}

/// Length of the axes of a marker's frame, as a share of the size.
const AXIS: f64 = 0.05;

/// Distance between lanes and height of all lanes, as shares of the size.
const LANE: f64 = 0.16;
const LANES: f64 = 0.6;

/// Side of a block, as a share of the distance between lanes.
const BLOCK: f64 = 0.5;

/// A motion smaller than this share of the coordinates is rounding.
const ROUNDING: f64 = 1e-9;

/// Size of what does not move at all (m).
const STILL: f64 = 1.0;

/// Motions smaller than this are none (m).
const SMALLEST: f64 = 1e-100;

impl Stage {
    /// The space that `motion` takes.
    pub fn of(motion: &Motion) -> Self {
        let uses = |least| motion.markers.iter().any(|m| m.form.coordinates() >= least);
        let (mut low, mut high) = extent(motion);
        let span = (high - low).max();
        let size = match span > SMALLEST.max(ROUNDING * low.amax().max(high.amax())) {
            true => span,
            false => STILL,
        };
        let mut slides = vec![false; motion.subsystems.len()];
        for marker in &motion.markers {
            slides[marker.subsystem] |= marker.form == Form::Line;
        }
        let count = slides.iter().filter(|slides| **slides).count();
        let lane_distance = size * LANE.min(LANES / count.max(1) as f64);
        let mut free = low.y - if uses(2) { lane_distance } else { 0.0 };
        let lane = |slides| {
            let own = free;
            free -= if slides { lane_distance } else { 0.0 };
            slides.then_some(own)
        };
        let lanes: Vec<Option<f64>> = slides.into_iter().map(lane).collect();
        low.y = lanes.iter().flatten().fold(low.y, |y, lane| y.min(*lane));
        let room = match uses(2) {
            true => Vector3::repeat(1.2 * AXIS * size),
            false => Vector3::new(AXIS * size, 0.5 * lane_distance, 0.0),
        };
        // What does not move gets room to be seen at its place.
        let widen = if span < size { 0.5 * size } else { 0.0 };
        low -= room + Vector3::repeat(widen);
        high += room + Vector3::repeat(widen);
        Self {
            low,
            high,
            size,
            is_space: uses(3),
            has_heights: uses(2),
            lanes,
            lane_distance,
        }
    }

    /// The pose of a marker in a frame.
    pub fn pose(&self, marker: &Marker, frame: &Frame) -> Pose {
        pose(marker, frame, self.lane(marker))
    }

    /// The two points in which a joint holds its markers in a frame (m), which coincide where the joint makes them.
    pub fn held(&self, joint: &RecordedJoint, motion: &Motion, frame: &Frame) -> [Vector3<f64>; 2] {
        [0, 1].map(|end| {
            let pose = self.pose(&motion.markers[joint.ends[end]], frame);
            pose.point(&joint.points[end].into())
        })
    }

    /// The lane of a marker in y (m); 0 for those that have none.
    pub fn lane(&self, marker: &Marker) -> f64 {
        self.lanes[marker.subsystem].unwrap_or(0.0)
    }

    /// All lanes in y (m).
    pub fn lanes(&self) -> impl Iterator<Item = f64> {
        self.lanes.iter().flatten().copied()
    }

    /// Side of the blocks on the lanes (m).
    pub fn block(&self) -> f64 {
        BLOCK * self.lane_distance
    }

    /// The lines that show a marker, in its own axes (m): a block on a line, elsewhere its axes.
    pub fn shape(&self, form: Form) -> Vec<Vec<Vector3<f64>>> {
        let (side, axis) = (0.5 * self.block(), AXIS * self.size);
        let along = |direction: Vector3<f64>| vec![Vector3::zeros(), axis * direction];
        match form {
            Form::Line => {
                let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
                let corner = |(x, y)| Vector3::new(side * x, side * y, 0.0);
                let closed = corners.into_iter().chain([corners[0]]);
                vec![closed.map(corner).collect()]
            }
            Form::PlanePoint | Form::SpacePoint => Vec::new(),
            Form::Plane => vec![along(Vector3::x()), along(0.6 * Vector3::y())],
            Form::Space => vec![
                along(Vector3::x()),
                along(0.8 * Vector3::y()),
                along(0.6 * Vector3::z()),
            ],
        }
    }
}

fn pose(marker: &Marker, frame: &Frame, lane: f64) -> Pose {
    let numbers = &frame.numbers[marker.start..][..marker.form.numbers()];
    match *numbers {
        [x] => Pose::planar(x, lane, 0.0),
        [x, y] => Pose::planar(x, y, 0.0),
        [x, y, angle] if marker.form == Form::Plane => Pose::planar(x, y, angle),
        [x, y, z, w, i, j, k] if [w, i, j, k] != [0.0; 4] => {
            Pose::spatial(Vector3::new(x, y, z), [w, i, j, k])
        }
        _ => Pose {
            position: Vector3::new(numbers[0], numbers[1], numbers[2]),
            ..Pose::default()
        },
    }
}

/// Lowest and highest coordinates of all markers and joints in all frames; 0 where nothing has a coordinate.
fn extent(motion: &Motion) -> (Vector3<f64>, Vector3<f64>) {
    let mut low = Vector3::repeat(f64::INFINITY);
    let mut high = Vector3::repeat(f64::NEG_INFINITY);
    let mut take = |marker: &Marker, point: &Vector3<f64>| {
        for axis in 0..marker.form.coordinates() {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    };
    for frame in motion.frames() {
        for marker in &motion.markers {
            take(marker, &pose(marker, frame, 0.0).position);
        }
        for joint in &motion.joints {
            for (end, point) in joint.ends.into_iter().zip(joint.points) {
                let marker = &motion.markers[end];
                take(marker, &pose(marker, frame, 0.0).point(&point.into()));
            }
        }
    }
    let finite = |value: f64| if value.is_finite() { value } else { 0.0 };
    (low.map(finite), high.map(finite))
}
