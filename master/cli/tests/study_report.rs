//! The report: its page, its tables, what they tell of runs that diverge, and the mistakes of a study.
#![allow(missing_docs, clippy::unwrap_used)]

use std::path::{Path, PathBuf};

use linchpin::study::report::{
    Bound, Depth, Ending, Plan, Report, cost_of, envelope, json, page, report,
};
use linchpin_master::scene;

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");

fn study(text: &str) -> scene::StudyFile {
    scene::parse_study(text, &format!("{SCENES}/study.toml")).unwrap()
}

/// Two scenes, one of which cannot have one of the methods, and a method that diverges.
const STUDY: &str = r#"
[study]
name = "small"
title = "a < b & c"

[[scene]]
name = "oscillator"
file = "oscillator.toml"
macro_steps = [1e-2, 5e-3, 2e-3]
[scene.set]
"coupling.macro_step" = 5e-3
"scene.t_end" = 0.5
"stability.x" = { key = "subsystem.*.parameters.c", from = 13.0, to = 7e6, points = 5, scale = "log" }
"stability.y" = { key = "subsystem.*.parameters.d", from = 0.17, to = 9e2, points = 3, scale = "log" }

[[scene]]
name = "slider-crank"
file = "slider-crank.toml"
macro_steps = [2e-2, 1e-2]
set = { "scene.t_end" = 0.3 }

[[setting]]
name = "weighted, k = 1"
set = { "coupling.method" = "weighted", "coupling.degree" = 1, "coupling.jacobian" = "every-step" }

[[setting]]
name = "index 2, k = 0"
paper = true
set = { "coupling.method" = "weighted", "coupling.a" = 1.0, "coupling.b" = 0.0, "coupling.degree" = 0, "coupling.exchanged_degree" = 0, "coupling.jacobian" = "every-step" }

[[setting]]
name = "index 3, k = 1"
set = { "coupling.method" = "baumgarte", "coupling.beta" = 0.0, "coupling.gamma" = 0.0, "coupling.degree" = 1, "coupling.jacobian" = "every-step" }

[[setting]]
name = "unequal degrees"
scenes = ["slider-crank"]
set = { "coupling.method" = "weighted", "coupling.loads" = "master", "coupling.degree" = 1, "coupling.jacobian" = "every-step" }
"#;

fn run(depth: Depth) -> Report {
    let plan = Plan::of_study(&study(STUDY), depth).unwrap();
    report(&plan, &|| ()).whole().unwrap()
}

/// Every element is closed in its order; attributes and entities are left aside.
fn assert_well_formed(page: &str) {
    let mut open: Vec<&str> = Vec::new();
    for piece in page.split('<').skip(1) {
        let (tag, rest) = piece.split_once('>').unwrap();
        assert!(
            !rest.contains('>') || open.last() == Some(&"style"),
            "{piece}"
        );
        let name = tag.split([' ', '/']).find(|part| !part.is_empty());
        match name {
            _ if tag.starts_with('!') || tag.ends_with('/') => {}
            Some(name) if tag.starts_with('/') => assert_eq!(open.pop(), Some(name)),
            Some(name) => open.push(name),
            None => panic!("<{tag}>"),
        }
    }
    assert_eq!(open, Vec::<&str>::new());
}

#[test]
fn the_page_shows_every_setting_and_loads_nothing() {
    let found = run(Depth::Quick);
    let text = page(&found).unwrap();
    assert_well_formed(&text);
    for load in [
        "http:", "https:", "src=", "@import", "url(", "<link", "<script",
    ] {
        assert!(!text.contains(load), "{load}");
    }
    assert!(text.contains("<title>a &lt; b &amp; c</title>"));
    for setting in [
        "weighted, k = 1",
        "index 2, k = 0",
        "index 3, k = 1",
        "unequal degrees",
    ] {
        assert!(text.contains(&format!("<td>{setting}</td>")), "{setting}");
    }
    assert!(text.contains("no: the run diverged at t ="));
    assert!(text.contains("against the closed form") && text.contains("against a monolithic run"));
    // Cost and residuals of both scenes, and the maps of one.
    assert_eq!(text.matches("<figure>").count(), 5);
    assert!(text.contains("prefers-color-scheme: dark"));
}

