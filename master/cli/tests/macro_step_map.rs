//! The macro-step map of the oscillator against real runs, known spectral radii and the closed rules of stability.
#![allow(missing_docs, clippy::unwrap_used)]

use std::path::Path;

use linchpin::connect::{Connector, Place};
use linchpin_master::CoSimulation;
use linchpin_master::probe::{MacroStepMap, ProbeError, macro_step_map};
use linchpin_master::results::Row;
use linchpin_master::scene::{self, Override, Scene};
use linchpin_master::setup::Options;

fn oscillator(settings: &[(&str, &str)]) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/oscillator.toml");
    let overrides: Vec<Override> = settings
        .iter()
        .map(|(key, value)| Override {
            key: (*key).to_owned(),
            value: (*value).to_owned(),
        })
        .collect();
    scene::load(&path, &overrides).unwrap()
}

fn try_map(scene: &Scene) -> Result<MacroStepMap, ProbeError> {
    let connector = Connector::new(Place::InProcess);
    macro_step_map(scene, &mut |scene, subsystem| {
        connector.connect(scene, subsystem)
    })
}

fn radius(settings: &[(&str, &str)]) -> f64 {
    try_map(&oscillator(settings))
        .unwrap()
        .spectral_radius()
        .unwrap()
}

/// The states of a run at all macro points.
fn run(scene: &Scene, map: &MacroStepMap) -> Vec<Vec<f64>> {
    let connector = Connector::new(Place::InProcess);
    let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
    let options = Options {
        watch_nothing: true,
        ..Options::default()
    };
    let mut simulation = CoSimulation::start(scene, &mut connect, &options).unwrap();
    let mut rows: Vec<Row> = vec![simulation.row().clone()];
    while simulation.macro_step().unwrap() {
        rows.push(simulation.row().clone());
    }
    let state = |point: usize| {
        let value = |coordinate: &linchpin_master::probe::Coordinate| {
            rows[point.saturating_sub(coordinate.age)]
                .get(&coordinate.column)
                .unwrap()
        };
        map.coordinates().iter().map(value).collect()
    };
    (0..rows.len()).map(state).collect()
}

const RUN_LIKE: f64 = 1e-9;

/// The multiplier of index 3 is a second difference of positions: it carries their rounding, magnified.
const SECOND_DIFFERENCE: f64 = 1e-7;

const METHODS: [(f64, &[(&str, &str)]); 9] = [
    (
        RUN_LIKE,
        &[("coupling.index", "1"), ("coupling.degree", "0")],
    ),
    (
        RUN_LIKE,
        &[("coupling.index", "1"), ("coupling.degree", "1")],
    ),
    (
        RUN_LIKE,
        &[
            ("coupling.index", "1"),
            ("coupling.gamma", "H^2"),
            ("coupling.degree", "3"),
        ],
    ),
    (
        RUN_LIKE,
        &[("coupling.index", "2"), ("coupling.degree", "0")],
    ),
    (
        SECOND_DIFFERENCE,
        &[
            ("coupling.index", "3"),
            ("coupling.beta", "0"),
            ("coupling.degree", "0"),
        ],
    ),
    (
        RUN_LIKE,
        &[
            ("coupling.method", "weighted"),
            ("coupling.index", "1"),
            ("coupling.degree", "2"),
        ],
    ),
    (
        RUN_LIKE,
        &[
            ("coupling.method", "weighted"),
            ("coupling.a", "1"),
            ("coupling.degree", "0"),
        ],
    ),
    (
        RUN_LIKE,
        &[
            ("coupling.method", "explicit"),
            ("coupling.mu", "5e-3"),
            ("coupling.degree", "0"),
        ],
    ),
    (
        RUN_LIKE,
        &[
            ("coupling.method", "penalty"),
            ("coupling.stiffness", "3e4"),
            ("coupling.damping", "70"),
        ],
    ),
];

#[test]
fn powers_of_the_map_are_the_run() {
    let recorded = ("output.variables", "['mass1.v', 'mass2.v']");
    for (tolerance, method) in METHODS {
        let scene = oscillator(&[method, &[recorded, ("coupling.macro_step", "1.3e-3")]].concat());
        let map = try_map(&scene).unwrap();
        let states = run(&scene, &map);
        let established = scene.coupling.degree.fixed().unwrap();
        let mut state = states[established].clone();
        // The last steps of the grid are shorter.
        for found in &states[established + 1..states.len() - 2] {
            state = map.apply(&state);
            for (place, (found, expected)) in found.iter().zip(&state).enumerate() {
                let largest = states.iter().map(|s| s[place].abs()).fold(0.0, f64::max);
                let difference = (found - expected).abs() / largest;
                assert!(difference < tolerance, "{method:?}: {difference:e}");
            }
        }
    }
}

