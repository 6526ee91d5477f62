//! Integrals of outputs over a step.

use linchpin_proto::v1;
use linchpin_proto::weights::{MAX_WEIGHTS, legendre};

use crate::all_ways;
use crate::driver::{assert_misuse, failure, oscillator, tank, through};
use crate::peer::{Serve, host};
use crate::subjects::{ROUTES, STEP, Subject, advance, bits, load, predict, subjects};

all_ways!(
    they_are_those_of_the_outputs,
    a_step_that_is_cut_has_the_integrals_of_the_whole,
    perturbed_steps_and_directions_have_their_own,
    both_routes_have_equal_bits,
    a_step_that_is_taken_again_has_the_same,
    an_evaluation_has_none,
    what_is_not_offered_is_refused,
    more_than_there_are_weights_for_are_refused,
);

const WEIGHTS: u32 = 4;

/// Subjects that offer integrals, with all coupling outputs integrated and told at instants.
fn offering(serve: Serve) -> impl Iterator<Item = Subject> {
    let offering = subjects(serve)
        .into_iter()
        .filter(|(name, _)| *name != "tank");
    offering.map(|(name, instance)| (name, integrated(&instance)))
}

fn integrated(instance: &v1::InitializeRequest) -> v1::InitializeRequest {
    v1::InitializeRequest {
        integrated_outputs: instance.coupling_outputs.clone(),
        interior_outputs: instance.coupling_outputs.clone(),
        ..instance.clone()
    }
}

fn looking(number: u32, end: f64) -> v1::ExchangeRequest {
    v1::ExchangeRequest {
        predict: Some(v1::Predict {
            integrals: WEIGHTS,
            ..predict(number, end)
        }),
        ..v1::ExchangeRequest::default()
    }
}

fn advancing(number: u32, end: f64) -> v1::ExchangeRequest {
    v1::ExchangeRequest {
        advance: Some(v1::Advance {
            integrals: WEIGHTS,
            ..advance(number, end)
        }),
        ..looking(number + 1, end)
    }
}

/// How far integrals may be off, of the size of the output: rounding, or what a solver leaves. One that controls its
/// error does not control that of integrals.
fn allowed(name: &str) -> f64 {
    match name {
        "exact oscillator" => 1e-12,
        "oscillator with fixed steps" => 1e-5,
        _ => 1e-5,
    }
}

/// Parts of a step with Gauss's formula on each.
const PARTS: u32 = 4;

/// Gauss's formula with five points on each of the parts of [0, 1].
fn gauss() -> Vec<[f64; 2]> {
    let root = |sign: f64| (5.0 + sign * 2.0 * (10.0f64 / 7.0).sqrt()).sqrt() / 3.0;
    let weight = |sign: f64| (322.0 - sign * 13.0 * 70.0f64.sqrt()) / 900.0;
    let [far, near] = [1.0, -1.0].map(|sign| [root(sign), weight(sign)]);
    let mirrored = |[x, weight]: [f64; 2]| [-x, weight];
    let points = [
        mirrored(far),
        mirrored(near),
        [0.0, 128.0 / 225.0],
        near,
        far,
    ];
    let of_part = |part: u32| {
        let length = 1.0 / f64::from(PARTS);
        points.map(|[x, weight]| {
            [
                (f64::from(part) + 0.5 + x / 2.0) * length,
                weight / 2.0 * length,
            ]
        })
    };
    (0..PARTS).flat_map(of_part).collect()
}

