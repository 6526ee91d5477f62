//! Variable macro steps in the scene.

use super::*;
use crate::methods::Baumgarte;
use crate::scene::{Formula, Method};

/// The example with `[coupling]` settings that make the macro step vary.
fn controlled(settings: &str) -> Result<Scene, SceneErrors> {
    let text = EXAMPLE.replace("macro_step = 1e-3", settings);
    parse(&text, "scene.toml", &[])
}

fn control(settings: &str) -> (f64, crate::scene::StepControl) {
    let coupling = controlled(settings).unwrap().coupling;
    (coupling.macro_step, coupling.step_control.unwrap())
}

#[test]
fn a_tolerance_makes_the_step_vary_with_defaults_by_the_simulated_time() {
    let (first, own) = control("tolerance = 1e-5");
    assert_eq!((own.tolerance, own.absolute_tolerance), (1e-5, None));
    assert_eq!(
        (own.least_step, first, own.greatest_step),
        (1e-9, 1e-4, 0.1)
    );
    assert_eq!(
        controlled("macro_step = 1e-3")
            .unwrap()
            .coupling
            .step_control,
        None
    );
}

#[test]
fn steps_that_are_given_move_the_defaults_of_the_others() {
    let (first, own) = control("tolerance = 1e-5\nmacro_step = 0.3");
    assert_eq!((first, own.greatest_step), (0.3, 0.3));
    let (first, own) = control("tolerance = 1e-5\nleast_step = 0.01");
    assert_eq!(
        (own.least_step, first, own.greatest_step),
        (0.01, 0.01, 0.1)
    );
    let (first, own) = control("tolerance = 1e-5\ngreatest_step = 1e-11");
    assert_eq!(
        (own.least_step, first, own.greatest_step),
        (1e-11, 1e-11, 1e-11)
    );
}

#[test]
fn multiples_of_a_variable_step_stay_formulas() {
    let scene = controlled("tolerance = 1e-5").unwrap();
    let scene = scene.with(&["coupling.beta=3H".parse().unwrap()]).unwrap();
    let Method::Baumgarte(Baumgarte { beta, gamma, .. }) = scene.coupling.method else {
        panic!("{:?}", scene.coupling.method)
    };
    assert_eq!((beta.at(0.25), beta.at(0.5)), (0.75, 1.5));
    assert_eq!(gamma, Formula::from(0.0));
}

#[test]
fn mistakes_of_variable_steps_are_told() {
    for (settings, words) in [
        (
            "macro_step = 1e-3\nleast_step = 1e-6",
            &["`coupling.least_step`", "`coupling.tolerance` turns on"][..],
        ),
        (
            "tolerance = 1e-13",
            &["`coupling.tolerance`", "from 1e-12", "to 0.1"],
        ),
        ("tolerance = 1", &["`coupling.tolerance`", "to 0.1"]),
        (
            "tolerance = 1e-4\nabsolute_tolerance = 0",
            &["`coupling.absolute_tolerance`", "greater than 0"],
        ),
        (
            "tolerance = 1e-4\ngreatest_step = 7",
            &[
                "`coupling.greatest_step` = 7 s",
                "at most the simulated time",
            ],
        ),
        (
            "tolerance = 1e-4\nleast_step = 1e-3\nmacro_step = 1e-4",
            &["`coupling.least_step` = 0.001 s must be at most `coupling.macro_step` = 0.0001 s"],
        ),
        (
            "tolerance = 1e-4\nleast_step = 1e-3\ngreatest_step = 1e-4",
            &[
                "`coupling.least_step` = 0.001 s must be at most `coupling.greatest_step` = 0.0001 s",
            ],
        ),
    ] {
        let error = controlled(settings).unwrap_err().to_string();
        for word in words {
            assert!(error.contains(word), "{settings}: {word}: {error}");
        }
    }
}
