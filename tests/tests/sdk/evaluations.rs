//! Evaluations beside a prediction.

use linchpin_proto::v1;

use crate::all_ways;
use crate::driver::{assert_misuse, oscillator};
use crate::peer::{Serve, host};
use crate::subjects::{ROUTES, advance, bits, evaluate, predict, subjects};

all_ways!(
    an_evaluation_stands_beside_a_prediction,
    an_evaluation_feels_its_inputs_at_once,
    an_evaluation_has_no_length,
    parts_that_are_not_asked_for_are_absent,
);

/// Each part has the bits that it has alone, and an evaluation is no integration.
fn an_evaluation_stands_beside_a_prediction(serve: Serve) {
    for route in ROUTES {
        for (name, instance) in subjects(serve) {
            let peer = serve(host());
            let [mut both, mut apart] = [0, 1].map(|number| route.drive(&peer, &instance, number));
            let evaluation = |end| v1::ExchangeRequest {
                evaluate: Some(evaluate(1, end)),
                ..v1::ExchangeRequest::default()
            };
            let found = both.turn(v1::ExchangeRequest {
                advance: Some(advance(0, 4.0)),
                predict: Some(predict(1, 5.0)),
                ..evaluation(6.0)
            });
            let found = found.unwrap();
            assert_eq!(found.work.unwrap().integrations, 3, "{name}, {route:?}");

            let stepped = apart.turn(v1::ExchangeRequest {
                advance: Some(advance(0, 4.0)),
                predict: Some(predict(1, 5.0)),
                ..v1::ExchangeRequest::default()
            });
            let evaluated = apart.turn(evaluation(6.0)).unwrap();
            assert_eq!(evaluated.work.unwrap().integrations, 0);
            let expected = v1::ExchangeReply {
                evaluated: evaluated.evaluated,
                evaluated_perturbed: evaluated.evaluated_perturbed,
                ..stepped.unwrap()
            };
            assert_eq!(bits(&found), bits(&expected), "{name}, {route:?}");
        }
    }
}

fn an_evaluation_feels_its_inputs_at_once(serve: Serve) {
    let peer = serve(host());
    let instance = v1::InitializeRequest {
        coupling_outputs: vec!["a".into(), "x".into()],
        recorded_outputs: vec![],
        ..oscillator(5, "radau5")
    };
    for route in ROUTES {
        let mut driver = route.drive(&peer, &instance, 0);
        let reply = driver.turn(v1::ExchangeRequest {
            evaluate: Some(evaluate(0, 41.3)),
            ..v1::ExchangeRequest::default()
        });
        let reply = reply.unwrap();
        let expected = |force: f64| (force - 1.7e5 * 0.37 + 10.3 * 2.9) / 1.3;
        let all =
            [&reply.evaluated.unwrap(), &reply.evaluated_perturbed[0]].map(|o| o.values.clone());
        for (values, force) in all.iter().zip([41.3, 41.4]) {
            let error = (values[0] / expected(force) - 1.0).abs();
            assert!(error < 1e-15 && values[1] == 0.37, "{values:?} {force}");
        }
    }
}

fn an_evaluation_has_no_length(serve: Serve) {
    let peer = serve(host());
    for route in ROUTES {
        let mut driver = route.drive(&peer, &oscillator(5, "exact"), 0);
        for (t, step) in [
            (0.0, 1.7e-3),
            (0.0, -1e-3),
            (0.0, f64::NAN),
            (f64::INFINITY, 0.0),
        ] {
            let request = v1::ExchangeRequest {
                evaluate: Some(v1::Predict {
                    t,
                    step,
                    ..evaluate(0, 1.0)
                }),
                ..v1::ExchangeRequest::default()
            };
            let words = [&*t.to_string(), &step.to_string(), "the length 0"];
            assert_misuse(driver.turn(request), "evaluate.step", &words);
        }
    }
}

/// Also in memory that an earlier answer has used.
fn parts_that_are_not_asked_for_are_absent(serve: Serve) {
    let peer = serve(host());
    for route in ROUTES {
        let mut driver = route.drive(&peer, &oscillator(5, "exact"), 0);
        let mut reply = v1::ExchangeReply::default();
        let mut turn = |request: v1::ExchangeRequest| {
            let request = v1::ExchangeRequest {
                instance: driver.instance,
                sequence: driver.next(),
                ..request
            };
            driver.calls.exchange(&request, &mut reply).unwrap();
            bits(&reply)
        };
        let all = turn(v1::ExchangeRequest {
            advance: Some(v1::Advance {
                samples: vec![1e-3],
                ..advance(0, 4.0)
            }),
            predict: Some(with_direction(predict(1, 5.0))),
            evaluate: Some(with_direction(evaluate(1, 5.0))),
            ..v1::ExchangeRequest::default()
        });
        let lengths: Vec<_> = all
            .iter()
            .map(|(name, values)| (*name, values.len()))
            .collect();
        let expected = [
            ("advanced", 3),
            ("evaluated", 2),
            ("predicted", 2),
            ("samples", 3),
            ("perturbed", 2),
            ("derivatives", 2),
            ("evaluated_perturbed", 2),
            ("evaluated_derivatives", 2),
        ];
        assert_eq!(lengths, expected);
        assert_eq!(turn(v1::ExchangeRequest::default()), []);
    }
}

fn with_direction(look: v1::Predict) -> v1::Predict {
    v1::Predict {
        directions: look.signals.clone(),
        ..look
    }
}
