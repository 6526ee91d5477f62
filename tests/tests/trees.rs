//! More than two subsystems: chains and stars of oscillators against their closed form.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_tests::convergence::{Study, assert_orders};
use linchpin_tests::errors::{Errors, closed_form};
use linchpin_tests::masses::{FOUR, scene_text};
use linchpin_tests::runs::run;
use linchpin_tests::scenes::with_settings;

const MACRO_STEPS: [f64; 4] = [1e-3, 5e-4, 2.5e-4, 1.25e-4];

/// The orders are those of two masses (`shortened_steps.rs`).
const ORDERS: [(&str, [f64; 3]); 8] = [
    (
        "method=weighted index=1 a=2 b=2.6 degree=0",
        [3.0, 2.0, 1.0],
    ),
    (
        "method=weighted index=1 a=2 b=2.6 degree=1",
        [4.0, 4.0, 2.0],
    ),
    (
        "method=weighted index=1 a=2 b=2.6 degree=2",
        [5.0, 4.0, 3.0],
    ),
    (
        "method=baumgarte index=1 beta=2e-1 gamma=1e-2 degree=2",
        [3.0, 3.0, 3.0],
    ),
    (
        "method=baumgarte index=1 beta=2H gamma=H^2 degree=1",
        [4.0, 4.0, 2.0],
    ),
    (
        "method=baumgarte index=2 beta=2e-1 degree=0",
        [2.0, 2.0, 1.0],
    ),
    ("method=weighted index=3 degree=0", [4.0, 2.0, 1.0]),
    ("method=explicit mu=1e-2", [1.0, 1.0, 1.0]),
];

#[test]
fn a_chain_of_three() {
    assert_orders_of(3, &[(0, 1), (1, 2)]);
}

/// The links meet at mass 1, once as end b.
#[test]
fn a_star_of_four() {
    assert_orders_of(4, &[(0, 1), (2, 0), (0, 3)]);
}

fn assert_orders_of(masses: usize, links: &[(usize, usize)]) {
    let order: Vec<usize> = (0..masses).collect();
    let text = scene_text(&FOUR[..masses], links, &order);
    let names: Vec<String> = (1..=masses)
        .map(|number| format!("\"mass{number}.v\""))
        .collect();
    let velocities = format!("output.variables=[{}]", names.join(", "));
    assert_orders(&ORDERS, 0.15, |coupling| {
        Study::new(&MACRO_STEPS, |h| {
            let coupling = format!("{coupling} macro_step={h:e}");
            let scene = with_settings(&text, &coupling, &[&velocities]);
            Errors::of(
                &run(&scene, Place::InProcess).settled(),
                closed_form(&scene),
            )
        })
    });
}
