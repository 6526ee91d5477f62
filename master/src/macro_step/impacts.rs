//! Impacts within a macro step: the impulses that go through the joints.
//!
//! A worker finds an impact as if it were alone, and only then its partners come into play, in two more exchanges over the same step:
//!
//! 1. it looks ahead with its [`Interface`](linchpin_proto::v1::Interface), that is, the mobility of its partners at its joints, and finds
//!    the impulses of their multipliers;
//! 2. the partners look ahead with these impulses, and with those that they cause at the joints between them.
//!
//! The correction that follows, and the advance, keep instants, contacts and impulses: momentum goes from one to the other without
//! loss, and what the impulses are off by is corrected by the loads of the step.
//!
//! The mobility comes from columns that are there: what loads, constant or not, make of the velocities at the end of the step, over their
//! integrals. With the conditions of a finder's own joints `c`, those of the other joints of its group `o` and the responses of all
//! but the finder,
//!
//! ```text
//! B = dg'/dP,   Y = S (B_cc - B_co B_oo^-1 B_oc),   P_o = -B_oo^-1 B_oc P_c
//! ```
//!
//! with the signs `S` for which `Y` is positive.

use linchpin_proto::v1;
use nalgebra::{DMatrix, DVector};

use super::correcting::Correcting;
use crate::error::RunError;
use crate::joint::Level;
use crate::layout::{DrivenInput, Layout};
use crate::policies::degree::AutomaticDegrees;
use crate::policies::iteration::IterationControl;
use crate::signal::Curves;
use crate::system::unknowns::Unknowns;
use crate::system::{Column, LookAhead, Point, System};
use crate::time::MacroStep;
use crate::workers::{Ahead, Workers};

/// Singular values below this share of the largest belong to conditions that follow from others.
const RANK: f64 = 1e-10;

/// A subsystem that finds impacts, and all that are joined to it, directly or by others.
#[derive(Debug, Clone, PartialEq)]
pub struct Colliding {
    /// The subsystem that finds impacts.
    pub finder: usize,
    /// The others.
    pub partners: Vec<usize>,
    /// Conditions of the joints at the finder.
    pub own: Vec<usize>,
    /// Conditions of the joints between others.
    pub others: Vec<usize>,
}

/// What couples impacts.
pub struct Impacts {
    groups: Vec<Colliding>,
    /// The conditions on velocity level without the responses of finders.
    system: System,
    columns: Vec<Column>,
    /// `B`.
    influence: DMatrix<f64>,
}

/// How the joints of a finder give way.
struct Mobility {
    /// `Y`.
    own: DMatrix<f64>,
    /// What an impulse at each of the finder's conditions makes of the impulses at the others.
    others: DMatrix<f64>,
}

impl Impacts {
    /// For these groups, with the unknowns of a method.
    pub fn new(groups: Vec<Colliding>, layout: &Layout, unknowns: &Unknowns) -> Self {
        let rows = layout.rows.len();
        Self {
            groups,
            system: System::new(layout, unknowns.clone()),
            columns: Vec::new(),
            influence: DMatrix::zeros(rows, rows),
        }
    }

    /// The groups whose finders have found impacts in the last look-ahead.
    fn struck(&self, workers: &Workers) -> Vec<Colliding> {
        let found = |group: &&Colliding| !workers.found_impacts(group.finder).is_empty();
        self.groups.iter().filter(found).cloned().collect()
    }

    /// Takes the responses of all but the finders over a step of this length (s).
    fn take_influence(
        &mut self,
        layout: &Layout,
        (ahead, columns): (&dyn LookAhead, &[Column]),
        point: Point<'_>,
        raised: &dyn Curves,
    ) {
        self.columns.clear();
        self.columns.extend_from_slice(columns);
        for group in &self.groups {
            for column in self.system.columns_of(layout, group.finder) {
                self.columns[column].derivatives.fill(0.0);
            }
        }
        let outputs = |subsystem: usize| ahead.of(subsystem);
        self.system.assemble(layout, outputs, &self.columns, point);
        let unknowns = self.system.unknowns();
        let pattern = self.system.pattern();
        let jacobian = self.system.jacobian(Level::Velocity);
        let rows = layout.rows.len();
        self.influence.fill(0.0);
        for multiplier in 0..rows {
            let (unknown, integral) = largest_impulse(unknowns, multiplier, raised);
            for entry in pattern.entries_of(unknown) {
                let row = pattern.rows()[entry];
                if row < rows {
                    self.influence[(row, multiplier)] = jacobian[entry] / integral;
                }
            }
        }
    }

    fn mobility(&self, group: &Colliding) -> Mobility {
        let Colliding { own, others, .. } = group;
        let part = |rows: &[usize], columns: &[usize]| {
            DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
                self.influence[(rows[i], columns[j])]
            })
        };
        let mut mobility = part(own, own);
        let mut answer = DMatrix::zeros(others.len(), own.len());
        if !others.is_empty() {
            let inner = part(others, others).svd(true, true);
            let least = RANK * inner.singular_values.max();
            // Both factors were asked for.
            answer = -inner.solve(&part(others, own), least).unwrap_or(answer);
            mobility += part(own, others) * &answer;
        }
        for (row, mut entries) in mobility.row_iter_mut().enumerate() {
            if entries[row] < 0.0 {
                entries.neg_mut();
            }
        }
        // Columns of different instants are off by different shares.
        let symmetric = 0.5 * (&mobility + mobility.transpose());
        Mobility {
            own: symmetric,
            others: answer,
        }
    }
}

/// The unknown of a multiplier whose shape has the largest integral over the step, and that integral (s).
fn largest_impulse(unknowns: &Unknowns, multiplier: usize, raised: &dyn Curves) -> (usize, f64) {
    let mut largest = (unknowns.of(multiplier).start, 0.0_f64);
    for (shape, unknown) in unknowns.of(multiplier).enumerate() {
        let integral = raised.shape(multiplier, shape).integrated().value(1.0);
        if integral.abs() > largest.1.abs() {
            largest = (unknown, integral);
        }
    }
    (largest.0, largest.1 * raised.length())
}

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
