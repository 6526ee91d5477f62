//! An advance that is taken back.

use linchpin_proto::v1;

use crate::all_ways;
use crate::driver::{assert_misuse, constant, exchange, tank};
use crate::peer::{Serve, host};
use crate::subjects::{ROUTES, Route, Subject, advance, bits, evaluate, predict, subjects};
use crate::tank::START;

all_ways!(
    an_advance_that_was_taken_back_leaves_no_trace,
    one_advance_is_taken_back_and_not_two,
    nothing_is_taken_back_after_a_restore,
    a_repeated_number_goes_back_once,
    a_failed_request_to_go_back_changes_nothing,
    a_plain_step_is_taken_back_as_well,
);

fn step(number: u32, end: f64) -> v1::ExchangeRequest {
    v1::ExchangeRequest {
        advance: Some(advance(number, end)),
        ..v1::ExchangeRequest::default()
    }
}

/// A step, and what a method may ask after it.
fn look(number: u32, end: f64) -> v1::ExchangeRequest {
    v1::ExchangeRequest {
        evaluate: Some(evaluate(number + 1, end)),
        predict: Some(predict(number + 1, end)),
        ..step(number, end)
    }
}

fn back(request: v1::ExchangeRequest) -> v1::ExchangeRequest {
    v1::ExchangeRequest {
        go_back: true,
        ..request
    }
}

fn only_back() -> v1::ExchangeRequest {
    back(v1::ExchangeRequest::default())
}

fn an_advance_that_was_taken_back_leaves_no_trace(serve: Serve) {
    let peer = serve(host());
    for (route, (place, (name, instance))) in pairs(subjects(serve)) {
        let mut straight = route.drive(&peer, &instance, 2 * place);
        let mut wandering = route.drive(&peer, &instance, 2 * place + 1);
        let mut same = |detour: &[v1::ExchangeRequest], last: v1::ExchangeRequest| {
            for request in detour {
                wandering.turn(request.clone()).unwrap();
            }
            let direct = v1::ExchangeRequest {
                go_back: false,
                ..last.clone()
            };
            let expected = bits(&straight.turn(direct).unwrap());
            let found = bits(&wandering.turn(last).unwrap());
            assert_eq!(found, expected, "{name}, {route:?}");
        };
        // Back to the start, in one request with another advance; then alone.
        same(&[look(0, -31.0)], back(step(0, 4.0)));
        same(&[look(1, 9.3), only_back()], look(1, 6.0));
        // One step again and again.
        let again = |end| back(look(2, end));
        same(&[step(2, 7.1), again(5.0), again(7.3)], again(7.0));
        same(&[], look(3, 8.0));
    }
}

/// Every route with every subject, which are numbered.
fn pairs(subjects: Vec<Subject>) -> impl Iterator<Item = (Route, (u64, Subject))> {
    ROUTES.into_iter().flat_map(move |route| {
        (0..)
            .zip(subjects.clone())
            .map(move |subject| (route, subject))
    })
}

fn one_advance_is_taken_back_and_not_two(serve: Serve) {
    let peer = serve(host());
    for route in ROUTES {
        let mut driver = route.drive(&peer, &tank(5), 0);
        let mut refused = |requests: &[v1::ExchangeRequest]| {
            for request in requests {
                driver.turn(request.clone()).unwrap();
            }
            let words = ["nothing to take back", "one advance", "not two"];
            for request in [only_back(), back(step(1, 0.5))] {
                assert_misuse(driver.turn(request), "go_back", &words);
            }
        };
        refused(&[]);
        refused(&[step(0, 0.5), step(1, 0.5), only_back()]);
        // A look ahead is no advance.
        let look = v1::ExchangeRequest {
            predict: Some(predict(1, 0.5)),
            ..v1::ExchangeRequest::default()
        };
        refused(&[look]);
        refused(&[step(1, 0.5), back(step(1, 0.7)), only_back()]);
    }
}

fn nothing_is_taken_back_after_a_restore(serve: Serve) {
    let peer = serve(host());
    let mut driver = Route::Exchange.drive(&peer, &tank(5), 0);
    let start = driver.snapshot(None).unwrap();
    driver.turn(step(0, 0.5)).unwrap();
    driver.restore(start).unwrap();
    assert_misuse(
        driver.turn(only_back()),
        "go_back",
        &["nothing to take back"],
    );
    assert_eq!(driver.level(), START);
}

fn a_repeated_number_goes_back_once(serve: Serve) {
    let peer = serve(host());
    for route in ROUTES {
        let [mut straight, mut driver] = [0, 1].map(|number| route.drive(&peer, &tank(5), number));
        straight.turn(step(0, 0.5)).unwrap();
        driver.turn(step(0, 3.0)).unwrap();
        let request = v1::ExchangeRequest {
            instance: driver.instance,
            sequence: driver.next(),
            ..back(look(0, 0.5))
        };
        let first = exchange(&*driver.calls, &request).unwrap();
        for _ in 0..2 {
            // Equal to the nanosecond of work: nothing was computed again.
            let repeated = exchange(&*driver.calls, &request).unwrap();
            assert_eq!(repeated, first, "{route:?}");
        }
        let [expected, found] =
            [&mut straight, &mut driver].map(|driver| bits(&driver.turn(step(1, 0.7)).unwrap()));
        assert_eq!(found, expected, "{route:?}");

        let failing = v1::ExchangeRequest {
            sequence: driver.next(),
            advance: Some(flood()),
            ..request
        };
        let first = exchange(&*driver.calls, &failing).unwrap_err();
        let repeated = exchange(&*driver.calls, &failing).unwrap_err();
        assert_eq!(repeated, first, "{route:?}");
        driver.turn(back(step(1, 0.7))).unwrap();
    }
}

/// An advance that overflows the tank.
fn flood() -> v1::Advance {
    v1::Advance {
        signals: vec![constant(0, 1e5)],
        ..advance(1, 0.0)
    }
}

fn a_failed_request_to_go_back_changes_nothing(serve: Serve) {
    let peer = serve(host());
    for route in ROUTES {
        let [mut straight, mut failing] = [0, 1].map(|number| route.drive(&peer, &tank(5), number));
        for driver in [&mut straight, &mut failing] {
            driver.turn(step(0, 0.5)).unwrap();
            driver.turn(step(1, 0.7)).unwrap();
        }
        let flooded = v1::ExchangeRequest {
            advance: Some(flood()),
            ..v1::ExchangeRequest::default()
        };
        let look_into_flood = v1::ExchangeRequest {
            predict: Some(v1::Predict {
                signals: flood().signals,
                ..predict(2, 0.5)
            }),
            ..step(1, 0.7)
        };
        for request in [flooded, look_into_flood] {
            for request in [request.clone(), back(request)] {
                let failure = failing.turn(request).unwrap_err();
                assert!(failure.message.contains("overflows"), "{failure:?}");
            }
        }
        // The second step still stands, and can still be taken back.
        for request in [look(2, 0.9), back(look(2, 0.8))] {
            let [expected, found] = [&mut straight, &mut failing]
                .map(|driver| bits(&driver.turn(request.clone()).unwrap()));
            assert_eq!(found, expected, "{route:?}");
        }
    }
}

fn a_plain_step_is_taken_back_as_well(serve: Serve) {
    let peer = serve(host());
    let mut driver = Route::Exchange.drive(&peer, &tank(5), 0);
    driver.step(0.0, 0.5, vec![constant(0, 1.0)]).unwrap();
    driver.turn(only_back()).unwrap();
    assert_eq!(driver.level(), START);
}
