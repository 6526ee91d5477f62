//! Joints and connections tied to places in the subsystems' inputs and outputs.

use std::ops::Range;
use std::sync::Arc;

use linchpin_proto::v1;
use nalgebra::UnitQuaternion;

use super::border::Border;
use super::coupled::MarkedConnection;
use super::exchanged::{Exchanged, What};
use super::input::DrivenInput;
use super::inside::Inside;
use super::marker::BoundEnd;
use crate::joint::{Joint, Level};
use crate::signal::Variables;

/// The joints and connections of a scene tied to places in the subsystems' inputs and outputs.
///
/// The coupling variables `w` are the multipliers of all rows, then the exchanged variables.
pub struct Layout {
    /// Names of the subsystems.
    pub subsystems: Vec<String>,
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
    /// Conditions of the joints that follow from others.
    pub border: Border,
    /// Highest level of the conditions.
    pub level: Level,
    /// What is read inside a step.
    pub inside: Inside,
    pub(super) ranges: Vec<Range<usize>>,
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

/// A marker whose attitude the coupling outputs tell.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Place of the subsystem in the scene.
    pub subsystem: usize,
    /// Places of the angle, or of the quaternion `w, x, y, z`, in the coupling outputs.
    pub attitude: Vec<usize>,
    /// Places of vectors of the marker's motion in the coupling outputs, two in the plane and three in space.
    pub vectors: Vec<Vec<usize>>,
    /// Numbers of inputs that are vectors: force and moment on the marker, and what a joint load there reads of the partner.
    pub inputs: Vec<Vec<usize>>,
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

    /// Whether variables are exchanged without rates.
    pub fn has_signals(&self) -> bool {
        self.exchanged.iter().any(|one| one.rates.is_none())
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

    /// For each row whether its condition is a length, and its multiplier a force.
    pub fn are_lengths(&self) -> impl Iterator<Item = bool> {
        let rows = self.rows.iter();
        rows.map(|row| {
            let joint = &self.joints[row.joint].joint;
            joint.condition(row.condition).is_length()
        })
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
        let own = self.exchanged_of(variable);
        own.map_or_else(String::new, |exchanged| exchanged.name.clone())
    }

    /// The variable of a connected signal.
    pub fn variable_of(&self, connection: &MarkedConnection) -> usize {
        let (subsystem, output) = &connection.from;
        let is_source = |one: &&Exchanged| {
            let place = match one.what {
                What::Output(place) => place,
                What::Attitude { .. } => return false,
            };
            one.subsystem == *subsystem && self.outputs[*subsystem][place] == *output
        };
        let exchanged = self.exchanged.iter().find(is_source);
        exchanged.map_or(self.rows.len(), |one| one.first)
    }

    /// What an exchanged variable belongs to.
    pub(super) fn exchanged_of(&self, variable: usize) -> Option<&Exchanged> {
        let mut exchanged = self.exchanged.iter();
        exchanged.find(|one| (one.first..one.first + one.size()).contains(&variable))
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
