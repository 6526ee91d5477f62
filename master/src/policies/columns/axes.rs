//! Responses that turn with the bodies.
//!
//! The response of a rigid body to a load is constant in the axes of the body up to what its motion changes within one
//! macro step: for a free body with mass `m`, inertia `J` and a point `r` the acceleration of the point under a force there is
//! `f/m - r x J^-1 (r x f)`, and all of `r`, `J`, `f` turn with the body. So a response that was measured at the attitude `A` holds at the
//! attitude `B` with every vector turned by `R = B A^T`: `C' = R C R^T`. Where several bodies move against each other this is
//! an approximation; the rate of convergence shows how good it is.

use std::ops::Range;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::layout::{Frame, Layout, MomentsFrom};
use crate::signal::attitude::{small_rotation, unit_quaternion};
use crate::system::Outputs;

/// Writes the attitudes of all frames at the end of a look-ahead, then at each look inside it; where they are not told there, as with
/// integrals, those at the end.
pub fn attitudes_of(
    layout: &Layout,
    ahead: &dyn Outputs,
    attitudes: &mut Vec<UnitQuaternion<f64>>,
) {
    attitudes.clear();
    let at_end = |frame: &Frame| {
        let outputs = ahead.of(frame.subsystem);
        attitude(frame, |place| outputs.get(place).copied())
    };
    attitudes.extend(
        layout
            .frames
            .iter()
            .map(|frame| at_end(frame).unwrap_or_default()),
    );
    for look in 0..layout.inside.looks() {
        let is_instant = layout.inside.kind(look) == MomentsFrom::Instants;
        for (number, frame) in layout.frames.iter().enumerate() {
            let told = ahead.inside(frame.subsystem);
            let inside = attitude(frame, |place| {
                let place = layout.inside.find(frame.subsystem, look, place)?;
                told.get(place).copied()
            });
            attitudes.push(inside.filter(|_| is_instant).unwrap_or(attitudes[number]));
        }
    }
}

/// The attitude of a frame that outputs tell, if they do.
fn attitude(frame: &Frame, output: impl Fn(usize) -> Option<f64>) -> Option<UnitQuaternion<f64>> {
    Some(match frame.attitude[..] {
        [w, x, y, z] => {
            let [w, x, y, z] = [w, x, y, z].map(output);
            unit_quaternion([w?, x?, y?, z?])
        }
        [angle] => UnitQuaternion::from_axis_angle(&Vector3::z_axis(), output(angle)?),
        _ => UnitQuaternion::identity(),
    })
}

/// Turns responses from the attitudes `before` to the attitudes `now`, both as [`attitudes_of`] writes them; `of_input` are those of each
/// input, shape by shape. Responses that are not known are empty.
pub fn turn(
    layout: &Layout,
    [before, now]: [&[UnitQuaternion<f64>]; 2],
    of_input: &[Range<usize>],
    responses: &mut [Vec<f64>],
) {
    let frames = layout.frames.len();
    for (number, frame) in layout.frames.iter().enumerate() {
        let of_frame = |all: &[UnitQuaternion<f64>], look: usize| all[look * frames + number];
        for own in &of_input[layout.input_range(frame.subsystem)] {
            for response in responses[own.clone()].iter_mut() {
                if response.is_empty() {
                    continue;
                }
                let at_end = [before, now].map(|all| of_frame(all, 0));
                turn_outputs(frame, at_end, Some, response);
                let outputs = layout.outputs[frame.subsystem].len();
                // Responses over no length have nothing inside.
                if response.len() == outputs {
                    continue;
                }
                for look in 0..layout.inside.looks() {
                    let inside = [before, now].map(|all| of_frame(all, look + 1));
                    let find = |place: usize| {
                        let found = layout.inside.find(frame.subsystem, look, place);
                        found.map(|found| outputs + found)
                    };
                    turn_outputs(frame, inside, find, response);
                }
            }
        }
        let turn = now[number] * before[number].inverse();
        for inputs in &frame.inputs {
            for shape in 0..of_input[inputs[0]].len() {
                let place = |component: usize| of_input[inputs[component]].start + shape;
                turn_inputs(inputs.len(), place, &turn, responses);
            }
        }
    }
}

/// Turns what a response says at one look; `find` tells where an output stands there, if it is told.
fn turn_outputs(
    frame: &Frame,
    [before, now]: [UnitQuaternion<f64>; 2],
    find: impl Fn(usize) -> Option<usize>,
    response: &mut [f64],
) {
    let turn = now * before.inverse();
    for places in &frame.vectors {
        let mut vector = Vector3::zeros();
        let found = places
            .iter()
            .zip(vector.iter_mut())
            .all(|(&place, component)| {
                let place = find(place);
                place.is_some_and(|place| {
                    *component = response[place];
                    true
                })
            });
        if !found {
            continue;
        }
        vector = turn * vector;
        for (component, place) in vector
            .iter()
            .zip(places.iter().filter_map(|&place| find(place)))
        {
            response[place] = *component;
        }
    }
    let [w, x, y, z] = frame.attitude[..] else {
        return;
    };
    let [Some(w), Some(x), Some(y), Some(z)] = [w, x, y, z].map(find) else {
        return;
    };
    let parts = [w, x, y, z];
    let old = [before.w, before.i, before.j, before.k];
    let rotation = turn * small_rotation(old, parts.map(|place| response[place]));
    let change = Quaternion::from_imag(0.5 * rotation) * now.quaternion();
    let changes = [change.w, change.i, change.j, change.k];
    for (place, change) in parts.into_iter().zip(changes) {
        response[place] = change;
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
