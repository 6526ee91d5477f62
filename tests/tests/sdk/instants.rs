//! Outputs at instants inside a step.

use linchpin_proto::v1;

use crate::all_ways;
use crate::driver::{assert_misuse, oscillator, through};
use crate::peer::{Serve, host};
use crate::subjects::{ROUTES, STEP, advance, load, predict, subjects};

all_ways!(
    a_step_goes_from_instant_to_instant,
    perturbed_steps_are_cut_like_the_step,
    both_routes_have_equal_bits,
    derivatives_at_instants_are_quotients_of_differences,
    instants_outside_of_their_step_or_out_of_order_are_refused,
);

const INSTANTS: [f64; 3] = [0.13 * STEP, 0.5 * STEP, 0.97 * STEP];

/// The instance, with its first coupling output told inside a step.
fn inside(instance: &v1::InitializeRequest) -> v1::InitializeRequest {
    v1::InitializeRequest {
        interior_outputs: instance.coupling_outputs[..1].to_vec(),
        ..instance.clone()
    }
}

fn looking(number: u32, end: f64) -> v1::ExchangeRequest {
    v1::ExchangeRequest {
        predict: Some(v1::Predict {
            instants: INSTANTS.to_vec(),
            ..predict(number, end)
        }),
        ..v1::ExchangeRequest::default()
    }
}

fn advancing(number: u32, end: f64) -> v1::ExchangeRequest {
    v1::ExchangeRequest {
        advance: Some(v1::Advance {
            instants: INSTANTS.to_vec(),
            ..advance(number, end)
        }),
        ..looking(number + 1, end)
    }
}

/// The outputs of an advance in four steps, from instant to instant, all under the polynomial of the whole.
fn by_hand(mut turn: impl FnMut(v1::Advance) -> Vec<f64>) -> (Vec<f64>, Vec<f64>) {
    let (mut inside, mut end) = (Vec::new(), Vec::new());
    let starts = [0.0, INSTANTS[0], INSTANTS[1], INSTANTS[2]];
    let ends = [INSTANTS[0], INSTANTS[1], INSTANTS[2], STEP];
    for (from, to) in starts.into_iter().zip(ends) {
        let mut signal = load(4.0);
        signal.nodes.iter_mut().for_each(|node| *node -= from);
        end = turn(v1::Advance {
            t: from,
            step: to - from,
            signals: vec![signal],
            ..v1::Advance::default()
        });
        inside.push(end[0]);
    }
    inside.pop();
    (end, inside)
}

fn a_step_goes_from_instant_to_instant(serve: Serve) {
    for route in ROUTES {
        for (name, instance) in subjects(serve) {
            let peer = serve(host());
            let mut cut = route.drive(&peer, &inside(&instance), 0);
            let mut parts = route.drive(&peer, &instance, 1);
            let (end, at_instants) = by_hand(|advance| {
                let request = v1::ExchangeRequest {
                    advance: Some(advance),
                    ..v1::ExchangeRequest::default()
                };
                parts.turn(request).unwrap().advanced.unwrap().values
            });
            let answer = cut.turn(advancing(0, 4.0)).unwrap();
            let expected = [end, at_instants].concat();
            assert_eq!(
                answer.advanced.unwrap().values,
                expected,
                "{name}, {route:?}"
            );
        }
    }
}

/// With the signal of the step itself in place of its perturbed one nothing changes, to the bit.
fn perturbed_steps_are_cut_like_the_step(serve: Serve) {
    for route in ROUTES {
        for (name, instance) in subjects(serve) {
            let peer = serve(host());
            let mut driver = route.drive(&peer, &inside(&instance), 0);
            let mut request = looking(0, 4.0);
            let predict = request.predict.as_mut().unwrap();
            predict.perturbed.insert(0, load(4.0));
            let answer = driver.turn(request).unwrap();
            let predicted = answer.predicted.unwrap();
            assert_eq!(
                predicted.values.len(),
                instance.coupling_outputs.len() + INSTANTS.len()
            );
            assert_eq!(answer.perturbed[0], predicted, "{name}, {route:?}");
            assert_ne!(answer.perturbed[1], predicted, "{name}, {route:?}");
            assert_eq!(answer.perturbed[1].values.len(), predicted.values.len());
        }
    }
}

fn both_routes_have_equal_bits(serve: Serve) {
    for (name, instance) in subjects(serve) {
        let peer = serve(host());
        let [fused, unary] = ROUTES.map(|route| {
            let mut driver = route.drive(&peer, &inside(&instance), 0);
            let mut answers = vec![driver.turn(looking(0, 3.0)).unwrap()];
            for number in 0..3 {
                answers.push(
                    driver
                        .turn(advancing(number, 4.0 + f64::from(number)))
                        .unwrap(),
                );
            }
            answers
                .into_iter()
                .map(|answer| (answer.advanced, answer.predicted, answer.perturbed))
                .collect::<Vec<_>>()
        });
        assert_eq!(fused, unary, "{name}");
    }
}

fn derivatives_at_instants_are_quotients_of_differences(serve: Serve) {
    for route in ROUTES {
        for solver in ["exact", "radau5", "rk4"] {
            let peer = serve(host());
            let mut driver = route.drive(&peer, &inside(&oscillator(5, solver)), 0);
            let direction = through(0, &[(0.0, 1.0), (STEP, 2.0)]);
            let mut raised = load(4.0);
            for (node, value) in raised.nodes.iter().zip(&mut raised.values) {
                *value += 10.0 * (1.0 + node / STEP);
            }
            let mut request = looking(0, 4.0);
            let predict = request.predict.as_mut().unwrap();
            predict.perturbed = vec![raised];
            predict.directions = vec![direction];
            let answer = driver.turn(request).unwrap();
            let (from, to) = (answer.predicted.unwrap(), &answer.perturbed[0]);
            let found = &answer.derivatives[0].values;
            assert_eq!(found.len(), from.values.len());
            for ((from, to), found) in from.values.iter().zip(&to.values).zip(found) {
                let quotient = (to - from) / 10.0;
                // Parts of a step have internal steps of their own.
                assert!(
                    (found - quotient).abs() < 2e-2 * found.abs() + 1e-12,
                    "{solver}: {found:e} {quotient:e}"
                );
            }
        }
    }
}

fn instants_outside_of_their_step_or_out_of_order_are_refused(serve: Serve) {
    let peer = serve(host());
    for route in ROUTES {
        let mut driver = route.drive(&peer, &inside(&oscillator(5, "exact")), 0);
        let wrong: [(&[f64], usize); 4] = [
            (&[0.0], 0),
            (&[1e-4, STEP], 1),
            (&[1e-4, 1e-4], 1),
            (&[f64::NAN], 0),
        ];
        for (instants, place) in wrong {
            let words = [
                &*format!("instant {place} is {}", instants[place]),
                &STEP.to_string(),
            ];
            let mut request = looking(0, 4.0);
            request.predict.as_mut().unwrap().instants = instants.to_vec();
            assert_misuse(driver.turn(request), "instants", &words);
            let mut request = advancing(0, 4.0);
            request.advance.as_mut().unwrap().instants = instants.to_vec();
            assert_misuse(driver.turn(request), "instants", &words);
        }
        driver.turn(advancing(0, 4.0)).unwrap();
    }
}
