//! Where the variables of the built-in bodies are: each has two markers, and the outputs of the body behind them.

use std::ops::Range;

/// Places of a body's variables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Body {
    /// `planar-body`.
    Planar,
    /// `spatial-body`.
    Spatial,
}

impl Body {
    /// Components of a translation.
    pub fn translations(self) -> usize {
        match self {
            Self::Planar => 2,
            Self::Spatial => 3,
        }
    }

    /// Components of the load of a marker.
    pub fn loads(self) -> usize {
        match self {
            Self::Planar => 3,
            Self::Spatial => 6,
        }
    }

    /// Inputs of a marker.
    pub fn load(self, marker: usize) -> Range<usize> {
        marker * self.loads()..(marker + 1) * self.loads()
    }

    /// Outputs of a marker.
    pub fn outputs(self) -> usize {
        self.positions() + 2 * self.loads()
    }

    fn positions(self) -> usize {
        match self {
            Self::Planar => 3,
            Self::Spatial => 7,
        }
    }

    /// First output of a marker's position, velocity and acceleration.
    pub fn places(self, marker: usize) -> [usize; 3] {
        let first = marker * self.outputs();
        let velocity = first + self.positions();
        [first, velocity, velocity + self.loads()]
    }

    /// First output of the position of the centre of mass.
    pub fn centre(self) -> usize {
        2 * self.outputs()
    }

    /// First output of its velocity.
    pub fn centre_velocity(self) -> usize {
        match self {
            Self::Planar => self.centre() + 3,
            Self::Spatial => self.centre() + 3,
        }
    }

    /// Output of the energy: the last one.
    pub fn energy(self) -> usize {
        match self {
            Self::Planar => self.centre() + 6,
            Self::Spatial => self.centre() + 9,
        }
    }

    /// Turns a vector from the axes of the body to inertial ones, by the outputs.
    pub fn turned(self, outputs: &[f64], vector: &[f64]) -> Vec<f64> {
        match self {
            Self::Planar => {
                let (sin, cos) = outputs[2].sin_cos();
                vec![
                    cos * vector[0] - sin * vector[1],
                    sin * vector[0] + cos * vector[1],
                ]
            }
            Self::Spatial => {
                let [w, x, y, z] = [3, 4, 5, 6].map(|place| outputs[place]);
                let attitude = nalgebra::UnitQuaternion::from_quaternion(
                    nalgebra::Quaternion::new(w, x, y, z),
                );
                let turned = attitude * nalgebra::Vector3::from_column_slice(vector);
                turned.as_slice().to_vec()
            }
        }
    }

    /// From the centre of mass to a marker, by the outputs.
    pub fn arm(self, outputs: &[f64], marker: usize) -> Vec<f64> {
        let [position, ..] = self.places(marker);
        let component = |place| outputs[position + place] - outputs[self.centre() + place];
        (0..self.translations()).map(component).collect()
    }

    /// The moment of a force at an arm: one component in the plane.
    pub fn moment(self, arm: &[f64], force: &[f64]) -> Vec<f64> {
        match self {
            Self::Planar => vec![arm[0] * force[1] - arm[1] * force[0]],
            Self::Spatial => {
                let [arm, force] = [arm, force].map(nalgebra::Vector3::from_column_slice);
                arm.cross(&force).as_slice().to_vec()
            }
        }
    }
}
