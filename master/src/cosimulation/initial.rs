//! Consistent multipliers at the first macro point.

use super::Parts;
use crate::coupling::columns::Column;
use crate::coupling::layout::{Layout, MarkedJoint};
use crate::coupling::solve::{LinearSolver, SingularColumn};
use crate::coupling::system::{System, motion_of};
use crate::error::RunError;
use crate::joint::{Level, extent};
use crate::scene::Scene;
use crate::signal::combine;

/// Joints that are open by less than this share of the motion are closed up to rounding.
const CLOSED: f64 = 1e-9;

/// Multipliers with which the run starts.
pub(super) struct InitialState {
    pub(super) multipliers: Vec<f64>,
}

/// No load at the start.
pub(super) fn at_rest(parts: &Parts) -> InitialState {
    InitialState {
        multipliers: vec![0.0; parts.layout.rows.len()],
    }
}

impl InitialState {
    /// Takes the multipliers from the scene where it gives them all; otherwise solves `g'' = 0` at `t_start`, which is
    /// linear in them because loads enter the equations of motion linearly (for the oscillator: S1 eq. 3).
    pub(super) fn find(
        scene: &Scene,
        joints: &[MarkedJoint],
        parts: &Parts,
        accept_open_joints: bool,
    ) -> Result<Self, RunError> {
        if !accept_open_joints {
            check_closed(scene, parts)?;
        }
        let given = given_multipliers(scene, &parts.layout)?;
        if let Some(multipliers) = given {
            return Ok(Self { multipliers });
        }
        let subsystems = parts.subsystems.len();
        let layout = Layout::new(joints, subsystems, Level::Acceleration)
            .map_err(|lacks| ask_for_multiplier(scene, lacks.joint))?;
        Ok(Self {
            multipliers: solve_accelerations(scene, &layout, parts)?,
        })
    }

    /// Reads the outputs of all subsystems at `t` under these multipliers.
    pub(super) fn read_outputs(&self, t: f64, parts: &mut Parts) -> Result<(), RunError> {
        for number in 0..parts.subsystems.len() {
            let inputs = self.inputs(&parts.layout, number);
            let subsystem = &mut parts.subsystems[number];
            subsystem.outputs = subsystem.evaluate(t, &inputs, &subsystem.output_names)?;
        }
        Ok(())
    }

    /// Driven inputs of one subsystem; motion of a partner counts as absent.
    fn inputs(&self, layout: &Layout, number: usize) -> Vec<f64> {
        let rows = layout.rows.len();
        let load = |input: &crate::coupling::layout::DrivenInput| {
            let loads = input
                .combination
                .iter()
                .filter(|(variable, _)| *variable < rows);
            combine(&loads.copied().collect::<Vec<_>>(), &self.multipliers)
        };
        layout.inputs_of(number).map(load).collect()
    }
}

fn solve_accelerations(
    scene: &Scene,
    layout: &Layout,
    parts: &Parts,
) -> Result<Vec<f64>, RunError> {
    let t = scene.t_start;
    let rows = layout.rows.len();
    let free = evaluate_all(layout, parts, t)?;
    let mut columns = Vec::with_capacity(layout.inputs.len());
    for (number, input) in layout.inputs.iter().enumerate() {
        let loaded = evaluate_one(layout, parts, t, input.subsystem, Some(number))?;
        let mut column = Column {
            increment: 1.0,
            ..Column::default()
        };
        column.difference(&free[input.subsystem], &loaded);
        columns.push(column);
    }
    let mut system = System::new(rows, Level::Acceleration);
    let outputs = |subsystem: usize| free[subsystem].as_slice();
    system.assemble_residuals(layout, outputs);
    system.assemble_jacobians(layout, outputs, &columns);
    let (jacobian, solution) = system.level_equation(Level::Acceleration);
    LinearSolver::new(rows)
        .solve(jacobian, solution)
        .map_err(|SingularColumn(row)| refuse_redundant(scene, layout.rows[row].joint))?;
    Ok(solution.to_vec())
}

/// Outputs that `layout` reads of all subsystems, without loads.
fn evaluate_all(layout: &Layout, parts: &Parts, t: f64) -> Result<Vec<Vec<f64>>, RunError> {
    (0..parts.subsystems.len())
        .map(|number| evaluate_one(layout, parts, t, number, None))
        .collect()
}

/// Outputs that `layout` reads of one subsystem, with a unit load at input `loaded`.
fn evaluate_one(
    layout: &Layout,
    parts: &Parts,
    t: f64,
    number: usize,
    loaded: Option<usize>,
) -> Result<Vec<f64>, RunError> {
    let own = layout
        .inputs
        .iter()
        .enumerate()
        .filter(|(_, input)| input.subsystem == number);
    let inputs: Vec<f64> = own
        .map(|(input, _)| if Some(input) == loaded { 1.0 } else { 0.0 })
        .collect();
    parts.subsystems[number].evaluate(t, &inputs, &layout.outputs[number])
}

/// Refuses a scene whose joints are open at the start, on the levels that the method demands below the acceleration.
fn check_closed(scene: &Scene, parts: &Parts) -> Result<(), RunError> {
    let layout = &parts.layout;
    let outputs = evaluate_all(layout, parts, scene.t_start)?;
    for (number, row) in layout.rows.iter().enumerate() {
        let motion = motion_of(layout, row.joint, |s| outputs[s].as_slice());
        for &level in layout.level.up_to() {
            let law = &layout.joints[row.joint].law;
            let residual = law.condition(row.condition, level, &motion);
            if level < Level::Acceleration && residual.abs() > CLOSED * extent(&motion, level) {
                let message = format!(
                    "the joint is open at t = {} s: {} is {residual:e}",
                    scene.t_start,
                    layout.column_name(number, &format!("residual.{}", level.name()))
                );
                let help = "choose initial values of the two subsystems that meet the joint";
                let key = format!("joint.{}", scene.joints[row.joint].name);
                return Err(scene.error(&key, message, Some(help.into())).into());
            }
        }
    }
    Ok(())
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
        let expected = bound.law.rows().len();
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

fn refuse_redundant(scene: &Scene, joint: usize) -> RunError {
    let key = format!("joint.{}", scene.joints[joint].name);
    let message = "nothing determines the multiplier of this joint at the start: another joint demands the same \
                   already, or no coupled body reacts to its load";
    let help = "remove the redundant joint, or check the markers at its ends";
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
