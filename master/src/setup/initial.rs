//! Consistent coupling variables at the first macro point.

use nalgebra::UnitQuaternion;

use super::consistency;
use super::signal_loop::SignalBlock;
use crate::error::RunError;
use crate::joint::Level;
use crate::layout::{Coupled, Layout, What};
use crate::scene::{Connection, Scene};
use crate::signal::attitude::unit_quaternion;
use crate::system::Column;
use crate::system::solve::{LinearSolver, SingularColumn};
use crate::system::unknowns::Unknowns;
use crate::system::{Point, System};
use crate::workers::Workers;

/// Connected signals that change by less than this share are settled.
const SETTLED: f64 = 1e-12;

/// Most passes until connected signals have to be settled.
const MOST_PASSES: usize = 50;

/// Coupling variables with which the run starts.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct InitialState {
    /// Multipliers, then exchanged variables.
    pub(super) variables: Vec<f64>,
    /// Attitudes to which rotation vectors are relative.
    pub(super) attitudes: Vec<UnitQuaternion<f64>>,
}

impl InitialState {
    /// No load at the start, and no motion of partners.
    pub(super) fn at_rest(variables: usize) -> Self {
        Self {
            variables: vec![0.0; variables],
            attitudes: Vec::new(),
        }
    }

    /// Takes exchanged variables from the subsystems, and the multipliers from the scene where it gives them all; otherwise
    /// solves `g'' = 0` at `t_start`, which is linear in them because loads enter the equations of motion linearly (for the
    /// oscillator: S1 eq. 3). Where signals are connected, `w - y(w) = 0` is solved for them, together with `g'' = 0`, by
    /// Newton's method.
    pub(super) fn find(
        scene: &Scene,
        coupled: &Coupled<'_>,
        layout: &Layout,
        workers: &Workers,
        accept_open_joints: bool,
    ) -> Result<Self, RunError> {
        let given = given_multipliers(scene, layout)?;
        let mut state = Self::read(scene, layout, workers, given.as_deref())?;
        state.check_closed(scene, layout, workers, accept_open_joints)?;
        match given {
            Some(_) if scene.connections.is_empty() => {}
            Some(_) => state.settle(scene, layout, workers, Multipliers::Held)?,
            None => {
                let layout = Layout::new(coupled, Level::Acceleration)
                    .map_err(|lacks| ask_for_multiplier(scene, lacks.joint))?;
                state.settle(scene, &layout, workers, Multipliers::Free)?;
            }
        }
        Ok(state)
    }

    /// Exchanged variables as the subsystems show them without loads of joints; connected signals meet `w - y(w) = 0`.
    pub(super) fn unloaded(
        scene: &Scene,
        layout: &Layout,
        workers: &Workers,
        accept_open_joints: bool,
    ) -> Result<Self, RunError> {
        let mut state = Self::read(scene, layout, workers, None)?;
        state.check_closed(scene, layout, workers, accept_open_joints)?;
        if !scene.connections.is_empty() {
            state.settle(scene, layout, workers, Multipliers::Held)?;
        }
        Ok(state)
    }

    fn check_closed(
        &self,
        scene: &Scene,
        layout: &Layout,
        workers: &Workers,
        accept_open: bool,
    ) -> Result<(), RunError> {
        if accept_open {
            return Ok(());
        }
        let outputs = evaluate_all(layout, workers, scene.t_start, self)?;
        consistency::check(scene, layout, &outputs)
    }

    /// Exchanged variables as the subsystems show them under these multipliers, 0 if none are given. Positions do not
    /// depend on inputs; connected signals may, and are settled later.
    pub(super) fn read(
        scene: &Scene,
        layout: &Layout,
        workers: &Workers,
        multipliers: Option<&[f64]>,
    ) -> Result<Self, RunError> {
        let mut state = Self {
            variables: vec![0.0; layout.variables()],
            attitudes: vec![UnitQuaternion::identity(); layout.attitudes().count()],
        };
        if let Some(multipliers) = multipliers {
            state.variables[..multipliers.len()].copy_from_slice(multipliers);
        }
        let outputs = evaluate_all(layout, workers, scene.t_start, &state)?;
        state.take(layout, &outputs);
        Ok(state)
    }

    /// Takes over what the outputs show.
    fn take(&mut self, layout: &Layout, outputs: &[Vec<f64>]) {
        for exchanged in &layout.exchanged {
            let own = &outputs[exchanged.subsystem];
            match exchanged.what {
                What::Output(place) => self.variables[exchanged.first] = own[place],
                What::Attitude { places, attitude } => {
                    self.attitudes[attitude] = unit_quaternion(places.map(|place| own[place]));
                }
            }
        }
    }

    /// Newton's method; one pass is enough unless signals are connected.
    fn settle(
        &mut self,
        scene: &Scene,
        layout: &Layout,
        workers: &Workers,
        multipliers: Multipliers,
    ) -> Result<(), RunError> {
        let mut system = System::new(layout, Unknowns::ends(layout));
        let mut solver = LinearSolver::new(system.pattern());
        let mut unsettled = 0;
        for _ in 0..MOST_PASSES {
            self.linearise(scene, layout, workers, &mut system)?;
            let changes = match multipliers {
                Multipliers::Held => change_of_signals(scene, layout, &mut system)?,
                Multipliers::Free => change_of_all(scene, layout, &mut system, &mut solver)?,
            };
            let mut largest: f64 = 0.0;
            for (variable, change) in changes.iter().enumerate() {
                let value = &mut self.variables[variable];
                *value += *change;
                let share = change.abs() / value.abs().max(1.0);
                if share > largest {
                    (largest, unsettled) = (share, variable);
                }
            }
            if scene.connections.is_empty() || largest <= SETTLED {
                return Ok(());
            }
        }
        Err(refuse_loop(scene, layout, unsettled))
    }

