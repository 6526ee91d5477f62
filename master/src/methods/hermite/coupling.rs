//! Hermite coupling in a macro step.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::accuracy::{Attempts, CHORD_ORDER};
use crate::joint::Level;
use crate::layout::{Exchanged, Layout};
use crate::methods::condition::SingularRow;
use crate::methods::method::{Built, Corrected, CouplingMethod, LoadErrors, Reached};
use crate::methods::saved::{Saved, Unreadable};
use crate::signal::{Curves, Held, History};
use crate::system::solve::{LinearSolver, SingularColumn};
use crate::system::unknowns::Unknowns;
use crate::system::{Moments, Outputs, Point, System};

use super::curves::{HermiteCurves, Past};
use super::moments::Rule;
use super::reduced::{Relaxed, top_share};
use super::sample::Sample;
use super::shapes::Shapes;
use super::stack::Stack;
use super::variant::{ENDS, Family, LEAST_DEGREE};

/// Mean error of exchanged motion over the step, per difference between predicted and corrected end: the curve of degree 4 misses
/// `s^3 (s - 1)^2`, whose mean is 1/60, times a term that falls faster than the difference does.
const MOTION_SHARE: f64 = 1.0 / 60.0;

/// The power of the step with which that difference falls.
const MOTION_ORDER: usize = 4;

/// The degree of the first step, where the degree follows the errors.
const FIRST_DEGREE: usize = LEAST_DEGREE + 1;

/// Whose states are written.
const NAME: &str = "hermite";

/// State of Hermite coupling between two macro steps.
pub struct HermiteCoupling {
    family: Family,
    has_limiter: bool,
    curves: HermiteCurves,
    /// The corrected curves of the last step.
    before: HermiteCurves,
    multipliers: Vec<f64>,
    /// All variables at the start of the step.
    held: Vec<f64>,
    stack: Stack,
    solver: LinearSolver,
    /// For equations of fewer degrees.
    nested_solver: LinearSolver,
    point_solver: Option<LinearSolver>,
    /// Degree of the multipliers' polynomials over the present step.
    degree: usize,
    /// The same of the last step.
    last_degree: usize,
    /// The top conditions of the step that are relaxed.
    relaxed: Vec<Relaxed>,
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
    degree: usize,
    last_degree: usize,
}

impl HermiteCoupling {
    /// The method from the first macro point, with these coupling `outputs`, where `history` holds all variables.
    pub fn build(
        (family, rule, has_limiter): (Family, &Rule, bool),
        history: History,
        layout: &Layout,
        outputs: &dyn Outputs,
    ) -> Built {
        let size = layout.variables();
        let shapes = Shapes::new(family);
        let unknowns = shapes.unknowns_of(layout);
        let mut curves = HermiteCurves::new(layout, shapes.clone(), unknowns.clone(), history);
        start_motion(&mut curves, layout, outputs);
        let point = family
            .variant
            .starts_anew()
            .then(|| System::new(layout, Unknowns::ends(layout)));
        let looks: Vec<_> = rule.looks().collect();
        let sample = Sample::new(&unknowns, &looks, size);
        let settled = Sample::new(&unknowns, &looks, size);
        let mut end = System::new(layout, unknowns.clone());
        if !looks.is_empty() {
            let shown = looks.iter().map(|look| look.of(|share| shapes.at(layout, share)));
            let weights = rule.weights(family);
            end = end.with_moments(Moments::new(layout, unknowns, weights, shown.collect()));
        }
        let stack = Stack::new(layout, family, &end, point.as_ref());
        let mut method = Self {
            family,
            has_limiter,
            multipliers: vec![0.0; layout.rows.len()],
            before: curves.clone(),
            held: vec![0.0; size],
            curves,
            solver: stack.solver(&end),
            nested_solver: stack.solver(&end),
            degree: family.degree,
            last_degree: family.degree,
            relaxed: Vec::new(),
            point_solver: point.as_ref().map(System::solver),
            stack,
            sample,
            settled,
            accelerations: vec![0.0; size],
        };
        method.read_starts();
        Built {
            method: Box::new(method),
            end: Some((end, levels_of(family, layout))),
            point: point.map(|system| (system, &[Level::Acceleration][..])),
        }
    }

