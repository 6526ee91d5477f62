//! The JSON schemas for editors, on the shipped files and on mistakes in one of them.

use std::fs;
use std::path::{Path, PathBuf};

use linchpin_master::scene::{is_spectrum, is_study};
use serde_json::Value;

use crate::page::repository;

fn schema_of(file: &Path) -> &'static str {
    match (is_study(file), is_spectrum(file)) {
        (true, _) => "study",
        (_, true) => "spectrum",
        _ => "scene",
    }
}

/// What a schema finds wrong with a text, each with its place.
fn mistakes(schema: &str, text: &str) -> Vec<String> {
    let path = repository().join(format!("docs/reference/{schema}.schema.json"));
    let schema: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let file: Value = toml::from_str(text).unwrap();
    let mistakes = validator.iter_errors(&file);
    mistakes
        .map(|mistake| format!("{}: {mistake}", mistake.instance_path()))
        .collect()
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => files(&path, found),
            false if path.extension().is_some_and(|end| end == "toml") => found.push(path),
            false => {}
        }
    }
}

#[test]
fn every_shipped_file_fits_its_schema() {
    let mut shipped = Vec::new();
    files(&repository().join("scenes"), &mut shipped);
    assert!(shipped.len() > 50, "{shipped:?}");
    for file in shipped {
        let found = mistakes(schema_of(&file), &fs::read_to_string(&file).unwrap());
        assert!(found.is_empty(), "{}: {found:#?}", file.display());
    }
}

#[test]
fn a_schema_finds_what_the_reader_finds() {
    let scene = fs::read_to_string(repository().join("scenes/oscillator.toml")).unwrap();
    for (old, new, place) in [
        ("t_end = 1.0", "", "/scene"),
        ("t_end = 1.0", "t_end = 1.0\nt_ent = 1.0", "/scene"),
        ("t_end = 1.0", "t_end = \"1\"", "/scene/t_end"),
        (
            "macro_step = 1e-3",
            "macro_step = 0",
            "/coupling/macro_step",
        ),
        ("beta = 2e-3", "beta = \"2H^2\"", "/coupling/beta"),
        ("\"baumgarte\"", "\"baumgart\"", "/coupling/method"),
        ("name = \"mass1\"", "name = \"mass 1\"", "/subsystem/0/name"),
    ] {
        assert!(scene.contains(old), "{old}");
        let found = mistakes("scene", &scene.replacen(old, new, 1));
        let [mistake] = &found[..] else {
            panic!("{new}: {found:?}")
        };
        assert!(mistake.starts_with(&format!("{place}: ")), "{mistake}");
    }
}
