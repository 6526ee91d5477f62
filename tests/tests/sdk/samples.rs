//! Samples: outputs inside a macro step.

use linchpin_proto::v1;

use crate::all_ways;
use crate::driver::{assert_misuse, oscillator, tank, through};
use crate::peer::{Serve, host};
use crate::subjects::{ROUTES, STEP, advance, bits, evaluate, predict, subjects};

all_ways!(
    samples_disturb_nothing,
    a_sample_is_the_end_of_a_shorter_step,
    samples_outside_of_their_step_or_out_of_order_are_refused,
    a_sample_that_fails_fails_the_request,
);

const SAMPLES: [f64; 3] = [0.13 * STEP, 0.5 * STEP, 0.97 * STEP];

fn sampled(number: u32, end: f64, samples: &[f64]) -> v1::ExchangeRequest {
    v1::ExchangeRequest {
        advance: Some(v1::Advance {
            samples: samples.to_vec(),
            ..advance(number, end)
        }),
        ..v1::ExchangeRequest::default()
    }
}

fn samples_disturb_nothing(serve: Serve) {
    for route in ROUTES {
        for (name, instance) in subjects(serve) {
            let peer = serve(host());
            let [mut plain, mut watched] =
                [0, 1].map(|number| route.drive(&peer, &instance, number));
            for number in 0..3 {
                let end = 4.0 + f64::from(number);
                let request = |samples| v1::ExchangeRequest {
                    evaluate: Some(evaluate(number + 1, end)),
                    predict: Some(predict(number + 1, end)),
                    go_back: number == 2,
                    ..sampled(number.min(1), end, samples)
                };
                let expected = plain.turn(request(&[])).unwrap();
                let mut found = watched.turn(request(&SAMPLES)).unwrap();
                let integrations = |reply: &v1::ExchangeReply| reply.work.unwrap().integrations;
                assert_eq!(integrations(&expected), 3);
                assert_eq!(integrations(&found), 3 + SAMPLES.len() as u64);
                found.samples.clear();
                assert_eq!(bits(&found), bits(&expected), "{name}, {route:?}");
            }
        }
    }
}

fn a_sample_is_the_end_of_a_shorter_step(serve: Serve) {
    for route in ROUTES {
        for (name, instance) in subjects(serve) {
            let peer = serve(host());
            let mut watched = route.drive(&peer, &instance, 0);
            let answer = watched.turn(sampled(0, 4.0, &SAMPLES)).unwrap();
            assert_eq!(answer.samples.len(), SAMPLES.len());
            for ((sample, number), found) in SAMPLES.into_iter().zip(1..).zip(&answer.samples) {
                let mut alone = route.drive(&peer, &instance, number);
                let request = v1::ExchangeRequest {
                    advance: Some(v1::Advance {
                        step: sample,
                        ..advance(0, 4.0)
                    }),
                    ..v1::ExchangeRequest::default()
                };
                let expected = alone.turn(request).unwrap().advanced.unwrap();
                assert_eq!(*found, expected, "{name}, {route:?}");
                assert_ne!(Some(found), answer.advanced.as_ref());
            }
        }
    }
}

fn samples_outside_of_their_step_or_out_of_order_are_refused(serve: Serve) {
    let peer = serve(host());
    for route in ROUTES {
        let mut driver = route.drive(&peer, &oscillator(5, "exact"), 0);
        let wrong: [(&[f64], usize); 7] = [
            (&[0.0], 0),
            (&[-1e-4], 0),
            (&[1e-3, STEP], 1),
            (&[1e-3, 3e-3], 1),
            (&[1e-3, 1.1e-3, 1.05e-3], 2),
            (&[1e-3, 1e-3], 1),
            (&[f64::NAN], 0),
        ];
        for (samples, place) in wrong {
            let words = [
                &*format!("sample {place} is {}", samples[place]),
                &STEP.to_string(),
            ];
            assert_misuse(
                driver.turn(sampled(0, 4.0, samples)),
                "advance.samples",
                &words,
            );
        }
        let untouched = route.drive(&peer, &oscillator(5, "exact"), 1);
        let [found, expected] =
            [driver, untouched].map(|mut driver| bits(&driver.turn(sampled(0, 4.0, &[])).unwrap()));
        assert_eq!(found, expected);
    }
}

/// The tank overflows in the middle of a step at whose end it would not.
fn a_sample_that_fails_fails_the_request(serve: Serve) {
    let peer = serve(host());
    for route in ROUTES {
        let [mut plain, mut driver] = [0, 1].map(|number| route.drive(&peer, &tank(5), number));
        let swelling = |samples: &[f64]| v1::ExchangeRequest {
            advance: Some(v1::Advance {
                t: 0.0,
                step: 1.0,
                signals: vec![through(0, &[(0.0, 10.0), (0.5, 0.0), (1.0, -10.0)])],
                samples: samples.to_vec(),
                ..v1::Advance::default()
            }),
            ..v1::ExchangeRequest::default()
        };
        let failure = driver.turn(swelling(&[0.25, 0.5])).unwrap_err();
        assert!(failure.message.contains("overflows"), "{failure:?}");
        assert_eq!((failure.t, failure.step), (Some(0.5), Some(0.5)));
        let [expected, found] = [&mut plain, &mut driver]
            .map(|driver| bits(&driver.turn(swelling(&[0.25])).unwrap())[0].clone());
        assert_eq!(found, expected, "{route:?}");
    }
}