    /// Puts the equations of the step together for multipliers of this degree: conditions at its end and inside it, columns at its start, and
    /// what is missed there.
    fn assemble(&mut self, end: &System, [start, missed]: [Option<&System>; 2], degree: usize) {
        let step = self.curves.length();
        self.stack.assemble_jacobian(end, start, step);
        self.stack.assemble_end(end, step);
        if let Some(missed) = missed {
            self.stack.assemble_start(missed);
        }
        self.stack.reduce(degree, &self.curves);
    }

    fn solve_stack(&mut self, end: &System, solution: &mut [f64]) -> Result<(), SingularRow> {
        let (pattern, jacobian, change) = self.stack.equation();
        let solved = self.solver.solve(pattern, jacobian, change);
        solved.map_err(|SingularColumn(unknown)| SingularRow {
            row: end.unknowns().variable(unknown),
            level: self.family.variant.level(),
        })?;
        solution.copy_from_slice(change);
        Ok(())
    }

    fn read_starts(&mut self) {
        for (held, start) in self.held.iter_mut().zip(self.curves.starts()) {
            *held = start;
        }
        for (multiplier, start) in self.multipliers.iter_mut().zip(self.curves.starts()) {
            *multiplier = start;
        }
    }

    /// The second derivatives of exchanged motion at the end of the step: linearised outputs.
    fn foresee_accelerations(&mut self, solution: &[f64], end: &System) {
        if self.family.variant.level() < Level::Acceleration {
            return;
        }
        let step = self.curves.length();
        let accelerations = &mut self.accelerations;
        end.shift(Level::Acceleration, solution, accelerations);
        let residual = end.residual(Level::Acceleration);
        for (acceleration, residual) in accelerations.iter_mut().zip(residual) {
            *acceleration = -(residual + *acceleration) / (step * step);
        }
    }
}

impl CouplingMethod for HermiteCoupling {
    fn predict(&mut self, length: f64) {
        self.curves.predict(length);
        self.sample.take(&self.curves);
    }

    fn lend(&self, to: &mut dyn FnMut(&dyn Curves, &dyn Curves)) {
        to(&self.curves, &self.curves);
    }

    fn ends(&self) -> &[f64] {
        self.sample.ends()
    }

    fn accept(&mut self) {
        self.last_degree = self.degree;
        self.before.copy_from(&self.curves);
        self.settled.take(&self.before);
        self.curves.move_on(self.sample.ends(), &self.accelerations);
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
        Saved::new(NAME, &State {
            past: self.curves.past(),
            before: self.before.past(),
            multipliers: self.multipliers.clone(),
            degree: self.degree,
            last_degree: self.last_degree,
        })
    }

    fn resume(&mut self, state: &Saved) -> Result<(), Unreadable> {
        let state: State = state.read(NAME)?;
        self.curves.resume(state.past);
        self.before.resume(state.before);
        self.settled.take(&self.before);
        self.read_starts();
        self.multipliers = state.multipliers;
        (self.degree, self.last_degree) = (state.degree, state.last_degree);
        self.curves.set_degree(self.degree);
        Ok(())
    }

    fn held(&self) -> Option<Held<'_>> {
        self.family.variant.starts_anew().then(|| Held {
            values: &self.held,
            attitudes: self.curves.attitudes(),
        })
    }

    fn corrected(&mut self) -> Option<&mut dyn Corrected> {
        Some(self)
    }
}

