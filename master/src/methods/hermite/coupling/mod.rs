//! Hermite coupling in a macro step.

mod corrected;

use serde::{Deserialize, Serialize};

use crate::joint::Level;
use crate::layout::Layout;
use crate::methods::condition::SingularRow;
use crate::methods::method::{Built, Corrected, CouplingMethod, Reached};
use crate::methods::saved::{Saved, Unreadable};
use crate::signal::{Curves, Held, History};
use crate::system::solve::LinearSolver;
use crate::system::unknowns::Unknowns;
use crate::system::{Moments, Outputs, System};

use crate::methods::hermite::curves::{HermiteCurves, Past};
use crate::methods::hermite::moments::Rule;
use crate::methods::hermite::reduced::Relaxed;
use crate::methods::hermite::sample::Sample;
use crate::methods::hermite::shapes::Shapes;
use crate::methods::hermite::stack::Stack;
use crate::methods::hermite::variant::{ENDS, Family};

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

    fn read_starts(&mut self) {
        for (held, start) in self.held.iter_mut().zip(self.curves.starts()) {
            *held = start;
        }
        for (multiplier, start) in self.multipliers.iter_mut().zip(self.curves.starts()) {
            *multiplier = start;
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
