//! What a layout is made of: joints and connections of the scene with the models' markers, inputs and outputs.

use std::sync::Arc;

use linchpin_proto::v1;

use crate::joint::{Joint, Level};

/// A joint of the scene with the markers that it holds, found in the models' descriptions.
#[derive(Clone)]
pub struct MarkedJoint {
    /// Name in the scene.
    pub name: String,
    /// Its conditions.
    pub joint: Arc<Joint>,
    /// Subsystem and marker of ends a and b.
    pub ends: [(usize, v1::Marker); 2],
}

/// A signal connection of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkedConnection {
    /// Subsystem and output.
    pub from: (usize, String),
    /// Subsystem and input.
    pub to: (usize, String),
    /// Where the search for its value at the start begins: given by the scene, or by the model as the default of the input.
    pub start: Option<f64>,
}

/// How a subsystem takes loads whose direction turns with the bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoadForm {
    /// It evaluates the joint's law itself.
    Joint,
    /// It takes force and moment as polynomials of this degree.
    Wrench {
        /// Degree.
        degree: usize,
    },
}

/// What a scene couples.
pub struct Coupled<'a> {
    /// Names of the subsystems.
    pub subsystems: Vec<&'a str>,
    /// How each takes loads.
    pub forms: Vec<LoadForm>,
    /// Its joints.
    pub joints: &'a [MarkedJoint],
    /// Its signal connections.
    pub connections: &'a [MarkedConnection],
}

/// A marker cannot take part in a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MarkerLacks {
    /// Number of the joint.
    pub joint: usize,
    /// 0 for end a, 1 for end b.
    pub end: usize,
    /// What is missing.
    pub what: Lack,
}

/// What a marker may lack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lack {
    /// An output on this level.
    Output(Level),
    /// An input for the load.
    Load,
}
