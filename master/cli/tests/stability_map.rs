//! Stability by simulation against the spectral radius of the macro-step map.
#![allow(missing_docs, clippy::unwrap_used)]

use std::path::Path;

use linchpin::study::stability::{CaseMap, Count, Grid, map};
use linchpin_master::scene::{self, Override, Scene};

const AXES: [(&str, &str); 2] = [
    (
        "stability.x",
        "{ key = 'subsystem.*.parameters.c', from = 13, to = 7e7, points = 9, scale = 'log' }",
    ),
    (
        "stability.y",
        "{ key = 'subsystem.*.parameters.d', from = 0.17, to = 9e4, points = 6, scale = 'log' }",
    ),
];

fn oscillator(settings: &[(&str, &str)]) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/oscillator.toml");
    let given = |(key, value): &(&str, &str)| Override {
        key: (*key).to_owned(),
        value: (*value).to_owned(),
    };
    let overrides: Vec<Override> = settings.iter().map(given).collect();
    scene::load(&path, &overrides).unwrap()
}

fn map_of(settings: &[(&str, &str)]) -> CaseMap {
    let scene = oscillator(&[settings, &AXES].concat());
    let grid = Grid::new(scene.stability.as_ref().unwrap());
    map(&scene, &grid, &|| ())
        .unwrap()
        .whole()
        .unwrap()
        .remove(0)
}

/// Methods with the settings of S1 Figs. 7 to 14, and others. With index 3 all is stable, and the thin bands of
/// weighted multipliers at index 2 lie between the points.
#[test]
fn no_simulation_contradicts_the_spectral_radius() {
    let coarse = [("coupling.macro_step", "5e-3"), ("scene.t_end", "7.5")];
    let large = [("coupling.beta", "2e-1"), ("coupling.gamma", "1e-2")];
    let small = [("coupling.beta", "2e-3"), ("coupling.gamma", "1e-6")];
    let weighted = ("coupling.method", "weighted");
    let explicit = ("coupling.method", "explicit");
    let index = |index| ("coupling.index", index);
    let degree = |degree| ("coupling.degree", degree);
    let fine = [("coupling.macro_step", "1e-3"), ("scene.t_end", "1.5")];
    let both = true;
    for (settings, has_both) in [
        (
            [&coarse[..], &large, &[index("1"), degree("0")]].concat(),
            both,
        ),
        (
            [&fine[..], &large, &[index("1"), degree("1")]].concat(),
            both,
        ),
        (
            [&fine[..], &small, &[index("1"), degree("2")]].concat(),
            both,
        ),
        (
            [
                &coarse[..],
                &[index("2"), degree("0"), ("coupling.beta", "2e-2")],
            ]
            .concat(),
            both,
        ),
        (
            [
                &coarse[..],
                &[index("3"), degree("0"), ("coupling.beta", "0")],
            ]
            .concat(),
            !both,
        ),
        (
            [
                &fine[..],
                &[
                    weighted,
                    index("1"),
                    ("coupling.a", "1"),
                    ("coupling.b", "1"),
                    degree("1"),
                ],
            ]
            .concat(),
            both,
        ),
        (
            [&coarse[..], &[weighted, ("coupling.a", "1"), degree("0")]].concat(),
            !both,
        ),
        (
            [&fine[..], &[explicit, degree("0"), ("coupling.mu", "1e-3")]].concat(),
            both,
        ),
    ] {
        let found = map_of(&settings);
        let count = Count::of(&found);
        assert_eq!(found.no_radius, None, "{settings:?}");
        assert_eq!(count.disagree, 0, "{settings:?}: {count}");
        assert!(count.agree > 45, "{settings:?}: {count}");
        assert_eq!(
            count.stable > 0 && count.unstable > 0,
            has_both,
            "{settings:?}: {count}"
        );
    }
}

#[test]
fn an_inexact_solver_is_mapped_by_simulation_alone() {
    let found = map_of(&[
        ("subsystem.mass1.solver", "{ kind = 'radau5' }"),
        ("scene.t_end", "0.05"),
    ]);
    assert!(found.no_radius.as_ref().unwrap().contains("mass1"));
    assert!(found.cells.iter().all(|cell| cell.radius.is_none()));
    assert_eq!(found.cells.len(), 54);
}