/// By outputs at the points of Gauss's formula.
fn they_are_those_of_the_outputs(serve: Serve) {
    for route in ROUTES {
        for (name, instance) in offering(serve) {
            let peer = serve(host());
            let outputs = instance.coupling_outputs.len();
            let mut driver = route.drive(&peer, &instance, 0);
            let mut at_points = route.drive(&peer, &instance, 1);
            let mut request = looking(0, 4.0);
            let predict = request.predict.as_mut().unwrap();
            predict.integrals = 0;
            predict.instants = gauss().iter().map(|[node, _]| node * STEP).collect();
            let told = at_points.turn(request).unwrap().predicted.unwrap().values;
            let mut expected = vec![0.0; outputs * WEIGHTS as usize];
            for ([node, weight], values) in gauss().iter().zip(told[outputs..].chunks(outputs)) {
                let mut polynomials = [0.0; WEIGHTS as usize];
                legendre(*node, &mut polynomials);
                for (sums, polynomial) in expected.chunks_mut(outputs).zip(polynomials) {
                    for (sum, value) in sums.iter_mut().zip(values) {
                        *sum += weight * polynomial * value;
                    }
                }
            }
            let answer = driver.turn(looking(0, 4.0)).unwrap();
            let found = answer.predicted.unwrap().values;
            assert_eq!(found.len(), outputs + expected.len(), "{name}");
            let allowed = allowed(name);
            for place in 0..expected.len() {
                let of_output = told[outputs + place % outputs..].iter().step_by(outputs);
                let size = of_output.fold(0.1f64, |size, value| size.max(value.abs()));
                let (found, expected) = (found[outputs + place], expected[place]);
                assert!(
                    (found - expected).abs() < allowed * size,
                    "{name}, {route:?}, {place}: {found:e} {expected:e}"
                );
            }
        }
    }
}

fn a_step_that_is_cut_has_the_integrals_of_the_whole(serve: Serve) {
    for route in ROUTES {
        for (name, instance) in offering(serve) {
            let peer = serve(host());
            let [whole, cut] = [&[][..], &[0.2 * STEP, 0.71 * STEP]].map(|instants| {
                let mut driver = route.drive(&peer, &instance, instants.len() as u64);
                let mut request = looking(0, 4.0);
                request.predict.as_mut().unwrap().instants = instants.to_vec();
                let answer = driver.turn(request).unwrap();
                [
                    answer.predicted.unwrap().values,
                    answer.perturbed[0].values.clone(),
                ]
            });
            let outputs = instance.coupling_outputs.len();
            let integrals = outputs..outputs * (1 + WEIGHTS as usize);
            let allowed = allowed(name);
            for (whole, cut) in whole.iter().zip(&cut) {
                assert_eq!(cut.len(), whole.len() + 2 * outputs, "{name}");
                for place in integrals.clone() {
                    let size = whole[place % outputs].abs() + 0.1;
                    let off = (whole[place] - cut[place]).abs();
                    assert!(off < allowed * size, "{name}, {route:?}, {place}: {off:e}");
                }
            }
        }
    }
}

/// Derivatives are quotients of differences, which for a linear subject are exact.
fn perturbed_steps_and_directions_have_their_own(serve: Serve) {
    for route in ROUTES {
        for solver in ["exact", "radau5", "rk4"] {
            let peer = serve(host());
            let mut driver = route.drive(&peer, &integrated(&oscillator(5, solver)), 0);
            let direction = through(0, &[(0.0, 1.0), (STEP, 2.0)]);
            let mut raised = load(4.0);
            for (node, value) in raised.nodes.iter().zip(&mut raised.values) {
                *value += 10.0 * (1.0 + node / STEP);
            }
            let mut request = looking(0, 4.0);
            let predict = request.predict.as_mut().unwrap();
            predict.perturbed = vec![load(4.0), raised];
            predict.directions = vec![direction];
            let answer = driver.turn(request).unwrap();
            let from = answer.predicted.unwrap();
            // With the signal of the step itself nothing changes, to the bit.
            assert_eq!(answer.perturbed[0], from, "{solver}");
            let (to, found) = (&answer.perturbed[1].values, &answer.derivatives[0].values);
            assert_eq!(found.len(), from.values.len(), "{solver}");
            let largest = found
                .iter()
                .fold(0.0f64, |most, value| most.max(value.abs()));
            for ((from, to), found) in from.values.iter().zip(to).zip(found) {
                let off = (found - (to - from) / 10.0).abs();
                assert!(
                    off < 1e-8 * largest,
                    "{solver}, {route:?}: {off:e} {found:e}"
                );
            }
        }
    }
}

