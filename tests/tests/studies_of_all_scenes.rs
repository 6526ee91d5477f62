//! `linchpin converge` and `linchpin stability` on every shipped scene.

#![allow(clippy::unwrap_used, missing_docs)]

use std::path::{Path, PathBuf};

use linchpin::study::Found;
use linchpin::study::converge::{Quantity, converge};
use linchpin::study::stability::{Grid, map};
use linchpin_master::scene::{self, Override, Scene};

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes");

/// The scene whose workers run in containers, those that are no scenes but studies, monolithic ones and those of S2, which couple
/// nothing, those that need a macro step that varies, and benchmarks, which move within shorter times or need longer ones.
const LEFT_OUT: [&str; 7] = [
    "benchmarks/",
    "oscillator-compose.toml",
    "report.toml",
    "s1/report.toml",
    "monolithic/",
    "s2/",
    "hard/",
];

fn shipped() -> Vec<PathBuf> {
    let mut folders = vec![PathBuf::from(SCENES)];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => folders.push(path),
                false => found.push(path),
            }
        }
    }
    found.retain(|path| {
        let name = path.strip_prefix(SCENES).unwrap().to_string_lossy();
        let is_scene = !scene::is_spectrum(path);
        is_scene && LEFT_OUT.iter().all(|left_out| !name.starts_with(left_out))
    });
    assert!(found.len() >= 25, "{found:?}");
    found
}

/// The scene without its cases, with other settings.
fn changed(path: &Path, settings: &[&str]) -> Scene {
    let overrides: Vec<Override> = settings.iter().map(|own| own.parse().unwrap()).collect();
    let scene = scene::load(path, &[]).and_then(|scene| scene.with(&overrides));
    let mut scene = scene.unwrap_or_else(|errors| panic!("{errors}"));
    scene.cases.clear();
    scene
}

#[test]
fn errors_of_every_scene() {
    for path in shipped() {
        let settings = [
            "scene.t_end=0.024",
            "converge.macro_steps=[4e-3, 2e-3, 1e-3]",
            "converge.reference=automatic",
        ];
        let scene = changed(&path, &settings);
        let cases = converge(&scene, scene.converge.as_ref().unwrap(), &|| ())
            .and_then(Found::whole)
            .unwrap();
        let errors = [0, 1].map(|number| cases[0].runs[number].error(Quantity::Position));
        let [coarse, fine] = errors.map(|error| error.unwrap_or(f64::NAN));
        assert!(
            fine < coarse && coarse < 0.1,
            "{}: {errors:?}",
            path.display()
        );
    }
}

/// Index 3: stable with k = 0, and never with k = 2, which diverges within a few steps.
#[test]
fn stability_of_every_scene() {
    for path in shipped() {
        let model = changed(&path, &[]).subsystems[0].model.clone();
        // The criterion for linear scenes needs a few vibrations.
        let t_end = match model.as_deref() {
            Some("oscillator") => "scene.t_end=0.5",
            _ => "scene.t_end=0.04",
        };
        let settings = [
            t_end,
            "coupling.method=baumgarte",
            "coupling.index=3",
            "coupling.beta=0",
            "coupling.gamma=0",
            "coupling.exchanged_degree=2",
            "stability.x={ key = 'coupling.degree', values = [0, 2] }",
            "stability.y={ key = 'coupling.macro_step', values = [1e-3, 2e-3] }",
        ];
        let scene = changed(&path, &settings);
        let grid = Grid::new(scene.stability.as_ref().unwrap());
        let maps = map(&scene, &grid, &|| ()).and_then(Found::whole).unwrap();
        let verdicts: Vec<bool> = { maps[0].cells.iter() }
            .map(|cell| cell.simulated.is_stable())
            .collect();
        let growth: Vec<f64> = { maps[0].cells.iter() }
            .map(|cell| cell.simulated.growth)
            .collect();
        assert_eq!(
            verdicts,
            [true, false, true, false],
            "{}: {growth:?}",
            path.display()
        );
        assert!(
            growth[0].is_finite() && growth[2].is_finite(),
            "{}: {growth:?}",
            path.display()
        );
    }
}