#[test]
fn radii_are_the_known_ones() {
    let weighted = ("coupling.method", "weighted");
    let linear = [("coupling.index", "2"), ("coupling.degree", "1")];
    let [index_two, degree_one] = linear;
    for (settings, expected, half_a_digit) in [
        (
            &[
                weighted,
                ("coupling.index", "1"),
                ("coupling.a", "1"),
                ("coupling.b", "1"),
                ("coupling.degree", "2"),
            ][..],
            1.13,
            5e-3,
        ),
        (
            &[index_two, degree_one, ("coupling.beta", "0.2")],
            0.9989,
            5e-5,
        ),
        (
            &[index_two, degree_one, ("coupling.beta", "2e-2")],
            1.014,
            5e-4,
        ),
        (
            &[weighted, index_two, degree_one, ("coupling.a", "1")],
            1.995,
            5e-4,
        ),
    ] {
        let found = radius(settings);
        assert!(
            (found - expected).abs() <= half_a_digit,
            "{settings:?}: {found} instead of {expected}"
        );
    }
}

/// Limits for H -> 0 of the parameter below which the map is unstable, whatever the masses, springs and dampers.
#[test]
fn the_closed_rules_are_found() {
    for (degree, gamma_over_h2, b) in [
        ("1", 1.0 / 12.0, 0.5),
        ("2", 1.0 / 12.0 + 2.3 / 6.0, 2.0 / 3.0 + 0.4 * 2.3),
        ("3", 7.0 / 90.0 + 2.3 / 3.0, 0.737 + 0.889 * 2.3),
    ] {
        let degree = ("coupling.degree", degree);
        let index = ("coupling.index", "1");
        let baumgarte = [index, ("coupling.beta", "2.3H"), degree];
        let found = limit("coupling.gamma", "H^2", &baumgarte);
        assert!(
            (found / gamma_over_h2 - 1.0).abs() < 0.01,
            "{degree:?}: gamma = {found} H^2"
        );
        let weighted = [
            ("coupling.method", "weighted"),
            index,
            ("coupling.a", "2.3"),
            degree,
        ];
        let found = limit("coupling.b", "", &weighted);
        assert!((found / b - 1.0).abs() < 0.01, "{degree:?}: b = {found}");
    }
}

/// The explicit method is a double integrator under the feedback `-(x + 2 mu v) / mu^2` that is held over each step; its
/// map has the eigenvalue -1 at `mu = H`.
#[test]
fn the_explicit_method_needs_a_time_constant_of_one_step() {
    let settings = [("coupling.method", "explicit"), ("coupling.degree", "0")];
    let found = limit("coupling.mu", "H", &settings);
    assert!((found - 1.0).abs() < 0.01, "mu = {found} H");
}

/// Bisects for the value of `key`, in units of `unit`, above which the map is stable.
fn limit(key: &str, unit: &str, others: &[(&str, &str)]) -> f64 {
    let step = [("coupling.macro_step", "1e-5")];
    let (mut unstable, mut stable) = (1e-3, 10.0);
    while stable / unstable > 1.001 {
        let middle = f64::sqrt(unstable * stable);
        let value = format!("{middle}{unit}");
        if radius(&[others, &step, &[(key, &value)]].concat()) > 1.0 {
            unstable = middle;
        } else {
            stable = middle;
        }
    }
    stable
}

#[test]
fn a_scene_without_a_map_says_why() {
    let refused = |settings: &[(&str, &str)]| try_map(&oscillator(settings)).unwrap_err();
    let radau = refused(&[("subsystem.mass2.solver", "{ kind = 'radau5' }")]);
    assert!(
        matches!(radau, ProbeError::Inexact { ref subsystem, .. } if subsystem == "mass2"),
        "{radau}"
    );
    let sequence = [
        ("coupling.method", "penalty"),
        ("coupling.order", "gauss-seidel"),
        ("coupling.stiffness", "3e5"),
    ];
    assert!(matches!(
        refused(&sequence),
        ProbeError::RemembersOutputs { degree: 2 }
    ));
    let changing = [("coupling.index", "1"), ("coupling.degree", "automatic")];
    assert!(matches!(refused(&changing), ProbeError::ChangesDegree));
    let unknown = refused(&[("subsystem.mass1.parameters.m", "-1")]);
    assert!(matches!(unknown, ProbeError::Run(_)), "{unknown}");
}