fn both_routes_have_equal_bits(serve: Serve) {
    for (name, instance) in offering(serve) {
        let peer = serve(host());
        let [fused, unary] = ROUTES.map(|route| {
            let mut driver = route.drive(&peer, &instance, 0);
            let mut answers = vec![driver.turn(looking(0, 3.0)).unwrap()];
            for number in 0..3 {
                let end = 4.0 + f64::from(number);
                answers.push(driver.turn(advancing(number, end)).unwrap());
            }
            answers.iter().map(bits).collect::<Vec<_>>()
        });
        assert_eq!(fused, unary, "{name}");
    }
}

/// Integrals belong to no state: from one that is taken back or restored they come again, whatever was integrated in between.
fn a_step_that_is_taken_again_has_the_same(serve: Serve) {
    for route in ROUTES {
        for (name, instance) in offering(serve) {
            let peer = serve(host());
            let mut driver = route.drive(&peer, &instance, 0);
            driver.turn(looking(0, 3.0)).unwrap();
            let first = driver.turn(advancing(0, 4.0)).unwrap();
            let back = |end: f64| v1::ExchangeRequest {
                go_back: true,
                ..advancing(0, end)
            };
            let mut other = back(7.0);
            other.advance.as_mut().unwrap().integrals = 1;
            let other = driver.turn(other).unwrap();
            assert_ne!(other.advanced, first.advanced, "{name}");
            let again = driver.turn(back(4.0)).unwrap();
            assert_eq!(bits(&again), bits(&first), "{name}, {route:?}");
        }
    }
}

fn an_evaluation_has_none(serve: Serve) {
    let peer = serve(host());
    for route in ROUTES {
        let instance = integrated(&oscillator(5, "exact"));
        let mut driver = route.drive(&peer, &instance, 0);
        let request = v1::ExchangeRequest {
            predict: Some(v1::Predict {
                step: 0.0,
                signals: vec![through(0, &[(0.0, 4.0)])],
                ..v1::Predict::default()
            }),
            ..looking(0, 4.0)
        };
        let answer = driver.turn(request).unwrap();
        let outputs = instance.coupling_outputs.len();
        assert_eq!(answer.predicted.unwrap().values.len(), outputs);
    }
}

fn what_is_not_offered_is_refused(serve: Serve) {
    let peer = serve(host());
    let error = failure(peer.calls().initialize(&integrated(&tank(5))));
    let words = ["tank", "does not offer integrals", "output_integrals"];
    assert_misuse(error, "integrated_outputs", &words);
    let unknown = v1::InitializeRequest {
        integrated_outputs: vec!["y".into()],
        ..oscillator(6, "exact")
    };
    let error = failure(peer.calls().initialize(&unknown));
    assert_misuse(error, "integrated_outputs", &["y"]);
}

fn more_than_there_are_weights_for_are_refused(serve: Serve) {
    let peer = serve(host());
    let too_many = MAX_WEIGHTS as u32 + 1;
    for route in ROUTES {
        let mut driver = route.drive(&peer, &integrated(&oscillator(5, "exact")), 0);
        let words = [&*too_many.to_string(), &MAX_WEIGHTS.to_string()];
        let mut request = looking(0, 4.0);
        request.predict.as_mut().unwrap().integrals = too_many;
        assert_misuse(driver.turn(request), "integrals", &words);
        let mut request = advancing(0, 4.0);
        request.advance.as_mut().unwrap().integrals = too_many;
        assert_misuse(driver.turn(request), "integrals", &words);
        driver.turn(advancing(0, 4.0)).unwrap();
    }
}
