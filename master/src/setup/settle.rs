//! Multipliers and connected signals that meet their conditions at the first macro point.

use super::initial::{InitialState, evaluate_all, refuse_start};
use super::signal_loop::SignalBlock;
use super::{redundancy, responses};
use crate::error::RunError;
use crate::joint::Level;
use crate::layout::{Border, Coupled, Layout};
use crate::scene::{Connection, Scene};
use crate::system::solve::{LinearSolver, SingularColumn};
use crate::system::unknowns::Unknowns;
use crate::system::{Point, System};
use crate::workers::Workers;

/// Connected signals that change by less than this share of their size are settled.
const SETTLED: f64 = 1e-12;

/// A change by less than this share is taken whole: residuals are rounding.
const NEAR: f64 = 1e-6;

/// Most passes until connected signals have to be settled.
const MOST_PASSES: usize = 50;

/// How often the change of a pass is halved before the search ends.
const MOST_HALVINGS: i32 = 30;

/// Whether multipliers are solved for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Multipliers {
    Held,
    Free,
}

/// Newton's method for `w - y(w) = 0` and, where multipliers are free, `g'' = 0`; one pass is enough unless signals are connected.
///
/// The change of a pass is halved while a worker refuses the changed signals or their residuals hardly fall. Where the search from what
/// the outputs showed first comes to nothing it begins again at the start values.
pub(super) fn settle(
    (scene, coupled): (&Scene, &Coupled<'_>),
    layout: &Layout,
    workers: &Workers,
    state: &mut InitialState,
    multipliers: Multipliers,
) -> Result<(), RunError> {
    let shown = state.clone();
    let mut search = Search::new((scene, coupled), layout, workers, multipliers);
    let found = search.run(state);
    let mut begin = shown.clone();
    for (connection, signal) in coupled.connections.iter().zip(&search.signals) {
        begin.variables[*signal] = connection.start.unwrap_or(0.0);
    }
    if found.is_ok() || begin == shown {
        return found;
    }
    *state = begin;
    search.sizes.fill(0.0);
    search.run(state)
}

/// Without a search: what loads do at the start, and which conditions follow from others, where the scene gives the multipliers.
pub(super) fn look(
    (scene, coupled): (&Scene, &Coupled<'_>),
    layout: &Layout,
    workers: &Workers,
    state: &mut InitialState,
) -> Result<(), RunError> {
    let search = Search::new((scene, coupled), layout, workers, Multipliers::Held);
    let mut system = System::new(layout, Unknowns::ends(layout));
    let outputs = search.evaluate(state)?;
    search.linearise(state, &outputs, &mut system)?;
    state.border = border_of(layout, &mut system);
    Ok(())
}

fn border_of(layout: &Layout, system: &mut System) -> Border {
    let (pattern, values, _) = system.level_equation(Level::Acceleration);
    redundancy::find(layout, pattern, values)
}

/// The search for the variables.
struct Search<'a> {
    scene: &'a Scene,
    layout: &'a Layout,
    workers: &'a Workers,
    multipliers: Multipliers,
    /// The variables of the connections.
    signals: Vec<usize>,
    /// How large each variable has been.
    sizes: Vec<f64>,
}

impl<'a> Search<'a> {
    fn new(
        (scene, coupled): (&'a Scene, &Coupled<'_>),
        layout: &'a Layout,
        workers: &'a Workers,
        multipliers: Multipliers,
    ) -> Self {
        let connections = coupled.connections.iter();
        Self {
            scene,
            layout,
            workers,
            multipliers,
            signals: connections.map(|one| layout.variable_of(one)).collect(),
            sizes: vec![0.0; layout.variables()],
        }
    }

    fn run(&mut self, state: &mut InitialState) -> Result<(), RunError> {
        let (scene, layout) = (self.scene, self.layout);
        let mut system = System::new(layout, Unknowns::ends(layout));
        let mut solver = None;
        let mut outputs = self.evaluate(state)?;
        let mut unsettled = 0;
        for _ in 0..MOST_PASSES {
            self.linearise(state, &outputs, &mut system)?;
            let change = match self.multipliers {
                Multipliers::Held => change_of_signals(scene, layout, &mut system)?,
                Multipliers::Free => {
                    let solver = solver.get_or_insert_with(|| {
                        state.border = border_of(layout, &mut system);
                        let unknowns: Vec<_> =
                            (0..layout.rows.len()).map(|row| row..row + 1).collect();
                        LinearSolver::bordered(system.pattern(), &state.border, &unknowns)
                    });
                    change_of_all(scene, layout, &mut system, solver)?
                }
            };
            let (largest, variable) = self.share(state, &change);
            unsettled = variable;
            if scene.connections.is_empty() || largest <= SETTLED {
                add(&mut state.variables, 1.0, &change);
                return Ok(());
            }
            outputs = self.go(state, &outputs, &change, largest <= NEAR)?;
        }
        Err(refuse_search(scene, layout, unsettled))
    }

    fn evaluate(&self, state: &InitialState) -> Result<Vec<Vec<f64>>, RunError> {
        evaluate_all(self.layout, self.workers, self.scene.t_start, state)
            .map_err(|error| refuse_start(self.scene, error))
    }

    fn linearise(
        &self,
        state: &mut InitialState,
        outputs: &[Vec<f64>],
        system: &mut System,
    ) -> Result<(), RunError> {
        let (layout, t) = (self.layout, self.scene.t_start);
        let columns = responses::columns(t, layout, self.workers, state, outputs)
            .map_err(|error| refuse_start(self.scene, error))?;
        if layout.level == Level::Acceleration {
            state.responses = responses::of_accelerations(layout, outputs, &columns);
        }
        let used = |number: &usize| !system.unknowns().columns(*number).is_empty();
        let numbers = (0..layout.inputs.len()).filter(used);
        let columns: Vec<_> = numbers.map(|number| columns[number].clone()).collect();
        let point = Point::ends(&state.variables, &state.attitudes);
        system.assemble(layout, |subsystem| &outputs[subsystem], &columns, point);
        Ok(())
    }

    /// The largest change as a share of how large its variable has been, and the variable.
    fn share(&mut self, state: &InitialState, change: &[f64]) -> (f64, usize) {
        let mut largest = (0.0, 0);
        for (variable, change) in change.iter().enumerate() {
            let value = state.variables[variable];
            let size = &mut self.sizes[variable];
            *size = size.max(value.abs()).max((value + change).abs());
            let share = change.abs() / *size;
            if share > largest.0 {
                largest = (share, variable);
            }
        }
        largest
    }

    /// Goes as far along the change as workers follow and the residuals of the signals fall; what the outputs are there.
    fn go(
        &self,
        state: &mut InitialState,
        outputs: &[Vec<f64>],
        change: &[f64],
        is_near: bool,
    ) -> Result<Vec<Vec<f64>>, RunError> {
        let before = self.residual(state, outputs);
        let from = state.variables.clone();
        let mut refusal = None;
        for halvings in 0..=MOST_HALVINGS {
            let part = 0.5_f64.powi(halvings);
            state.variables.copy_from_slice(&from);
            add(&mut state.variables, part, change);
            match self.evaluate(state) {
                Ok(found) if is_near || self.falls(before, self.residual(state, &found), part) => {
                    return Ok(found);
                }
                Ok(_) => refusal = None,
                Err(error @ RunError::SignalsAtStart(_)) => refusal = Some(error),
                Err(error) => return Err(error),
            }
        }
        Err(refusal.unwrap_or_else(|| self.refuse_stuck(state, outputs)))
    }

    /// Newton's direction lets residuals fall by the part that is gone of it; a quarter of that is enough.
    fn falls(&self, before: f64, after: f64, part: f64) -> bool {
        after <= (1.0 - 0.25 * part) * before
    }

    /// The largest `w - y(w)` of a signal as a share of its size, and which.
    fn open(&self, state: &InitialState, outputs: &[Vec<f64>]) -> (f64, usize) {
        let mut largest = (0.0, self.signals.first().copied().unwrap_or_default());
        for exchanged in
            { self.layout.exchanged.iter() }.filter(|one| self.signals.contains(&one.first))
        {
            let (own, first) = (&outputs[exchanged.subsystem], exchanged.first);
            let shown = exchanged.read(own, &state.attitudes, &state.variables).x;
            let open = (state.variables[first] - shown).abs() / self.sizes[first];
            if open > largest.0 {
                largest = (open, first);
            }
        }
        largest
    }

    fn residual(&self, state: &InitialState, outputs: &[Vec<f64>]) -> f64 {
        self.open(state, outputs).0
    }

    fn refuse_stuck(&self, state: &InitialState, outputs: &[Vec<f64>]) -> RunError {
        let (_, variable) = self.open(state, outputs);
        refuse_search(self.scene, self.layout, variable)
    }
}

fn add(variables: &mut [f64], part: f64, change: &[f64]) {
    for (variable, change) in variables.iter_mut().zip(change) {
        *variable += part * change;
    }
}

/// The change of multipliers and exchanged variables that meets `g'' = 0` and `w - y = 0`.
fn change_of_all(
    scene: &Scene,
    layout: &Layout,
    system: &mut System,
    solver: &mut LinearSolver,
) -> Result<Vec<f64>, RunError> {
    check_loops(scene, layout, system)?;
    let (pattern, jacobian, change) = system.level_equation(Level::Acceleration);
    solver
        .solve(pattern, jacobian, change)
        .map_err(|SingularColumn(variable)| refuse_redundant(scene, layout, variable))?;
    Ok(change.to_vec())
}

/// The change of the exchanged variables that meets `w - y = 0` under the present multipliers.
fn change_of_signals(
    scene: &Scene,
    layout: &Layout,
    system: &mut System,
) -> Result<Vec<f64>, RunError> {
    let block = check_loops(scene, layout, system)?;
    let rows = layout.rows.len();
    let solution = block.solution();
    let solution = solution.ok_or_else(|| refuse_loop(scene, layout, rows))?;
    let mut changes = vec![0.0; rows];
    changes.extend(solution.iter());
    Ok(changes)
}

/// Refuses signals that depend on each other without delay with a gain of 1.
fn check_loops(
    scene: &Scene,
    layout: &Layout,
    system: &mut System,
) -> Result<SignalBlock, RunError> {
    let rows = layout.rows.len();
    let (pattern, jacobian, rhs) = system.level_equation(Level::Position);
    let block = SignalBlock::of((pattern, jacobian, rhs), rows);
    let undetermined = match scene.connections.is_empty() {
        true => None,
        false => block.undetermined(),
    };
    match undetermined {
        None => Ok(block),
        Some(variable) => Err(refuse_loop(scene, layout, rows + variable)),
    }
}

fn refuse_redundant(scene: &Scene, layout: &Layout, variable: usize) -> RunError {
    let Some(row) = layout.rows.get(variable) else {
        return refuse_loop(scene, layout, variable);
    };
    let key = format!("joint.{}", scene.joints[row.joint].name);
    let message = format!(
        "nothing determines {} at the start: another joint demands the same already, or no coupled body reacts to its load",
        layout.column_name(variable, "lambda")
    );
    let help = "remove the redundant joint, or check the markers at its ends";
    scene.error(&key, message, Some(help.into())).into()
}

fn refuse_loop(scene: &Scene, layout: &Layout, variable: usize) -> RunError {
    let signal = layout.variable_name(variable);
    let message = format!(
        "\"{signal}\" has no unique value at t = {} s: connected signals depend on each other without delay, and the gain \
         around the loop is 1",
        scene.t_start
    );
    let help = "change a gain, or let one of the connected models have a state between its input and its output";
    let key = key_of(scene, &signal);
    scene.error(&key, message, Some(help.into())).into()
}

fn refuse_search(scene: &Scene, layout: &Layout, variable: usize) -> RunError {
    let signal = layout.variable_name(variable);
    let message = format!(
        "no value of \"{signal}\" was found at t = {} s: connected signals depend on each other without delay, and Newton's method \
         does not converge in {MOST_PASSES} passes",
        scene.t_start
    );
    let help = "give `start`, a value near the solution, in the connections of the loop; it may have no solution";
    let key = key_of(scene, &signal);
    scene.error(&key, message, Some(help.into())).into()
}

/// The key of the connection that a signal belongs to.
fn key_of(scene: &Scene, signal: &str) -> String {
    let of_signal = |connection: &&Connection| {
        let (subsystem, output) = &connection.from;
        signal == format!("{}.{output}", scene.subsystems[*subsystem].name)
    };
    match scene.connections.iter().find(of_signal) {
        Some(connection) => format!("connection.{}", connection.name),
        None => "connection".to_owned(),
    }
}
