//! How responses are measured, and in which curves.

use crate::signal::{Nodes, SharePolynomial};
use crate::system::{Increment, Sizes};

/// How responses are measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measuring {
    /// How much inputs are raised.
    pub increment: Increment,
    /// What motion is measured by at the start.
    pub sizes: Sizes,
    /// In which curves.
    pub basis: Basis,
    /// Whether responses stay in use after their macro step.
    pub stay: bool,
}

/// In which curves inputs are raised.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// In the shapes of the unknowns themselves: one each, but where a shape depends on past nodes its response serves with these alone.
    Shapes,
    /// In the powers of the share of the step that the shapes are made of: responses to shapes with any past nodes follow from these.
    Powers,
}

impl Basis {
    /// Number of curves for an input with this many shapes.
    pub(super) fn curves(self, shapes: usize) -> usize {
        match self {
            Self::Shapes => shapes,
            Self::Powers => SharePolynomial::TERMS,
        }
    }

    /// The past nodes on which responses depend, of those on which the shapes do.
    pub(super) fn nodes(self, nodes: Nodes<'_>) -> Nodes<'_> {
        match self {
            Self::Shapes => nodes,
            Self::Powers => Nodes::default(),
        }
    }

    /// One of these curves, for an input with these shapes.
    pub(super) fn curve(self, shapes: &[SharePolynomial], number: usize) -> SharePolynomial {
        match self {
            Self::Shapes => shapes[number],
            Self::Powers => SharePolynomial::power(number),
        }
    }
}
