//! Impulses of loads within a step, and impacts at a model without any.

use linchpin_proto::v1;

use crate::all_ways;
use crate::driver::assert_misuse;
use crate::peer::{Serve, host};
use crate::subjects::{ROUTES, STEP, Subject, advance, load, predict, subjects};

all_ways!(
    a_step_goes_from_impact_to_impact,
    perturbed_steps_have_the_same_impulses,
    no_impact_is_no_difference,
    impacts_out_of_their_step_or_order_are_refused,
    an_interface_needs_a_model_with_impacts,
);

const AT: [f64; 2] = [0.21 * STEP, 0.83 * STEP];

/// Of the first signal of the instance; the others are no loads, or have none.
fn impacts(instance: &v1::InitializeRequest, loads: [f64; 2]) -> v1::Impacts {
    let impact = |(at, load): (f64, f64)| v1::Impact {
        at,
        loads: (0..instance.inputs.len())
            .map(|signal| if signal == 0 { load } else { 0.0 })
            .collect(),
        ..v1::Impact::default()
    };
    let both = AT.into_iter().zip(loads).map(impact);
    v1::Impacts {
        impacts: both.collect(),
    }
}

/// The subjects whose input is a load.
fn struck(serve: Serve) -> Vec<Subject> {
    let mut subjects = subjects(serve);
    subjects.retain(|(name, _)| *name != "tank");
    subjects
}

fn with(impacts: Option<v1::Impacts>) -> v1::ExchangeRequest {
    v1::ExchangeRequest {
        advance: Some(v1::Advance {
            impacts: impacts.clone(),
            ..advance(0, 4.0)
        }),
        predict: Some(v1::Predict {
            impacts,
            ..predict(1, 4.0)
        }),
        ..v1::ExchangeRequest::default()
    }
}

/// Impulses are those of a load that acts so shortly that nothing moves meanwhile.
fn a_step_goes_from_impact_to_impact(serve: Serve) {
    let loads = [0.031, -0.017];
    for route in ROUTES {
        for (name, instance) in struck(serve) {
            let peer = serve(host());
            let mut whole = route.drive(&peer, &instance, 0);
            let answer = whole.turn(with(Some(impacts(&instance, loads)))).unwrap();
            let own = answer.advanced.unwrap().values;

            let mut parts = route.drive(&peer, &instance, 1);
            let short = 1e-9;
            let mut t = 0.0;
            let mut values = Vec::new();
            let mut turn = |from: f64, length: f64, force: f64| {
                let mut signal = load(4.0);
                signal.nodes.iter_mut().for_each(|node| *node -= from);
                signal.values.iter_mut().for_each(|value| *value += force);
                let request = v1::ExchangeRequest {
                    advance: Some(v1::Advance {
                        t: from,
                        step: length,
                        signals: vec![signal],
                        ..v1::Advance::default()
                    }),
                    ..v1::ExchangeRequest::default()
                };
                values = parts.turn(request).unwrap().advanced.unwrap().values;
            };
            for (at, impulse) in AT.into_iter().zip(loads) {
                turn(t, at - 0.5 * short - t, 0.0);
                turn(at - 0.5 * short, short, impulse / short);
                t = at + 0.5 * short;
            }
            turn(t, STEP - t, 0.0);
            for (own, expected) in own.iter().zip(&values) {
                let size = 1.0 + expected.abs();
                assert!(
                    (own - expected).abs() < 1e-6 * size,
                    "{name}, {route:?}: {own} {expected}"
                );
            }
        }
    }
}

fn perturbed_steps_have_the_same_impulses(serve: Serve) {
    for route in ROUTES {
        for (name, instance) in struck(serve) {
            let peer = serve(host());
            let mut driver = route.drive(&peer, &instance, 0);
            let mut request = with(Some(impacts(&instance, [0.031, -0.017])));
            request.advance = None;
            let look = request.predict.as_mut().unwrap();
            look.t = 0.0;
            look.perturbed.insert(0, load(4.0));
            look.signals = vec![load(4.0)];
            let answer = driver.turn(request).unwrap();
            assert_eq!(
                answer.perturbed[0],
                answer.predicted.unwrap(),
                "{name}, {route:?}"
            );
            assert!(answer.impacts.is_none());
        }
    }
}

fn no_impact_is_no_difference(serve: Serve) {
    for (name, instance) in struck(serve) {
        let peer = serve(host());
        let mut one = ROUTES[0].drive(&peer, &instance, 0);
        let mut other = ROUTES[0].drive(&peer, &instance, 1);
        let own = one.turn(with(None)).unwrap();
        let given = other.turn(with(Some(v1::Impacts::default()))).unwrap();
        assert_eq!(own.advanced, given.advanced, "{name}");
        assert_eq!(own.predicted, given.predicted, "{name}");
    }
}

fn impacts_out_of_their_step_or_order_are_refused(serve: Serve) {
    let changes: [fn(&mut v1::Impacts); 5] = [
        |all| all.impacts[1].at = 1.01 * STEP,
        |all| all.impacts[0].at = -1e-9,
        |all| all.impacts.swap(0, 1),
        |all| all.impacts[0].loads.push(0.0),
        |all| all.impacts[1].loads[0] = f64::NAN,
    ];
    let (_, instance) = struck(serve).remove(0);
    for (number, change) in (0..).zip(changes) {
        let peer = serve(host());
        let mut driver = ROUTES[0].drive(&peer, &instance, number);
        let mut wrong = impacts(&instance, [0.1, 0.2]);
        change(&mut wrong);
        assert_misuse(driver.turn(with(Some(wrong))), "impacts", &["impact"]);
    }
}

fn an_interface_needs_a_model_with_impacts(serve: Serve) {
    let (_, instance) = struck(serve).remove(0);
    for (number, interface) in (0..).zip([
        v1::Interface {
            rows: 1,
            directions: vec![1.0],
            mobility: vec![0.3],
        },
        v1::Interface {
            rows: 2,
            directions: vec![1.0],
            mobility: vec![0.3],
        },
    ]) {
        let peer = serve(host());
        let mut driver = ROUTES[0].drive(&peer, &instance, number);
        let mut request = with(None);
        request.predict.as_mut().unwrap().interface = Some(interface);
        assert_misuse(driver.turn(request), "interface", &[]);
    }
}
