//! How far a step is foreseen to go, which errors are compared with.

use super::correcting::{Correcting, Corrector};
use crate::accuracy::StepErrors;
use crate::layout::Layout;
use crate::workers::Ahead;

impl Correcting<'_> {
    /// Tells how far the motion is foreseen to go, and what the multipliers alone make of it.
    pub fn foresee(&mut self, errors: &mut StepErrors) {
        errors.foresee(&self.workers.looked(Ahead::Step));
        if errors.needs_lever() {
            let are_lengths: Vec<bool> = self.layout.are_lengths().collect();
            let mut largest = [0.0_f64; 2];
            for (is_length, largest) in [true, false].into_iter().zip(&mut largest) {
                let unit = |row: usize| f64::from(u8::from(are_lengths[row] == is_length));
                visit_effects(
                    self.own,
                    self.layout,
                    unit,
                    &mut |_, moves_length, effect| {
                        if moves_length == is_length {
                            *largest = largest.max(effect.abs());
                        }
                    },
                );
            }
            match largest[1] > 0.0 {
                true => errors.take_lever((largest[0] / largest[1]).sqrt()),
                false => errors.take_lever(arm_of_forces(self.own, self.layout)),
            }
        }
        let ends: &[f64] = self.method.ends();
        visit_effects(
            self.own,
            self.layout,
            |row| ends[row],
            &mut |place, _, effect| {
                errors.take_effect(place, effect);
            },
        );
    }
}

/// How far forces at the joints move markers for each radian by which they turn the bodies; 0 if they turn none.
fn arm_of_forces(own: &Corrector, layout: &Layout) -> f64 {
    let (unknowns, columns) = (own.end.system.unknowns(), own.end.columns.all());
    let [mut length, mut angle] = [0.0_f64; 2];
    for (number, input) in layout.inputs.iter().enumerate() {
        if !input.drives_load(layout.rows.len()) {
            continue;
        }
        for column in unknowns.columns(number) {
            let response = |place: usize| columns[column].derivatives.get(place).copied();
            let ends = layout.joints.iter().flat_map(|joint| &joint.ends);
            for end in ends.filter(|end| end.subsystem == input.subsystem) {
                let moved = end
                    .coordinates()
                    .iter()
                    .filter_map(|&place| response(place));
                length = moved.fold(length, |length, moved| length.max(moved.abs()));
            }
            let frames = layout
                .frames
                .iter()
                .filter(|frame| frame.subsystem == input.subsystem);
            for frame in frames {
                let changes = frame.attitude.iter().filter_map(|&place| response(place));
                let size = changes.map(|change| change * change).sum::<f64>().sqrt();
                // A quaternion changes by half of the angle.
                let turned = if frame.attitude.len() > 1 {
                    2.0 * size
                } else {
                    size
                };
                angle = angle.max(turned);
            }
        }
    }
    if angle > 0.0 { length / angle } else { 0.0 }
}

/// Visits the positions at all joints, subsystem and output, whether they are lengths, and by how much multipliers of these values, constant
/// over the step, move them.
fn visit_effects(
    own: &mut Corrector,
    layout: &Layout,
    value: impl Fn(usize) -> f64,
    visit: &mut dyn FnMut([usize; 2], bool, f64),
) {
    let unknowns = own.end.system.unknowns();
    own.errors.fill(0.0);
    for row in 0..layout.rows.len() {
        own.errors[unknowns.of(row)].fill(value(row));
    }
    let end = (&own.end.system, own.end.columns.all());
    own.position_errors
        .visit_effects(layout, end, &own.errors, visit);
}
