//! Fits joints to the start that rounded data leave open there.
//!
//! Geometry that was written with a few digits does not meet to rounding. Such a joint is closed by its own geometry: the least shift of its point
//! and the least turn of its axis, or of the attitude that it keeps, at marker b. With `d = (shift/L, turn)`, `L` being the size of the joint's
//! lengths, Newton's method solves `g(d) = 0` by steps of least norm.

use std::borrow::Cow;
use std::sync::Arc;

use linchpin_proto::v1::{self, MarkerKind};
use nalgebra::{DMatrix, DVector, UnitQuaternion, Vector3};

use super::degrees::load_forms;
use super::discover::{connect_signals, mark, refuse_marker};
use super::geometry::{Needs, law_of};
use super::initial::InitialState;
use super::instances::{initialize, initialize_request, names};
use super::options::Options;
use crate::error::RunError;
use crate::joint::{Joint as Law, Level, Motion};
use crate::layout::{Coupled, Layout, MarkedJoint};
use crate::results::FittedJoint;
use crate::scene::{CLOSED, Geometry, Joint, Scene};
use crate::system::motion_of;
use crate::time::at_start;
use crate::workers::{Subsystem, Workers};

/// Change of an unknown by which its influence is found.
const UNIT: f64 = 1e-6;

/// Singular values below this share of the largest are rounding.
const RANK: f64 = 1e-8;

/// Residuals below this share of what counts as closed are not made smaller.
const SOLVED: f64 = 1e-3;

/// Steps of Newton's method; it doubles the digits of a gap that is small.
const STEPS: usize = 6;

/// The scene with the geometry of its joints fitted to the start, and which were changed. Joints that are closed stay as they are; so do those that are
/// open by more than `coupling.start_tolerance`, or that have no geometry, to be refused. Leaves no instance behind. Where a run accepts open joints they
/// are a part of the state that it starts from.
pub(super) fn fit<'a>(
    scene: &'a Scene,
    models: &[v1::Model],
    subsystems: &mut Vec<Subsystem>,
    options: &Options,
) -> Result<(Cow<'a, Scene>, Vec<FittedJoint>), RunError> {
    let mut fitted = Vec::new();
    let tolerance = scene.coupling.start_tolerance;
    if tolerance <= CLOSED || scene.joints.is_empty() || options.accept_open_joints {
        return Ok((Cow::Borrowed(scene), fitted));
    }
    let joints = mark(scene, models)?;
    let mut fitting = scene.clone();
    let motions = motions(scene, models, &joints, subsystems)?;
    for (number, (marked, motion)) in joints.iter().zip(&motions).enumerate() {
        let is_within = |limit: f64| is_closed(&marked.joint, motion, limit);
        if is_within(CLOSED) || !is_within(tolerance) {
            continue;
        }
        let markers = marked.ends[0].1.kind();
        if let Some((geometry, told)) = fit_one(scene, &scene.joints[number], markers, motion)? {
            fitting.joints[number].geometry = geometry;
            fitted.push(told);
        }
    }
    Ok((Cow::Owned(fitting), fitted))
}

/// How the markers of every joint are placed at the start.
fn motions(
    scene: &Scene,
    models: &[v1::Model],
    joints: &[MarkedJoint],
    subsystems: &mut Vec<Subsystem>,
) -> Result<Vec<Motion>, RunError> {
    let connections = connect_signals(scene, models)?;
    let turning = turning(scene, joints)?;
    let coupled = Coupled {
        subsystems: names(scene),
        forms: load_forms(scene, models)?,
        joints: &turning,
        connections: &connections,
    };
    let layout =
        Layout::new(&coupled, Level::Position).map_err(|lacks| refuse_marker(scene, lacks))?;
    let request = |number| initialize_request(scene, number, models, &layout, &[]);
    let requests: Vec<_> = (0..models.len()).map(request).collect();
    initialize(scene, models, &requests, subsystems)?;
    let mut workers = Workers::new(std::mem::take(subsystems), None, layout.variables());
    let read = InitialState::read(scene, &coupled, &layout, &workers, None);
    *subsystems = std::mem::take(&mut workers.subsystems);
    let (_, outputs) = read?;
    for subsystem in &*subsystems {
        { subsystem.terminate() }
            .map_err(|error| subsystem.failed(error, at_start(scene.t_start)))?;
    }
    let motion = |number| motion_of(&layout, number, |subsystem| &outputs[subsystem]);
    Ok((0..joints.len()).map(motion).collect())
}

/// The joints with a point off the marker at b: of a marker that is the point itself no attitude would be read.
fn turning(scene: &Scene, joints: &[MarkedJoint]) -> Result<Vec<MarkedJoint>, RunError> {
    let mut turning = joints.to_vec();
    for (marked, written) in turning.iter_mut().zip(&scene.joints) {
        let markers = marked.ends[0].1.kind();
        let needs = Needs::of(written.kind, markers);
        if needs.is_some_and(|needs| needs.points) {
            let mut written = written.clone();
            let dimension = if markers == MarkerKind::Planar { 2 } else { 3 };
            written.geometry.points[1] = Some(vec![1.0; dimension]);
            marked.joint = Arc::new(law_of(scene, &written, markers)?);
        }
    }
    Ok(turning)
}

