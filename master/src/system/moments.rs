//! The conditions inside a step, weighted: moments.

use super::answers::Outputs;
use super::column::Column;
use super::equations::{Moments, System, Weights};
use super::point::Point;
use super::unknowns::Unknowns;
use crate::joint::Level;
use crate::layout::{Layout, MomentsFrom};

impl System {
    /// Conditions and Jacobians inside the step, for systems that have them. `columns` belong to the inputs of `layout`; without them the
    /// Jacobians stay as they are.
    pub fn assemble_inside(
        &mut self,
        layout: &Layout,
        outputs: &dyn Outputs,
        columns: Option<&[Column]>,
        point: Point<'_>,
    ) {
        if let Some(moments) = &mut self.moments {
            moments.assemble(layout, outputs, columns, point);
        }
    }
}

impl Moments {
    /// For these unknowns; `shapes` are the values of the shapes of all unknowns at the looks, look by look.
    pub fn new(
        layout: &Layout,
        unknowns: Unknowns,
        weights: Weights,
        shapes: Vec<Vec<f64>>,
    ) -> Self {
        let columns = layout.inputs.len().checked_sub(1);
        let columns = columns.map_or(0, |last| unknowns.columns(last).end);
        let at_look = System::at_positions(layout, unknowns);
        let entries = at_look.pattern().entries();
        let moments = weights.of_motion.len().max(weights.of_signals.len());
        Self {
            weights,
            at_look,
            units: shapes,
            is_signal: (0..layout.variables())
                .map(|one| layout.is_signal(one))
                .collect(),
            outputs: layout
                .outputs
                .iter()
                .map(|names| vec![0.0; names.len()])
                .collect(),
            columns: vec![Column::default(); columns],
            residuals: vec![vec![0.0; layout.variables()]; moments],
            jacobians: vec![vec![0.0; entries]; moments],
        }
    }

    /// Moment number `moment` of every condition.
    pub fn residual(&self, moment: usize) -> &[f64] {
        &self.residuals[moment]
    }

    /// Its derivatives, entry by entry of the pattern of the system.
    pub fn jacobian(&self, moment: usize) -> &[f64] {
        &self.jacobians[moment]
    }

    /// Takes what the workers have told, and their `columns` unless the Jacobians stay as they are. A worker that has told nothing leaves
    /// no condition to be met.
    fn assemble(
        &mut self,
        layout: &Layout,
        told: &dyn Outputs,
        columns: Option<&[Column]>,
        point: Point<'_>,
    ) {
        self.residuals
            .iter_mut()
            .for_each(|residual| residual.fill(0.0));
        if columns.is_some() {
            self.jacobians
                .iter_mut()
                .for_each(|jacobian| jacobian.fill(0.0));
        }
        let inside = &layout.inside;
        let is_silent =
            |subsystem: usize| inside.values(subsystem) > 0 && told.inside(subsystem).is_empty();
        if (0..layout.outputs.len()).any(is_silent) {
            return;
        }
        if columns.is_some() {
            self.at_look.differentiate_inputs(layout, point);
        }
        for (look, w) in point.inside.iter().enumerate() {
            for (subsystem, outputs) in self.outputs.iter_mut().enumerate() {
                if inside.kind(look) == MomentsFrom::Integrals {
                    // What is not integrated has to be something that there is: a quaternion, where conditions that are not served stand
                    // beside others.
                    let at_end = &told.of(subsystem)[..outputs.len()];
                    outputs.copy_from_slice(at_end);
                }
                inside.spread(subsystem, look, told.inside(subsystem), outputs);
            }
            let point = Point { w, ..point };
            if let Some(columns) = columns {
                self.spread_columns(layout, look, columns);
            }
            let outputs = &self.outputs;
            let outputs = |subsystem: usize| &outputs[subsystem][..];
            self.at_look.assemble_residuals(layout, outputs, point);
            if columns.is_some() {
                self.at_look.set_units(&self.units[look]);
                self.at_look
                    .assemble_responses(layout, outputs, &self.columns, point);
            }
            self.add(
                (look, inside.kind(look)),
                &inside.moments,
                columns.is_some(),
            );
        }
    }

    /// Writes what `columns` say about one look to the places of the coupling outputs.
    fn spread_columns(&mut self, layout: &Layout, look: usize, columns: &[Column]) {
        for (subsystem, outputs) in self.outputs.iter().enumerate() {
            let own = self.at_look.columns_of(layout, subsystem);
            let places = columns[own.clone()].iter().zip(&mut self.columns[own]);
            for (column, spread) in places {
                let Some(inside) = column.derivatives.get(outputs.len()..) else {
                    spread.derivatives.clear();
                    continue;
                };
                spread.derivatives.resize(outputs.len(), 0.0);
                layout
                    .inside
                    .spread(subsystem, look, inside, &mut spread.derivatives);
            }
        }
    }

    /// Adds the conditions at a look, of those that are served by looks of its kind.
    fn add(
        &mut self,
        (look, kind): (usize, MomentsFrom),
        served_by: &[MomentsFrom],
        with_jacobians: bool,
    ) {
        let Self {
            weights,
            at_look,
            is_signal,
            ..
        } = self;
        let weight = |moment: usize, row: usize| {
            let weights = match is_signal[row] {
                true => &weights.of_signals,
                false => &weights.of_motion,
            };
            let own = weights.get(moment).filter(|_| served_by[row] == kind);
            own.map(|weights| weights[look])
        };
        for (moment, residuals) in self.residuals.iter_mut().enumerate() {
            let values = at_look.residual(Level::Position).iter().enumerate();
            for (sum, (row, value)) in residuals.iter_mut().zip(values) {
                if let Some(weight) = weight(moment, row) {
                    *sum += weight * value;
                }
            }
        }
        if !with_jacobians {
            return;
        }
        let rows = at_look.pattern().rows();
        for (moment, jacobian) in self.jacobians.iter_mut().enumerate() {
            let values = at_look.jacobian(Level::Position).iter().zip(rows);
            for (sum, (value, &row)) in jacobian.iter_mut().zip(values) {
                if let Some(weight) = weight(moment, row) {
                    *sum += weight * value;
                }
            }
        }
    }
}
