//! A joint as rows of scalar conditions.

use linchpin_proto::joint_load::{End, Reads};
use nalgebra::Vector3;

use super::condition::Condition;

/// A joint: its conditions, each with the end of its name in result columns.
pub struct Joint {
    rows: Vec<(&'static str, Box<dyn Condition>)>,
    aligned: Vec<[Vector3<f64>; 2]>,
}

impl Joint {
    pub(super) fn new(
        rows: Vec<(&'static str, Box<dyn Condition>)>,
        aligned: Vec<[Vector3<f64>; 2]>,
    ) -> Self {
        Self { rows, aligned }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether it demands nothing: no joint of [`super::composite`] does.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// End of the name of a row in result columns; empty if it is the only one.
    pub fn name(&self, row: usize) -> &'static str {
        self.rows[row].0
    }

    /// The condition of a row.
    pub fn condition(&self, row: usize) -> &dyn Condition {
        &*self.rows[row].1
    }

    /// All conditions.
    pub fn conditions(&self) -> impl Iterator<Item = &dyn Condition> {
        self.rows.iter().map(|(_, condition)| &**condition)
    }

    /// What the joint reads of the marker at `end`.
    pub fn reads(&self, end: End) -> Reads {
        let reads = self.conditions().map(|condition| condition.reads(end));
        reads.fold(Reads::default(), |all, one| Reads {
            position: all.position || one.position,
            rotation: all.rotation || one.rotation,
        })
    }

    /// Axes of markers a and b that have to point to the same side: the conditions also hold where they point to opposite
    /// sides, and those that keep an attitude also a third of a turn away from it, where they are at right angles.
    pub fn aligned(&self) -> &[[Vector3<f64>; 2]] {
        &self.aligned
    }
}