fn is_closed(law: &Law, motion: &Motion, limit: f64) -> bool {
    law.conditions().all(|condition| {
        let residual = condition.value(Level::Position, motion);
        residual.abs() <= limit * condition.extent(Level::Position, motion)
    })
}

/// The geometry that closes a joint, if there is one.
fn fit_one(
    scene: &Scene,
    written: &Joint,
    markers: MarkerKind,
    motion: &Motion,
) -> Result<Option<(Geometry, FittedJoint)>, RunError> {
    let Some(needs) = Needs::of(written.kind, markers) else {
        return Ok(None);
    };
    let law = law_of(scene, written, markers)?;
    let length = law
        .conditions()
        .filter(|condition| condition.is_length())
        .map(|condition| condition.extent(Level::Position, motion))
        .fold(0.0, f64::max);
    let moves = Moves::of(needs, markers, if length > 0.0 { length } else { 1.0 });
    let law_at = |moved: &DVector<f64>| {
        let geometry = moves.moved(&written.geometry, moved);
        let joint = Joint {
            geometry,
            ..written.clone()
        };
        law_of(scene, &joint, markers)
    };
    let mut moved = DVector::zeros(moves.len());
    let mut law = law_at(&moved)?;
    for _ in 0..STEPS {
        if is_closed(&law, motion, SOLVED * CLOSED) {
            break;
        }
        let open = openings(&law, motion);
        let mut influence = DMatrix::zeros(open.len(), moves.len());
        for unknown in 0..moves.len() {
            let mut changed = moved.clone();
            changed[unknown] += UNIT;
            let change = openings(&law_at(&changed)?, motion) - &open;
            influence.set_column(unknown, &(change / UNIT));
        }
        let svd = influence.svd(true, true);
        let rank = RANK * svd.singular_values.max();
        match svd.solve(&open, rank) {
            Ok(step) => moved -= step,
            Err(_) => return Ok(None),
        }
        law = law_at(&moved)?;
    }
    let told = FittedJoint {
        joint: written.name.clone(),
        shift: moves.shift(&moved).norm(),
        turn: moves.turn(&moved).norm(),
    };
    let geometry = moves.moved(&written.geometry, &moved);
    Ok(is_closed(&law, motion, CLOSED).then_some((geometry, told)))
}

/// The residuals on position level, relative to what they are measured by.
fn openings(law: &Law, motion: &Motion) -> DVector<f64> {
    let openings = law.conditions().map(|condition| {
        condition.value(Level::Position, motion) / condition.extent(Level::Position, motion)
    });
    DVector::from_vec(openings.collect())
}

/// How the geometry of a joint at marker b can move: shifts over a length, then turns.
struct Moves {
    is_planar: bool,
    shifts: usize,
    turns: usize,
    length: f64,
    needs: Needs,
}

impl Moves {
    fn of(needs: Needs, markers: MarkerKind, length: f64) -> Self {
        let is_planar = markers == MarkerKind::Planar;
        let [shifts, turns] = if is_planar { [2, 1] } else { [3, 3] };
        let has = |count: usize, is_there: bool| if is_there { count } else { 0 };
        Self {
            is_planar,
            shifts: has(shifts, needs.points),
            turns: has(turns, needs.axes[1] || needs.attitude),
            length,
            needs,
        }
    }

    fn len(&self) -> usize {
        self.shifts + self.turns
    }

    /// The shift of the point in m, in the axes of b.
    fn shift(&self, moved: &DVector<f64>) -> DVector<f64> {
        moved.rows(0, self.shifts) * self.length
    }

    /// The turn as a rotation vector in the axes of b, in the plane about its normal.
    fn turn(&self, moved: &DVector<f64>) -> Vector3<f64> {
        let turn = moved.rows(self.shifts, self.turns);
        match turn.len() {
            0 => Vector3::zeros(),
            1 => Vector3::z() * turn[0],
            _ => Vector3::new(turn[0], turn[1], turn[2]),
        }
    }

    fn moved(&self, written: &Geometry, moved: &DVector<f64>) -> Geometry {
        let mut geometry = written.clone();
        let turn = self.turn(moved);
        let rotation = UnitQuaternion::from_scaled_axis(turn);
        if self.shifts > 0 {
            let point = geometry.points[1].get_or_insert_with(|| vec![0.0; self.shifts]);
            let shift = self.shift(moved);
            point
                .iter_mut()
                .zip(&shift)
                .for_each(|(own, by)| *own += by);
        }
        if let Some(axis) = geometry.axes[1].as_mut().filter(|_| self.turns > 0) {
            let mut whole = Vector3::zeros();
            { whole.iter_mut().zip(&*axis) }.for_each(|(own, given)| *own = *given);
            let turned = rotation * whole;
            axis.iter_mut()
                .zip(&turned)
                .for_each(|(own, by)| *own = *by);
        }
        if self.needs.attitude && self.is_planar {
            *geometry.angle.get_or_insert(0.0) += turn.z;
        } else if self.needs.attitude {
            let given = geometry.attitude.as_deref();
            let &[w, x, y, z] = given.unwrap_or(&[1.0, 0.0, 0.0, 0.0]) else {
                return geometry;
            };
            let turned = rotation.into_inner() * nalgebra::Quaternion::new(w, x, y, z);
            geometry.attitude = Some(vec![turned.w, turned.i, turned.j, turned.k]);
        }
        geometry
    }
}