    fn linearise(
        &self,
        scene: &Scene,
        layout: &Layout,
        workers: &Workers,
        system: &mut System,
    ) -> Result<(), RunError> {
        let base = evaluate_all(layout, workers, scene.t_start, self)?;
        let columns = self.columns(layout, workers, scene.t_start, &base, system.unknowns())?;
        let point = Point::ends(&self.variables, &self.attitudes);
        system.assemble(layout, |subsystem| &base[subsystem], &columns, point);
        Ok(())
    }

    /// Responses of zero length to all perturbed inputs.
    fn columns(
        &self,
        layout: &Layout,
        workers: &Workers,
        t: f64,
        base: &[Vec<f64>],
        unknowns: &Unknowns,
    ) -> Result<Vec<Column>, RunError> {
        let mut columns = Vec::with_capacity(layout.inputs.len());
        for (number, input) in layout.inputs.iter().enumerate() {
            if unknowns.columns(number).is_empty() {
                continue;
            }
            let mut column = Column::new(input, layout);
            column.increment = 1.0;
            let names = &layout.outputs[input.subsystem];
            if input.is_perturbed {
                let mut inputs =
                    layout.input_values(input.subsystem, &self.variables, &self.attitudes);
                if !column.is_load {
                    column.increment = 1e-6 * inputs[input.place].abs().max(1.0);
                }
                inputs[input.place] += column.increment;
                let subsystem = &workers.subsystems[input.subsystem];
                let raised = subsystem.evaluate(t, &inputs, names)?;
                column.difference(&base[input.subsystem], &raised);
            }
            columns.push(column);
        }
        Ok(columns)
    }

    /// Reads the outputs of all subsystems at `t` under these variables.
    pub(super) fn read_outputs(
        &self,
        t: f64,
        layout: &Layout,
        workers: &mut Workers,
    ) -> Result<(), RunError> {
        for number in 0..workers.subsystems.len() {
            let inputs = layout.input_values(number, &self.variables, &self.attitudes);
            let subsystem = &mut workers.subsystems[number];
            subsystem.outputs = subsystem.evaluate(t, &inputs, &subsystem.output_names)?;
        }
        Ok(())
    }
}

/// Whether multipliers are solved for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Multipliers {
    Held,
    Free,
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

/// Outputs that `layout` reads of all subsystems under the variables of `state`.
pub(super) fn evaluate_all(
    layout: &Layout,
    workers: &Workers,
    t: f64,
    state: &InitialState,
) -> Result<Vec<Vec<f64>>, RunError> {
    let evaluate = |number: usize| {
        let inputs = layout.input_values(number, &state.variables, &state.attitudes);
        workers.subsystems[number].evaluate(t, &inputs, &layout.outputs[number])
    };
    (0..workers.subsystems.len()).map(evaluate).collect()
}

/// The multipliers that the scene gives: those of all joints, or none.
fn given_multipliers(scene: &Scene, layout: &Layout) -> Result<Option<Vec<f64>>, RunError> {
    if scene.joints.iter().all(|joint| joint.multiplier.is_none()) {
        return Ok((scene.joints.is_empty()).then(Vec::new));
    }
    let mut given = Vec::new();
    for (joint, bound) in scene.joints.iter().zip(&layout.joints) {
        let Some(multiplier) = &joint.multiplier else {
            let message = "this joint has no initial multiplier, but another one does";
            let help = "give the multipliers of all joints, or none: then all are computed";
            let key = format!("joint.{}", joint.name);
            return Err(scene.error(&key, message, Some(help.into())).into());
        };
        let expected = bound.joint.len();
        if multiplier.len() != expected {
            let message = format!(
                "{} multipliers, this joint has {expected}",
                multiplier.len()
            );
            let key = format!("joint.{}.multiplier", joint.name);
            return Err(scene.error(&key, message, None).into());
        }
        given.extend_from_slice(multiplier);
    }
    Ok(Some(given))
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
    let of_signal = |connection: &&Connection| {
        let (subsystem, output) = &connection.from;
        signal == format!("{}.{output}", scene.subsystems[*subsystem].name)
    };
    let key = match scene.connections.iter().find(of_signal) {
        Some(connection) => format!("connection.{}", connection.name),
        None => "connection".to_owned(),
    };
    let message = format!(
        "\"{signal}\" has no unique value at t = {} s: connected signals depend on each other without delay, and the gain \
         around the loop is 1",
        scene.t_start
    );
    let help = "change a gain, or let one of the connected models have a state between its input and its output";
    scene.error(&key, message, Some(help.into())).into()
}

fn ask_for_multiplier(scene: &Scene, joint: usize) -> RunError {
    let joint = &scene.joints[joint].name;
    let message =
        "the initial multiplier cannot be computed: a marker of this joint offers no acceleration";
    let help = format!("give it: `multiplier = ...` in joint \"{joint}\"");
    scene
        .error(&format!("joint.{joint}"), message, Some(help))
        .into()
}
