//! Laws of joints as messages.

use nalgebra::Vector3;

use super::{End, JointLaw, Law};
use crate::v1;

/// A message that is no joint load.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum JointLoadError {
    /// No law, or one that is not known.
    #[error("law {found} is unknown; known are 1 (atpoint), 2 (inplane) and 3 (perpendicular)")]
    Law {
        /// The number in the message.
        found: i32,
    },
    /// Neither end.
    #[error("end {found} is unknown; known are 1 (a) and 2 (b)")]
    End {
        /// The number in the message.
        found: i32,
    },
    /// Not three finite numbers.
    #[error("{field} must be three finite numbers")]
    Vector {
        /// Which field.
        field: &'static str,
    },
    /// Not of length 1.
    #[error("{field} has the length {length}; it must be a unit vector")]
    NotUnit {
        /// Which field.
        field: &'static str,
        /// Its length.
        length: f64,
    },
}

impl JointLoadError {
    /// Field of the message.
    pub fn field(&self) -> &'static str {
        match self {
            Self::Law { .. } => "law",
            Self::End { .. } => "end",
            Self::Vector { field } | Self::NotUnit { field, .. } => field,
        }
    }
}

impl JointLaw {
    /// A law from the message of a load, with the end that it acts on.
    ///
    /// # Errors
    /// [`JointLoadError`]: unknown law or end, axes that are no unit vectors, numbers that are not finite.
    pub fn from_message(message: &v1::JointLoad) -> Result<(Self, End), JointLoadError> {
        let law = match message.law() {
            v1::JointLaw::Atpoint => Law::AtPoint {
                direction: unit("axis_a", &message.axis_a)?,
            },
            v1::JointLaw::Inplane => Law::InPlane {
                normal: unit("axis_b", &message.axis_b)?,
            },
            v1::JointLaw::Perpendicular => Law::Perpendicular {
                axes: [
                    unit("axis_a", &message.axis_a)?,
                    unit("axis_b", &message.axis_b)?,
                ],
            },
            v1::JointLaw::Unspecified => return Err(JointLoadError::Law { found: message.law }),
        };
        let end = match message.end() {
            v1::JointEnd::A => End::A,
            v1::JointEnd::B => End::B,
            v1::JointEnd::Unspecified => return Err(JointLoadError::End { found: message.end }),
        };
        let points = [
            vector("point_a", &message.point_a)?,
            vector("point_b", &message.point_b)?,
        ];
        Ok((Self { law, points }, end))
    }

    /// The message of the load on marker `marker` at `end`; the places of signals are left to the caller.
    pub fn to_message(&self, marker: &str, end: End) -> v1::JointLoad {
        let list = |vector: &Vector3<f64>| vector.as_slice().to_vec();
        let (law, axis_a, axis_b) = match &self.law {
            Law::AtPoint { direction } => (v1::JointLaw::Atpoint, list(direction), Vec::new()),
            Law::InPlane { normal } => (v1::JointLaw::Inplane, Vec::new(), list(normal)),
            Law::Perpendicular { axes: [a, b] } => (v1::JointLaw::Perpendicular, list(a), list(b)),
        };
        v1::JointLoad {
            marker: marker.to_owned(),
            law: law.into(),
            end: match end {
                End::A => v1::JointEnd::A,
                End::B => v1::JointEnd::B,
            }
            .into(),
            point_a: list(&self.points[0]),
            point_b: list(&self.points[1]),
            axis_a,
            axis_b,
            ..v1::JointLoad::default()
        }
    }
}

fn vector(field: &'static str, values: &[f64]) -> Result<Vector3<f64>, JointLoadError> {
    match *values {
        [x, y, z] if values.iter().all(|value| value.is_finite()) => Ok(Vector3::new(x, y, z)),
        _ => Err(JointLoadError::Vector { field }),
    }
}

/// Lengths off 1 by less than this are rounding.
const UNIT_ROUNDING: f64 = 1e-9;

fn unit(field: &'static str, values: &[f64]) -> Result<Vector3<f64>, JointLoadError> {
    let vector = vector(field, values)?;
    let length = vector.norm();
    if (length - 1.0).abs() > UNIT_ROUNDING {
        return Err(JointLoadError::NotUnit { field, length });
    }
    Ok(vector)
}
