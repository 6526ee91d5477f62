//! Joint loads: what a subsystem is given, step by step.

use linchpin_proto::joint_load::{End, JointLaw, Law};
use linchpin_proto::v1;
use linchpin_proto::version::PROTOCOL;
use nalgebra::Vector3;

use crate::both_ways;
use crate::driver::{Driver, FIRST, assert_misuse, constant, failure, number, through, values};
use crate::in_python;
use crate::peer::{Serve, host};
use crate::stand::{at_pose, named};

both_ways!(
    places_of_joint_inputs_follow_those_of_driven_inputs,
    a_driven_input_can_be_the_multiplier,
    impulses_follow_the_polynomials_of_joint_inputs,
    perturbed_joint_inputs_are_those_of_the_steps_that_they_stand_for,
    an_exchange_is_the_step_and_the_evaluation_that_it_stands_for,
    accelerations_feel_the_load_at_zero_length,
    columns_of_joint_inputs_are_no_noise,
    a_restored_state_gives_the_same_bits,
    repeated_numbers_get_the_first_answer,
    a_joint_input_needs_a_signal,
);

in_python!(
    places_of_joint_inputs_follow_those_of_driven_inputs,
    a_driven_input_can_be_the_multiplier,
    impulses_follow_the_polynomials_of_joint_inputs,
    perturbed_joint_inputs_are_those_of_the_steps_that_they_stand_for,
    an_exchange_is_the_step_and_the_evaluation_that_it_stands_for,
    repeated_numbers_get_the_first_answer,
    a_joint_input_needs_a_signal,
);

/// Own marker: x (m), y (m), angle (rad).
const OWN: [f64; 3] = [0.3, -0.7, 1.1];
/// Normal of the plane in the axes of the own marker.
const NORMAL: [f64; 2] = [0.6, -0.8];
/// The joint's point in the axes of the partner.
const POINT: [f64; 2] = [0.4, 0.25];

/// A stand, which is end b of an inplane condition. Signals 0 and 1 are its inputs moment and fx; 2 is the multiplier, 3 and
/// 4 the position of the partner, 5 its angle.
pub fn stand(instance: u64) -> v1::InitializeRequest {
    let vector = |[x, y]: [f64; 2]| Vector3::new(x, y, 0.0);
    let law = JointLaw {
        law: Law::InPlane {
            normal: vector(NORMAL),
        },
        points: [vector(POINT), vector([-0.5, 0.9])],
    };
    let load = v1::JointLoad {
        multiplier: 2,
        partner_position: vec![3, 4],
        partner_rotation: vec![5],
        ..law.to_message("foot", End::B)
    };
    v1::InitializeRequest {
        instance,
        sequence: FIRST,
        protocol: Some(PROTOCOL),
        model: "stand".into(),
        parameters: at_pose("planar", &OWN),
        inputs: named(&["moment", "fx"]),
        coupling_outputs: named(&["fx_total", "fy_total", "moment_total"]),
        recorded_outputs: named(&["fx_impulse", "fy_impulse", "moment_impulse"]),
        joint_inputs: named(&["lambda", "partner_x", "partner_y", "partner_angle"]),
        joint_loads: vec![load],
        ..v1::InitializeRequest::default()
    }
}

/// `fx, fy, moment` of the load on the stand, S1 eq. (39).
fn expected(multiplier: f64, [x, y, angle]: [f64; 3]) -> [f64; 3] {
    let turned = |[x, y]: [f64; 2], angle: f64| {
        let (sin, cos) = angle.sin_cos();
        [x * cos - y * sin, x * sin + y * cos]
    };
    let [normal_x, normal_y] = turned(NORMAL, OWN[2]);
    let [point_x, point_y] = turned(POINT, angle);
    let arm = [x + point_x - OWN[0], y + point_y - OWN[1]];
    let moment = arm[0] * normal_y - arm[1] * normal_x;
    [-normal_x, -normal_y, -moment].map(|part| multiplier * part)
}

fn assert_near(values: &[f64], expected: &[f64]) {
    assert_eq!(values.len(), expected.len());
    for (value, expected) in values.iter().zip(expected) {
        let error = (value - expected).abs();
        assert!(
            error < 1e-13 * (1.0 + expected.abs()),
            "{values:?} instead of {expected:?}"
        );
    }
}

