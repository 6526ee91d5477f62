//! Directional derivatives.

use linchpin_proto::v1;

use crate::both_ways;
use crate::driver::{Driver, assert_misuse, constant, failure, number, oscillator, through};
use crate::in_python;
use crate::peer::{Serve, host};
use crate::subjects::{ROUTES, STEP, advance, evaluate, load, predict, subjects};

both_ways!(
    the_exact_solver_gives_the_closed_form,
    every_solver_gives_the_quotient_of_differences,
    an_evaluation_gives_the_feed_through,
    a_controller_gives_its_closed_form,
    a_derivative_needs_no_step_before_it,
    derivatives_disturb_nothing_and_are_counted_apart,
    who_does_not_offer_them_refuses,
    a_wrong_direction_is_named,
);

in_python!(
    the_exact_solver_gives_the_closed_form,
    every_solver_gives_the_quotient_of_differences,
    an_evaluation_gives_the_feed_through,
    a_derivative_needs_no_step_before_it,
    derivatives_disturb_nothing_and_are_counted_apart,
    a_wrong_direction_is_named,
);

const M: f64 = 1.3;
const C: f64 = 1.7e5;
const D: f64 = 10.3;
const PARTNER_STIFFNESS: f64 = 930.7;
const PARTNER_DAMPING: f64 = 2.9;

/// Force, position and velocity of the partner are driven.
fn instance(solver: &str) -> v1::InitializeRequest {
    let mut request = v1::InitializeRequest {
        inputs: ["f", "partner_x", "partner_v"].map(str::to_owned).into(),
        coupling_outputs: ["x", "v", "a"].map(str::to_owned).into(),
        recorded_outputs: vec![],
        ..oscillator(5, solver)
    };
    let partner = [
        ("partner_stiffness", PARTNER_STIFFNESS),
        ("partner_damping", PARTNER_DAMPING),
    ];
    let partner = partner.map(|(name, value)| (name.to_owned(), number(value)));
    request.parameters.extend(partner);
    request
}

/// Position, velocity and acceleration at the end of the step of the oscillator that starts from rest, under the force
/// 1, and under the force that is the time.
fn responses() -> [[f64; 3]; 2] {
    let (c, d) = (C + PARTNER_STIFFNESS, D + PARTNER_DAMPING);
    let (delta, t) = (d / (2.0 * M), STEP);
    let omega = (c / M - delta * delta).sqrt();
    let (sin, cos) = (omega * t).sin_cos();
    let decay = (-delta * t).exp();
    // e^(-delta t) (p cos + q sin) and its derivative.
    let free = |p: f64, q: f64| {
        let rate = (q * omega - delta * p) * cos - (p * omega + delta * q) * sin;
        [decay * (p * cos + q * sin), decay * rate]
    };
    let [x, v] = free(-1.0 / c, -delta / (c * omega));
    let constant = [x + 1.0 / c, v];
    let lag = d / (c * c);
    let [x, v] = free(lag, (delta * lag - 1.0 / c) / omega);
    let ramp = [x + t / c - lag, v + 1.0 / c];
    [(constant, 1.0), (ramp, t)].map(|([x, v], force)| [x, v, (force - c * x - d * v) / M])
}

fn with_directions(request: v1::ExchangeRequest, directions: &[v1::Signal]) -> v1::ExchangeRequest {
    let with = |look: v1::Predict| v1::Predict {
        directions: directions.to_vec(),
        ..look
    };
    v1::ExchangeRequest {
        predict: request.predict.map(with),
        evaluate: request.evaluate.map(with),
        ..request
    }
}

fn look_ahead(end: f64) -> v1::ExchangeRequest {
    v1::ExchangeRequest {
        predict: Some(predict(0, end)),
        ..v1::ExchangeRequest::default()
    }
}

fn assert_near(found: &[f64], expected: &[f64], relative: f64, what: &str) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        let error = (found / expected - 1.0).abs();
        assert!(
            error < relative,
            "{what}: {found:e} instead of {expected:e}"
        );
    }
}

fn the_exact_solver_gives_the_closed_form(serve: Serve) {
    let peer = serve(host());
    for route in ROUTES {
        let mut driver = route.drive(&peer, &instance("exact"), 0);
        let ramp = through(0, &[(STEP, STEP), (0.0, 0.0)]);
        let both = through(1, &[(0.0, 3.0), (STEP, 3.0 - 0.7 * STEP)]);
        let request = with_directions(look_ahead(4.0), &[constant(0, 1.0), ramp, both]);
        let [level, rising] = responses();
        let mixed = [0, 1, 2].map(|i| PARTNER_STIFFNESS * (3.0 * level[i] - 0.7 * rising[i]));
        let reply = driver.turn(request).unwrap();
        for (found, expected) in reply.derivatives.iter().zip([level, rising, mixed]) {
            assert_near(&found.values, &expected, 1e-12, "closed form");
        }
    }
}

