//! Spectrum files and the mistakes in them.

use crate::scene::{SpectrumFile, SpectrumScheme, parse_spectrum};

const FILE: &str = r#"[spectrum]
name = "schemes"
from = 1e-1
to = 10
points = 3

[[spectrum.curve]]
label = "optimal"
scheme = { kind = "generalized-alpha", rho_inf = 0.8 }

[[spectrum.curve]]
label = "HHT"
scheme = { kind = "newmark-alpha", alpha_m = 0, alpha_f = 0.3 }

[[spectrum.curve]]
label = "ED"
scheme = { kind = "ed-alpha", rho_inf = 0 }

[[spectrum.curve]]
label = "Bathe"
scheme = { kind = "bathe" }

[spectrum.region]
alpha_m = { from = 0.5, to = -1.0, points = 4 }
alpha_f = { from = -0.5, to = 0.5, points = 3 }
[[spectrum.region.point]]
label = "A"
alpha_m = -1
alpha_f = 0.5
"#;

fn file(text: &str) -> SpectrumFile {
    parse_spectrum(text, "spectrum.toml").unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn what_a_file_says_and_what_it_leaves_open() {
    let found = file(FILE);
    assert_eq!(found.name, "schemes");
    assert_eq!(found.sweep.len(), 3);
    assert_eq!((found.sweep[0], found.sweep[2]), (0.1, 10.0));
    assert!((found.sweep[1] - 1.0).abs() < 1e-15);
    let schemes: Vec<SpectrumScheme> = found.curves.iter().map(|curve| curve.scheme).collect();
    let expected = [
        SpectrumScheme::GeneralizedAlpha { rho_inf: 0.8 },
        SpectrumScheme::NewmarkAlpha {
            alpha_m: 0.0,
            alpha_f: 0.3,
        },
        SpectrumScheme::EdAlpha {
            rho_inf: 0.0,
            alpha_ar: 1.0 / 6.0,
        },
        SpectrumScheme::Bathe,
    ];
    assert_eq!(schemes, expected);
    let region = found.region.unwrap();
    assert_eq!(region.alpha_m, [-1.0, -0.5, 0.0, 0.5]);
    assert_eq!(region.alpha_f, [-0.5, 0.0, 0.5]);
    assert_eq!(region.points[0].label, "A");

    let small =
        "[spectrum]\nname = \"a\"\n[[spectrum.curve]]\nlabel = \"b\"\nscheme = { kind = \"hets\" }";
    let small = file(small);
    assert_eq!((small.sweep.len(), small.period_to), (161, 0.5));
    assert_eq!((small.sweep[0], small.sweep[160]), (1e-2, 1e2));
    assert!(small.region.is_none());
}

#[test]
fn a_region_may_stand_alone() {
    let from = |piece| &FILE[FILE.find(piece).unwrap()..];
    let head = FILE.strip_suffix(from("from =")).unwrap();
    let region = from("[spectrum.region]");
    assert!(file(&format!("{head}{region}")).curves.is_empty());
}

#[test]
fn mistakes_have_place_value_and_help() {
    for (old, new, expected) in [
        (
            "[spectrum]",
            "[scene]\nt_end = 1\n[spectrum]",
            "spectrum.toml:1:2: `spectrum file` has no key `scene`; it has spectrum",
        ),
        ("name = \"schemes\"\n", "", "`spectrum` lacks `name`"),
        ("\"schemes\"", "\"../s\"", "is not a name"),
        ("points = 3\n", "point = 3\n", "did you mean `points`?"),
        (
            "from = 1e-1",
            "from = 0",
            "`spectrum.from` must be greater than 0 and at most 1e6, found 0",
        ),
        (
            "from = 1e-1",
            "from = 20.0",
            "`spectrum.to` must be such that from = 20.0 is less than to = 10.0, found 10",
        ),
        (
            "points = 3",
            "points = 1",
            "a whole number from 2 to 100000, found 1",
        ),
        (
            "from = 1e-1",
            "period_to = -1",
            "`spectrum.period_to` must be a finite number greater than 0, found -1",
        ),
        (
            "label = \"optimal\"",
            "label = \"ED\"",
            "spectrum.toml:16:9: `spectrum.curve[2].label` = \"ED\" is taken already by a curve in line 8",
        ),
        ("label = \"ED\"\n", "", "`spectrum.curve[2]` lacks `label`"),
        ("label = \"ED\"", "label = \"\"", "a text that is not empty"),
        (
            "scheme = { kind = \"bathe\" }",
            "",
            "for example scheme = { kind = \"generalized-alpha\", rho_inf = 0.8 }",
        ),
        ("\"bathe\"", "\"bath\"", "did you mean `bathe`?"),
        (
            "kind = \"bathe\"",
            "kind = \"bathe\", rho_inf = 0",
            "`spectrum.curve[3].scheme` has no key `rho_inf`; it has kind",
        ),
        (
            "rho_inf = 0.8",
            "rho_inf = 1.2",
            "spectrum.toml:9:50: `spectrum.curve[0].scheme.rho_inf` must be 0 to 1, found 1.2",
        ),
        (", rho_inf = 0.8", "", "for example rho_inf = 0.8"),
        (
            "alpha_f = 0.3",
            "alpha_f = 0.6",
            "must be at most 0.5, or high frequencies grow, found 0.6",
        ),
        (
            "alpha_m = 0,",
            "alpha_m = 0.4,",
            "alpha_m` must be at most alpha_f = 0.3, or high frequencies grow, found 0.4",
        ),
        (
            "rho_inf = 0 }",
            "rho_inf = 0, alpha_ar = 0 }",
            "alpha_ar` must be a finite number greater than 0, found 0",
        ),
        (
            "alpha_m = { from = 0.5, to = -1.0, points = 4 }\n",
            "",
            "`spectrum.region` lacks `alpha_m`",
        ),
        (
            "to = -1.0, points = 4",
            "to = 0.5, points = 4",
            "must be another number than `from`",
        ),
        (
            "label = \"A\"",
            "label = \"A\"\nalpha = 1",
            "`spectrum.region.point[0]` has no key `alpha`",
        ),
        (
            "[[spectrum.region.point]]",
            "[spectrum.region.point]",
            "must be tables headed [[spectrum.region.point]]",
        ),
    ] {
        assert!(FILE.contains(old), "{old}");
        let Err(errors) = parse_spectrum(&FILE.replacen(old, new, 1), "spectrum.toml") else {
            panic!("{new} is allowed");
        };
        let text = errors.to_string();
        assert!(
            text.contains(expected),
            "{expected:?} is missing in\n{text}"
        );
    }
}

#[test]
fn a_scene_and_an_empty_file_are_told_what_is_missing() {
    for text in ["", super::EXAMPLE] {
        let errors = parse_spectrum(text, "scene.toml").unwrap_err();
        assert_eq!(errors.iter().count(), 1, "{errors}");
        let text = errors.to_string();
        assert!(text.contains("`spectrum file` lacks `spectrum`"), "{text}");
        assert!(
            text.contains("[spectrum] with name, and [[spectrum.curve]]"),
            "{text}"
        );
    }
    let errors = parse_spectrum("[spectrum]\nname = \"a\"", "a.toml").unwrap_err();
    assert!(
        errors.to_string().contains("`spectrum` lacks `curve`"),
        "{errors}"
    );
}
