//! Positions of the markers at some of the recorded macro points.

use linchpin_master::results::{Mechanism, RecordedJoint, RecordedMarker};
use linchpin_proto::v1::MarkerKind;

use super::contacts::{Contact, NUMBERS_PER_FRAME};
use super::roles::{Role, roles};
use crate::results::Thinned;

/// Most frames: at 60 in a second they last for ten seconds.
const MOST_FRAMES: usize = 600;

/// Numbers in the file, which keep it below about 1 MB; a scene with many markers gets fewer frames for that.
const MOST_NUMBERS: usize = 140_000;

/// A point of a trace in the first frame takes as much room as two numbers of the frames.
const NUMBERS_PER_TRACE_POINT: usize = 2;

/// Positions beyond this are drawn here (m): lengths in the picture stay finite.
const FARTHEST: f64 = 1e100;

/// The motion of a mechanism, in bounded memory.
pub struct Motion {
    /// Names of the subsystems.
    pub(super) subsystems: Vec<String>,
    /// Markers that can be shown.
    pub(super) markers: Vec<Marker>,
    /// Joints between them.
    pub(super) joints: Vec<RecordedJoint>,
    /// Markers that are contacts.
    pub(super) contacts: Vec<Contact>,
    frames: Thinned<Frame>,
    last: Option<Frame>,
    rows: usize,
}

/// A marker with the numbers of its position.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Marker {
    /// Place of its subsystem.
    pub subsystem: usize,
    /// Name in the model.
    pub name: String,
    /// What the numbers are.
    pub form: Form,
    /// How it is shown.
    pub role: Role,
    /// Place of its first number in a frame.
    pub start: usize,
    columns: Vec<usize>,
}

/// What the numbers of a marker's position are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// x.
    Line,
    /// x, y.
    PlanePoint,
    /// x, y, angle.
    Plane,
    /// x, y, z.
    SpacePoint,
    /// x, y, z, quaternion (w, x, y, z).
    Space,
}

/// The numbers of all markers at one macro point.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Frame {
    /// Time in s.
    pub t: f64,
    /// m, rad, quaternions.
    pub numbers: Vec<f64>,
    /// Normal forces of the contacts (N).
    pub forces: Vec<f64>,
}

impl Form {
    fn of(marker: &RecordedMarker) -> Option<Self> {
        match (marker.kind, marker.columns.len()) {
            (MarkerKind::Scalar, 1..) => Some(Self::Line),
            (MarkerKind::Planar, 2) => Some(Self::PlanePoint),
            (MarkerKind::Planar, 3..) => Some(Self::Plane),
            (MarkerKind::Spatial, 3..7) => Some(Self::SpacePoint),
            (MarkerKind::Spatial, 7..) => Some(Self::Space),
            _ => None,
        }
    }

    /// Without the turn.
    fn as_point(self) -> Self {
        match self {
            Self::Line => Self::Line,
            Self::PlanePoint | Self::Plane => Self::PlanePoint,
            Self::SpacePoint | Self::Space => Self::SpacePoint,
        }
    }

    /// How many of the numbers are coordinates in m; they come first.
    pub fn coordinates(self) -> usize {
        match self {
            Self::Line => 1,
            Self::PlanePoint | Self::Plane => 2,
            Self::SpacePoint | Self::Space => 3,
        }
    }

    /// How many numbers there are.
    pub fn numbers(self) -> usize {
        match self {
            Self::Line => 1,
            Self::PlanePoint => 2,
            Self::Plane | Self::SpacePoint => 3,
            Self::Space => 7,
        }
    }
}