/// The system is linear, so the difference of two runs is the derivative, whatever the increment.
fn every_solver_gives_the_quotient_of_differences(serve: Serve) {
    const INCREMENT: f64 = 1e6;
    let peer = serve(host());
    for route in ROUTES {
        for (solver, number) in ["exact", "radau5", "rk4"].into_iter().zip(0..) {
            let mut driver = route.drive(&peer, &instance(solver), number);
            driver
                .turn(v1::ExchangeRequest {
                    advance: Some(advance(0, 4.0)),
                    ..v1::ExchangeRequest::default()
                })
                .unwrap();
            let signals = [load(5.0), constant(1, 0.2), constant(2, -0.7)];
            let directions: Vec<v1::Signal> = (0..3)
                .map(|input| through(input, &[(0.0, 0.3), (STEP, 1.1), (-STEP, 0.9)]))
                .collect();
            let mut request = with_directions(look_ahead(5.0), &directions);
            let predict = request.predict.as_mut().unwrap();
            predict.signals = signals.to_vec();
            predict.perturbed = signals
                .iter()
                .zip(&directions)
                .map(|(signal, direction)| raised(signal, direction, INCREMENT))
                .collect();
            let reply = driver.turn(request).unwrap();
            let predicted = reply.predicted.unwrap().values;
            for (derivative, perturbed) in reply.derivatives.iter().zip(&reply.perturbed) {
                let differences = perturbed.values.iter().zip(&predicted);
                let quotients: Vec<f64> = differences.map(|(p, q)| (p - q) / INCREMENT).collect();
                assert_near(&derivative.values, &quotients, 1e-12, solver);
            }
            assert_eq!(reply.derivatives.len(), 3);
        }
    }
}

/// The signal plus `increment` times the direction, through the points of the direction.
fn raised(signal: &v1::Signal, direction: &v1::Signal, increment: f64) -> v1::Signal {
    let signal = linchpin_proto::polynomial::Polynomial::from_signal(signal).unwrap();
    let points = direction.nodes.iter().zip(&direction.values);
    let points: Vec<(f64, f64)> = points
        .map(|(&node, &value)| (node, signal.value(node) + increment * value))
        .collect();
    through(direction.input, &points)
}

fn an_evaluation_gives_the_feed_through(serve: Serve) {
    let peer = serve(host());
    for route in ROUTES {
        let mut driver = route.drive(&peer, &instance("radau5"), 0);
        let evaluation = v1::ExchangeRequest {
            evaluate: Some(evaluate(0, 4.0)),
            ..v1::ExchangeRequest::default()
        };
        let directions = [
            through(0, &[(0.0, 1.0), (STEP, 7.0)]),
            constant(1, 2.0),
            constant(2, 1.0),
        ];
        let reply = driver
            .turn(with_directions(evaluation, &directions))
            .unwrap();
        let through = [1.0 / M, 2.0 * PARTNER_STIFFNESS / M, PARTNER_DAMPING / M];
        for (found, through) in reply.evaluated_derivatives.iter().zip(through) {
            assert_eq!(found.values[..2], [0.0, 0.0]);
            assert_near(&found.values[2..], &[through], 1e-15, "feed-through");
        }
        assert_eq!(reply.evaluated_derivatives.len(), 3);
        assert_eq!(reply.work.unwrap_or_default().derivatives, 0);
    }
}

/// `control = k e + i` with `i' = q e`, `e = setpoint - measured`.
fn a_controller_gives_its_closed_form(serve: Serve) {
    const K: f64 = 7.3;
    const Q: f64 = 41.9;
    let parameters = [("proportional", K), ("integral", Q), ("integral0", 0.9)];
    let parameters = parameters.map(|(name, value)| (name.to_owned(), number(value)));
    let peer = serve(host());
    for route in ROUTES {
        for (solver, place) in ["radau5", "rk4"].into_iter().zip(0..) {
            let request = v1::InitializeRequest {
                model: "pi-controller".into(),
                parameters: parameters.clone().into(),
                inputs: vec!["measured".into()],
                coupling_outputs: vec!["control".into()],
                recorded_outputs: vec![],
                ..oscillator(5, solver)
            };
            let mut driver = route.drive(&peer, &request, place);
            let rising = through(0, &[(0.0, 0.2), (STEP, 1.3)]);
            let request = v1::ExchangeRequest {
                evaluate: Some(evaluate(0, 4.0)),
                ..look_ahead(4.0)
            };
            let reply = driver.turn(with_directions(request, &[rising])).unwrap();
            let mean = 0.5 * (0.2 + 1.3);
            let expected = -K * 1.3 - Q * mean * STEP;
            assert_near(&reply.derivatives[0].values, &[expected], 1e-14, solver);
            let direct = &reply.evaluated_derivatives[0].values;
            assert_near(direct, &[-K * 0.2], 1e-15, solver);
        }
    }
}