fn signals(numbers: [f64; 6]) -> Vec<v1::Signal> {
    (0..)
        .zip(numbers)
        .map(|(place, value)| constant(place, value))
        .collect()
}

const LOADS: [&str; 3] = ["fx_total", "fy_total", "moment_total"];

fn places_of_joint_inputs_follow_those_of_driven_inputs(serve: Serve) {
    let peer = serve(host());
    let driver = Driver::initialize(peer.calls(), &stand(5));
    let [fx, fy, moment] = expected(2.9, [1.7, 0.4, -0.8]);
    let given = signals([13.0, 7.0, 2.9, 1.7, 0.4, -0.8]);
    let loads = driver.evaluate(given, &LOADS).unwrap();
    assert_near(&loads, &[fx + 7.0, fy, moment + 13.0]);
}

fn a_driven_input_can_be_the_multiplier(serve: Serve) {
    let peer = serve(host());
    let mut request = stand(5);
    request.joint_loads[0].multiplier = 1;
    let driver = Driver::initialize(peer.calls(), &request);
    let [fx, fy, moment] = expected(7.0, [1.7, 0.4, -0.8]);
    let given = signals([13.0, 7.0, 2.9, 1.7, 0.4, -0.8]);
    let loads = driver.evaluate(given, &LOADS).unwrap();
    assert_near(&loads, &[fx + 7.0, fy, moment + 13.0]);
}

/// The load is of third degree in time, which Simpson's rule integrates exactly: as the one with the middle and the ends
/// computed here.
fn impulses_follow_the_polynomials_of_joint_inputs(serve: Serve) {
    const STEP: f64 = 0.7;
    let multiplier = |t: f64| 2.9 - 3.0 * t + 11.0 * t * t;
    let x = |t: f64| 1.7 - 4.0 * t;
    let polynomial = |place, value: &dyn Fn(f64) -> f64, nodes: &[f64]| {
        let points: Vec<(f64, f64)> = nodes.iter().map(|&t| (t, value(t))).collect();
        through(place, &points)
    };
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &stand(5));
    let mut given = signals([0.0, 0.0, 0.0, 0.0, 0.4, -0.8]);
    given[2] = polynomial(2, &multiplier, &[STEP, 0.0, -STEP]);
    given[3] = polynomial(3, &x, &[STEP, 0.0]);
    let request = v1::StepRequest {
        outputs: v1::OutputSet::All.into(),
        ..driver.step_request(0.0, STEP, given)
    };
    let reply = failure(driver.calls.step(&request)).unwrap();
    let at = |t: f64| expected(multiplier(t), [x(t), 0.4, -0.8]);
    let (start, middle, end) = (at(0.0), at(0.5 * STEP), at(STEP));
    let impulse = |i: usize| STEP / 6.0 * (start[i] + 4.0 * middle[i] + end[i]);
    let all = [end[0], end[1], end[2], impulse(0), impulse(1), impulse(2)];
    assert_near(&values(reply.outputs), &all);
}

const POINTS: [f64; 6] = [13.0, 7.0, 2.9, 1.7, 0.4, -0.8];

/// Every signal once with another slope.
fn perturbed() -> Vec<v1::Signal> {
    let ramp = |(place, value): (u32, f64)| through(place, &[(0.3, value + 0.1), (0.0, value)]);
    (0..).zip(POINTS).map(ramp).collect()
}

fn perturbed_joint_inputs_are_those_of_the_steps_that_they_stand_for(serve: Serve) {
    let peer = serve(host());
    let request = v1::InitializeRequest {
        coupling_outputs: named(&["fx_impulse", "fy_impulse", "moment_impulse"]),
        ..stand(5)
    };
    let mut driver = Driver::initialize(peer.calls(), &request);
    let start = driver.snapshot(None).unwrap();
    let request = driver.perturbed_request(0.3, signals(POINTS), perturbed());
    let columns = failure(driver.calls.perturbed_step(&request))
        .unwrap()
        .outputs;
    let unperturbed = driver.step(0.0, 0.3, signals(POINTS)).unwrap();
    for (place, column) in columns.iter().enumerate() {
        driver.restore(start).unwrap();
        let mut given = signals(POINTS);
        given[place] = perturbed()[place].clone();
        let stepped = driver.step(0.0, 0.3, given).unwrap();
        assert_eq!(column.values, stepped, "signal {place}");
        assert_ne!(column.values, unperturbed, "signal {place}");
    }
}