impl Corrected for HermiteCoupling {
    fn point(&self) -> Point<'_> {
        self.sample.point(self.curves.length(), self.curves.attitudes())
    }

    fn has_past(&self) -> bool {
        self.curves.has_past()
    }

    fn solve(
        &mut self,
        end: &mut System,
        start: Option<&System>,
        is_first: bool,
        solution: &mut [f64],
    ) -> Result<(), SingularRow> {
        // The accelerations are linear in the multipliers: the first correction meets the conditions at the start.
        let missed = start.filter(|_| is_first);
        let degree = self.degree;
        self.assemble(end, [start, missed], degree);
        if !self.family.variant.starts_anew() {
            self.stack
                .find_relaxed(degree, &self.curves, None, &mut self.relaxed);
        } else if is_first {
            self.relaxed.clear();
        }
        self.stack.relax(&self.relaxed, &self.curves);
        self.solve_stack(end, solution)?;
        if is_first && self.has_limiter && self.family.variant.starts_anew() {
            let solved = Some(&*solution);
            self.stack
                .find_relaxed(degree, &self.curves, solved, &mut self.relaxed);
            if !self.relaxed.is_empty() {
                self.assemble(end, [start, missed], degree);
                self.stack.relax(&self.relaxed, &self.curves);
                self.solve_stack(end, solution)?;
            }
        }
        Ok(())
    }

    fn nested(
        &mut self,
        end: &System,
        start: Option<&System>,
        fewer: usize,
        change: &mut [f64],
    ) -> bool {
        let Some(degree) = self.degree.checked_sub(fewer) else {
            return false;
        };
        self.assemble(end, [start, start], degree);
        let (pattern, jacobian, own) = self.stack.equation();
        let solved = self.nested_solver.solve(pattern, jacobian, own);
        change.copy_from_slice(own);
        solved.is_ok()
    }

    fn expect_rate(&mut self, rate: Option<f64>) {
        self.curves.expect_rate(rate);
    }

    fn tells_error(&self) -> bool {
        true
    }

    fn degree(&self) -> usize {
        self.degree
    }

    /// Of the degrees whose errors moments tell the one with the fewest columns: a first step is short.
    fn first_degree(&self) -> Option<usize> {
        Some(FIRST_DEGREE.min(self.family.degree))
    }

    fn lowest_degree(&self) -> usize {
        LEAST_DEGREE
    }

    fn top_share(&self) -> f64 {
        top_share(self.degree, &self.curves)
    }

    fn is_limited(&self) -> bool {
        self.relaxed.iter().any(|one| one.is_heard)
    }

    fn restart_exchanged(&mut self) {
        self.curves.restart_exchanged();
    }

    fn set_degree(&mut self, variables: Range<usize>, degree: usize) {
        if variables.start == 0 {
            self.degree = degree.clamp(LEAST_DEGREE, self.family.degree);
            self.curves.set_degree(self.degree);
        }
    }

    fn degree_of_last_step(&self, _variable: usize) -> usize {
        self.last_degree
    }

    fn correct(&mut self, change: &[f64], solution: &[f64], end: &System) {
        self.curves.change(change);
        self.sample.take(&self.curves);
        self.foresee_accelerations(solution, end);
    }

    fn least_pivot(&self) -> f64 {
        self.solver.least_pivot()
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
            shares: self.curves.load_error(),
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
        let unknowns = unknowns.of(variable);
        let change = change[unknowns.start];
        // The solutions with fewer degrees tell the errors of curves with moments, but for what curves make of a signal inside the step.
        if exchanged.rates.is_none() && unknowns.len() > 1 {
            return (self.curves.signal_effect(variable), 2 * self.degree + 1);
        }
        if unknowns.len() > 2 {
            return (0.0, 2 * self.degree + 2);
        }
        if exchanged.rates.is_some() {
            return (MOTION_SHARE * change, MOTION_ORDER);
        }
        let start = self.curves.chord_start(variable);
        match start.and_then(|start| attempts.chord_error(variable, start)) {
            Some(error) => (error, CHORD_ORDER),
            None => {
                let shares = self.curves.signal_error(variable, self.curves.length());
                (shares.mean * change, shares.order)
            }
        }
    }

    fn remaining(&mut self, end: &mut System, remaining: &mut [f64]) {
        self.stack.assemble_end(end, self.before.length());
        self.stack.meet_reduced(self.last_degree, &self.before);
        self.stack.relax_residual(&self.relaxed, &self.before);
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
fn levels_of(family: Family, layout: &Layout) -> &'static [Level] {
    match layout.exchanged.iter().any(|one| one.rates.is_some()) {
        true => family.variant.level().up_to(),
        false => &ENDS,
    }
}

/// Gives exchanged motion the rates that the outputs at the first macro point tell.
fn start_motion(curves: &mut HermiteCurves, layout: &Layout, outputs: &dyn Outputs) {
    for exchanged in &layout.exchanged {
        let Some(rates) = &exchanged.rates else {
            continue;
        };
        let outputs = outputs.of(exchanged.subsystem);
        let speed = rates.speed(outputs, &Default::default());
        let acceleration = rates.acceleration(outputs);
        for component in 0..exchanged.size() {
            let variable = exchanged.first + component;
            curves.set_rates(variable, speed[component], acceleration[component]);
        }
    }
}
