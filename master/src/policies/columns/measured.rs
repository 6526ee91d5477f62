//! Responses that were measured over one length, and what they depend on.

use nalgebra::UnitQuaternion;
use serde::{Deserialize, Serialize};

use crate::signal::Nodes;
use crate::signal::attitude::quaternions;

/// To what responses belong: the length of a look-ahead in s, and the nodes.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Kind {
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
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    pub(super) kind: Kind,
    pub(super) responses: Vec<Vec<f64>>,
    #[serde(with = "quaternions")]
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