fn an_exchange_is_the_step_and_the_evaluation_that_it_stands_for(serve: Serve) {
    let peer = serve(host());
    let mut fused = Driver::initialize(peer.calls(), &stand(5));
    let mut unary = Driver::initialize(peer.calls(), &stand(6));
    let advance = v1::Advance {
        t: 0.0,
        step: 0.3,
        signals: perturbed(),
        ..v1::Advance::default()
    };
    let predict = v1::Predict {
        t: 0.3,
        step: 0.0,
        signals: signals(POINTS),
        perturbed: perturbed(),
        ..v1::Predict::default()
    };
    let reply = fused.exchange(Some(advance), Some(predict)).unwrap();
    let stepped = unary.step(0.0, 0.3, perturbed()).unwrap();
    assert_eq!(values(reply.advanced)[..3], stepped);
    let evaluated = unary.evaluate(signals(POINTS), &LOADS).unwrap();
    assert_eq!(values(reply.predicted), evaluated);
    // At zero length the perturbed signals have their old values.
    for column in reply.perturbed {
        assert_eq!(column.values, evaluated);
    }
}

const MASS: f64 = 1.3;
const HALF: f64 = 0.45;

/// A link, pulled at its centre of mass along a fixed direction. Signal 0 is a moment, 1 the multiplier.
fn pulled_link(instance: u64, solver: &str) -> v1::InitializeRequest {
    let law = JointLaw {
        law: Law::AtPoint {
            direction: Vector3::new(0.6, 0.8, 0.0),
        },
        points: [Vector3::zeros(), Vector3::new(-HALF, 0.0, 0.0)],
    };
    let parameters = [
        ("m", MASS),
        ("inertia", 0.17),
        ("length", 2.0 * HALF),
        ("gravity", 9.7),
        ("angle0", 1.1),
        ("vx0", 2.0),
        ("rate0", -40.0),
    ];
    let parameters = parameters.map(|(name, value)| (name.to_owned(), number(value)));
    v1::InitializeRequest {
        instance,
        sequence: FIRST,
        protocol: Some(PROTOCOL),
        model: "planar-body".into(),
        parameters: parameters.into(),
        solver: Some(v1::Solver {
            kind: solver.into(),
            options: match solver {
                "rk4" => [("step".into(), number(1.3e-3))].into(),
                _ => [].into(),
            },
        }),
        inputs: named(&["start_moment"]),
        coupling_outputs: named(&["vx", "vy", "rate", "x"]),
        joint_inputs: named(&["lambda"]),
        joint_loads: vec![v1::JointLoad {
            multiplier: 1,
            ..law.to_message("end", End::B)
        }],
        ..v1::InitializeRequest::default()
    }
}

fn accelerations_feel_the_load_at_zero_length(serve: Serve) {
    let peer = serve(host());
    let driver = Driver::initialize(peer.calls(), &pulled_link(5, "radau5"));
    let accelerations = ["start_ax", "start_ay", "start_alpha"];
    let at = |multiplier| {
        let signals = vec![
            constant(0, 0.0),
            through(1, &[(0.0, multiplier), (1.0, 99.0)]),
        ];
        driver.evaluate(signals, &accelerations).unwrap()
    };
    let (with, without) = (at(3.9), at(0.0));
    let change = [0, 1, 2].map(|i: usize| with[i] - without[i]);
    let expected = [-0.6 * 3.9 / MASS, -0.8 * 3.9 / MASS, 0.0];
    for (change, expected) in change.iter().zip(expected) {
        assert!((change - expected).abs() < 1e-11, "{with:?} {without:?}");
    }
    assert_eq!(at(3.9), with, "an evaluation changes nothing");
}

