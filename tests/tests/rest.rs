//! Scenes that rest at rounding noise until a load sets in, and steps so short that the first ones move nothing.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_tests::runs::run;
use linchpin_tests::scenes::with_settings;

/// Two masses in a rigid link at `x0`, pulled by `load` from `from` on.
fn masses(x0: f64, load: f64, from: f64) -> String {
    let mass = |name: &str, load: &str| {
        format!(
            "[[subsystem]]\nname = \"{name}\"\nmodel = \"oscillator\"\n\
             parameters = {{ m = 1.0, c = 1.0, x0 = {x0:e}{load} }}\n"
        )
    };
    let pulled = format!(", load = {load:e}, load_from = {from:e}");
    [
        "[scene]\nname = \"rest\"\nt_end = 1.0\n".to_owned(),
        mass("m1", &pulled),
        mass("m2", ""),
        "[[joint]]\nname = \"link\"\nkind = \"rigid-link\"\na = \"m1\"\nb = \"m2\"\n".to_owned(),
    ]
    .concat()
}

const METHODS: [&str; 6] = [
    "method=weighted",
    "method=baumgarte",
    "method=hermite",
    "method=hermite degree=4",
    "method=explicit mu=10H",
    "method=penalty stiffness=1e4 damping=10",
];

/// `x = F/c (1 - cos(t - 1/2))` with the stiffness `c = 2` and the mass 2 of both.
#[test]
fn a_load_that_sets_in_at_rest_is_no_divergence() {
    for x0 in [0.0, 6.123_233_995_736_766e-17, 1e-14, 1e-12] {
        for load in [10.0, 1e-3, 1e6] {
            for method in METHODS {
                let coupling = format!("{method} macro_step=1e-3");
                let found = run(
                    &with_settings(&masses(x0, load, 0.5), &coupling, &[]),
                    Place::InProcess,
                );
                let exact = 0.5 * load * (1.0 - 0.5_f64.cos());
                let x = *found.column("m1.x").last().unwrap();
                let most = if method.contains("explicit") || method.contains("penalty") {
                    2e-2
                } else {
                    1e-5
                };
                assert!(
                    (x / exact - 1.0).abs() < most,
                    "{method}, x0 = {x0:e}, {load:e} N: {x:e}, {exact:e}"
                );
            }
        }
    }
}

/// In ten steps of a tenth of a millisecond a load that grows with the fourth power of the time moves nothing.
#[test]
fn short_steps_grow_by_powers_of_the_time() {
    for method in METHODS {
        let coupling = format!("{method} macro_step=2e-5");
        let scene = with_settings(&masses(0.0, 1.0, 3e-5), &coupling, &["scene.t_end=0.2"]);
        let found = run(&scene, Place::InProcess);
        let x = *found.column("m1.x").last().unwrap();
        let exact = 0.5 * (1.0 - 0.2_f64.cos());
        assert!((x / exact - 1.0).abs() < 2e-2, "{method}: {x:e}, {exact:e}");
    }
}
