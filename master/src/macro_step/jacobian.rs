//! Conditions, linearised by the responses of the workers.

use crate::layout::Layout;
use crate::methods::CouplingMethod;
use crate::policies::columns::{self, Columns};
use crate::results::Cause;
use crate::signal::Held;
use crate::system::{LookAhead, Point, System};
use crate::workers::{Ahead, Look, Workers};

/// The conditions at one instant and the columns of the workers for them.
pub struct Jacobian {
    /// The columns.
    pub columns: Columns,
    /// The conditions.
    pub system: System,
}

impl Jacobian {
    /// Takes the answers to a look-ahead: columns, conditions and their derivatives about a point (S1 eqs. 62 to 67).
    pub fn linearise(&mut self, layout: &Layout, ahead: &dyn LookAhead, point: Point<'_>) {
        self.columns.difference(layout, ahead);
        let outputs = |subsystem: usize| ahead.of(subsystem);
        let columns = self.columns.all();
        self.system.assemble(layout, outputs, columns, point);
        self.system
            .assemble_inside(layout, ahead, Some(columns), point);
    }
}

/// The conditions at the present macro point.
pub struct PointJacobian {
    own: Jacobian,
    /// Whether they are linearised about the present macro point.
    is_known: bool,
    /// Whether new responses are asked for: they are measured as often as those at the end of the step.
    pub is_wanted: bool,
}

impl PointJacobian {
    /// Not known yet.
    pub fn new(own: Jacobian) -> Self {
        Self {
            own,
            is_known: false,
            is_wanted: true,
        }
    }

    /// The conditions, if they are known.
    pub fn system(&self) -> &System {
        &self.own.system
    }

    /// The same, with memory that may be written over.
    pub fn system_mut(&mut self) -> &mut System {
        &mut self.own.system
    }

    /// Columns of earlier macro points, and whether new ones are wanted, to be written.
    pub fn state(&self) -> (columns::State, bool) {
        (self.own.columns.state(), self.is_wanted)
    }

    /// Goes on from what was written.
    pub fn resume(&mut self, (columns, is_wanted): (columns::State, bool)) {
        self.own.columns.resume(columns);
        self.is_wanted = is_wanted;
        self.is_known = false;
    }

    /// Whether an evaluation at the present macro point is missing.
    pub fn is_missing(&self) -> bool {
        self.is_wanted && !self.is_known
    }

    /// Lets the next exchange evaluate the responses at `t`.
    pub fn request(
        &mut self,
        workers: &mut Workers,
        layout: &Layout,
        method: &dyn CouplingMethod,
        t: f64,
    ) {
        let Some(held) = method.held() else { return };
        let perturbed = self.own.columns.ask(layout, &held, held.values, true);
        let look = Look {
            ahead: Ahead::Now,
            t,
            length: 0.0,
            curves: &held,
            raised: &held,
            perturbed,
            cause: Cause::Predictor,
        };
        workers.request_look(layout, look);
    }

    /// Linearises the conditions about the outputs at the present macro point, where the variables are `held`.
    pub fn linearise(&mut self, layout: &Layout, now: &dyn LookAhead, held: Held<'_>) {
        let point = Point::ends(held.values, held.attitudes);
        self.own.linearise(layout, now, point);
        self.is_known = true;
    }

    /// The same unless that is done.
    pub fn linearise_once(&mut self, layout: &Layout, now: &dyn LookAhead, held: Held<'_>) {
        if !self.is_known {
            self.linearise(layout, now, held);
        }
    }

    /// The step is taken: another macro point follows.
    pub fn accept(&mut self) {
        self.own.columns.settle();
        self.is_known = false;
    }
}
