//! Which subsystems find impacts, and who takes part in them.

use linchpin_proto::v1;

use crate::error::RunError;
use crate::joint::Level;
use crate::layout::{Layout, MarkedJoint};
use crate::macro_step::Colliding;
use crate::scene::{GROUND, ImpactsAtJoints, Scene};

/// What to do where impulses are asked too much of.
const HELP: &str = "; coupling.impacts = \"forces\" lets forces alone cross the joints, which is accurate only without impacts";

/// The groups with a subsystem that finds impacts in each: it and all that are joined to it, directly or by others. The ground
/// joins nothing.
///
/// # Errors
/// What stands against impulses at the joints, by its name.
pub(super) fn groups(
    scene: &Scene,
    models: &[v1::Model],
    joints: &[MarkedJoint],
    layout: &Layout,
) -> Result<Vec<Colliding>, RunError> {
    if scene.coupling.impacts == ImpactsAtJoints::Forces {
        return Ok(Vec::new());
    }
    let is_ground = |subsystem: usize| models[subsystem].name == GROUND;
    let of = |subsystem: usize| models[subsystem].capabilities.unwrap_or_default();
    let joined = joined(models.len(), joints, is_ground);
    let has_joint = |subsystem: &usize| {
        let mut ends = joints.iter().flat_map(|joint| &joint.ends);
        ends.any(|(own, _)| own == subsystem)
    };
    let mut finders = Vec::new();
    for finder in (0..models.len()).filter(|one| of(*one).impacts && has_joint(one)) {
        check_coupling(scene, layout, finder)?;
        check_solver(scene, &models[finder], finder)?;
        let known = finders
            .iter()
            .find(|known: &&Colliding| known.partners.contains(&finder));
        if let Some(Colliding { finder: other, .. }) = known {
            return Err(refuse_two(scene, [*other, finder]));
        }
        let takes_part = |one: &usize| *one != finder && joined[*one] == joined[finder];
        let mut partners: Vec<usize> = (0..models.len()).filter(takes_part).collect();
        let at_finder = |row: &usize| {
            let (joint, _) = (&joints[layout.rows[*row].joint], row);
            joint.ends.iter().any(|(own, _)| *own == finder)
        };
        let in_mechanism = |row: &usize| {
            let mut ends = joints[layout.rows[*row].joint].ends.iter();
            ends.any(|(own, _)| !is_ground(*own) && joined[*own] == joined[finder])
        };
        let rows = (0..layout.rows.len()).filter(in_mechanism);
        let (own, others) = rows.partition(at_finder);
        for &partner in &partners {
            if !of(partner).impulses && !of(partner).impacts {
                return Err(refuse_partner(scene, models, [finder, partner]));
            }
        }
        // It has nothing that an impulse could move.
        partners.retain(|one| !is_ground(*one));
        finders.push(Colliding {
            finder,
            partners,
            own,
            others,
        });
    }
    Ok(finders)
}

/// For each subsystem the first one that joints connect it with.
fn joined(
    subsystems: usize,
    joints: &[MarkedJoint],
    is_ground: impl Fn(usize) -> bool,
) -> Vec<usize> {
    let mut first: Vec<usize> = (0..subsystems).collect();
    let between = joints
        .iter()
        .map(|joint| [joint.ends[0].0, joint.ends[1].0]);
    let moving = between.filter(|ends| !ends.iter().any(|&end| is_ground(end)));
    for ends in moving {
        let [a, b] = ends.map(|end| first[end]);
        let (least, other) = (a.min(b), a.max(b));
        for own in first.iter_mut().filter(|own| **own == other) {
            *own = least;
        }
    }
    first
}

fn check_coupling(scene: &Scene, layout: &Layout, finder: usize) -> Result<(), RunError> {
    let name = &scene.subsystems[finder].name;
    let refuse = |key: &str, message: String, help: &str| {
        Err(scene
            .error(key, message, Some(format!("{help}{HELP}")))
            .into())
    };
    if !scene.coupling.method.corrects() {
        let message = format!(
            "\"{name}\" has impacts, and this method hands no impulses over at joints: it does not correct its loads"
        );
        return refuse(
            "coupling.method",
            message,
            "choose hermite, weighted or baumgarte",
        );
    }
    if !scene.coupling.method.parameters().forgets_loads() {
        let message = format!(
            "\"{name}\" has impacts, and this variant goes on with the loads of the step before, which an impact changes"
        );
        return refuse("coupling.variant", message, "choose variant \"apv\"");
    }
    if layout.level < Level::Velocity {
        let message = format!(
            "\"{name}\" has impacts, and with index 3 the coupling knows no velocities that could jump"
        );
        return refuse(
            "coupling.index",
            message,
            "choose index 2 or 1, or method hermite",
        );
    }
    Ok(())
}

/// The solver that the scene names, or the first one of the model.
fn check_solver(scene: &Scene, model: &v1::Model, finder: usize) -> Result<(), RunError> {
    let written = &scene.subsystems[finder];
    let kind = written.solver.as_ref().map(|solver| solver.kind.as_str());
    let mut solvers = model.solvers.iter();
    let solver = match kind {
        Some(kind) => solvers.find(|solver| solver.name == kind),
        None => solvers.next(),
    };
    let Some(solver) = solver.filter(|solver| solver.without_impacts) else {
        return Ok(());
    };
    let others = model.solvers.iter().filter(|other| !other.without_impacts);
    let others: Vec<&str> = others.map(|other| other.name.as_str()).collect();
    let message = format!(
        "\"{}\" has joints, and with solver {} it does not tell its impacts from its forces",
        written.name, solver.name
    );
    let help = format!("choose one of: {}{HELP}", others.join(", "));
    let key = format!("subsystem.{}.solver.kind", written.name);
    Err(scene.error(&key, message, Some(help)).into())
}

fn refuse_two(scene: &Scene, finders: [usize; 2]) -> RunError {
    let [one, other] = finders.map(|finder| &scene.subsystems[finder].name);
    let message = format!(
        "\"{one}\" and \"{other}\" both have contacts that collide, and joints connect them: an impact of one would need the contacts of the \
         other"
    );
    let help = format!("put both into one subsystem{HELP}");
    let key = format!("subsystem.{other}.model");
    scene.error(&key, message, Some(help)).into()
}

fn refuse_partner(scene: &Scene, models: &[v1::Model], [finder, partner]: [usize; 2]) -> RunError {
    let [name, own] = [finder, partner].map(|one| &scene.subsystems[one].name);
    let message = format!(
        "\"{name}\" has impacts, and \"{own}\", which joints connect it with, has the model \"{}\", which takes no impulses",
        models[partner].name
    );
    let help = format!("choose a model whose capabilities say impulses{HELP}");
    let key = format!("subsystem.{own}.model");
    scene.error(&key, message, Some(help)).into()
}
