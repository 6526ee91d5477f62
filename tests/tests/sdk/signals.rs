//! Inputs as polynomials of time.

use linchpin_proto::v1;

use crate::all_ways;
use crate::driver::{Driver, assert_misuse, constant, oscillator, tank, through};
use crate::peer::{Serve, host};
use crate::tank::{LEAK, START};

all_ways!(
    every_degree_is_followed_exactly,
    an_input_without_a_signal_has_its_default,
    an_input_without_a_default_needs_a_signal,
    perturbed_steps_are_the_steps_that_they_stand_for,
    wrong_signals_are_refused_and_change_nothing,
    wrong_steps_and_evaluations_are_refused,
);

/// inflow = n (t/H)^(n-1) fills the tank by H in a step, whatever n is.
fn every_degree_is_followed_exactly(serve: Serve) {
    const STEP: f64 = 0.7;
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let start = driver.snapshot(None).unwrap();
    for n in 1..=8 {
        let node = |i: i32| STEP * (1.0 - 0.3 * f64::from(i));
        let value = |tau: f64| f64::from(n) * (tau / STEP).powi(n - 1);
        let points: Vec<(f64, f64)> = (0..n).map(|i| (node(i), value(node(i)))).collect();
        let reached = driver
            .step(0.0, STEP, vec![through(0, &points), constant(1, 0.0)])
            .unwrap();
        assert!((reached[0] - START - STEP).abs() < 1e-13, "{n} {reached:?}");
        assert!((reached[1] - f64::from(n)).abs() < 1e-12, "{n} {reached:?}");
        driver.restore(start).unwrap();
    }
}

fn an_input_without_a_signal_has_its_default(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let rate = |driver: &mut Driver, signals| driver.step(0.0, 0.01, signals).unwrap()[1];
    assert_eq!(
        rate(&mut driver, vec![constant(0, 1.0), constant(1, 0.5)]),
        0.5
    );
    assert_eq!(rate(&mut driver, vec![constant(0, 1.0)]), 1.0 - LEAK);

    let undriven = v1::InitializeRequest {
        inputs: vec!["inflow".into()],
        ..tank(6)
    };
    let mut driver = Driver::initialize(peer.calls(), &undriven);
    assert_eq!(rate(&mut driver, vec![constant(0, 1.0)]), 1.0 - LEAK);
}

fn an_input_without_a_default_needs_a_signal(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let words = ["inflow", "neither a signal nor a default"];
    assert_misuse(
        driver.step(0.0, 0.5, vec![constant(1, 0.0)]),
        "signals",
        &words,
    );
    assert_misuse(driver.evaluate(vec![], &["level"]), "signals", &words);
    let predict = v1::Predict {
        t: 0.0,
        step: 0.5,
        signals: vec![],
        perturbed: vec![constant(0, 1.0)],
        ..v1::Predict::default()
    };
    assert_misuse(driver.exchange(None, Some(predict)), "signals", &words);
}

fn perturbed_steps_are_the_steps_that_they_stand_for(serve: Serve) {
    const STEP: f64 = 1.7e-3;
    let ramp = |end| through(0, &[(STEP, end), (0.0, -17.9)]);
    let peer = serve(host());
    for (instance, solver) in (5..).zip(["exact", "rk4"]) {
        let mut driver = Driver::initialize(peer.calls(), &oscillator(instance, solver));
        let start = driver.snapshot(None).unwrap();
        let mut step = |signals| {
            let reached = driver.step(0.0, STEP, signals).unwrap();
            driver.restore(start).unwrap();
            reached
        };
        let expected = [
            step(vec![ramp(41.4), constant(1, 0.2)]),
            step(vec![ramp(41.3), constant(1, 0.3)]),
            step(vec![ramp(41.3), constant(1, 0.2)]),
        ];
        let request = driver.perturbed_request(
            STEP,
            vec![ramp(41.3), constant(1, 0.2)],
            vec![ramp(41.4), constant(1, 0.3), ramp(41.3)],
        );
        let reply = driver.calls.perturbed_step(&request).unwrap();
        let got: Vec<Vec<f64>> = reply.outputs.into_iter().map(|one| one.values).collect();
        assert_eq!(got, expected, "{solver}");
        assert_ne!(expected[0], expected[2]);
    }
}

fn wrong_signals_are_refused_and_change_nothing(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let nine: Vec<(f64, f64)> = (0..9).map(|i| (f64::from(i), 1.0)).collect();
    let unequal = v1::Signal {
        input: 0,
        nodes: vec![0.0, 1.0],
        values: vec![1.0],
    };
    let wrong: [(Vec<v1::Signal>, &[&str]); 8] = [
        (vec![constant(2, 1.0)], &["input 2", "2 inputs"]),
        (vec![constant(u32::MAX, 1.0)], &["4294967295", "2 inputs"]),
        (
            vec![constant(0, 1.0), constant(0, 1.0)],
            &["inflow", "two signals"],
        ),
        (vec![through(0, &[])], &["input 0"]),
        (vec![through(0, &nine)], &["input 0", "9"]),
        (vec![unequal], &["input 0", "2", "1"]),
        (
            vec![through(0, &[(0.0, 1.0), (0.5, 1.0), (0.0, 2.0)])],
            &["input 0", "0", "2"],
        ),
        (
            vec![through(0, &[(0.0, 1.0), (0.5, f64::NAN)])],
            &["input 0", "1"],
        ),
    ];
    for (signals, words) in wrong {
        assert_misuse(driver.step(0.0, 0.5, signals.clone()), "signals", words);
        assert_misuse(
            driver.evaluate(signals.clone(), &["level"]),
            "signals",
            words,
        );
        let predict = v1::Predict {
            t: 0.0,
            step: 0.5,
            signals,
            perturbed: vec![],
            ..v1::Predict::default()
        };
        assert_misuse(driver.exchange(None, Some(predict)), "signals", words);
    }
    for perturbed in [
        constant(2, 1.0),
        through(0, &[]),
        constant(1, f64::INFINITY),
    ] {
        let good = vec![constant(0, 1.0), constant(1, 0.0)];
        let request = driver.perturbed_request(0.5, good.clone(), vec![good[0].clone(), perturbed]);
        let answer = crate::driver::failure(driver.calls.perturbed_step(&request));
        assert_misuse(answer, "signals", &["input"]);
    }
    assert_eq!(driver.level(), START);
    assert_eq!(
        driver.step(0.0, 0.5, vec![constant(0, LEAK)]).unwrap(),
        [START, 0.0]
    );
}

fn wrong_steps_and_evaluations_are_refused(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let inflow = || vec![constant(0, 1.0)];
    for (t, step) in [
        (f64::NAN, 0.5),
        (0.0, 0.0),
        (0.0, -0.5),
        (0.0, f64::INFINITY),
    ] {
        let words = [&*t.to_string(), &step.to_string()];
        assert_misuse(driver.step(t, step, inflow()), "step", &words);
    }
    assert_misuse(
        driver.evaluate(inflow(), &["level", "depth"]),
        "outputs",
        &["depth", "level", "rate"],
    );
    let request = v1::EvaluateRequest {
        instance: 5,
        t: f64::NAN,
        signals: inflow(),
        outputs: vec![],
        ..v1::EvaluateRequest::default()
    };
    let answer = crate::driver::failure(driver.calls.evaluate(&request));
    assert_misuse(answer, "t", &["NaN"]);
    assert_eq!(driver.level(), START);
}
