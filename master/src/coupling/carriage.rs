//! Columns of earlier macro steps, carried along with the bodies.

use std::ops::Range;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::columns::Column;
use super::layout::{Frame, Layout};
use crate::signal::attitude::{small_rotation, unit_quaternion};

/// The columns as they were measured over look-aheads of one or several shapes, and the attitudes that the bodies had then.
///
/// The response of a rigid body to a load is constant in the axes of the body up to what its motion changes within one
/// macro step: for a free body with mass `m`, inertia `J` and a point `r` the acceleration of the point under a force there is
/// `f/m - r x J^-1 (r x f)`, and all of `r`, `J`, `f` turn with the body. So a column that was measured at the attitude `A` holds at the
/// attitude `B` with every vector turned by `R = B A^T`: `C' = R C R^T`. Where several bodies move against each other this is
/// an approximation; the rate of convergence shows how good it is.
///
/// What is measured belongs to a macro step that may yet be rejected; only [`Carriage::settle`] makes it one of those that stay.
#[derive(Debug, Clone, PartialEq)]
pub struct Carriage {
    /// Those that stay, the last used first.
    settled: Vec<Measured>,
    /// Those of the present macro step, if `is_pending`.
    pending: Measured,
    is_pending: bool,
    /// The shape in use.
    shape: Shape,
}

/// The past nodes of the polynomials that are raised, if they have any, and how many of them each uses.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Nodes<'a> {
    /// Times of past macro points relative to the present one in s.
    pub times: &'a [f64],
    /// Degrees of the polynomials of all coupling variables.
    pub degrees: &'a [usize],
}

/// To what columns belong: the length of a look-ahead in s, and the nodes.
#[derive(Debug, Clone, Default, PartialEq)]
struct Shape {
    length: f64,
    times: Vec<f64>,
    degrees: Vec<usize>,
}

impl Shape {
    fn set(&mut self, length: f64, nodes: Nodes<'_>) {
        self.length = length;
        self.times.clear();
        self.times.extend_from_slice(nodes.times);
        self.degrees.clear();
        self.degrees.extend_from_slice(nodes.degrees);
    }

    fn is(&self, length: f64, nodes: Nodes<'_>) -> bool {
        self.length == length && self.times == nodes.times && self.degrees == nodes.degrees
    }

    fn nodes(&self) -> Nodes<'_> {
        Nodes {
            times: &self.times,
            degrees: &self.degrees,
        }
    }
}

#[derive(Debug, Clone, Default, PartialEq)]
struct Measured {
    shape: Shape,
    columns: Vec<Vec<f64>>,
    attitudes: Vec<UnitQuaternion<f64>>,
}

/// Most shapes whose columns stay: macro steps that vary come back to the same lengths.
const MOST_SHAPES: usize = 16;

impl Carriage {
    /// For the frames of `layout`.
    pub fn new(layout: &Layout) -> Self {
        Self {
            settled: Vec::with_capacity(MOST_SHAPES),
            pending: Measured {
                attitudes: vec![UnitQuaternion::identity(); layout.frames.len()],
                ..Measured::default()
            },
            is_pending: false,
            shape: Shape::default(),
        }
    }

    /// Whether there are columns of this shape.
    pub fn has(&self, length: f64, nodes: Nodes<'_>) -> bool {
        self.settled.iter().any(|one| one.shape.is(length, nodes))
    }

    /// Begins with the first look-ahead over a macro step, or over a repeated one: what was measured for a step that is not taken is
    /// dropped. Gives whether the macro step before had this shape.
    pub fn begin(&mut self, length: f64, nodes: Nodes<'_>) -> bool {
        self.is_pending = false;
        self.shape.set(length, nodes);
        self.settled
            .first()
            .is_some_and(|last| last.shape == self.shape)
    }

    /// The macro step is done: its columns stay.
    pub fn settle(&mut self) {
        let place = self.settled.iter().position(|one| one.shape == self.shape);
        if std::mem::take(&mut self.is_pending) {
            let place = place.unwrap_or_else(|| {
                if self.settled.len() < MOST_SHAPES {
                    self.settled.push(self.pending.clone());
                }
                self.settled.len() - 1
            });
            std::mem::swap(&mut self.settled[place], &mut self.pending);
            self.settled[..=place].rotate_right(1);
        } else if let Some(place) = place {
            self.settled[..=place].rotate_right(1);
        }
    }

