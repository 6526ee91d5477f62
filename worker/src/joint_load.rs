//! Joint loads: the force and moment of a joint, evaluated inside the solver at the pose that its marker has there.
//!
//! The master sends what the load depends on besides the own pose, as signals: the multiplier and the pose of the
//! partner's marker. The laws are those of [`linchpin_proto::joint_load`]. At every evaluation of its right-hand side, and of
//! outputs that feel loads, a solver adds [`JointLoad::wrench`] to what its marker's own inputs give.

pub(crate) mod request;

use linchpin_proto::joint_load::{End, JointLaw, Pose, Wrench};
use nalgebra::Vector3;

/// The load of one multiplier on one marker. Places of signals count the input values as the subsystem sees them: see
/// [`Subsystem`](crate::Subsystem).
#[derive(Debug, Clone, PartialEq)]
pub struct JointLoad {
    /// The marker that takes it.
    pub marker: LoadedMarker,
    /// Condition of the multiplier.
    pub law: JointLaw,
    /// Which end of the joint the marker is.
    pub end: End,
    /// Place of the multiplier.
    pub multiplier: usize,
    /// The marker at the other end.
    pub partner: Partner,
}

/// A marker of the model with the places of its pose and of its load.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LoadedMarker {
    /// Its name.
    pub name: String,
    /// In the plane or in space.
    pub space: Space,
    /// Its position among the outputs, in the order of [`Marker`](linchpin_proto::v1::Marker); may end early.
    pub position: Vec<usize>,
    /// Its load among the inputs; may end early.
    pub load: Vec<usize>,
}

/// Where a marker moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Space {
    /// In the plane: position `x, y, angle`, load `fx, fy, moment`.
    Planar,
    /// In space: position `x, y, z, qw, qx, qy, qz`, load `force (3), moment (3)`.
    Spatial,
}

/// Places of the partner's pose. What the law does not read is absent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Partner {
    /// In the plane.
    Planar {
        /// `x, y` (m).
        position: Option<[usize; 2]>,
        /// Angle (rad).
        angle: Option<usize>,
    },
    /// In space.
    Spatial {
        /// `x, y, z` (m).
        position: Option<[usize; 3]>,
        /// Orientation.
        orientation: Option<Orientation>,
    },
}

/// An orientation in space: a rotation vector that follows on a reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Orientation {
    /// Quaternion `(w, x, y, z)` of the reference, from the marker's axes to inertial ones; its length does not count.
    pub attitude: [usize; 4],
    /// Rotation vector (rad) in inertial axes.
    pub rotation: [usize; 3],
}

impl JointLoad {
    /// Force (N) and moment about the marker (N m) in inertial axes: the multiplier times
    /// [`JointLaw::unit_wrench`]. `own` is the pose of the own marker and `inputs` the input values, both at the same
    /// instant.
    ///
    /// # Panics
    /// If `inputs` is shorter than the places of this load tell; it never is with the input values of a subsystem.
    pub fn wrench(&self, own: &Pose, inputs: &[f64]) -> Wrench {
        let unit = self.law.unit_wrench(self.end, &self.poses(own, inputs));
        scaled(inputs[self.multiplier], unit)
    }

    fn poses(&self, own: &Pose, inputs: &[f64]) -> [Pose; 2] {
        let partner = self.partner.pose(inputs);
        match self.end {
            End::A => [*own, partner],
            End::B => [partner, *own],
        }
    }
}

impl Partner {
    /// Pose of the partner's marker; what is absent is that of [`Pose::default`].
    ///
    /// # Panics
    /// As [`JointLoad::wrench`].
    pub fn pose(&self, inputs: &[f64]) -> Pose {
        match *self {
            Self::Planar { position, angle } => {
                let [x, y] = position.map_or([0.0; 2], |places| values(inputs, places));
                Pose::planar(x, y, angle.map_or(0.0, |place| inputs[place]))
            }
            Self::Spatial {
                position,
                orientation,
            } => Pose {
                position: position
                    .map_or_else(Vector3::zeros, |places| values(inputs, places).into()),
                rotation: orientation
                    .map_or_else(Pose::default, |own| own.pose(inputs))
                    .rotation,
            },
        }
    }
}

impl Orientation {
    fn pose(&self, inputs: &[f64]) -> Pose {
        let reference = Pose::spatial(Vector3::zeros(), values(inputs, self.attitude));
        reference.turned(&values(inputs, self.rotation).into())
    }
}

impl LoadedMarker {
    /// Pose of the marker, from the model's outputs by their places. Components that the marker does not offer are 0 and
    /// no rotation; no load of a request reads them.
    pub fn pose(&self, output: impl Fn(usize) -> f64) -> Pose {
        let component = |place: usize| self.position.get(place).map_or(0.0, |&place| output(place));
        match self.space {
            Space::Planar => Pose::planar(component(0), component(1), component(2)),
            Space::Spatial => {
                let position = Vector3::from_fn(|i, _| component(i));
                match self.position[..] {
                    [_, _, _, w, x, y, z] => Pose::spatial(position, [w, x, y, z].map(output)),
                    _ => Pose {
                        position,
                        ..Pose::default()
                    },
                }
            }
        }
    }

    /// Adds a load to the input values of this marker.
    ///
    /// # Panics
    /// If `inputs` is shorter than the places of the marker tell.
    pub fn add(&self, wrench: &Wrench, inputs: &mut [f64]) {
        let Wrench { force, moment } = wrench;
        let planar = [force.x, force.y, moment.z];
        let spatial = [force.x, force.y, force.z, moment.x, moment.y, moment.z];
        let components: &[f64] = match self.space {
            Space::Planar => &planar,
            Space::Spatial => &spatial,
        };
        for (&place, component) in self.load.iter().zip(components) {
            inputs[place] += component;
        }
    }
}

fn scaled(multiplier: f64, unit: Wrench) -> Wrench {
    Wrench {
        force: multiplier * unit.force,
        moment: multiplier * unit.moment,
    }
}

fn values<const N: usize>(inputs: &[f64], places: [usize; N]) -> [f64; N] {
    places.map(|place| inputs[place])
}
