//! Which outputs of which subsystem the joints read, which are exchanged, and which inputs are driven.
//!
//! * [`marker`]: the motion of a marker in its subsystem's outputs;
//! * [`exchanged`]: outputs that are inputs of other subsystems;
//! * [`input`]: driven inputs and how they follow from the coupling variables.

mod bind;
pub mod exchanged;
pub mod frames;
pub mod input;
mod loads;
pub mod marker;
mod springs;

use std::ops::Range;
use std::sync::Arc;

use linchpin_proto::v1;
use nalgebra::UnitQuaternion;

pub use exchanged::{Exchanged, What};
pub use frames::Frame;
pub use input::{DrivenInput, Over, Source};
pub use marker::BoundEnd;
pub use springs::springs_at;

use crate::joint::{Joint, Level};
use crate::signal::Variables;

/// The joints and connections of a scene tied to places in the subsystems' inputs and outputs.
///
/// The coupling variables `w` are the multipliers of all rows, then the exchanged variables.
pub struct Layout {
    /// Joints in the order of the scene.
    pub joints: Vec<BoundJoint>,
    /// Rows of all joints in their order; row `r` has multiplier number `r`.
    pub rows: Vec<Row>,
    /// Exchanged variables, behind the multipliers.
    pub exchanged: Vec<Exchanged>,
    /// Driven inputs of all subsystems, subsystem by subsystem, in the order of their signals.
    pub inputs: Vec<DrivenInput>,
    /// For each subsystem the joint loads that it evaluates itself.
    pub joint_loads: Vec<Vec<v1::JointLoad>>,
    /// Axes of the bodies; none unless columns of the coupling Jacobian are carried along with them.
    pub frames: Vec<Frame>,
    /// For each subsystem the names of the outputs that the coupling reads, each once.
    pub outputs: Vec<Vec<String>>,
    /// Highest level of the conditions.
    pub level: Level,
    ranges: Vec<Range<usize>>,
}

/// One scalar condition of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Row {
    /// Number of the joint.
    pub joint: usize,
    /// Number of the condition in the joint.
    pub condition: usize,
}

/// A joint and its two ends.
pub struct BoundJoint {
    /// Name in the scene.
    pub name: String,
    /// Its conditions.
    pub joint: Arc<Joint>,
    /// Ends a and b.
    pub ends: [BoundEnd; 2],
}

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
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MarkedConnection {
    /// Subsystem and output.
    pub from: (usize, String),
    /// Subsystem and input.
    pub to: (usize, String),
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
    /// A spring-damper to a partner.
    Spring,
}

impl Layout {
    /// Number of coupling variables.
    pub fn variables(&self) -> usize {
        let exchanged = self.exchanged.iter().map(Exchanged::size);
        self.rows.len() + exchanged.sum::<usize>()
    }

    /// What the variables are: multipliers of one degree, exchanged variables of another.
    pub fn describe_variables(&self, degree: usize, exchanged_degree: usize) -> Variables {
        let mut degrees = vec![degree; self.rows.len()];
        degrees.resize(self.variables(), exchanged_degree);
        let attitudes = self.attitudes();
        let rotations = attitudes.map(|exchanged| exchanged.first).collect();
        Variables { degrees, rotations }
    }

    /// Whether a variable is exchanged without rates.
    pub fn is_signal(&self, variable: usize) -> bool {
        let mut exchanged = self.exchanged.iter();
        exchanged.any(|one| {
            one.rates.is_none() && (one.first..one.first + one.size()).contains(&variable)
        })
    }

    /// The exchanged attitudes in their order.
    pub fn attitudes(&self) -> impl Iterator<Item = &Exchanged> {
        let is_attitude = |exchanged: &&Exchanged| matches!(exchanged.what, What::Attitude { .. });
        self.exchanged.iter().filter(is_attitude)
    }

    /// The driven inputs of one subsystem.
    pub fn inputs_of(&self, subsystem: usize) -> &[DrivenInput] {
        &self.inputs[self.input_range(subsystem)]
    }

    /// Places of these in [`Layout::inputs`].
    pub fn input_range(&self, subsystem: usize) -> Range<usize> {
        self.ranges[subsystem].clone()
    }

    /// The joint of a row.
    pub fn joint_of(&self, row: usize) -> &BoundJoint {
        &self.joints[self.rows[row].joint]
    }

    /// Name of a row in result columns: `JOINT.what`, with `.x` and the like if the joint has several rows.
    pub fn column_name(&self, row: usize, what: &str) -> String {
        let Row { joint, condition } = self.rows[row];
        let joint = &self.joints[joint];
        column_name(&joint.name, what, joint.joint.name(condition))
    }

    /// Name of a coupling variable for messages.
    pub fn variable_name(&self, variable: usize) -> String {
        if variable < self.rows.len() {
            return self.column_name(variable, "lambda");
        }
        let mut exchanged = self.exchanged.iter();
        let own = exchanged.find(|one| (one.first..one.first + one.size()).contains(&variable));
        own.map_or_else(String::new, |exchanged| exchanged.name.clone())
    }

    /// Values of the driven inputs of one subsystem at values `w` of all variables.
    pub fn input_values(
        &self,
        subsystem: usize,
        w: &[f64],
        attitudes: &[UnitQuaternion<f64>],
    ) -> Vec<f64> {
        let inputs = self.inputs_of(subsystem).iter();
        inputs.map(|input| input.value(w, attitudes)).collect()
    }
}

/// Name of the result column of one condition of a joint.
pub fn column_name(joint: &str, what: &str, part: &str) -> String {
    match part {
        "" => format!("{joint}.{what}"),
        part => format!("{joint}.{what}.{part}"),
    }
}