/// Under a constant multiplier the centre of mass is on a parabola, so the columns are known.
fn columns_of_joint_inputs_are_no_noise(serve: Serve) {
    const STEP: f64 = 0.01;
    let peer = serve(host());
    for (instance, solver) in (5..).zip(["radau5", "rk4"]) {
        let mut driver = Driver::initialize(peer.calls(), &pulled_link(instance, solver));
        let given = |multiplier| vec![constant(0, 0.3), constant(1, multiplier)];
        let start = driver.snapshot(None).unwrap();
        let first = driver.step(0.0, STEP, given(3.9)).unwrap();
        driver.restore(start).unwrap();
        let increment = 1e-5;
        let raised = vec![constant(1, 3.9), constant(1, 3.9 + increment)];
        let request = driver.perturbed_request(STEP, given(3.9), raised);
        let reply = failure(driver.calls.perturbed_step(&request)).unwrap();
        assert_eq!(reply.outputs[0].values, first, "{solver}: the same steps");
        let column = |output: usize| (reply.outputs[1].values[output] - first[output]) / increment;
        let impulse = STEP / MASS;
        let expected = [-0.6 * impulse, -0.8 * impulse, 0.0, -0.3 * STEP * impulse];
        for (output, expected) in expected.into_iter().enumerate() {
            let error = (column(output) - expected).abs();
            // Rounding of a rate of 40 rad/s over the increment.
            assert!(
                error < 4e-9,
                "{solver}: column {output} is off by {error:e}"
            );
        }
    }
}

fn a_restored_state_gives_the_same_bits(serve: Serve) {
    let peer = serve(host());
    for (instance, solver) in (5..).zip(["radau5", "rk4"]) {
        let mut driver = Driver::initialize(peer.calls(), &pulled_link(instance, solver));
        let given = || vec![constant(0, 0.3), through(1, &[(0.0, 3.9), (0.01, 5.1)])];
        driver.step(0.0, 0.01, given()).unwrap();
        let kept = driver.snapshot(None).unwrap();
        let first = driver.step(0.01, 0.01, given()).unwrap();
        driver.step(0.02, 0.01, given()).unwrap();
        driver.restore(kept).unwrap();
        let again = driver.step(0.01, 0.01, given()).unwrap();
        assert_eq!(first, again, "{solver}");
    }
}

fn repeated_numbers_get_the_first_answer(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &stand(5));
    let first = failure(peer.calls().initialize(&stand(5))).unwrap();
    assert_eq!(failure(peer.calls().initialize(&stand(5))).unwrap(), first);
    let mut other = stand(5);
    other.joint_loads[0].multiplier = 3;
    assert_misuse(
        failure(peer.calls().initialize(&other)),
        "instance",
        &["0x5", "exists"],
    );
    let request = driver.step_request(0.0, 0.3, perturbed());
    let first = failure(driver.calls.step(&request)).unwrap();
    let again = failure(driver.calls.step(&request)).unwrap();
    assert_eq!(first.outputs, again.outputs);
    let impulse = driver.evaluate(signals(POINTS), &["fx_impulse"]).unwrap();
    driver.step(0.3, 0.3, perturbed()).unwrap();
    let twice = driver.evaluate(signals(POINTS), &["fx_impulse"]).unwrap();
    assert_near(&twice, &[2.0 * impulse[0]]);
}

fn a_joint_input_needs_a_signal(serve: Serve) {
    let peer = serve(host());
    let mut driver = Driver::initialize(peer.calls(), &stand(5));
    let mut given = signals(POINTS);
    given.remove(2);
    let words = ["lambda", "neither a signal nor a default"];
    assert_misuse(driver.step(0.0, 0.3, given.clone()), "signals", &words);
    assert_misuse(driver.evaluate(given, &LOADS), "signals", &words);
    let mut given = signals(POINTS);
    given.push(constant(3, 1.0));
    assert_misuse(
        driver.evaluate(given, &LOADS),
        "signals",
        &["partner_x", "two signals"],
    );
    let mut given = signals(POINTS);
    given[0].input = 6;
    assert_misuse(
        driver.evaluate(given, &LOADS),
        "signals",
        &["input 6", "6 inputs"],
    );
}
