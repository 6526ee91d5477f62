//! Exchanged variables: outputs of one subsystem that are inputs of others.
//!
//! Their values `w` on a macro step are unknowns like the multipliers, with the additional coupling conditions `w - y = 0`
//! (S1 eqs. 42, 45, 51, 54); signal connections are of the same kind.

use linchpin_proto::joint_load::{Displacement, Pose};
use nalgebra::{UnitQuaternion, Vector3};

use super::marker::vector;
use crate::signal::attitude::{
    attitude, rotation_of_change, rotation_vector, small_rotation, unit_quaternion, vector_change,
};
use crate::signal::vector_at;

/// One exchanged output, or the attitude of a marker.
#[derive(Debug, Clone, PartialEq)]
pub struct Exchanged {
    /// `SUBSYSTEM.OUTPUT`, or `SUBSYSTEM.MARKER.rotation`.
    pub name: String,
    /// Place of the subsystem whose output it is.
    pub subsystem: usize,
    /// Number of its first variable.
    pub first: usize,
    /// What it is.
    pub what: What,
    /// Where its rates stand, if its curve is made of them too.
    pub rates: Option<Rates>,
}

/// Places of the rates of an exchanged variable in the outputs; of an attitude angular velocity and acceleration.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rates {
    /// First time derivative.
    pub speed: Vec<usize>,
    /// Second time derivative; empty if it is not read.
    pub acceleration: Vec<usize>,
}

impl Rates {
    /// First time derivatives of the variables; `phi` is the rotation vector if they are one, otherwise 0.
    pub fn speed(&self, outputs: &[f64], phi: &Vector3<f64>) -> Vector3<f64> {
        vector_change(phi, &vector(&self.speed, outputs))
    }

    /// Second time derivatives of the variables, of a rotation vector where it is 0.
    pub fn acceleration(&self, outputs: &[f64]) -> Vector3<f64> {
        vector(&self.acceleration, outputs)
    }
}

/// What is exchanged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum What {
    /// An output at this place: one variable.
    Output(usize),
    /// The attitude whose quaternion stands at these places: three variables, a rotation vector relative to attitude number
    /// `attitude` of the history.
    Attitude {
        /// `w, x, y, z`
        places: [usize; 4],
        /// Number in the history.
        attitude: usize,
    },
}

impl Exchanged {
    /// Number of variables.
    pub fn size(&self) -> usize {
        match self.what {
            What::Output(_) => 1,
            What::Attitude { .. } => 3,
        }
    }

    /// What the outputs of the subsystem say about the variables, in the first entries. Of the rotation vectors that differ
    /// by whole turns it is the one nearest to the values `near` of all variables.
    pub fn read(
        &self,
        outputs: &[f64],
        attitudes: &[UnitQuaternion<f64>],
        near: &[f64],
    ) -> Vector3<f64> {
        match self.what {
            What::Output(place) => Vector3::new(outputs[place], 0.0, 0.0),
            What::Attitude { places, attitude } => {
                let q = unit_quaternion(places.map(|place| outputs[place]));
                rotation_vector(&attitudes[attitude], &q, &vector_at(near, self.first))
            }
        }
    }

    /// The rotation vector if `shown`, what the outputs say, is one; otherwise 0.
    pub fn vector(&self, shown: &Vector3<f64>) -> Vector3<f64> {
        match self.what {
            What::Output(_) => Vector3::zeros(),
            What::Attitude { .. } => *shown,
        }
    }

    /// The change of [`Exchanged::read`], which is `shown`, that goes with a change `column` of the outputs.
    pub fn change(&self, outputs: &[f64], shown: &Vector3<f64>, column: &[f64]) -> Vector3<f64> {
        match self.what {
            What::Output(place) => Vector3::new(column[place], 0.0, 0.0),
            What::Attitude { places, .. } => {
                let theta = small_rotation(
                    places.map(|place| outputs[place]),
                    places.map(|place| column[place]),
                );
                vector_change(shown, &theta)
            }
        }
    }
}

/// The variables that tell the pose of a marker, as far as they are exchanged.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PoseVariables {
    /// Coordinates; empty if they are not needed.
    pub position: Vec<usize>,
    /// Orientation.
    pub turning: Turning,
}

/// The variables that tell an orientation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Turning {
    /// Not needed.
    #[default]
    None,
    /// The angle in the plane.
    Angle(usize),
    /// Rotation vector relative to attitude number `attitude`.
    Vector {
        /// Its first variable.
        first: usize,
        /// Number in the history.
        attitude: usize,
    },
}

impl PoseVariables {
    /// The pose at values `w` of all variables; what is not needed stays at its default.
    pub fn pose(&self, w: &[f64], attitudes: &[UnitQuaternion<f64>]) -> Pose {
        let mut position = Vector3::zeros();
        for (component, &variable) in position.iter_mut().zip(&self.position) {
            *component = w[variable];
        }
        match self.turning {
            Turning::None => Pose {
                position,
                ..Pose::default()
            },
            Turning::Angle(angle) => Pose::planar(position.x, position.y, w[angle]),
            Turning::Vector {
                first,
                attitude: number,
            } => {
                let attitude = attitude(&attitudes[number], &vector_at(w, first));
                Pose {
                    position,
                    rotation: attitude.to_rotation_matrix().into_inner(),
                }
            }
        }
    }

    /// Each variable with the displacement of the marker per unit of it.
    pub fn displacements(&self, w: &[f64]) -> impl Iterator<Item = (usize, Displacement)> {
        let unit = |component: usize| Vector3::ith(component, 1.0);
        let moves = self.position.iter().enumerate();
        let moves = moves.map(move |(component, &variable)| {
            let displacement = Displacement {
                position: unit(component),
                rotation: Vector3::zeros(),
            };
            (variable, displacement)
        });
        let turns = match self.turning {
            Turning::None => [None; 3],
            Turning::Angle(angle) => [Some((angle, unit(2))), None, None],
            Turning::Vector { first, .. } => {
                let phi = vector_at(w, first);
                std::array::from_fn(|component| {
                    let rotation = rotation_of_change(&phi, &unit(component));
                    Some((first + component, rotation))
                })
            }
        };
        let turns = turns.into_iter().flatten().map(|(variable, rotation)| {
            let displacement = Displacement {
                position: Vector3::zeros(),
                rotation,
            };
            (variable, displacement)
        });
        moves.chain(turns)
    }

    /// The numbers of all variables, in the order of [`PoseVariables::displacements`].
    pub fn variables(&self) -> impl Iterator<Item = usize> {
        let turning = match self.turning {
            Turning::None => 0..0,
            Turning::Angle(angle) => angle..angle + 1,
            Turning::Vector { first, .. } => first..first + 3,
        };
        self.position.iter().copied().chain(turning)
    }
}
