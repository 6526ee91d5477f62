//! Where the markers of all subsystems stand in the results: what a picture of the moving mechanism needs.

use linchpin_proto::v1::{self, MarkerKind};

use super::contacts::{self, RecordedContact};
use crate::layout::MarkedJoint;

/// All markers that the subsystems of a scene describe, and the joints between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Mechanism {
    /// Names of the subsystems in the order of the scene.
    pub subsystems: Vec<String>,
    /// Markers of the first subsystem in the order of its description, then those of the second one, and so on.
    pub markers: Vec<RecordedMarker>,
    /// Joints in the order of the scene.
    pub joints: Vec<RecordedJoint>,
    /// Markers that are contacts, in the order of the markers.
    pub contacts: Vec<RecordedContact>,
}

/// A marker and the result columns of its position.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RecordedMarker {
    /// Place of the subsystem in the scene.
    pub subsystem: usize,
    /// Name in the model.
    pub name: String,
    /// What its position consists of.
    pub kind: MarkerKind,
    /// Places of the columns that hold its position, in the order of [`v1::Marker::position`]: m, rad, quaternions.
    pub columns: Vec<usize>,
}

/// A joint and the markers that it holds.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedJoint {
    /// Name in the scene.
    pub name: String,
    /// Places of the markers of ends a and b in [`Mechanism::markers`].
    pub ends: [usize; 2],
    /// Where it holds, in the axes of these markers (m).
    pub points: [[f64; 3]; 2],
}

impl Mechanism {
    /// The markers of `models` of these subsystems and the points of the joints at their ends, as far as a scene gives them; their positions are all among the result `columns`.
    pub(crate) fn new(
        subsystems: Vec<String>,
        points: &[[Option<Vec<f64>>; 2]],
        models: &[v1::Model],
        joints: &[MarkedJoint],
        columns: &[String],
    ) -> Self {
        let all = models.iter().enumerate();
        let all = all.flat_map(|(number, model)| model.markers.iter().map(move |m| (number, m)));
        let markers: Vec<RecordedMarker> = all
            .map(|(subsystem, marker)| RecordedMarker {
                subsystem,
                name: marker.name.clone(),
                kind: marker.kind(),
                columns: columns_of(columns, &subsystems[subsystem], &marker.position),
            })
            .collect();
        let joint = |(points, joint): (&[Option<Vec<f64>>; 2], &MarkedJoint)| {
            let place = |(subsystem, marker): &(usize, v1::Marker)| {
                let mut all = markers.iter();
                all.position(|own| own.subsystem == *subsystem && own.name == marker.name)
            };
            Some(RecordedJoint {
                name: joint.name.clone(),
                ends: [place(&joint.ends[0])?, place(&joint.ends[1])?],
                points: points.each_ref().map(point),
            })
        };
        let contact = |(place, marker): (usize, &RecordedMarker)| {
            contacts::of_marker(columns, &subsystems[marker.subsystem], place, &marker.name)
        };
        let contacts = markers.iter().enumerate().filter_map(contact).collect();
        Self {
            contacts,
            joints: points.iter().zip(joints).filter_map(joint).collect(),
            subsystems,
            markers,
        }
    }
}

/// A point as the scene gives it; those in the plane have no third coordinate, and the marker itself is the default.
fn point(given: &Option<Vec<f64>>) -> [f64; 3] {
    let mut point = [0.0; 3];
    let coordinates = given.iter().flatten();
    point
        .iter_mut()
        .zip(coordinates)
        .for_each(|(to, from)| *to = *from);
    point
}

fn columns_of(columns: &[String], subsystem: &str, outputs: &[String]) -> Vec<usize> {
    let names = outputs.iter().map(|output| format!("{subsystem}.{output}"));
    let place = |name: String| columns.iter().position(|column| *column == name);
    names.filter_map(place).collect()
}
