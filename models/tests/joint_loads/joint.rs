//! Joints to a partner whose motion is prescribed.

use linchpin_proto::joint_load::{End, JointLaw, Law, Pose};
use linchpin_proto::v1;
use nalgebra::{Quaternion, UnitQuaternion, Vector3, Vector6};

use crate::run::Signal;

/// In the plane or in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Space {
    Planar,
    Spatial,
}

/// The motion of a partner's marker.
#[derive(Clone, Copy)]
pub struct Partner {
    pub space: Space,
    /// Position (m) at a time.
    pub position: fn(f64) -> Vector3<f64>,
    /// Rotation vector (rad) at a time, which follows on the reference; in the plane `(0, 0, angle)`.
    pub turn: fn(f64) -> Vector3<f64>,
    /// Reference, `(w, x, y, z)`.
    pub reference: [f64; 4],
}

/// One multiplier of a joint between a marker of the model and the partner.
#[derive(Debug, Clone, Copy)]
pub struct Joint {
    pub marker: &'static str,
    pub law: JointLaw,
    pub end: End,
}

impl Partner {
    pub fn pose(&self, t: f64) -> Pose {
        let turn = UnitQuaternion::from_scaled_axis((self.turn)(t));
        let [w, x, y, z] = self.reference;
        let attitude = turn * UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        Pose {
            position: (self.position)(t),
            rotation: attitude.to_rotation_matrix().into_inner(),
        }
    }

    /// Multiplier, position, rotation, attitude as signals, and what `Initialize` says of them: `joints` have the same
    /// multiplier and the same partner.
    pub fn request(&self, joints: &[Joint]) -> v1::InitializeRequest {
        let (position, rotation, attitude): (Vec<u32>, Vec<u32>, Vec<u32>) = match self.space {
            Space::Planar => ((1..3).collect(), vec![6], Vec::new()),
            Space::Spatial => ((1..4).collect(), (4..7).collect(), (7..11).collect()),
        };
        let loads = joints.iter().map(|joint| v1::JointLoad {
            multiplier: 0,
            partner_position: position.clone(),
            partner_rotation: rotation.clone(),
            partner_attitude: attitude.clone(),
            ..joint.law.to_message(joint.marker, joint.end)
        });
        v1::InitializeRequest {
            joint_inputs: [
                "lambda", "x", "y", "z", "rx", "ry", "rz", "qw", "qx", "qy", "qz",
            ]
            .map(str::to_owned)
            .into(),
            joint_loads: loads.collect(),
            ..v1::InitializeRequest::default()
        }
    }

    /// Calls `with` with the signals of [`Partner::request`].
    pub fn signals<T>(&self, multiplier: fn(f64) -> f64, with: impl FnOnce(&[Signal]) -> T) -> T {
        let (position, turn, reference) = (self.position, self.turn, self.reference);
        with(&[
            &multiplier,
            &|t| position(t).x,
            &|t| position(t).y,
            &|t| position(t).z,
            &|t| turn(t).x,
            &|t| turn(t).y,
            &|t| turn(t).z,
            &|_| reference[0],
            &|_| reference[1],
            &|_| reference[2],
            &|_| reference[3],
        ])
    }
}

impl Joint {
    /// The condition, straight from S1 eqs. (28), (37) and (46).
    pub fn condition(&self, own: &Pose, partner: &Pose) -> f64 {
        let [a, b] = match self.end {
            End::A => [own, partner],
            End::B => [partner, own],
        };
        let [point_a, point_b] = self.law.points;
        let place = |pose: &Pose, point: Vector3<f64>| pose.position + pose.rotation * point;
        let distance = place(a, point_a) - place(b, point_b);
        match self.law.law {
            Law::AtPoint { direction } => distance.dot(&direction),
            Law::InPlane { normal } => distance.dot(&(b.rotation * normal)),
            Law::Perpendicular { axes } => (a.rotation * axes[0]).dot(&(b.rotation * axes[1])),
        }
    }

    /// Derivative of the condition with respect to translation and rotation of the own marker, by differences of
    /// fourth order.
    pub fn derivative(&self, own: &Pose, partner: &Pose) -> Vector6<f64> {
        let increment = 1e-3;
        Vector6::from_fn(|direction, _| {
            let at = |parts: f64| {
                let mut moved = *own;
                let mut by = Vector3::zeros();
                by[direction % 3] = parts * increment;
                if direction < 3 {
                    moved.position += by;
                } else {
                    let turn = UnitQuaternion::from_scaled_axis(by);
                    moved.rotation = turn.to_rotation_matrix() * moved.rotation;
                }
                self.condition(&moved, partner)
            };
            (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * increment)
        })
    }
}

/// Names of the outputs that are the pose of a marker.
pub fn pose_outputs(space: Space, marker: &str) -> Vec<String> {
    let parts: &[&str] = match space {
        Space::Planar => &["x", "y", "angle"],
        Space::Spatial => &["x", "y", "z", "qw", "qx", "qy", "qz"],
    };
    parts
        .iter()
        .map(|part| format!("{marker}_{part}"))
        .collect()
}

/// The pose that these outputs tell.
pub fn pose(values: &[f64]) -> Pose {
    let (position, attitude) = match *values {
        [x, y, angle] => (
            Vector3::new(x, y, 0.0),
            UnitQuaternion::from_scaled_axis(Vector3::new(0.0, 0.0, angle)),
        ),
        [x, y, z, w, i, j, k] => (
            Vector3::new(x, y, z),
            UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k)),
        ),
        _ => panic!("{values:?} is no pose"),
    };
    Pose {
        position,
        rotation: attitude.to_rotation_matrix().into_inner(),
    }
}

/// One joint of every law, with both ends and points off the markers.
pub fn all_joints(space: Space, marker: &'static str) -> Vec<Joint> {
    let vector = |x: f64, y: f64, z: f64| match space {
        Space::Planar => Vector3::new(x, y, 0.0),
        Space::Spatial => Vector3::new(x, y, z),
    };
    let unit = |x, y, z| vector(x, y, z).normalize();
    let points = [vector(0.3, -0.2, 0.5), vector(-0.17, 0.4, 0.29)];
    let laws = [
        Law::AtPoint {
            direction: unit(1.0, 2.0, -0.5),
        },
        Law::InPlane {
            normal: unit(0.3, -1.0, 0.8),
        },
        Law::Perpendicular {
            axes: [unit(1.0, 0.2, 0.1), unit(-0.4, 0.5, 1.0)],
        },
    ];
    let joint = |law, end| Joint {
        marker,
        law: JointLaw { law, points },
        end,
    };
    laws.into_iter()
        .flat_map(|law| End::BOTH.map(|end| joint(law, end)))
        .collect()
}
