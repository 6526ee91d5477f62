//! Responses that were measured over one length, and what they depend on.

use nalgebra::UnitQuaternion;

/// The past nodes of the curves in which inputs are raised, if these depend on them, and how many of them each uses.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Nodes<'a> {
    /// Times of past macro points relative to the present one in s.
    pub times: &'a [f64],
    /// Degrees of the polynomials of all coupling variables.
    pub degrees: &'a [usize],
}

/// To what responses belong: the length of a look-ahead in s, and the nodes.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Kind {
    pub(super) length: f64,
    pub(super) times: Vec<f64>,
    pub(super) degrees: Vec<usize>,
}

impl Kind {
    pub(super) fn set(&mut self, length: f64, nodes: Nodes<'_>) {
        self.length = length;
        self.times.clear();
        self.times.extend_from_slice(nodes.times);
        self.degrees.clear();
        self.degrees.extend_from_slice(nodes.degrees);
    }

    pub(super) fn has_nodes(&self, nodes: Nodes<'_>) -> bool {
        self.times == nodes.times && self.degrees == nodes.degrees
    }

    pub(super) fn nodes(&self) -> Nodes<'_> {
        Nodes {
            times: &self.times,
            degrees: &self.degrees,
        }
    }
}

/// Responses to raised inputs over one length, those that are not known empty.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Measured {
    pub(super) kind: Kind,
    pub(super) responses: Vec<Vec<f64>>,
    pub(super) attitudes: Vec<UnitQuaternion<f64>>,
}

impl Measured {
    /// Length of the look-ahead in s.
    pub fn length(&self) -> f64 {
        self.kind.length
    }

    pub(super) fn has(&self, needed: &[bool]) -> bool {
        let mut responses = self.responses.iter().zip(needed);
        responses.all(|(response, is_needed)| !is_needed || !response.is_empty())
    }
}
