//! Mistakes in study files, and in `[monolithic]`.

use crate::scene::{Measure, StudyFile, parse_study};

use super::{ORIGIN, edited, only};

const STUDY: &str = r#"[study]
name = "work"
targets = [1e-6, 1e-3]

[[scene]]
name = "oscillator"
file = "oscillator.toml"
macro_steps = [1e-3, 1e-2, 5e-3]

[[scene]]
name = "pendulum"
file = "pendulum.toml"
macro_steps = [1e-3, 1e-2]
measure = "state"
trace_step = 4e-3

[[setting]]
name = "k = 1"
set = { "coupling.degree" = 1 }

[[setting]]
name = "k = 2"
scenes = ["pendulum"]
paper = true
set = { "coupling.degree" = 2 }
"#;

fn study(text: &str) -> StudyFile {
    parse_study(text, "folder/study.toml").unwrap()
}

#[test]
fn what_a_study_says_and_what_it_leaves_open() {
    let study = study(STUDY);
    assert_eq!(
        (study.name.as_str(), study.title.as_str()),
        ("work", "work")
    );
    assert_eq!(study.targets, [1e-3, 1e-6]);
    let [oscillator, pendulum] = &study.scenes[..] else {
        panic!("two scenes");
    };
    assert_eq!(oscillator.file.to_str(), Some("folder/oscillator.toml"));
    assert_eq!((oscillator.trace_step, pendulum.trace_step), (5e-3, 4e-3));
    assert_eq!(
        (oscillator.measure, pendulum.measure),
        (Measure::Position, Measure::State)
    );
    let places = |setting: usize| study.settings[setting].scenes.clone();
    assert_eq!((places(0), places(1)), (vec![0, 1], vec![1]));
    assert!(study.settings[1].is_paper && !study.settings[0].is_paper);
    assert_eq!(study.general_settings().len(), 1);
    assert_eq!(study.settings_of(0).count(), 1);
    assert_eq!(
        study.settings[0].set.overrides()[0].to_string(),
        "coupling.degree=1"
    );
}

#[test]
fn mistakes_in_a_study_have_place_value_and_help() {
    for (old, new, expected) in [
        (
            "[study]",
            "[studie]",
            "folder/study.toml:1:2: `study file` has no key `studie`",
        ),
        ("name = \"work\"\n", "", "`study` lacks `name`"),
        (
            "targets = [1e-6, 1e-3]",
            "targets = []",
            "study.toml:3:11: `study.targets` must be a list of one or more",
        ),
        (
            "targets = [1e-6, 1e-3]",
            "targets = [-1e-6]",
            "must be a finite number greater than 0, found -1e-6",
        ),
        (
            "file = \"oscillator.toml\"\n",
            "",
            "study.toml:5:1: `scene.oscillator` lacks `file`",
        ),
        (
            "macro_steps = [1e-3, 1e-2]",
            "macro_steps = [1e-3]",
            "a list of two or more different macro steps",
        ),
        (
            "measure = \"state\"",
            "measure = \"stat\"",
            "did you mean `state`?",
        ),
        (
            "paper = true",
            "paper = 1",
            "`setting.k = 2.paper` must be true or false, found 1",
        ),
        (
            "[\"pendulum\"]",
            "[\"pendulm\"]",
            "nothing is named \"pendulm\"; known: oscillator, pendulum",
        ),
        (
            "name = \"k = 2\"",
            "name = \"k = 1\"",
            "is taken already by a setting in line 18",
        ),
        (
            "name = \"pendulum\"\n",
            "name = \"oscillator\"\n",
            "is taken already by a scene in line 6",
        ),
        (
            "set = { \"coupling.degree\" = 2 }",
            "set = 2",
            "`setting.k = 2.set` must be a table, found 2",
        ),
        (
            "set = { \"coupling.degree\" = 1 }\n",
            "",
            "`setting.k = 1` lacks `set`",
        ),
        ("trace_step = 4e-3", "trace_step = 0.0", "found 0.0"),
        (
            "[[setting]]\nname = \"k = 1\"",
            "[[setting]\nname = \"k = 1\"",
            "this is not TOML",
        ),
    ] {
        assert!(STUDY.contains(old), "{old}");
        let Err(errors) = parse_study(&STUDY.replacen(old, new, 1), "folder/study.toml") else {
            panic!("{new} is allowed");
        };
        let text = errors.to_string();
        assert!(
            text.contains(expected),
            "{expected:?} is missing in\n{text}"
        );
    }
}

fn monolithic(section: &str) -> String {
    let text = edited(&[]);
    let (head, rest) = text.split_once("[monolithic]").unwrap();
    let (_, tail) = rest.split_once("[output]").unwrap();
    format!("{head}[monolithic]\n{section}\n[output]{tail}")
}

#[test]
fn a_monolithic_scene_is_found_beside_its_scene() {
    let text = monolithic(
        "scene = \"one/mass.toml\"\ncolumns = { \"mass1.x\" = \"m.x\", \"mass1.e+mass2.e\" = \"m.e\" }",
    );
    let scene = super::parse(&text, "folder/scene.toml", &[]).unwrap();
    let found = scene.monolithic.unwrap();
    assert_eq!(found.scene.to_str(), Some("folder/one/mass.toml"));
    assert_eq!(found.columns["mass1.e + mass2.e"], "m.e");
}

#[test]
fn mistakes_in_a_monolithic_section() {
    for (section, expected) in [
        (
            "columns = { \"a.x\" = \"b.x\" }",
            "`monolithic` lacks `scene`",
        ),
        ("scene = \"one.toml\"", "`monolithic` lacks `columns`"),
        (
            "scene = \"one.toml\"\ncolumns = { \"x\" = \"b.x\" }",
            "result columns such as",
        ),
        (
            "scene = \"one.toml\"\ncolumns = { \"a.x\" = \"b.x +\" }",
            "\"b.x +\" is not result columns",
        ),
        (
            "scene = \"one.toml\"\ncolumns = { \"a.x\" = 1 }",
            "must be a text in quotes, found 1",
        ),
        (
            "scene = \"one.toml\"\ncolumn = 1\ncolumns = { \"a.x\" = \"b.x\" }",
            "did you mean `columns`?",
        ),
    ] {
        let errors = super::parse(&monolithic(section), ORIGIN, &[]).unwrap_err();
        let text = only(errors).to_string();
        assert!(
            text.contains(expected),
            "{expected:?} is missing in\n{text}"
        );
    }
}
