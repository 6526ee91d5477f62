//! The end of a joint: where a marker's motion stands in its subsystem's outputs.

use linchpin_proto::joint_load::{Pose, Reads};
use linchpin_proto::v1::{self, MarkerKind};
use nalgebra::Vector3;

use crate::joint::{Level, MarkerGradient, MarkerMotion};
use crate::signal::attitude::quaternion_gradient;

/// A marker that a joint holds.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundEnd {
    /// Place of the subsystem in the scene.
    pub subsystem: usize,
    kind: MarkerKind,
    levels: Vec<Places>,
    /// All places of the levels, one level after the other.
    places: Vec<usize>,
    /// How many of them the levels up to each one have.
    counts: Vec<usize>,
}

/// A coordinate or part of an attitude, or a rate of them, among the coupling outputs of a subsystem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Position {
    /// Its place.
    pub place: usize,
    /// Whether it is a coordinate, measured by the size of the mechanism; otherwise it is an angle or part of a quaternion, measured by 1.
    pub is_length: bool,
}

/// Places in the coupling outputs on one level; empty where nothing is read.
#[derive(Debug, Clone, PartialEq, Default)]
struct Places {
    position: Vec<usize>,
    rotation: Vec<usize>,
}

impl BoundEnd {
    /// Finds what `reads` tells on every level up to `level`; `place_of` gives the place of an output.
    ///
    /// # Errors
    /// The level on which the marker offers too little.
    pub(super) fn new(
        subsystem: usize,
        marker: &v1::Marker,
        reads: Reads,
        level: Level,
        mut place_of: impl FnMut(&str) -> usize,
    ) -> Result<Self, Level> {
        let (mut levels, mut places, mut counts) = (Vec::<Places>::new(), Vec::new(), Vec::new());
        for &level in level.up_to() {
            let names = outputs_of(marker, level);
            let parts = Parts::of(marker.kind(), level);
            let mut find = |places: std::ops::Range<usize>| {
                let names = names.get(places).ok_or(level)?;
                Ok(names.iter().map(|name| place_of(name)).collect())
            };
            let own = Places {
                position: find(if reads.position { parts.position } else { 0..0 })?,
                rotation: find(if reads.rotation { parts.rotation } else { 0..0 })?,
            };
            places.extend(own.position.iter().chain(&own.rotation));
            counts.push(places.len());
            levels.push(own);
        }
        Ok(Self {
            subsystem,
            kind: marker.kind(),
            levels,
            places,
            counts,
        })
    }

    /// Places of the coordinates and of the angle or quaternion on position level.
    pub fn positions(&self) -> impl Iterator<Item = usize> {
        self.places(Level::Position)
    }

    /// Places of what is read on a level.
    pub fn places(&self, level: Level) -> impl Iterator<Item = usize> {
        let levels = self.levels.get(level as usize).into_iter();
        levels.flat_map(|places| places.position.iter().chain(&places.rotation).copied())
    }

    /// Places of what is read on a level and on those below it.
    pub fn places_up_to(&self, highest: Level) -> &[usize] {
        let count = self.counts.get(highest as usize).or(self.counts.last());
        &self.places[..count.copied().unwrap_or(0)]
    }

    /// Places of what is read on a level, and what of it is measured by the size of the mechanism.
    pub fn sized(&self, level: Level) -> impl Iterator<Item = Position> {
        let translation = self.translation(level).iter().map(|&place| (place, true));
        let orientation = self.orientation(level).iter().map(|&place| (place, false));
        let both = translation.chain(orientation);
        both.map(|(place, is_length)| Position { place, is_length })
    }

    /// Places of the coordinates on position level.
    pub fn coordinates(&self) -> &[usize] {
        self.translation(Level::Position)
    }

    /// Places of the coordinates, their velocities or accelerations.
    pub fn translation(&self, level: Level) -> &[usize] {
        let places = self.levels.get(level as usize);
        places.map_or(&[], |places| &places.position)
    }

    /// Places of the angle or quaternion, or of its rates.
    pub fn orientation(&self, level: Level) -> &[usize] {
        let places = self.levels.get(level as usize);
        places.map_or(&[], |places| &places.rotation)
    }

