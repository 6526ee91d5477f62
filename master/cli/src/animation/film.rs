//! The frames as the script of the page reads them.

use std::f64::consts::TAU;

use linchpin_master::results::RecordedJoint;
use nalgebra::Vector3;
use serde::Serialize;

use super::contacts::{Contact, FLASH};
use super::motion::{Form, Frame, Marker, Motion};
use super::roles::{Role, joined};
use super::scenery::Scenery;
use super::stage::Stage;
use super::view::View;

/// Unit of angles (rad) and of the parts of quaternions in the frames: finer than what a screen shows.
const TURN_UNIT: f64 = 1e-4;

/// Decimal places of the size that the frames keep.
const PLACES: i32 = 4;

/// What the script gets. Coordinates are whole numbers: `origin[axis] + unit number` in m.
#[derive(Debug, Serialize)]
pub(super) struct Film<'a> {
    origin: [f64; 3],
    unit: f64,
    turn_unit: f64,
    view: &'a View,
    /// What has to be turned with the view.
    scenery: Option<&'a Scenery>,
    markers: Vec<MarkerFilm<'a>>,
    /// Markers of each subsystem that a line joins.
    bodies: Vec<Vec<usize>>,
    joints: Vec<JointFilm>,
    contacts: Vec<ContactFilm>,
    /// Of the ring that shows an impact: first and last radius in pixels, and number of frames.
    flash: (f64, f64, usize),
    /// Times of the frames in s.
    t: Vec<f64>,
}

#[derive(Debug, Serialize)]
struct MarkerFilm<'a> {
    subsystem: &'a str,
    name: &'a str,
    /// Numbers of a frame that are coordinates, and all numbers of a frame.
    coordinates: usize,
    numbers: usize,
    /// y of what moves along x only (m).
    lane: f64,
    /// Whether it has a frame or a block, and a path.
    framed: bool,
    /// Lines in the axes of the marker (m).
    shape: Vec<Vec<[f64; 3]>>,
    /// The numbers of all frames, frame by frame.
    motion: Vec<i64>,
}

#[derive(Debug, Serialize)]
struct JointFilm {
    /// Places of its markers.
    ends: [usize; 2],
    /// Where it holds, in their axes (m).
    points: [[f64; 3]; 2],
}

#[derive(Debug, Serialize)]
struct ContactFilm {
    /// Place of its marker.
    marker: usize,
    /// Radius of its dot in tenths of a pixel in each frame; 0 where it is open.
    radii: Vec<u64>,
    /// Strength of its impacts in each frame in hundredths; 0 without one.
    flashes: Vec<u64>,
}

impl JointFilm {
    fn of(joint: &RecordedJoint) -> Self {
        Self {
            ends: joint.ends,
            points: joint.points,
        }
    }
}

impl<'a> Film<'a> {
    /// The frames of `motion`.
    pub fn of(motion: &'a Motion, stage: &Stage, view: &'a View, scenery: &'a Scenery) -> Self {
        let unit = 10f64.powi(stage.size.log10().floor() as i32 - PLACES);
        let origin = 0.5 * (stage.low + stage.high);
        let marker_film = |marker: &'a Marker| MarkerFilm {
            subsystem: &motion.subsystems[marker.subsystem],
            name: &marker.name,
            coordinates: marker.form.coordinates(),
            numbers: marker.form.numbers(),
            lane: stage.lane(marker),
            framed: marker.role == Role::Framed,
            shape: as_arrays(stage.shape(marker.form)),
            motion: motion
                .frames()
                .flat_map(|frame| rounded(marker, frame, &origin, unit))
                .collect(),
        };
        Self {
            origin: origin.into(),
            unit,
            turn_unit: TURN_UNIT,
            view,
            scenery: view.turn.is_some().then_some(scenery),
            markers: motion.markers.iter().map(marker_film).collect(),
            bodies: joined(motion)
                .into_iter()
                .map(|line| line.markers)
                .collect(),
            joints: motion.joints.iter().map(JointFilm::of).collect(),
            contacts: contacts(motion),
            flash: FLASH,
            t: motion.frames().map(|frame| frame.t).collect(),
        }
    }
}

fn contacts(motion: &Motion) -> Vec<ContactFilm> {
    let hundredths = |strength: f64| (100.0 * strength).round() as u64;
    let film = |(place, contact): (usize, &Contact)| ContactFilm {
        marker: contact.marker,
        radii: motion
            .frames()
            .map(|frame| (10.0 * motion.dot_radius(place, frame)).round() as u64)
            .collect(),
        flashes: motion
            .flashes(contact)
            .into_iter()
            .map(hundredths)
            .collect(),
    };
    motion.contacts.iter().enumerate().map(film).collect()
}

fn rounded<'a>(
    marker: &'a Marker,
    frame: &'a Frame,
    origin: &'a Vector3<f64>,
    unit: f64,
) -> impl Iterator<Item = i64> + 'a {
    let numbers = &frame.numbers[marker.start..][..marker.form.numbers()];
    let (coordinates, turn) = numbers.split_at(marker.form.coordinates());
    let place = move |(x, origin): (&f64, &f64)| ((x - origin) / unit).round() as i64;
    let full_turns = |part: &f64| match marker.form {
        Form::Plane => TAU * (part / TAU).round(),
        _ => 0.0,
    };
    let turn = turn.iter();
    let turn = turn.map(move |part| ((part - full_turns(part)) / TURN_UNIT).round() as i64);
    coordinates.iter().zip(origin).map(place).chain(turn)
}

fn as_arrays(lines: Vec<Vec<Vector3<f64>>>) -> Vec<Vec<[f64; 3]>> {
    let points = |line: Vec<Vector3<f64>>| line.into_iter().map(Into::into).collect();
    lines.into_iter().map(points).collect()
}
