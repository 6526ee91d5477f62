//! No subsystem of a shipped scene is accused at the macro step of its scene.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use linchpin::conformance::Settings;
use linchpin::conformance::verdict::Grade;
use linchpin_master::scene::{self, Served};

use crate::subjects::{built_in, examine};

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes");

fn scenes(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            scenes(&path, found);
        } else if !scene::is_spectrum(&path) && !scene::is_study(&path) {
            found.push(path);
        }
    }
}

#[test]
#[ignore = "takes minutes: some mechanisms have tight tolerances"]
fn no_subsystem_of_a_shipped_scene_is_accused() {
    accuse_none_of(|name| !name.starts_with("monolithic/"));
}

#[test]
#[ignore = "takes minutes: some mechanisms have tight tolerances"]
fn no_monolithic_mechanism_is_accused() {
    accuse_none_of(|name| name.starts_with("monolithic/"));
}

fn accuse_none_of(is_chosen: impl Fn(&str) -> bool) {
    let mut paths = Vec::new();
    scenes(Path::new(SCENES), &mut paths);
    paths.retain(|path| is_chosen(&path.strip_prefix(SCENES).unwrap().to_string_lossy()));
    paths.sort();
    let (mut seen, mut accused) = (BTreeSet::new(), Vec::new());
    for path in paths {
        let scene = scene::load(&path, &[]).unwrap_or_else(|errors| panic!("{errors}"));
        for subsystem in scene
            .subsystems
            .iter()
            .filter(|own| own.served == Served::BuiltIn)
        {
            let settings = Settings {
                model: subsystem.model.clone(),
                parameters: subsystem.parameters.clone(),
                solver: subsystem.solver.clone(),
                steps: vec![scene.coupling.macro_step],
            };
            if !seen.insert(format!("{settings:?}")) {
                continue;
            }
            let started = std::time::Instant::now();
            let report = examine(built_in(), &settings);
            let name = format!(
                "{} {}",
                path.strip_prefix(SCENES).unwrap().display(),
                subsystem.name
            );
            println!(
                "{name:<50}{:>6.2} s warnings {:?}",
                started.elapsed().as_secs_f64(),
                report.names(Grade::Warn)
            );
            if !report.is_sound() {
                accused.push(format!("{name}\n{report}"));
            }
        }
    }
    assert!(
        accused.is_empty(),
        "{} accused\n{}",
        accused.len(),
        accused.join("\n")
    );
}