#[test]
fn tables_have_every_run_and_what_it_cost() {
    let found = run(Depth::Full);
    let [oscillator, crank] = &found.scenes[..] else {
        panic!("two scenes");
    };
    assert_eq!((oscillator.settings.len(), crank.settings.len()), (3, 4));
    let diverged = &oscillator.settings[2].runs;
    let stopped =
        |ending: &Ending| matches!(ending, Ending::Stopped(why) if why.contains("diverged"));
    assert!(diverged.iter().all(|run| stopped(&run.ending)));
    let value: serde_json::Value = serde_json::from_str(&json(&found).unwrap()).unwrap();
    let scene = &value["scenes"][0];
    // 3 integrations a subsystem and step: predicted, perturbed, corrected; 2 subsystems.
    let first = &scene["settings"][0]["runs"][0];
    assert_eq!(first["macro_steps"], 50);
    assert_eq!(first["integrations"], 300);
    assert_eq!(first["statistics"]["integrations"], 300);
    assert_eq!(scene["settings"][2]["runs"][0]["stable"], false);
    assert!(scene["settings"][2]["runs"][0]["error"].is_null());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("report.csv");
    linchpin::files::write_table(&path, found.rows()).unwrap();
    let rows = std::fs::read_to_string(&path).unwrap().lines().count();
    assert_eq!(rows, 1 + 3 * 3 + 9 + 4 * 2 + 9);
    // k = 1 has order 4, so a tenth of the error costs the fourth root of ten.
    let rows = envelope(oscillator, &[1e-5, 1e-6]);
    let cost = |row: usize| rows[row].cheapest.as_ref().unwrap().cost;
    let growth = cost(1).integrations / cost(0).integrations;
    assert_eq!(
        (cost(0).bound, cost(1).bound),
        (Bound::Interpolated, Bound::Interpolated)
    );
    assert!((growth / 10f64.powf(0.25) - 1.0).abs() < 0.05, "{growth}");
    let paper = oscillator.settings[1].runs.iter().map(|run| {
        let integrations = run.ending.statistics()?.integrations as f64;
        Some((integrations, run.error(oscillator.quantity)?))
    });
    let paper = cost_of(&paper.collect::<Vec<_>>(), 1e-5).unwrap();
    let expected = cost(0).integrations / paper.integrations;
    assert_eq!(rows[0].to_paper.unwrap().value, expected);
    assert!(expected < 0.6, "{expected}");
    assert_eq!(rows[2].cheapest, None);
}

/// The solver's own error against its tolerance: the curve of the monolithic scene falls with it.
#[test]
fn monolithic_runs_follow_their_tolerance() {
    let found = run(Depth::Quick);
    let runs = &found.scenes[1].monolithic;
    let error = |place: usize| runs[place].ending.error(found.scenes[1].quantity).unwrap();
    assert!(
        error(8) < error(0) && error(0) < 1e-3,
        "{:e} {:e}",
        error(0),
        error(8)
    );
    assert!(error(8) < 1e-12, "{:e}", error(8));
}

#[test]
fn scenes_alone_get_the_usual_settings() {
    let files = [PathBuf::from(format!("{SCENES}/spatial/gimbal.toml"))];
    let plan = Plan::of_scenes(&files, Depth::Quick).unwrap();
    assert_eq!(plan.name, "gimbal");
    assert!(plan.number_of_tasks() > 4 * 15);
}

#[test]
fn the_shipped_study_is_sound() {
    let study = scene::load_study(Path::new(&format!("{SCENES}/report.toml"))).unwrap();
    let plan = Plan::of_study(&study, Depth::Full).unwrap();
    assert!(study.scenes.len() >= 6 && plan.number_of_tasks() > 1000);
    let paper = study.settings.iter().filter(|setting| setting.is_paper);
    let mut with_paper: Vec<usize> = paper.flat_map(|setting| setting.scenes.clone()).collect();
    with_paper.sort_unstable();
    with_paper.dedup();
    assert_eq!(with_paper, [0, 1, 2], "the scenes of the paper");
}

/// A mistake in what a setting sets is told with its place in the study.
#[test]
fn settings_that_do_not_fit_a_scene_are_refused() {
    for (old, new, words) in [
        (
            "\"weighted\", \"coupling.degree\" = 1",
            "\"weighted\", \"coupling.degre\" = 1",
            &["study.toml:24:41", "`degre`", "did you mean `degree`?"][..],
        ),
        (
            "file = \"slider-crank.toml\"",
            "file = \"slider-krank.toml\"",
            &["no scene file", "slider-krank.toml"][..],
        ),
        (
            "set = { \"scene.t_end\" = 0.3 }",
            "set = { \"scene.t_end\" = -0.3 }",
            &["study.toml:20:25", "t_end = -0.3"][..],
        ),
    ] {
        assert!(STUDY.contains(old));
        let study = study(&STUDY.replacen(old, new, 1));
        let Err(errors) = Plan::of_study(&study, Depth::Quick) else {
            panic!("{new} is allowed");
        };
        let text = errors.to_string();
        for word in words {
            assert!(text.contains(word), "{word:?} is missing in\n{text}");
        }
    }
}