impl Motion {
    /// Nothing yet of the motion of `mechanism`; `None` if it has no marker that can be shown.
    pub fn new(mechanism: &Mechanism) -> Option<Self> {
        let mut markers: Vec<Marker> = Vec::new();
        let mut places = Vec::with_capacity(mechanism.markers.len());
        let mut numbers = 0;
        for (marker, role) in mechanism.markers.iter().zip(roles(mechanism)) {
            let form = Form::of(marker).map(|form| match role {
                Role::Framed => form,
                Role::Outline | Role::Dot => form.as_point(),
            });
            places.push(form.map(|_| markers.len()));
            let Some(form) = form else { continue };
            markers.push(Marker {
                subsystem: marker.subsystem,
                name: marker.name.clone(),
                form,
                role,
                start: numbers,
                columns: marker.columns[..form.numbers()].to_vec(),
            });
            numbers += form.numbers();
        }
        let joint = |joint: &RecordedJoint| {
            let [a, b] = joint.ends;
            Some(RecordedJoint {
                name: joint.name.clone(),
                ends: [places[a]?, places[b]?],
                points: joint.points,
            })
        };
        let contacts = mechanism.contacts.iter();
        let contacts = contacts.filter_map(|own| Some(Contact::new(own, places[own.marker]?)));
        let contacts: Vec<Contact> = contacts.collect();
        let framed = markers.iter().filter(|marker| marker.role == Role::Framed);
        let cost =
            numbers + NUMBERS_PER_TRACE_POINT * framed.count() + NUMBERS_PER_FRAME * contacts.len();
        let most = (MOST_NUMBERS / cost.max(1)).min(MOST_FRAMES);
        (!markers.is_empty()).then(|| Self {
            subsystems: mechanism.subsystems.clone(),
            joints: mechanism.joints.iter().filter_map(joint).collect(),
            markers,
            contacts,
            // The last row is always there.
            frames: Thinned::at_most(most.saturating_sub(1)),
            last: None,
            rows: 0,
        })
    }

    /// Takes the values of a row.
    pub fn record(&mut self, row: &[f64]) {
        let columns = self.markers.iter().flat_map(|marker| &marker.columns);
        let read = |&column: &usize| row[column].clamp(-FARTHEST, FARTHEST);
        let last = self.last.get_or_insert_with(Frame::default);
        last.t = row[0];
        last.numbers.clear();
        last.numbers.extend(columns.map(read));
        last.forces.clear();
        last.forces
            .extend(self.contacts.iter().map(|contact| contact.force(row)));
        let last: &Frame = last;
        let owner = |contact: &Contact| self.markers[contact.marker].subsystem;
        let closed = self.contacts.iter().zip(&last.forces);
        let closed = closed.filter(|(_, force)| **force > 0.0);
        let closed: Vec<usize> = closed.map(|(contact, _)| owner(contact)).collect();
        for (contact, force) in self.contacts.iter_mut().zip(&last.forces) {
            let may_be_hit = *force > 0.0 || !closed.contains(&owner(contact));
            contact.record(self.rows, row, may_be_hit);
        }
        self.frames.push(|| last.clone());
        self.rows += 1;
    }

    /// The frames: one of [`Motion::stride`] rows, and the last one.
    pub(super) fn frames(&self) -> impl Iterator<Item = &Frame> + Clone {
        let kept = self.frames.items();
        let is_new = |last: &&Frame| kept.last().is_some_and(|kept| kept.t < last.t);
        kept.iter().chain(self.last.iter().filter(is_new))
    }

    /// Largest normal force of all contacts in all rows (N).
    pub(super) fn largest_force(&self) -> f64 {
        let forces = self.contacts.iter().map(|contact| contact.largest_force);
        forces.fold(0.0, f64::max)
    }

    /// Radius in pixels of the dot at contact number `place`; 0 where it is open.
    pub(super) fn dot_radius(&self, place: usize, frame: &Frame) -> f64 {
        let radius = self.contacts[place].radius(frame.forces[place], self.largest_force());
        radius.unwrap_or(0.0)
    }

    /// Strength of the flash of a contact in every frame, 0 to 1.
    pub(super) fn flashes(&self, contact: &Contact) -> Vec<f64> {
        let impulses = self.contacts.iter().map(Contact::largest_impulse);
        let largest = impulses.fold(0.0, f64::max);
        contact.flashes(self.frames().count(), self.stride(), largest)
    }

    /// Of how many rows one is a frame.
    pub(super) fn stride(&self) -> usize {
        self.frames.stride()
    }

    /// Number of rows that were taken.
    pub(super) fn rows(&self) -> usize {
        self.rows
    }
}