    /// Takes columns that were measured at these coupling outputs.
    pub fn keep<'a>(
        &mut self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64],
        columns: &[Column],
    ) {
        let pending = &mut self.pending;
        pending.shape.set(self.shape.length, self.shape.nodes());
        pending.columns.resize_with(columns.len(), Vec::new);
        for (measured, column) in pending.columns.iter_mut().zip(columns) {
            measured.clone_from(&column.derivatives);
        }
        for (attitude, frame) in pending.attitudes.iter_mut().zip(&layout.frames) {
            *attitude = attitude_of(frame, outputs(frame.subsystem));
        }
        self.is_pending = true;
    }

    /// Turns the columns of the shape in use to the attitudes of these coupling outputs; `of_input` are the columns of each input.
    pub fn carry<'a>(
        &self,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64],
        columns: &mut [Column],
        of_input: &[Range<usize>],
    ) {
        let source = match self.is_pending {
            true => Some(&self.pending),
            false => self.settled.iter().find(|one| one.shape == self.shape),
        };
        let Some(source) = source else {
            return;
        };
        for (measured, column) in source.columns.iter().zip(&mut *columns) {
            column.derivatives.clone_from(measured);
        }
        for (before, frame) in source.attitudes.iter().zip(&layout.frames) {
            let now = attitude_of(frame, outputs(frame.subsystem));
            let turn = now * before.inverse();
            for own in &of_input[layout.input_range(frame.subsystem)] {
                let measured = columns[own.clone()].iter_mut();
                for column in measured.filter(|one| !one.derivatives.is_empty()) {
                    turn_outputs(frame, (before, &now), &turn, &mut column.derivatives);
                }
            }
            for inputs in &frame.inputs {
                for shape in 0..of_input[inputs[0]].len() {
                    let column = |component: usize| of_input[inputs[component]].start + shape;
                    turn_inputs(inputs.len(), column, &turn, columns);
                }
            }
        }
    }
}

fn turn_outputs(
    frame: &Frame,
    (before, now): (&UnitQuaternion<f64>, &UnitQuaternion<f64>),
    turn: &UnitQuaternion<f64>,
    derivatives: &mut [f64],
) {
    for places in &frame.vectors {
        let mut vector = Vector3::zeros();
        for (component, &place) in vector.iter_mut().zip(places) {
            *component = derivatives[place];
        }
        vector = turn * vector;
        for (component, &place) in vector.iter().zip(places) {
            derivatives[place] = *component;
        }
    }
    if let [w, x, y, z] = frame.attitude[..] {
        let parts = [w, x, y, z];
        let old = [before.w, before.i, before.j, before.k];
        let rotation = turn * small_rotation(old, parts.map(|place| derivatives[place]));
        let change = Quaternion::from_imag(0.5 * rotation) * now.quaternion();
        let changes = [change.w, change.i, change.j, change.k];
        for (place, change) in parts.into_iter().zip(changes) {
            derivatives[place] = change;
        }
    }
}

/// The columns of the components of one vector become those of the components in turned axes.
fn turn_inputs(
    components: usize,
    column: impl Fn(usize) -> usize,
    turn: &UnitQuaternion<f64>,
    columns: &mut [Column],
) {
    for output in 0..columns[column(0)].derivatives.len() {
        let mut row = Vector3::zeros();
        for component in 0..components {
            row[component] = columns[column(component)].derivatives[output];
        }
        row = turn * row;
        for component in 0..components {
            columns[column(component)].derivatives[output] = row[component];
        }
    }
}

fn attitude_of(frame: &Frame, outputs: &[f64]) -> UnitQuaternion<f64> {
    match frame.attitude[..] {
        [w, x, y, z] => unit_quaternion([w, x, y, z].map(|place| outputs[place])),
        [angle] => UnitQuaternion::from_axis_angle(&Vector3::z_axis(), outputs[angle]),
        _ => UnitQuaternion::identity(),
    }
}
