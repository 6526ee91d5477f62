//! Hermite coupling: multipliers that are polynomials of their own on every macro step.
//!
//! On the step from `T_N` to `T_{N+1}` a multiplier is a quadratic polynomial in `s = (t - T_N)/H`. Nothing of it comes from
//! steps before but, in the variant that is continuous, its start value. It has as many unknown values at equidistant
//! nodes as there are conditions ([`Variant`]), for APV
//!
//! ```text
//! lambda(s) = l_0 (1 - s)(1 - 2s) + l_1 4s(1 - s) + l_2 s(2s - 1)
//! g''(T_N) = 0,   g(T_{N+1}) / H^2 = 0,   g'(T_{N+1}) / H = 0
//! ```
//!
//! For free bodies the velocity at the end takes the mean of a load over the step, the position its mean weighted by `1 - s`:
//! `l_1` weighs 2/3 and 1/3, `l_2` 1/6 and 0. What the polynomial misses of the true multiplier,
//! `c H^3 s (s^2 - 6 s/5 + 3/10)`, then has no mean of either kind, so positions and velocities feel it only through
//! stiffness, damping and geometry: one power of `H` for each integration. That is why APV has order 5 where its multipliers,
//! which miss `c H^3/10` at the end, have order 3.
//!
//! Motion that is exchanged is a polynomial through position and velocity at both ends and the acceleration at the start: the
//! end values are unknowns, with the conditions that they are what the partner's outputs say (`arcs`). All conditions are
//! linearised about the prediction with columns of the workers for each shape, and solved together (`stack`).
//!
//! * `variant`: which conditions;
//! * `arcs`: the curves of all variables;
//! * `stack`: the equations of all unknowns.

mod arcs;
mod sample;
mod stack;
mod variant;

use serde::{Deserialize, Serialize};

use super::condition::SingularRow;
use super::method::{Built, Corrected, LoadErrors, Method, Reached};
use super::saved::{Saved, Unreadable};
use crate::accuracy::{Attempts, CHORD_ORDER};
use crate::joint::Level;
use crate::layout::{Exchanged, Layout};
use crate::signal::{Curves, Held, History};
use crate::system::solve::{LinearSolver, SingularColumn};
use crate::system::unknowns::Unknowns;
use crate::system::{Outputs, Point, System};

use arcs::{Arcs, Past, unknowns_of};
use sample::Sample;
use stack::Stack;
pub use variant::Variant;

/// Mean error of exchanged motion over the step, per difference between predicted and corrected end: the curve of degree 4 misses
/// `s^3 (s - 1)^2`, whose mean is 1/60, times a term that falls faster than the difference does.
const MOTION_SHARE: f64 = 1.0 / 60.0;

/// The power of the step with which that difference falls.
const MOTION_ORDER: usize = 4;

/// State of Hermite coupling between two macro steps.
pub struct Hermite {
    variant: Variant,
    arcs: Arcs,
    /// The corrected curves of the last step.
    before: Arcs,
    multipliers: Vec<f64>,
    /// All variables at the start of the step.
    held: Vec<f64>,
    stack: Stack,
    solver: LinearSolver,
    point_solver: Option<LinearSolver>,
    sample: Sample,
    /// The same of the last step.
    settled: Sample,
    accelerations: Vec<f64>,
}

/// What is remembered at a macro point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    past: Past,
    before: Past,
    multipliers: Vec<f64>,
}

