//! Turns the scene as written into the scene as resolved.

use std::sync::Arc;

use super::connection;
use super::coupling;
use super::joint;
use super::monolithic;
use super::output;
use super::resolved::RunSettings;
use super::subsystem;
use super::sweeps;
use super::whole::Scene;
use crate::reading::error::{SceneError, SceneErrors};
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::lists::{collect, sections};
use crate::reading::names::Registry;
use crate::reading::reader::{FINITE, Field, Problems, Range, Section};
use crate::reading::written::{Value, Written};

const SECTIONS: [&str; 11] = [
    "scene",
    "coupling",
    "subsystem",
    "joint",
    "connection",
    "output",
    "run",
    "case",
    "converge",
    "stability",
    "monolithic",
];
const DEFAULT_DEADLINE: f64 = 30.0;
const DEFAULT_START_TIMEOUT: f64 = 10.0;
/// Longer than any sensible wait, and short enough for every clock.
const TIME_LIMIT: Range = Range {
    words: "greater than 0 s and at most 1e6 s",
    contains: |value| value > 0.0 && value <= 1e6,
};

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

fn read(written: &Arc<Written>, problems: &mut Problems<'_>) -> Option<Scene> {
    let Value::Table(table) = &written.root.value else {
        return None;
    };
    let root = Section::root(written, table);
    root.allow_only(&SECTIONS, problems);
    let head = root
        .require("scene", "[scene] with name and t_end", problems)
        .and_then(|field| field.section(problems))
        .and_then(|section| read_head(&section, problems));
    let duration = head.as_ref().map(|head| head.t_end - head.t_start);
    let coupling = root
        .require(
            "coupling",
            "[coupling] with method and macro_step",
            problems,
        )
        .and_then(|field| field.section(problems))
        .and_then(|section| coupling::read(&section, duration, problems));
    let subsystem_tables = sections(&root, "subsystem", problems);
    let joint_tables = sections(&root, "joint", problems);
    let subsystem_names = Registry::collect("subsystem", &subsystem_tables, None, problems);
    Registry::collect("joint", &joint_tables, Some(&subsystem_names), problems);
    if !table.contains_key("subsystem") {
        problems.report(root.spot, SceneErrorKind::NoSubsystem);
    }
    let subsystems = collect(&subsystem_tables, |table| subsystem::read(table, problems));
    let joints = collect(&joint_tables, |table| {
        joint::read(table, &subsystem_names, problems)
    });
    let connection_tables = sections(&root, "connection", problems);
    Registry::collect("connection", &connection_tables, None, problems);
    let connections = collect(&connection_tables, |table| {
        connection::read(table, &subsystem_names, problems)
    });
    let output = output::read(&root, &subsystem_names, duration, problems);
    let run = read_run(&root, problems);
    let case_tables = sections(&root, "case", problems);
    Registry::collect("case", &case_tables, None, problems);
    let cases = collect(&case_tables, |table| sweeps::read_case(table, problems));
    let converge = optional(root.get("converge"), problems, |section, problems| {
        sweeps::read_converge(section, duration, problems)
    });
    let stability = optional(root.get("stability"), problems, sweeps::read_stability);
    let monolithic = optional(root.get("monolithic"), problems, monolithic::read);
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
        cases: cases?,
        converge: converge?,
        stability: stability?,
        monolithic: monolithic?,
        written: Arc::clone(written),
    })
}

/// `Some(None)` if the table is absent.
fn optional<T>(
    field: Option<Field<'_>>,
    problems: &mut Problems<'_>,
    read: impl FnOnce(&Section<'_>, &mut Problems<'_>) -> Option<T>,
) -> Option<Option<T>> {
    match field {
        Some(field) => read(&field.section(problems)?, problems).map(Some),
        None => Some(None),
    }
}

struct Head {
    name: String,
    t_start: f64,
    t_end: f64,
}

fn read_head(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Head> {
    section.allow_only(&["name", "t_start", "t_end"], problems);
    let name = section
        .require("name", "name = \"oscillator\"", problems)
        .and_then(|field| field.name(problems));
    let t_start = section
        .get("t_start")
        .map_or(Some(0.0), |field| field.number(&FINITE, problems));
    let end_field = section.require("t_end", "t_end = 1.0", problems);
    let t_end = end_field
        .as_ref()
        .and_then(|field| field.number(&FINITE, problems));
    let (t_start, t_end) = (t_start?, t_end?);
    if t_end <= t_start || !(t_end - t_start).is_finite() {
        end_field?.report(SceneErrorKind::EndBeforeStart { t_start, t_end }, problems);
        return None;
    }
    Some(Head {
        name: name?.to_owned(),
        t_start,
        t_end,
    })
}

fn read_run(root: &Section<'_>, problems: &mut Problems<'_>) -> Option<RunSettings> {
    let default = RunSettings {
        deadline: DEFAULT_DEADLINE,
        start_timeout: DEFAULT_START_TIMEOUT,
    };
    let Some(field) = root.get("run") else {
        return Some(default);
    };
    let section = field.section(problems)?;
    section.allow_only(&["deadline", "start_timeout"], problems);
    let mut seconds = |key, default| {
        section
            .get(key)
            .map_or(Some(default), |field| field.number(&TIME_LIMIT, problems))
    };
    let deadline = seconds("deadline", default.deadline);
    let start_timeout = seconds("start_timeout", default.start_timeout);
    Some(RunSettings {
        deadline: deadline?,
        start_timeout: start_timeout?,
    })
}