/// The adaptive solver has no internal steps yet that it could take again.
fn a_derivative_needs_no_step_before_it(serve: Serve) {
    let peer = serve(host());
    for (solver, number) in ["exact", "radau5", "rk4"].into_iter().zip(5..) {
        let request = v1::InitializeRequest {
            instance: number,
            ..instance(solver)
        };
        let mut driver = Driver::initialize(peer.calls(), &request);
        let mut derivatives = || {
            let mut request = driver.perturbed_request(STEP, vec![load(4.0)], vec![]);
            request.directions = vec![load(1.0)];
            driver.calls.perturbed_step(&request).unwrap().derivatives
        };
        let first = derivatives();
        assert_eq!(derivatives(), first, "{solver}");
        let reply = driver.turn(with_directions(look_ahead(4.0), &[load(1.0)]));
        assert_eq!(reply.unwrap().derivatives, first, "{solver}");
    }
}

fn derivatives_disturb_nothing_and_are_counted_apart(serve: Serve) {
    let peer = serve(host());
    for route in ROUTES {
        for (solver, place) in ["exact", "radau5", "rk4"].into_iter().zip(0..) {
            let [mut plain, mut asked] =
                [0, 1].map(|number| route.drive(&peer, &instance(solver), 2 * place + number));
            for number in 0..3 {
                let request = v1::ExchangeRequest {
                    advance: Some(advance(number, 4.0)),
                    evaluate: Some(evaluate(number + 1, 4.0)),
                    predict: Some(predict(number + 1, 5.0)),
                    ..v1::ExchangeRequest::default()
                };
                let expected = plain.turn(request.clone()).unwrap();
                let found = asked.turn(with_directions(request, &[load(1.0), constant(1, 0.3)]));
                let mut found = found.unwrap();
                let counts = |reply: &v1::ExchangeReply| {
                    let work = reply.work.unwrap();
                    [work.integrations, work.derivatives]
                };
                assert_eq!([counts(&expected), counts(&found)], [[3, 0], [3, 2]]);
                found.derivatives.clear();
                found.evaluated_derivatives.clear();
                found.work = expected.work;
                found.instance = expected.instance;
                assert_eq!(found, expected, "{solver}, {route:?}");
            }
        }
    }
}

fn who_does_not_offer_them_refuses(serve: Serve) {
    let peer = serve(host());
    let described = failure(peer.calls().describe(&v1::DescribeRequest::default()));
    let offering: Vec<String> = { described.unwrap().models.into_iter() }
        .filter(|model| model.capabilities.unwrap().directional_derivatives)
        .map(|model| model.name)
        .collect();
    assert_eq!(offering, ["oscillator", "pi-controller"]);
    for route in ROUTES {
        for (place, (name, instance)) in (0..).zip(subjects(serve)) {
            let mut driver = route.drive(&peer, &instance, place);
            let evaluation = v1::ExchangeRequest {
                evaluate: Some(evaluate(0, 0.5)),
                ..v1::ExchangeRequest::default()
            };
            for request in [look_ahead(0.5), evaluation] {
                let answer = driver.turn(with_directions(request, &[constant(0, 1.0)]));
                if offering.contains(&instance.model) {
                    answer.unwrap();
                } else {
                    let words = ["does not offer directional derivatives"];
                    assert_misuse(answer, "directions", &words);
                }
            }
            driver
                .turn(look_ahead(0.5))
                .unwrap_or_else(|failure| panic!("{name}: {failure:?}"));
        }
    }
}

fn a_wrong_direction_is_named(serve: Serve) {
    let peer = serve(host());
    for route in ROUTES {
        let mut driver = route.drive(&peer, &instance("exact"), 0);
        for (direction, word) in [
            (constant(3, 1.0), "input 3"),
            (constant(0, f64::NAN), "not a finite number"),
            (through(0, &[(0.0, 1.0), (0.0, 2.0)]), "coincide"),
        ] {
            let request = with_directions(look_ahead(1.0), &[direction]);
            assert_misuse(driver.turn(request), "directions", &[word]);
        }
    }
}