impl Hermite {
    /// The method from the first macro point, with these coupling `outputs`, where `history` holds all variables.
    pub fn build(
        variant: Variant,
        history: History,
        layout: &Layout,
        outputs: &dyn Outputs,
    ) -> Built {
        let size = layout.variables();
        let unknowns = unknowns_of(layout, variant);
        let mut arcs = Arcs::new(layout, variant, unknowns.clone(), history);
        start_motion(&mut arcs, layout, outputs);
        let point = variant
            .starts_anew()
            .then(|| System::new(layout, Unknowns::ends(layout)));
        let sample = Sample::new(&unknowns, size);
        let settled = Sample::new(&unknowns, size);
        let end = System::new(layout, unknowns);
        let stack = Stack::new(layout, variant, &end, point.as_ref());
        let mut method = Self {
            variant,
            multipliers: vec![0.0; layout.rows.len()],
            before: arcs.clone(),
            held: vec![0.0; size],
            arcs,
            solver: LinearSolver::new(stack.pattern()),
            point_solver: point
                .as_ref()
                .map(|system| LinearSolver::new(system.pattern())),
            stack,
            sample,
            settled,
            accelerations: vec![0.0; size],
        };
        method.read_starts();
        Built {
            method: Box::new(method),
            end: Some((end, levels_of(variant, layout))),
            point: point.map(|system| (system, &[Level::Acceleration][..])),
        }
    }

    fn read_starts(&mut self) {
        for (held, start) in self.held.iter_mut().zip(self.arcs.starts()) {
            *held = start;
        }
        for (multiplier, start) in self.multipliers.iter_mut().zip(self.arcs.starts()) {
            *multiplier = start;
        }
    }

    /// The second derivatives of exchanged motion at the end of the step: linearised outputs.
    fn foresee_accelerations(&mut self, solution: &[f64], end: &System) {
        if self.variant.level() < Level::Acceleration {
            return;
        }
        let step = self.arcs.length();
        let accelerations = &mut self.accelerations;
        end.shift(Level::Acceleration, solution, accelerations);
        let residual = end.residual(Level::Acceleration);
        for (acceleration, residual) in accelerations.iter_mut().zip(residual) {
            *acceleration = -(residual + *acceleration) / (step * step);
        }
    }
}

impl Method for Hermite {
    fn predict(&mut self, length: f64) {
        self.arcs.predict(length);
        self.sample.take(&self.arcs);
    }

    fn lend(&self, to: &mut dyn FnMut(&dyn Curves, &dyn Curves)) {
        to(&self.arcs, &self.arcs);
    }

    fn ends(&self) -> &[f64] {
        self.sample.ends()
    }

    fn accept(&mut self) {
        self.before.copy_from(&self.arcs);
        self.settled.take(&self.before);
        self.arcs.move_on(self.sample.ends(), &self.accelerations);
        self.read_starts();
    }

    /// The multipliers with which `g'' = 0` at the present macro point: the end values of the step before are as good as the
    /// polynomial is, these as good as the motion. Where nothing determines them the end values stay.
    fn reached(&mut self, reached: Reached<'_>) -> Result<(), SingularRow> {
        let (Some(system), Some(solver)) = (reached.point, &mut self.point_solver) else {
            return Ok(());
        };
        let (pattern, jacobian, change) = system.level_equation(Level::Acceleration);
        if solver.solve(pattern, jacobian, change).is_ok() {
            for (multiplier, change) in self.multipliers.iter_mut().zip(change) {
                *multiplier += *change;
            }
        }
        Ok(())
    }

    fn multipliers(&self) -> &[f64] {
        &self.multipliers
    }

    fn multipliers_at(
        &self,
        tau: f64,
        _layout: &Layout,
        _outputs: &dyn Outputs,
        multipliers: &mut [f64],
    ) {
        for (row, multiplier) in multipliers.iter_mut().enumerate() {
            *multiplier = self.before.value(row, tau);
        }
    }

    fn state(&self) -> Saved {
        Saved::of(&State {
            past: self.arcs.past(),
            before: self.before.past(),
            multipliers: self.multipliers.clone(),
        })
    }

    fn resume(&mut self, state: &Saved) -> Result<(), Unreadable> {
        let state: State = state.read()?;
        self.arcs.resume(state.past);
        self.before.resume(state.before);
        self.settled.take(&self.before);
        self.read_starts();
        self.multipliers = state.multipliers;
        Ok(())
    }

    fn held(&self) -> Option<Held<'_>> {
        self.variant.starts_anew().then(|| Held {
            values: &self.held,
            attitudes: self.arcs.attitudes(),
        })
    }

    fn corrected(&mut self) -> Option<&mut dyn Corrected> {
        Some(self)
    }
}