    /// The motion that the outputs of the subsystem tell.
    pub fn motion(&self, outputs: &[f64]) -> MarkerMotion {
        self.motion_up_to(Level::Acceleration, outputs)
    }

    /// The same up to a level; what is above stays 0.
    pub fn motion_up_to(&self, highest: Level, outputs: &[f64]) -> MarkerMotion {
        let mut motion = MarkerMotion::default();
        for (level, places) in highest.up_to().iter().zip(&self.levels) {
            let position = vector(&places.position, outputs);
            match level {
                Level::Position => motion.pose = self.pose(position, places, outputs),
                Level::Velocity => {
                    motion.velocity = position;
                    motion.omega = self.turning(&places.rotation, outputs);
                }
                Level::Acceleration => {
                    motion.acceleration = position;
                    motion.alpha = self.turning(&places.rotation, outputs);
                }
            }
        }
        motion
    }

    fn pose(&self, position: Vector3<f64>, places: &Places, outputs: &[f64]) -> Pose {
        match places.rotation[..] {
            [angle] => Pose::planar(position.x, position.y, outputs[angle]),
            [w, x, y, z] => Pose::spatial(position, [w, x, y, z].map(|place| outputs[place])),
            _ => Pose {
                position,
                ..Pose::default()
            },
        }
    }

    /// Rates of turning: about the third axis in the plane.
    fn turning(&self, places: &[usize], values: &[f64]) -> Vector3<f64> {
        match self.kind {
            MarkerKind::Planar => Vector3::new(0.0, 0.0, vector(places, values).x),
            _ => vector(places, values),
        }
    }

    /// Writes the derivatives of a number with respect to the outputs at [`BoundEnd::places_up_to`] behind `into`, where those
    /// with respect to the motion are `by`.
    pub fn add_gradient(
        &self,
        highest: Level,
        outputs: &[f64],
        by: &MarkerGradient,
        into: &mut Vec<f64>,
    ) {
        for (level, places) in highest.up_to().iter().zip(&self.levels) {
            let (by_position, by_rotation) = match level {
                Level::Position => (&by.position, &by.rotation),
                Level::Velocity => (&by.velocity, &by.omega),
                Level::Acceleration => (&by.acceleration, &by.alpha),
            };
            into.extend(by_position.iter().take(places.position.len()));
            match places.rotation[..] {
                [_] => into.push(by_rotation.z),
                [w, x, y, z] => {
                    let q = [w, x, y, z].map(|place| outputs[place]);
                    into.extend(quaternion_gradient(q, by_rotation));
                }
                _ => into.extend(by_rotation.iter().take(places.rotation.len())),
            }
        }
    }
}

/// The first three of some values; missing ones are 0.
pub(crate) fn vector(places: &[usize], values: &[f64]) -> Vector3<f64> {
    let mut vector = Vector3::zeros();
    for (component, &place) in vector.iter_mut().zip(places) {
        *component = values[place];
    }
    vector
}

/// Which entries of a marker's lists are coordinates, and which tell the orientation.
pub(super) struct Parts {
    pub(super) position: std::ops::Range<usize>,
    pub(super) rotation: std::ops::Range<usize>,
}

impl Parts {
    pub(super) fn of(kind: MarkerKind, level: Level) -> Self {
        let (position, rotation) = match (kind, level) {
            (MarkerKind::Planar, _) => (0..2, 2..3),
            (MarkerKind::Spatial, Level::Position) => (0..3, 3..7),
            (MarkerKind::Spatial, _) => (0..3, 3..6),
            (MarkerKind::Scalar | MarkerKind::Unspecified, _) => (0..1, 0..0),
        };
        Self { position, rotation }
    }
}

/// Names of the marker's outputs on a level.
pub fn outputs_of(marker: &v1::Marker, level: Level) -> &[String] {
    match level {
        Level::Position => &marker.position,
        Level::Velocity => &marker.velocity,
        Level::Acceleration => &marker.acceleration,
    }
}
