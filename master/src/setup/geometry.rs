//! A joint of the scene between two markers: kind, points and axes, checked against the kind of the markers.

use linchpin_proto::v1::MarkerKind;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::error::RunError;
use crate::joint::Joint as Law;
use crate::joint::composite::{Frame, PlanarFrame, in_plane, in_space, link};
use crate::scene::{Joint, JointKind, Scene};

/// The conditions of a joint between two markers of one kind.
///
/// # Errors
/// A kind that such markers cannot take, a point or axis with the wrong number of components, one that is missing, or one
/// that the joint does not have.
pub(super) fn law_of(scene: &Scene, joint: &Joint, markers: MarkerKind) -> Result<Law, RunError> {
    let reader = Reader {
        scene,
        joint,
        dimension: match markers {
            MarkerKind::Planar => 2,
            _ => 3,
        },
    };
    let needs = Needs::of(joint.kind, markers).ok_or_else(|| reader.wrong_kind(markers))?;
    reader.refuse_superfluous(needs, markers)?;
    let points = [reader.point(0)?, reader.point(1)?];
    let axes = [reader.axis(0, needs)?, reader.axis(1, needs)?];
    let law = match markers {
        MarkerKind::Planar => {
            let angle = joint.geometry.angle.unwrap_or(0.0);
            let frame = PlanarFrame {
                points,
                axes,
                angle,
            };
            in_plane(joint.kind, &frame)
        }
        MarkerKind::Spatial => {
            let attitude = reader.attitude()?;
            let frame = Frame {
                points,
                axes,
                attitude,
            };
            in_space(joint.kind, &frame)
        }
        MarkerKind::Scalar | MarkerKind::Unspecified => Some(link()),
    };
    law.ok_or_else(|| reader.wrong_kind(markers))
}

/// Which keys a kind of joint has.
#[derive(Debug, Clone, Copy)]
pub(super) struct Needs {
    pub(super) points: bool,
    pub(super) axes: [bool; 2],
    pub(super) attitude: bool,
}

impl Needs {
    /// `None` if the joint cannot hold such markers.
    pub(super) fn of(kind: JointKind, markers: MarkerKind) -> Option<Self> {
        let in_space = markers == MarkerKind::Spatial;
        let (points, axes, attitude) = match (kind, markers) {
            (JointKind::RigidLink, MarkerKind::Scalar) => (false, [false; 2], false),
            (_, MarkerKind::Scalar | MarkerKind::Unspecified) => return None,
            (JointKind::RigidLink, _) => return None,
            (JointKind::Universal | JointKind::Cylindrical | JointKind::Planar, _) if !in_space => {
                return None;
            }
            (JointKind::AtPoint, _) => (true, [false; 2], false),
            (JointKind::InPlane | JointKind::Inline, _) => (true, [false, true], false),
            (JointKind::Perpendicular, _) => (false, [true; 2], false),
            (JointKind::Revolute, _) => (true, [in_space; 2], false),
            (JointKind::Universal | JointKind::Cylindrical | JointKind::Planar, _) => {
                (true, [true; 2], false)
            }
            (JointKind::Orientation, _) => (false, [false; 2], true),
            (JointKind::Translational, _) => (true, [false, true], true),
            (JointKind::Weld, _) => (true, [false; 2], true),
        };
        Some(Self {
            points,
            axes,
            attitude,
        })
    }
}

struct Reader<'a> {
    scene: &'a Scene,
    joint: &'a Joint,
    dimension: usize,
}

const ENDS: [&str; 2] = ["a", "b"];