impl Corrected for Hermite {
    fn point(&self) -> Point<'_> {
        self.sample.point(self.arcs.length(), self.arcs.attitudes())
    }

    fn has_past(&self) -> bool {
        self.arcs.has_past()
    }

    fn solve(
        &mut self,
        end: &mut System,
        start: Option<&System>,
        is_first: bool,
        solution: &mut [f64],
    ) -> Result<(), SingularRow> {
        let step = self.arcs.length();
        self.stack.assemble_jacobian(end, start, step);
        self.stack.assemble_end(end, step);
        if let Some(start) = start.filter(|_| is_first) {
            // The accelerations are linear in the multipliers: the first correction meets these conditions.
            self.stack.assemble_start(start);
        }
        let (pattern, jacobian, change) = self.stack.equation();
        let solved = self.solver.solve(pattern, jacobian, change);
        solved.map_err(|SingularColumn(unknown)| SingularRow {
            row: end.unknowns().variable(unknown),
            level: self.variant.level(),
        })?;
        solution.copy_from_slice(change);
        Ok(())
    }

    fn correct(&mut self, change: &[f64], solution: &[f64], end: &System) {
        self.arcs.change(change);
        self.sample.take(&self.arcs);
        self.foresee_accelerations(solution, end);
    }

    fn load_errors(
        &self,
        unknowns: &Unknowns,
        rows: usize,
        change: &[f64],
        _degree: Option<usize>,
        errors: &mut [f64],
    ) -> LoadErrors {
        let mut found = LoadErrors {
            shares: self.arcs.load_error(),
            change: 0.0,
        };
        let loads = (0..rows).map(|row| unknowns.of(row).end).max().unwrap_or(0);
        for (error, change) in errors[..loads].iter_mut().zip(change) {
            *error = found.shares.position * change;
            found.change = found.change.max(change.abs());
        }
        found
    }

    fn exchanged_error(
        &self,
        exchanged: &Exchanged,
        variable: usize,
        (unknowns, change): (&Unknowns, &[f64]),
        _degree: Option<usize>,
        attempts: &Attempts,
    ) -> (f64, usize) {
        let change = change[unknowns.of(variable).start];
        if exchanged.rates.is_some() {
            return (MOTION_SHARE * change, MOTION_ORDER);
        }
        let start = self.arcs.chord_start(variable);
        match start.and_then(|start| attempts.chord_error(variable, start)) {
            Some(error) => (error, CHORD_ORDER),
            None => {
                let shares = self.arcs.signal_error(variable, self.arcs.length());
                (shares.mean * change, shares.order)
            }
        }
    }

    fn remaining(&mut self, end: &mut System, remaining: &mut [f64]) {
        self.stack.assemble_end(end, self.before.length());
        let rhs = self.stack.rhs();
        self.solver.solve_again(rhs);
        remaining.copy_from_slice(rhs);
    }

    fn corrected_point(&self) -> Point<'_> {
        self.settled
            .point(self.before.length(), self.before.attitudes())
    }
}

/// The levels of the outputs that the conditions at `T_{N+1}` and exchanged motion are made of.
fn levels_of(variant: Variant, layout: &Layout) -> &'static [Level] {
    match layout.exchanged.iter().any(|one| one.rates.is_some()) {
        true => variant.level().up_to(),
        false => variant.ends(),
    }
}

/// Gives exchanged motion the rates that the outputs at the first macro point tell.
fn start_motion(arcs: &mut Arcs, layout: &Layout, outputs: &dyn Outputs) {
    for exchanged in &layout.exchanged {
        let Some(rates) = &exchanged.rates else {
            continue;
        };
        let outputs = outputs.of(exchanged.subsystem);
        let speed = rates.speed(outputs, &Default::default());
        let acceleration = rates.acceleration(outputs);
        for component in 0..exchanged.size() {
            let variable = exchanged.first + component;
            arcs.set_rates(variable, speed[component], acceleration[component]);
        }
    }
}
