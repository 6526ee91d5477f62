//! Responses that turn with the bodies.
//!
//! The response of a rigid body to a load is constant in the axes of the body up to what its motion changes within one
//! macro step: for a free body with mass `m`, inertia `J` and a point `r` the acceleration of the point under a force there is
//! `f/m - r x J^-1 (r x f)`, and all of `r`, `J`, `f` turn with the body. So a response that was measured at the attitude `A` holds at the
//! attitude `B` with every vector turned by `R = B A^T`: `C' = R C R^T`. Where several bodies move against each other this is
//! an approximation; the rate of convergence shows how good it is.

use std::ops::Range;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::layout::{Frame, Layout};
use crate::signal::attitude::{small_rotation, unit_quaternion};

/// The attitude of a frame that the coupling outputs of its subsystem tell.
pub fn attitude_of(frame: &Frame, outputs: &[f64]) -> UnitQuaternion<f64> {
    match frame.attitude[..] {
        [w, x, y, z] => unit_quaternion([w, x, y, z].map(|place| outputs[place])),
        [angle] => UnitQuaternion::from_axis_angle(&Vector3::z_axis(), outputs[angle]),
        _ => UnitQuaternion::identity(),
    }
}

/// Turns responses from the attitudes `before` of all frames to the attitudes that `now` gives; `of_input` are those of each input, shape by
/// shape. Responses that are not known are empty.
pub fn turn(
    layout: &Layout,
    before: &[UnitQuaternion<f64>],
    now: impl Fn(usize, &Frame) -> UnitQuaternion<f64>,
    of_input: &[Range<usize>],
    responses: &mut [Vec<f64>],
) {
    for (number, (before, frame)) in before.iter().zip(&layout.frames).enumerate() {
        let now = now(number, frame);
        let turn = now * before.inverse();
        for own in &of_input[layout.input_range(frame.subsystem)] {
            for response in responses[own.clone()].iter_mut() {
                if !response.is_empty() {
                    turn_outputs(frame, (before, &now), &turn, response);
                }
            }
        }
        for inputs in &frame.inputs {
            for shape in 0..of_input[inputs[0]].len() {
                let place = |component: usize| of_input[inputs[component]].start + shape;
                turn_inputs(inputs.len(), place, &turn, responses);
            }
        }
    }
}

fn turn_outputs(
    frame: &Frame,
    (before, now): (&UnitQuaternion<f64>, &UnitQuaternion<f64>),
    turn: &UnitQuaternion<f64>,
    response: &mut [f64],
) {
    for places in &frame.vectors {
        let mut vector = Vector3::zeros();
        for (component, &place) in vector.iter_mut().zip(places) {
            *component = response[place];
        }
        vector = turn * vector;
        for (component, &place) in vector.iter().zip(places) {
            response[place] = *component;
        }
    }
    if let [w, x, y, z] = frame.attitude[..] {
        let parts = [w, x, y, z];
        let old = [before.w, before.i, before.j, before.k];
        let rotation = turn * small_rotation(old, parts.map(|place| response[place]));
        let change = Quaternion::from_imag(0.5 * rotation) * now.quaternion();
        let changes = [change.w, change.i, change.j, change.k];
        for (place, change) in parts.into_iter().zip(changes) {
            response[place] = change;
        }
    }
}

/// The responses to the components of one vector become those to the components in turned axes.
fn turn_inputs(
    components: usize,
    place: impl Fn(usize) -> usize,
    turn: &UnitQuaternion<f64>,
    responses: &mut [Vec<f64>],
) {
    for output in 0..responses[place(0)].len() {
        let mut row = Vector3::zeros();
        for component in 0..components {
            row[component] = responses[place(component)][output];
        }
        row = turn * row;
        for component in 0..components {
            responses[place(component)][output] = row[component];
        }
    }
}
