//! What a result column shows.

use serde::{Deserialize, Serialize};

/// What a column of the results shows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Column {
    /// Its name, as in the head of the table.
    pub name: String,
    /// Its unit: for an output that which its model gives it, for multipliers and residuals what follows from the condition. 1 for
    /// numbers without a unit, empty if a worker does not tell.
    pub unit: String,
    /// In words; empty if a worker does not tell.
    #[serde(default)]
    pub description: String,
    /// What kind of number it is.
    #[serde(default)]
    pub quantity: Quantity,
    /// The marker that it belongs to, if it is part of the motion of one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marker: Option<MarkerPart>,
}

/// A component of the motion of a marker.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct MarkerPart {
    /// `SUBSYSTEM.MARKER`.
    pub name: String,
    /// Place in its position, velocity or acceleration, as in [`linchpin_proto::v1::Marker`].
    pub component: usize,
}

/// Kinds of numbers in the results.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Time.
    Time,
    /// Coordinate of a marker: a length, or an angle.
    Position,
    /// Component of the unit quaternion of a marker.
    Attitude,
    /// Velocity or angular velocity of a marker.
    Velocity,
    /// Acceleration or angular acceleration of a marker.
    Acceleration,
    /// Any other output of a model.
    #[default]
    Output,
    /// Multiplier of a joint: a force, or a moment.
    Multiplier,
    /// What is left of a condition of a joint.
    Residual,
    /// Length of the macro step.
    Step,
    /// Degree of polynomials.
    Degree,
    /// Estimated error of the macro step.
    ErrorEstimate,
}
