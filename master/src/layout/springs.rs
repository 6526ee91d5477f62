//! Joints that are replaced by spring-dampers (force/displacement coupling).

use linchpin_proto::joint_load::End;
use linchpin_proto::v1;

use super::bind::Binder;
use super::bound::Layout;
use super::coupled::{Coupled, Lack, MarkedJoint, MarkerLacks};
use crate::joint::Level;

impl Layout {
    /// Ties joints that are replaced by spring-dampers inside the subsystem at end a.
    /// Of the variables `(forces, positions of b, velocities of b)`, each with one entry for a row, the force loads
    /// end b and the motion of b is an input at end a. Several joints with end a at one marker share its spring: their
    /// forces are those of one spring, [`springs_at`] times as stiff, to the mean of the partners.
    ///
    /// # Errors
    /// The first marker that lacks something.
    pub fn with_springs(coupled: &Coupled<'_>) -> Result<Self, MarkerLacks> {
        let mut binder = Binder::new(coupled, Level::Velocity)?;
        let rows = binder.layout.rows.len();
        for row in 0..rows {
            let joint = binder.layout.rows[row].joint;
            let (a, marker) = &coupled.joints[joint].ends[0];
            let share = 1.0 / springs_at(coupled.joints, *a, marker);
            let spring = marker.spring.as_ref();
            let spring = spring.ok_or(MarkerLacks {
                joint,
                end: 0,
                what: Lack::Spring,
            })?;
            binder.drive(*a, &spring.partner_position, (rows + row, share));
            binder.drive(*a, &spring.partner_velocity, (2 * rows + row, share));
            binder.load_end(row, End::B)?;
        }
        Ok(binder.finish())
    }
}

/// Number of joints that have end a at this marker.
pub fn springs_at(joints: &[MarkedJoint], subsystem: usize, marker: &v1::Marker) -> f64 {
    let ends = joints.iter().map(|joint| &joint.ends[0]);
    let here = ends.filter(|(a, other)| *a == subsystem && other.name == marker.name);
    here.count() as f64
}
