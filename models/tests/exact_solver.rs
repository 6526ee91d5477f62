//! The exact solver against closed forms, manufactured solutions and itself.

#![allow(clippy::unwrap_used)]

mod common;

use common::{EXACT, force, interval, oscillator, polynomial, state};
use linchpin_models::oscillator::OscillatorParameters;
use linchpin_models::reference::FreeOscillation;
use linchpin_worker::Inputs;
use proptest::prelude::*;

fn parameters(own: &OscillatorParameters) -> [(&'static str, f64); 5] {
    let &OscillatorParameters { m, c, d, x0, v0 } = own;
    [("m", m), ("c", c), ("d", d), ("x0", x0), ("v0", v0)]
}

/// One free step against the closed form, in units of the last place of the largest size that occurs, which grows
/// with the phase `omega H`: it is only as certain as `omega` is.
fn free_step_error(own: &OscillatorParameters, length: f64) -> f64 {
    let mut subsystem = oscillator(&parameters(own), EXACT);
    subsystem
        .step(interval(0.0, length), &Inputs::constant(&[0.0; 3]))
        .unwrap();
    let [x, v] = state(&mut subsystem);
    let expected = FreeOscillation::new(own).motion(length);
    let omega = (own.c / own.m).sqrt();
    let v_size = own.v0.abs() + omega * own.x0.abs();
    let x_size =
        own.x0.abs() + (own.v0.abs() * length).min(own.v0.abs() / omega.max(f64::MIN_POSITIVE));
    let certainty = f64::EPSILON * (1.0 + omega * length);
    ((x - expected.x).abs() / x_size).max((v - expected.v).abs() / v_size) / certainty
}

#[test]
fn free_motion_is_right_to_rounding_for_every_damping_and_step() {
    let mut worst = 0.0f64;
    for m in [0.37, 1.0, 2.9] {
        for c in [0.0, 1.3e-3, 0.7, 1e3, 1e5, 1e8f64] {
            let critical = 2.0 * (m * c).sqrt();
            for d in [
                0.0,
                0.1 * critical,
                critical,
                1.0001 * critical,
                30.0 * critical,
                1e4,
                1e8,
            ] {
                for length in [1e-6, 1e-5, 1.7e-4, 1e-3, 1e-2, 1e-1] {
                    let own = OscillatorParameters {
                        m,
                        c,
                        d,
                        x0: 0.83,
                        v0: -97.0,
                    };
                    let error = free_step_error(&own, length);
                    assert!(
                        error < 8.0,
                        "{own:?} H = {length}: {error} units of the last place"
                    );
                    worst = worst.max(error);
                }
            }
        }
    }
    println!("worst error: {worst:.1} units of the last place");
}

#[test]
fn a_free_mass_answers_a_power_of_time_exactly() {
    // x'' = tau^j / m from rest: x = tau^(j+2) / (m (j+1)(j+2)), all relative to the response itself.
    let (m, length) = (1.7, 3.1e-4);
    for degree in 0..4 {
        let mut coefficients = vec![0.0; degree + 1];
        coefficients[degree] = 333.0 / f64::powi(length, degree as i32);
        let mut subsystem = oscillator(&[("m", m)], EXACT);
        subsystem
            .step(interval(0.0, length), &force(&coefficients, length))
            .unwrap();
        let [x, v] = state(&mut subsystem);
        let next = (degree + 1) as f64;
        let speed = 333.0 * length / (m * next);
        // Four nodes over three steps magnify rounding a little.
        let allowed = 1e-14;
        assert!(
            (v / speed - 1.0).abs() < allowed,
            "degree {degree}: {v} {speed}"
        );
        assert!(
            (x / (speed * length / (next + 1.0)) - 1.0).abs() < allowed,
            "degree {degree}: {x}"
        );
    }
}

#[test]
fn the_response_of_the_position_keeps_its_figures_in_a_short_step() {
    // Series of x = u/m tau^2/2 (1 - d tau/(3 m) + (d^2/m - c) tau^2/(12 m) - ...).
    let (m, c, d, u) = (1.3, 1e3, 10.0, 333.0);
    for length in [1e-6, 1e-5, 1e-4] {
        let mut subsystem = oscillator(&[("m", m), ("c", c), ("d", d)], EXACT);
        subsystem
            .step(interval(0.0, length), &force(&[u], length))
            .unwrap();
        let damping = d * length / m;
        let stiffness = c * length * length / m;
        let third = damping * (2.0 * stiffness - damping * damping) / 60.0;
        let series = 1.0 - damping / 3.0 + (damping * damping - stiffness) / 12.0 + third;
        let expected = u / m * length * length / 2.0 * series;
        let [x, _] = state(&mut subsystem);
        assert!(
            (x / expected - 1.0).abs() < 1e-11,
            "H = {length}: {x} {expected}"
        );
    }
}

#[test]
fn a_heavily_damped_mass_creeps_at_the_right_speed() {
    // delta = H d/m = 1e8: the slow root is -c/d to 16 figures, and the mass goes by 1e-8 of its position.
    let (c, d, length) = (1e3, 1e9, 0.1);
    let mut subsystem = oscillator(&[("m", 1.0), ("c", c), ("d", d), ("x0", 1.0)], EXACT);
    subsystem
        .step(interval(0.0, length), &Inputs::constant(&[0.0; 3]))
        .unwrap();
    let [_, v] = state(&mut subsystem);
    let expected = -c / d * (-c / d * length).exp();
    assert!((v / expected - 1.0).abs() < 1e-13, "{v} {expected}");
}

/// `x = sum_j p_j tau^j`, and the force that makes the oscillator follow it.
struct Manufactured {
    m: f64,
    c: f64,
    d: f64,
    p: Vec<f64>,
}

impl Manufactured {
    fn derivative(p: &[f64]) -> Vec<f64> {
        p.iter()
            .enumerate()
            .skip(1)
            .map(|(j, p)| j as f64 * p)
            .collect()
    }

    fn force(&self) -> Vec<f64> {
        let v = Self::derivative(&self.p);
        let a = Self::derivative(&v);
        let at = |p: &[f64], j: usize| p.get(j).copied().unwrap_or(0.0);
        let terms = 0..self.p.len();
        terms
            .map(|j| self.m * at(&a, j) + self.d * at(&v, j) + self.c * self.p[j])
            .collect()
    }

    fn at(p: &[f64], tau: f64) -> f64 {
        p.iter().rev().fold(0.0, |sum, p| sum * tau + p)
    }
}

proptest! {
    #[test]
    fn manufactured_solutions_are_followed(
        m in 0.1f64..5.0,
        log_c in -2f64..8.0,
        log_d in -2f64..6.0,
        length in 1e-3f64..0.5,
        p in proptest::collection::vec(-2f64..2.0, 1..=4),
    ) {
        let case = Manufactured { m, c: 10f64.powf(log_c), d: 10f64.powf(log_d), p };
        let v = Manufactured::derivative(&case.p);
        let start = (case.p[0], Manufactured::at(&v, 0.0));
        let mut subsystem = oscillator(
            &[("m", m), ("c", case.c), ("d", case.d), ("x0", start.0), ("v0", start.1)],
            EXACT,
        );
        subsystem.step(interval(0.0, length), &force(&case.force(), length)).unwrap();
        let [x_end, v_end] = state(&mut subsystem);
        let omega = (case.c / m).sqrt();
        prop_assert!((x_end - Manufactured::at(&case.p, length)).abs() < 1e-13 * (1.0 + omega * length));
        prop_assert!((v_end - Manufactured::at(&v, length)).abs() < 1e-13 * (1.0 + omega) * (1.0 + omega * length));
    }

    #[test]
    fn a_step_in_two_parts_ends_where_the_whole_step_ends(
        m in 0.1f64..5.0,
        log_c in -2f64..6.0,
        log_d in -2f64..5.0,
        length in 1e-4f64..0.1,
        cut in 0.05f64..0.95,
        coefficients in proptest::collection::vec(-50f64..50.0, 1..=4),
    ) {
        let own = [("m", m), ("c", 10f64.powf(log_c)), ("d", 10f64.powf(log_d)), ("x0", 0.2), ("v0", 3.0)];
        let (mut whole, mut parts) = (oscillator(&own, EXACT), oscillator(&own, EXACT));
        whole.step(interval(0.0, length), &force(&coefficients, length)).unwrap();
        let first = cut * length;
        parts.step(interval(0.0, first), &force(&coefficients, first)).unwrap();
        let value = |tau: f64| Manufactured::at(&coefficients, first + tau);
        let nodes: Vec<f64> = (0..coefficients.len()).map(|i| (length - first) * i as f64 / 4.0).collect();
        let values: Vec<f64> = nodes.iter().map(|&tau| value(tau)).collect();
        let mut rest = Inputs::constant(&[0.0; 3]);
        rest.replace(0, linchpin_proto::polynomial::Polynomial::through(&nodes, &values).unwrap());
        parts.step(interval(first, length - first), &rest).unwrap();
        let ([x, v], [x_parts, v_parts]) = (state(&mut whole), state(&mut parts));
        let omega = (own[1].1 / m).sqrt();
        prop_assert!((x - x_parts).abs() < 1e-12 * (1.0 + omega * length), "{x} {x_parts}");
        prop_assert!((v - v_parts).abs() < 1e-11 * (1.0 + omega) * (1.0 + omega * length), "{v} {v_parts}");
    }

    #[test]
    fn the_partner_acts_through_its_spring_and_damper(
        stiffness in 0f64..1e4,
        damping in 0f64..100.0,
        x in proptest::collection::vec(-1f64..1.0, 3),
        v in proptest::collection::vec(-5f64..5.0, 2),
    ) {
        let (m, c, d, length) = (1.3, 70.0, 2.1, 0.03);
        let own = [("m", m), ("x0", 0.4), ("v0", -1.7)];
        let spring = [("c", c), ("d", d), ("partner_stiffness", stiffness), ("partner_damping", damping)];
        let mut coupled = oscillator(&[own.as_slice(), &spring].concat(), EXACT);
        let mut inputs = Inputs::constant(&[0.0; 3]);
        inputs.replace(1, polynomial(&x, length));
        inputs.replace(2, polynomial(&v, length));
        coupled.step(interval(0.0, length), &inputs).unwrap();

        let grounded = [("c", c + stiffness), ("d", d + damping)];
        let mut driven = oscillator(&[own.as_slice(), &grounded].concat(), EXACT);
        let drive: Vec<f64> = (0..3)
            .map(|j| stiffness * x[j] + damping * v.get(j).copied().unwrap_or(0.0))
            .collect();
        driven.step(interval(0.0, length), &force(&drive, length)).unwrap();
        let (left, right) = (state(&mut coupled), state(&mut driven));
        prop_assert!((left[0] - right[0]).abs() < 1e-13 && (left[1] - right[1]).abs() < 1e-11);
    }
}