impl Reader<'_> {
    fn error(&self, key: &str, message: String, help: Option<&str>) -> RunError {
        let key = format!("joint.{}.{key}", self.joint.name);
        self.scene
            .error(&key, message, help.map(str::to_owned))
            .into()
    }

    fn wrong_kind(&self, markers: MarkerKind) -> RunError {
        let (name, help) = match markers {
            MarkerKind::Scalar => ("scalar", "scalar markers take a rigid-link"),
            MarkerKind::Planar => (
                "planar",
                "planar markers take atpoint, revolute, inplane, inline, perpendicular, orientation, translational or weld",
            ),
            MarkerKind::Spatial => ("spatial", "spatial markers take every joint but rigid-link"),
            MarkerKind::Unspecified => ("unspecified", "the worker must describe the kind"),
        };
        let message = format!("this joint cannot hold {name} markers");
        self.error("kind", message, Some(help))
    }

    /// Keys that the joint does not have.
    fn refuse_superfluous(&self, needs: Needs, markers: MarkerKind) -> Result<(), RunError> {
        let geometry = &self.joint.geometry;
        let is_planar = markers == MarkerKind::Planar;
        let given = [
            ("point_a", geometry.points[0].is_some(), needs.points),
            ("point_b", geometry.points[1].is_some(), needs.points),
            ("axis_a", geometry.axes[0].is_some(), needs.axes[0]),
            ("axis_b", geometry.axes[1].is_some(), needs.axes[1]),
            (
                "attitude",
                geometry.attitude.is_some(),
                needs.attitude && !is_planar,
            ),
            (
                "angle",
                geometry.angle.is_some(),
                needs.attitude && is_planar,
            ),
        ];
        let superfluous = given.iter().find(|(_, is_given, has)| *is_given && !has);
        match superfluous {
            None => Ok(()),
            Some((key, ..)) => {
                let known = given.iter().filter(|(.., has)| *has).map(|(key, ..)| *key);
                let known: Vec<&str> = known.collect();
                let message = format!("this joint between such markers has no `{key}`");
                let help = match known[..] {
                    [] => "it has no points and axes".to_owned(),
                    _ => format!("it has {}", known.join(", ")),
                };
                Err(self.error(key, message, Some(&help)))
            }
        }
    }

    fn point(&self, end: usize) -> Result<Vector3<f64>, RunError> {
        let key = format!("point_{}", ENDS[end]);
        match &self.joint.geometry.points[end] {
            Some(point) => self.vector(&key, point),
            None => Ok(Vector3::zeros()),
        }
    }

    /// Unit vector along the axis; what the joint does not have is not looked at.
    fn axis(&self, end: usize, needs: Needs) -> Result<Vector3<f64>, RunError> {
        let key = format!("axis_{}", ENDS[end]);
        match &self.joint.geometry.axes[end] {
            Some(axis) => {
                let axis = self.vector(&key, axis)?;
                axis.try_normalize(0.0).ok_or_else(|| {
                    self.error(&key, "an axis of length 0 has no direction".into(), None)
                })
            }
            None if needs.axes[end] => {
                let example = match self.dimension {
                    2 => "[0.0, 1.0]",
                    _ => "[0.0, 0.0, 1.0]",
                };
                let message = format!("this joint needs `{key}`");
                let help = format!(
                    "write `{key} = {example}`, in the axes of marker {}",
                    ENDS[end]
                );
                Err(self.error("kind", message, Some(&help)))
            }
            None => Ok(Vector3::z()),
        }
    }

    fn attitude(&self) -> Result<UnitQuaternion<f64>, RunError> {
        match self.joint.geometry.attitude.as_deref() {
            None => Ok(UnitQuaternion::identity()),
            Some(&[w, x, y, z]) if [w, x, y, z] != [0.0; 4] => {
                Ok(UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)))
            }
            Some(parts) => {
                let message = format!("{parts:?} is no attitude");
                let help = "write a quaternion of four numbers [w, x, y, z], not all 0";
                Err(self.error("attitude", message, Some(help)))
            }
        }
    }

    fn vector(&self, key: &str, components: &[f64]) -> Result<Vector3<f64>, RunError> {
        if components.len() != self.dimension {
            let message = format!(
                "{} components, the markers of this joint have {}",
                components.len(),
                self.dimension
            );
            return Err(self.error(key, message, None));
        }
        let mut vector = Vector3::zeros();
        vector
            .iter_mut()
            .zip(components)
            .for_each(|(own, given)| *own = *given);
        Ok(vector)
    }
}
