//! What borders the equations of a mechanism with redundant conditions.

/// Conditions of the joints that follow from others at the start, and multipliers that do nothing together.
///
/// With rows and columns brought to one size, `R A C`, these are the left and right singular vectors of singular value 0.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Border {
    /// What the conditions of the joints are multiplied by, `R`.
    pub rows: Vec<f64>,
    /// What their multipliers are divided by, `C`.
    pub columns: Vec<f64>,
    /// Left singular vectors: parts of the conditions.
    pub left: Vec<Vec<f64>>,
    /// Right singular vectors: parts of the multipliers.
    pub right: Vec<Vec<f64>>,
}

impl Border {
    /// Number of conditions that follow from others.
    pub fn len(&self) -> usize {
        self.left.len()
    }

    /// Whether none does.
    pub fn is_empty(&self) -> bool {
        self.left.is_empty()
    }
}
