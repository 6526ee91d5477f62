//! Any value of any key is taken or refused, and what is taken steps or fails with a message: nothing panics.

use linchpin_worker::Inputs;

use crate::FORMULATIONS;
use crate::common::body::model;
use crate::common::mechanisms::Given::{List as L, Number as N, Text as T};
use crate::common::mechanisms::{
    Composition, Given, PLANAR_TREE, SHAKEN_CRANK, SLIDER_CRANK, SPATIAL_LOOP, SPATIAL_TREE,
    values, with,
};
use crate::common::{Solver, build_values, interval};

const EXTREMES: [Given; 14] = [
    N(0.0),
    N(-1.0),
    N(1e300),
    N(1e-300),
    N(f64::NAN),
    N(f64::NEG_INFINITY),
    T(""),
    T("ground"),
    L(&[]),
    L(&[0.0, 0.0]),
    L(&[1e300, -1e300, 1e300]),
    L(&[1e-300, 1e-300, 1e-300]),
    L(&[0.0, 0.0, 0.0, 0.0]),
    L(&[1e300, 1e300, 1e300, 1e300]),
];

/// Whether the composition is taken; then it has stepped.
fn is_taken(name: &str, composition: &[(&str, Given)]) -> bool {
    let model = model(name);
    let given = values(composition);
    let Ok(description) = model.describe_with(&given) else {
        return false;
    };
    let solver = Solver("rk4", &[("step", 1e-3)]);
    let Ok(mut run) = build_values(&*model, given, solver) else {
        return false;
    };
    let inputs = vec![0.3; description.inputs.len()];
    let outputs: Vec<usize> = (0..description.outputs.len()).collect();
    let mut read = vec![0.0; outputs.len()];
    let stepped = run.step(interval(0.0, 2e-3), &Inputs::constant(&inputs));
    let told = run.outputs(2e-3, &inputs, &outputs, &mut read);
    for failure in [stepped.err(), told.err()].into_iter().flatten() {
        assert!(failure.to_string().len() > 20, "{failure}");
    }
    true
}

#[test]
fn every_key_may_have_any_value() {
    let compositions: [(&str, Composition); 5] = [
        ("planar-multibody", SLIDER_CRANK),
        ("planar-multibody", PLANAR_TREE),
        ("planar-multibody", SHAKEN_CRANK),
        ("spatial-multibody", SPATIAL_LOOP),
        ("spatial-multibody", SPATIAL_TREE),
    ];
    let (mut taken, mut refused) = (0, 0);
    for (name, composition) in compositions {
        for formulation in FORMULATIONS {
            let composition = with(composition, &[("formulation", T(formulation))]);
            for (key, _) in &composition {
                for extreme in EXTREMES {
                    let changed = with(&composition, &[(*key, extreme)]);
                    if is_taken(name, &changed) {
                        taken += 1;
                    } else {
                        refused += 1;
                    }
                }
            }
        }
    }
    println!("{taken} taken, {refused} refused");
    assert!(taken > 200 && refused > 2000, "{taken} {refused}");
}
