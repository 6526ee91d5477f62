//! Overrides and cases that are sound.

use super::super::{Degree, Index, Method, Override, Scene, parse};
use super::{EXAMPLE, ORIGIN, example, line_of, scene};
use crate::methods::{Baumgarte, Weighted};
use linchpin_proto::v1::value::Kind;

pub(super) fn overrides(settings: &[&str]) -> Vec<Override> {
    settings.iter().map(|text| text.parse().unwrap()).collect()
}

fn with(settings: &[&str]) -> Scene {
    parse(EXAMPLE, ORIGIN, &overrides(settings)).unwrap_or_else(|errors| panic!("{errors}"))
}

fn parameter(scene: &Scene, subsystem: usize, name: &str) -> f64 {
    match scene.subsystems[subsystem].parameters[name].kind {
        Some(Kind::Number(value)) => value,
        _ => panic!("{name} is not a number"),
    }
}

#[test]
fn an_override_replaces_or_adds_a_key() {
    let scene = with(&[
        "coupling.macro_step=5e-4",
        "coupling.increment = 1e-5",
        "joint.link.multiplier=3",
        "run.deadline=1.5",
        "subsystem.mass2.parameters.c=7",
        "subsystem.mass1.solver={kind = \"radau5\", rtol = 1e-9}",
        "scene.name=other",
    ]);
    assert_eq!(scene.coupling.macro_step, 5e-4);
    assert_eq!(scene.joints[0].multiplier, Some(vec![3.0]));
    assert_eq!(scene.run.deadline, 1.5);
    assert_eq!(parameter(&scene, 1, "c"), 7.0);
    assert_eq!(parameter(&scene, 0, "c"), 1000.0);
    assert_eq!(scene.subsystems[0].solver.as_ref().unwrap().kind, "radau5");
    assert_eq!(scene.name, "other");
}

#[test]
fn a_star_means_every_entry() {
    let scene = with(&["subsystem.*.parameters.d=0.25"]);
    assert_eq!(parameter(&scene, 0, "d"), 0.25);
    assert_eq!(parameter(&scene, 1, "d"), 0.25);
}

#[test]
fn multiples_of_the_macro_step_follow_it() {
    let base = with(&["coupling.beta=2H"]);
    let finer = base
        .with(&overrides(&["coupling.macro_step=1.25e-4"]))
        .unwrap();
    let expected = Method::Baumgarte(Baumgarte {
        index: Index::Two,
        beta: 2.5e-4.into(),
        gamma: 0.0.into(),
    });
    assert_eq!(finer.coupling.method, expected);
}

#[test]
fn further_overrides_keep_the_earlier_ones() {
    let both = ["coupling.macro_step=5e-4", "coupling.degree=3"];
    let at_once = with(&both);
    let step_by_step = with(&both[..1]).with(&overrides(&both[1..])).unwrap();
    assert_eq!(at_once, step_by_step);
    let later = at_once.with(&overrides(&["coupling.degree=2"])).unwrap();
    assert_eq!(later.coupling.degree, Degree::Fixed(2));
}

#[test]
fn resolving_twice_gives_equal_scenes() {
    let settings = ["subsystem.*.parameters.c=3e4", "coupling.index=1"];
    assert_eq!(with(&settings), with(&settings));
    assert_ne!(with(&settings), with(&settings[..1]));
}

#[test]
fn another_method_sets_the_parameters_of_the_old_one_aside() {
    let expected = Method::Weighted(Weighted {
        index: Index::Two,
        a: 1.5,
        b: 0.0,
    });
    let scene = with(&["coupling.a=1.5", "coupling.method=weighted"]);
    assert_eq!(scene.coupling.method, expected);
    let scene = with(&["coupling.method=penalty", "coupling.stiffness=4e5"]);
    assert!(matches!(scene.coupling.method, Method::Penalty(_)));
}

#[test]
fn places_tell_file_and_override_apart() {
    let scene = with(&["coupling.degree=2"]);
    let degree = scene.place("coupling.degree").unwrap();
    assert!(degree.is_override());
    assert_eq!(degree.to_string(), "--set coupling.degree=2");
    assert_eq!(&degree.text()[degree.span.clone()], "2");
    let mass = scene.place("subsystem.mass2.parameters.m").unwrap();
    assert_eq!(mass.line, line_of(EXAMPLE, "m = 2.0"));
    assert_eq!(&mass.text()[mass.span.clone()], "2.0");
    let line = EXAMPLE.lines().nth(mass.line - 1).unwrap();
    assert_eq!(&line[mass.column - 1..mass.column + 2], "2.0");
    let enclosing = scene.place("subsystem.mass2.parameters.k").unwrap();
    assert_eq!(enclosing.line, mass.line);
    assert_eq!(scene.place("run.deadline"), None);
}

#[test]
fn columns_count_characters() {
    let text = EXAMPLE.replace("name = \"link\"", "\"name\" = \"link\" # ü");
    let text = text.replace("{ m = 2.0", "{ \"ß\" = 0, m = 2.0");
    let scene = parse(&text, ORIGIN, &[]).unwrap();
    let place = scene.place("subsystem.mass2.parameters.m").unwrap();
    let line = text.lines().nth(place.line - 1).unwrap();
    let column = line.chars().position(|c| c == '2').unwrap() + 1;
    assert_eq!(place.column, column);
}

#[test]
fn what_a_worker_finds_is_shown_at_its_key() {
    let scene = example();
    let errors = scene.error(
        "subsystem.mass1.parameters.m",
        "mass must be greater than 0 kg, found -1",
        Some("give a positive mass".into()),
    );
    let shown = errors.to_string();
    let line = line_of(EXAMPLE, "m = 1.0");
    assert!(shown.starts_with(&format!("scene.toml:{line}:")), "{shown}");
    assert!(
        shown.contains("found -1\n  help: give a positive mass"),
        "{shown}"
    );
}

#[test]
fn cases_are_variants_of_the_scene() {
    let cases = "[[case]]
name = \"index 1, k = 0\"
set = { \"coupling.index\" = 1, \"coupling.degree\" = 0 }
[[case]]
name = \"weighted\"
set.'coupling.method' = 'weighted'
set.'subsystem.mass1.solver' = { kind = 'radau5', rtol = 1e-8 }
[[case]]
name = \"as it is\"
[output]";
    let scene = scene(&[("[output]", cases)]);
    let names: Vec<&str> = scene.cases.iter().map(|case| &*case.name).collect();
    assert_eq!(names, ["index 1, k = 0", "weighted", "as it is"]);
    for case in &scene.cases {
        let by_overrides = scene.with(&case.overrides).unwrap();
        let by_case = scene.with_case(case).unwrap();
        assert_eq!(by_overrides.coupling, by_case.coupling);
        assert_eq!(by_overrides.subsystems, by_case.subsystems);
    }
    let index_1 = scene.with_case(&scene.cases[0]).unwrap();
    let expected = Method::Baumgarte(Baumgarte {
        index: Index::One,
        beta: 2e-3.into(),
        gamma: (1e-3 * 1e-3).into(),
    });
    assert_eq!(index_1.coupling.method, expected);
    let weighted = scene.with_case(&scene.cases[1]).unwrap();
    assert!(matches!(weighted.coupling.method, Method::Weighted(_)));
    assert_eq!(
        weighted.subsystems[0]
            .solver
            .as_ref()
            .unwrap()
            .options
            .len(),
        1
    );
    let place = weighted.place("coupling.method").unwrap();
    assert!(!place.is_override());
}
