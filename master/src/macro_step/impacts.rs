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

use nalgebra::DMatrix;

use crate::joint::Level;
use crate::layout::Layout;
use crate::signal::Curves;
use crate::system::unknowns::Unknowns;
use crate::system::{Column, LookAhead, Point, System};
use crate::workers::Workers;

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
    pub groups: Vec<Colliding>,
    /// The conditions on velocity level without the responses of finders.
    system: System,
    columns: Vec<Column>,
    /// `B`.
    influence: DMatrix<f64>,
}

/// How the joints of a finder give way.
pub struct Mobility {
    /// `Y`.
    pub own: DMatrix<f64>,
    /// What an impulse at each of the finder's conditions makes of the impulses at the others.
    pub others: DMatrix<f64>,
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
    pub fn struck(&self, workers: &Workers) -> Vec<Colliding> {
        let found = |group: &&Colliding| !workers.found_impacts(group.finder).is_empty();
        self.groups.iter().filter(found).cloned().collect()
    }

    /// Takes the responses of all but the finders over a step of this length (s).
    pub fn take_influence(
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

    pub fn mobility(&self, group: &Colliding) -> Mobility {
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
