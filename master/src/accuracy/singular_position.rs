//! A singular position of the mechanism.

/// A position in which the joints do not determine their multipliers, and which a step ends or begins near. Errors of steps that end too near to it
/// do not fall with their length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SingularPosition {
    /// The length in s of a step that ends as far behind it as it begins before it, where steps come nearer: neither end is nearer than it has to
    /// be.
    pub across: Option<f64>,
    /// The length in s at which attempts come to an end.
    pub least: f64,
}
