//! Responses of zero length: what outputs at the start make of a raised input.

use super::initial::InitialState;
use crate::error::RunError;
use crate::joint::Level;
use crate::layout::Layout;
use crate::system::{Column, Response};
use crate::workers::Workers;

/// How much exchanged variables are raised, as a share of their size.
const EXCHANGED: f64 = 1e-6;

/// Responses to all perturbed inputs under the variables of `state`, for each input one; `base` are the outputs under them.
///
/// Accelerations are linear in loads: a unit tells how much load makes a response of the size of the outputs, which rounding then does not
/// spoil.
pub(super) fn columns(
    t: f64,
    layout: &Layout,
    workers: &Workers,
    state: &InitialState,
    base: &[Vec<f64>],
) -> Result<Vec<Column>, RunError> {
    let size = layout.size(|subsystem, place| base[subsystem][place]);
    let mut columns = Vec::with_capacity(layout.inputs.len());
    for input in &layout.inputs {
        let mut column = Column::new(input, layout);
        if input.is_perturbed {
            let own = &base[input.subsystem];
            let inputs = layout.input_values(input.subsystem, &state.variables, &state.attitudes);
            let respond = |column: &mut Column, increment: f64| {
                let mut raised = inputs.clone();
                raised[input.place] += increment;
                column.increment = increment;
                let subsystem = &workers.subsystems[input.subsystem];
                let names = &layout.outputs[input.subsystem];
                let raised = subsystem.evaluate(t, &raised, names)?;
                column.difference(own, &raised);
                Ok::<(), RunError>(())
            };
            if column.is_load {
                respond(&mut column, 1.0)?;
                if let Some(increment) = column.increment_of_size(own) {
                    respond(&mut column, increment)?;
                }
            } else {
                let unit = if layout.is_length(input) { size } else { 1.0 };
                respond(&mut column, EXCHANGED * inputs[input.place].abs().max(unit))?;
            }
        }
        columns.push(column);
    }
    Ok(columns)
}

/// The response to each input from these `columns`; not known of inputs that are no loads or not perturbed. `layout` reads accelerations.
pub(super) fn of_accelerations(
    layout: &Layout,
    outputs: &[Vec<f64>],
    columns: &[Column],
) -> Vec<Option<Response>> {
    let size = layout.size(|subsystem, place| outputs[subsystem][place]);
    let of_input = layout.inputs.iter().zip(columns).map(|(input, column)| {
        let is_told = input.is_perturbed && column.is_load;
        is_told.then(|| {
            let ends = layout.joints.iter().flat_map(|joint| &joint.ends);
            let own = ends.filter(|end| end.subsystem == input.subsystem);
            let mut largest = Response::default();
            for place in own.flat_map(|end| end.sized(Level::Acceleration)) {
                let value = column.derivatives[place.place].abs();
                let measure = if place.is_length { size } else { 1.0 };
                let share = value / measure;
                largest = largest.larger(Response { value, share });
            }
            largest
        })
    });
    of_input.collect()
}
