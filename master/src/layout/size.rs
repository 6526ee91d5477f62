//! The size of a mechanism: what its lengths are measured by.

use super::bound::{Layout, Row};
use super::exchanged::What;
use super::input::{DrivenInput, Source};

/// Size in m of a mechanism whose positions at the start and whose joints have none.
const WITHOUT_SIZE: f64 = 1.0;

/// Positions below this, in m, are rounding of lengths: a hundredth of an atom.
const ROUNDING: f64 = 1e-12;

/// The first component of a load that is one of its moment.
const FIRST_MOMENT: usize = 3;

impl Layout {
    /// Size of the mechanism in m: the largest position at its joints, and the largest arm of one; 1 if it has none. `output` gives an
    /// output of a subsystem.
    pub fn size(&self, output: impl Fn(usize, usize) -> f64) -> f64 {
        let laws = self.rows.iter().filter_map(|Row { joint, condition }| {
            self.joints[*joint].joint.condition(*condition).law()
        });
        let arms = laws.flat_map(|law| law.points.map(|point| point.norm()));
        match arms.fold(self.largest_position(output), f64::max) {
            size if size > ROUNDING => size,
            _ => WITHOUT_SIZE,
        }
    }

    /// The largest coordinate of a position at a joint.
    pub fn largest_position(&self, output: impl Fn(usize, usize) -> f64) -> f64 {
        let mut largest = 0.0_f64;
        for end in self.joints.iter().flat_map(|joint| &joint.ends) {
            for &place in end.coordinates() {
                largest = largest.max(output(end.subsystem, place).abs());
            }
        }
        largest
    }

    /// Whether a load is a moment: one whose direction turns may be either, one of fixed direction is what its conditions are.
    pub fn is_moment(&self, input: &DrivenInput) -> bool {
        match &input.source {
            Source::Sum(combination) => !combination.iter().any(|(variable, _)| {
                self.rows.get(*variable).is_some_and(|row| {
                    let joint = &self.joints[row.joint].joint;
                    joint.condition(row.condition).is_length()
                })
            }),
            Source::Load(load) => load.component >= FIRST_MOMENT,
            Source::Attitude { .. } => false,
        }
    }

    /// Whether an input is the coordinate of a marker at a joint.
    pub fn is_length(&self, input: &DrivenInput) -> bool {
        let Source::Sum(combination) = &input.source else {
            return false;
        };
        combination.iter().any(|(variable, _)| {
            let Some(exchanged) = self.exchanged_of(*variable) else {
                return false;
            };
            let ends = self.joints.iter().flat_map(|joint| &joint.ends);
            let mut ends = ends.filter(|end| end.subsystem == exchanged.subsystem);
            match exchanged.what {
                What::Output(place) => ends.any(|end| end.coordinates().contains(&place)),
                What::Attitude { .. } => false,
            }
        })
    }
}
