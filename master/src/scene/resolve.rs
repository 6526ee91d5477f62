//! Turns the scene as written into the scene as resolved.

use std::sync::Arc;

use super::connection;
use super::coupling;
use super::joint;
use super::monolithic;
use super::output;
use super::resolved::Subsystem;
use super::run;
use super::security;
use super::subsystem;
use super::sweeps;
use super::whole::Scene;
use crate::reading::error::{SceneError, SceneErrors};
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::key::{FINITE, Key, Takes};
use crate::reading::lists::sections;
use crate::reading::names::Registry;
use crate::reading::reader::{Problems, Section, collect, given};
use crate::reading::written::Written;

/// The tables of a scene file.
pub const SCENE_KEYS: [Key; 12] = [
    Key::new("scene", Takes::Table(|| HEAD.to_vec()))
        .required("[scene] with name and t_end")
        .means("name and times"),
    Key::new("coupling", Takes::Table(coupling::keys_of_all_methods))
        .required("[coupling] with method and macro_step")
        .means("the coupling method and its parameters"),
    Key::new("subsystem", Takes::Tables(|| subsystem::KEYS.to_vec()))
        .default("one at least")
        .means("a model that is coupled"),
    Key::new("joint", Takes::Tables(|| joint::KEYS.to_vec()))
        .default("none")
        .means("a constraint between two subsystems"),
    Key::new("connection", Takes::Tables(|| connection::KEYS.to_vec()))
        .default("none")
        .means("an output of one subsystem that is an input of another"),
    Key::new("output", Takes::Table(|| output::KEYS.to_vec()))
        .default("its defaults")
        .means("what is recorded and drawn"),
    Key::new("run", Takes::Table(|| run::KEYS.to_vec()))
        .default("its defaults")
        .means("how long workers may take"),
    Key::new("security", Takes::Table(|| security::KEYS.to_vec()))
        .default("its defaults")
        .means("certificates, and whether plain text may leave the machine"),
    Key::new("case", Takes::Tables(|| sweeps::CASE.to_vec()))
        .default("none")
        .means("a variant; one command runs all of them"),
    Key::new("converge", Takes::Table(|| sweeps::CONVERGE.to_vec()))
        .default("as the command line says")
        .means("the convergence study"),
    Key::new("stability", Takes::Table(|| sweeps::STABILITY.to_vec()))
        .default("as the command line says")
        .means("the map of stability"),
    Key::new("monolithic", Takes::Table(|| monolithic::KEYS.to_vec()))
        .default("none")
        .means("the same system in one subsystem, which runs are compared with"),
];
const HEAD: [Key; 3] = [
    Key::new("name", Takes::Name)
        .required("name = \"oscillator\"")
        .means("name of the results folder"),
    Key::new("t_start", Takes::Number(FINITE))
        .default_number(0.0)
        .means("start, s"),
    Key::new("t_end", Takes::Number(FINITE))
        .required("t_end = 1.0")
        .means("end, s"),
];
/// The scene, or everything that is wrong with it, together with the mistakes that were found before.
pub(super) fn resolve(written: Written, earlier: Vec<SceneError>) -> Result<Scene, SceneErrors> {
    let written = Arc::new(written);
    let mut problems = Problems::new(&written);
    for error in earlier {
        problems.keep(error);
    }
    let scene = read(&written, &mut problems);
    problems.finish(scene)
}

/// What stands for the inertial axes as the end of a joint: a subsystem of this name and model that no scene has to list.
pub(crate) const GROUND: &str = "ground";

fn read(written: &Arc<Written>, problems: &mut Problems<'_>) -> Option<Scene> {
    let root = Section::root(written)?;
    let [
        head,
        coupling,
        subsystems,
        joints,
        connections,
        output,
        run,
        security,
        cases,
        converge,
        stability,
        monolithic,
    ] = root.read(&SCENE_KEYS, problems);
    let head = head.and_then(|field| read_head(&field.section(problems)?, problems));
    let duration = head.as_ref().map(|head| head.t_end - head.t_start);
    let coupling =
        coupling.and_then(|field| coupling::read(&field.section(problems)?, duration, problems));
    if subsystems.is_none() {
        problems.report(root.spot, SceneErrorKind::NoSubsystem);
    }
    let subsystem_tables = sections(subsystems, problems);
    let joint_tables = sections(joints, problems);
    let mut subsystem_names = Registry::collect("subsystem", &subsystem_tables, None, problems);
    let has_ground = joint::any_to(GROUND, &joint_tables) && subsystem_names.imply(GROUND);
    Registry::collect("joint", &joint_tables, Some(&subsystem_names), problems);
    let security = security::read(security, problems);
    let mut subsystems = collect(&subsystem_tables, |table| {
        subsystem::read(table, security.as_ref(), problems)
    });
    if let Some(subsystems) = subsystems.as_mut().filter(|_| has_ground) {
        subsystems.push(Subsystem::built_in(GROUND));
    }
    let joints = collect(&joint_tables, |table| {
        joint::read(table, &subsystem_names, problems)
    });
    let connection_tables = sections(connections, problems);
    Registry::collect("connection", &connection_tables, None, problems);
    let connections = collect(&connection_tables, |table| {
        connection::read(table, &subsystem_names, problems)
    });
    let output = output::read(output, &subsystem_names, duration, problems);
    let run = run::read(run, problems);
    let case_tables = sections(cases, problems);
    Registry::collect("case", &case_tables, None, problems);
    let cases = collect(&case_tables, |table| sweeps::read_case(table, problems));
    let converge = given(converge, |field| {
        sweeps::read_converge(&field.section(problems)?, duration, problems)
    });
    let stability = given(stability, |field| {
        sweeps::read_stability(&field.section(problems)?, problems)
    });
    let monolithic = given(monolithic, |field| {
        monolithic::read(&field.section(problems)?, problems)
    });
    let head = head?;
    Some(Scene {
        name: head.name,
        t_start: head.t_start,
        t_end: head.t_end,
        coupling: coupling?,
        subsystems: subsystems?,
        joints: joints?,
        connections: connections?,
        output: output?,
        run: run?,
        security: security?,
        cases: cases?,
        converge: converge?,
        stability: stability?,
        monolithic: monolithic?,
        written: Arc::clone(written),
    })
}

struct Head {
    name: String,
    t_start: f64,
    t_end: f64,
}

fn read_head(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Head> {
    let [name, start, end] = section.read(&HEAD, problems);
    let name = name.and_then(|field| field.name(problems));
    let t_start = start.map_or(Some(0.0), |field| field.number(problems));
    let t_end = end.as_ref().and_then(|field| field.number(problems));
    let (t_start, t_end) = (t_start?, t_end?);
    if t_end <= t_start || !(t_end - t_start).is_finite() {
        end?.report(SceneErrorKind::EndBeforeStart { t_start, t_end }, problems);
        return None;
    }
    Some(Head {
        name: name?.to_owned(),
        t_start,
        t_end,
    })
}
