//! Impulses within a macro step: they are found by one worker and given to its partners.

use linchpin_proto::v1;
use nalgebra::DVector;

use super::correcting::Correcting;
use super::impacts::{Colliding, Mobility};
use crate::error::RunError;
use crate::layout::{DrivenInput, Layout};
use crate::policies::degree::AutomaticDegrees;
use crate::policies::iteration::IterationControl;
use crate::system::Point;
use crate::time::MacroStep;
use crate::workers::Ahead;

/// For each driven input of a subsystem the factor of one multiplier in it, and of no other variable.
fn direction(layout: &Layout, subsystem: usize, multiplier: usize, point: Point<'_>) -> Vec<f64> {
    let (mut variables, mut gradient) = (Vec::new(), Vec::new());
    let factor = |input: &DrivenInput| {
        variables.clear();
        gradient.clear();
        input.variables(&mut variables);
        input.gradient(point.w, point.attitudes, &mut gradient);
        let entries = variables.iter().zip(&gradient);
        let own = entries.filter(|(variable, _)| **variable == multiplier);
        own.map(|(_, factor)| factor).sum()
    };
    layout.inputs_of(subsystem).iter().map(factor).collect()
}

/// Impulses of the loads on a subsystem, one for each signal, from those of all multipliers.
fn loads(layout: &Layout, subsystem: usize, impulses: &[f64], point: Point<'_>) -> Vec<f64> {
    let mut loads = vec![0.0; layout.inputs_of(subsystem).len()];
    for (multiplier, impulse) in impulses.iter().enumerate() {
        if *impulse != 0.0 {
            let direction = direction(layout, subsystem, multiplier, point);
            for (load, factor) in loads.iter_mut().zip(direction) {
                *load += impulse * factor;
            }
        }
    }
    loads
}

fn interface(
    layout: &Layout,
    group: &Colliding,
    mobility: &Mobility,
    point: Point<'_>,
) -> v1::Interface {
    let own = group.own.iter();
    let directions = own.flat_map(|&row| direction(layout, group.finder, row, point));
    v1::Interface {
        rows: group.own.len() as u32,
        directions: directions.collect(),
        mobility: mobility.own.iter().copied().collect(),
    }
}

impl Correcting<'_> {
    /// Whether a worker has found an impact in the look-ahead over the step.
    pub fn meets_impacts(&self) -> bool {
        let impacts = self.impacts.as_deref();
        impacts.is_some_and(|impacts| {
            let finders = impacts.groups.iter();
            let mut finders = finders.map(|group| group.finder);
            finders.any(|finder| !self.workers.found_impacts(finder).is_empty())
        })
    }

    /// Lets the partners of those that have found impacts in the look-ahead over `step` take part in them. All columns are new behind it.
    pub fn couple_impacts(
        &mut self,
        step: MacroStep,
        iteration: &mut IterationControl,
        degrees: Option<&mut AutomaticDegrees>,
    ) -> Result<(), RunError> {
        self.linearise();
        let Some(impacts) = self.impacts.as_deref_mut() else {
            return Ok(());
        };
        let ahead = self.workers.looked(Ahead::Step);
        let (layout, point) = (self.layout, self.method.point());
        let columns = self.own.end.columns.all();
        self.method.lend(&mut |_, raised| {
            impacts.take_influence(layout, (&ahead, columns), point, raised);
        });
        let struck = impacts.struck(self.workers);
        let mobilities: Vec<_> = struck.iter().map(|own| impacts.mobility(own)).collect();
        iteration.bring_columns();
        // What jumps has no high derivatives.
        if let Some(degrees) = degrees {
            degrees.restart();
            self.apply(degrees);
            self.predict(step);
        }
        self.request_look_at_impacts(step);

        let all = || struck.iter().zip(&mobilities);
        let point = self.method.point();
        for (group, mobility) in all() {
            let interface = interface(layout, group, mobility, point);
            self.workers.let_find_impacts(group.finder, interface);
        }
        let finders: Vec<_> = struck.iter().map(|group| group.finder).collect();
        self.workers.look_of(&finders, step)?;
        let mut partners = Vec::new();
        for (group, mobility) in all() {
            let impulses = self.impulses(group, mobility, step)?;
            let point = self.method.point();
            let given = |subsystem: usize, has_contacts: bool| {
                let given = impulses.iter().map(|(found, impulses)| v1::Impact {
                    at: found.at,
                    contacts: match has_contacts {
                        true => found.contacts.clone(),
                        false => Vec::new(),
                    },
                    loads: loads(layout, subsystem, impulses, point),
                    multipliers: Vec::new(),
                });
                v1::Impacts {
                    impacts: given.collect(),
                }
            };
            self.workers
                .give_impacts(group.finder, given(group.finder, true));
            for &partner in &group.partners {
                self.workers.give_impacts(partner, given(partner, false));
                partners.push(partner);
            }
        }
        let rest = self.workers.others(&finders);
        tracing::debug!(
            t = step.start,
            H = step.length,
            ?finders,
            ?partners,
            "impacts within the step"
        );
        self.workers.look_of(&rest, step)
    }

    /// The impacts that the finder of a group has found, each with the impulses of all multipliers.
    fn impulses(
        &self,
        group: &Colliding,
        mobility: &Mobility,
        step: MacroStep,
    ) -> Result<Vec<(v1::Impact, Vec<f64>)>, RunError> {
        let found = self.workers.found_impacts(group.finder).iter();
        let spread = |impact: &v1::Impact| {
            let (own, right) = (&impact.multipliers, group.own.len());
            self.workers
                .check_impulses(group.finder, own, right, step)?;
            let others = &mobility.others * DVector::from_column_slice(own);
            let mut impulses = vec![0.0; self.layout.rows.len()];
            for (&row, impulse) in group.own.iter().zip(own) {
                impulses[row] = *impulse;
            }
            for (&row, impulse) in group.others.iter().zip(others.iter()) {
                impulses[row] = *impulse;
            }
            Ok((impact.clone(), impulses))
        };
        found.map(spread).collect()
    }
}
