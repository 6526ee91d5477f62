//! Order, honest tolerances, stiffness, replay and failures of the integrator.

use super::*;
use crate::oscillator::OscillatorParameters;
use crate::reference::FreeOscillation;

/// A right-hand side as a closure, without Jacobian.
struct Equation<F>(F);

impl<F: Fn(f64, &[f64], &mut [f64])> Ode for Equation<F> {
    fn derivative(&self, tau: f64, y: &[f64], dy: &mut [f64]) {
        (self.0)(tau, y, dy);
    }
}

const fn tolerances(tolerance: f64) -> Tolerances {
    Tolerances {
        relative: tolerance,
        absolute: tolerance,
    }
}

/// Two equal oscillators with a spring and a damper between them. Their sum and their difference are free
/// oscillators, hence the closed form. State `x1, x2, v1, v2`.
mod two_masses {
    use super::*;

    const M: f64 = 1.3;
    const C: f64 = 40.0;
    const D: f64 = 0.3;
    const D_BETWEEN: f64 = 0.1;
    pub const START: [f64; 4] = [0.7, -0.2, 0.5, 2.0];

    pub fn equation(c_between: f64) -> impl Ode {
        Equation(move |_, y: &[f64], dy: &mut [f64]| {
            let between = c_between * (y[1] - y[0]) + D_BETWEEN * (y[3] - y[2]);
            dy[0] = y[2];
            dy[1] = y[3];
            dy[2] = (between - C * y[0] - D * y[2]) / M;
            dy[3] = (-between - C * y[1] - D * y[3]) / M;
        })
    }

    pub fn solution(c_between: f64, t: f64) -> [f64; 4] {
        let [x1, x2, v1, v2] = START;
        let mode = |c, d, x0, v0| {
            FreeOscillation::new(&OscillatorParameters { m: M, c, d, x0, v0 }).motion(t)
        };
        let sum = mode(C, D, x1 + x2, v1 + v2);
        let difference = mode(C + 2.0 * c_between, D + 2.0 * D_BETWEEN, x2 - x1, v2 - v1);
        [
            (sum.x - difference.x) / 2.0,
            (sum.x + difference.x) / 2.0,
            (sum.v - difference.v) / 2.0,
            (sum.v + difference.v) / 2.0,
        ]
    }
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .fold(0.0, |largest, (a, b)| (a - b).abs().max(largest))
}

/// `parts` equal steps without error control.
fn fixed_steps(ode: &impl Ode, length: f64, parts: u32, y: &mut [f64]) {
    let mut radau = Radau::new(y.len(), tolerances(1e-12));
    let step = length / f64::from(parts);
    for part in 0..parts {
        let tau = step * f64::from(part);
        radau.prepare(ode, tau, length, y, true).unwrap();
        let place = radau.matrices.place(step, &radau.jacobian);
        let attempt = Attempt {
            tau,
            step,
            y,
            matrices: radau.matrices.get(place),
        };
        radau.stages.solve(ode, attempt, &radau.goal).unwrap();
        radau.stages.accept(tau, step, y, &mut ());
    }
}

fn observed_order(error: impl Fn(u32) -> f64, parts: u32) -> f64 {
    let (coarse, fine) = (error(parts), error(2 * parts));
    let order = (coarse / fine).log2();
    println!(
        "{parts} steps: {coarse:.3e}, {} steps: {fine:.3e}, order {order:.2}",
        2 * parts
    );
    order
}

#[test]
fn fixed_steps_are_of_order_five_on_a_linear_equation() {
    let order = observed_order(
        |parts| {
            let mut y = two_masses::START;
            fixed_steps(&two_masses::equation(25.0), 0.83, parts, &mut y);
            largest_difference(&y, &two_masses::solution(25.0, 0.83))
        },
        12,
    );
    assert!((order - 5.0).abs() < 0.15, "order {order}");
}

#[test]
fn fixed_steps_are_of_order_five_on_a_nonlinear_equation_with_time() {
    // y = 1 / (1.5 + sin t)
    let ode = Equation(|t: f64, y: &[f64], dy: &mut [f64]| dy[0] = -t.cos() * y[0] * y[0]);
    let order = observed_order(
        |parts| {
            let mut y = [1.0 / 1.5];
            fixed_steps(&ode, 3.1, parts, &mut y);
            (y[0] - 1.0 / (1.5 + 3.1f64.sin())).abs()
        },
        14,
    );
    assert!((order - 5.0).abs() < 0.2, "order {order}");
}

/// Largest error over the tolerance for an unknown that has the amplitude `amplitudes[i]`.
fn error_over_tolerance(y: &[f64], exact: &[f64], amplitudes: [f64; 4], tolerance: f64) -> f64 {
    let errors = y.iter().zip(exact).zip(amplitudes);
    errors.fold(0.0, |largest, ((y, exact), amplitude)| {
        largest.max((y - exact).abs() / tolerances(tolerance).at(amplitude))
    })
}

#[test]
fn the_error_of_a_run_stays_near_the_tolerance() {
    for (c_between, v_amplitude, tightest) in [(25.0, 5.0, 1e-12), (1e4, 60.0, 1e-10)] {
        for tolerance in [1e-5, 1e-6, 1e-8, tightest] {
            let mut y = two_masses::START;
            let mut radau = Radau::new(4, tolerances(tolerance));
            radau
                .integrate(&two_masses::equation(c_between), 10.0, &mut y)
                .unwrap();
            let exact = two_masses::solution(c_between, 10.0);
            let error =
                error_over_tolerance(&y, &exact, [0.7, 0.7, v_amplitude, v_amplitude], tolerance);
            println!(
                "c {c_between} tol {tolerance:e}: {error:.2} tol in {} steps",
                radau.steps()
            );
            assert!(
                (0.05..5.0).contains(&error),
                "c {c_between}: {error} times the tolerance {tolerance:e}"
            );
        }
    }
}

#[test]
fn short_intervals_start_warm() {
    let ode = two_masses::equation(25.0);
    let mut at_once = Radau::new(4, tolerances(1e-6));
    at_once
        .integrate(&ode, 10.0, &mut two_masses::START.clone())
        .unwrap();
    let mut in_pieces = Radau::new(4, tolerances(1e-6));
    let mut y = two_masses::START;
    for _ in 0..100 {
        in_pieces.integrate(&ode, 0.1, &mut y).unwrap();
    }
    let (few, many) = (at_once.steps(), in_pieces.steps());
    println!("{few} steps at once, {many} steps in 100 pieces");
    assert!(
        many < few * 3 / 2,
        "{few} steps at once, {many} steps in 100 pieces"
    );
    assert!(largest_difference(&y, &two_masses::solution(25.0, 10.0)) < 1e-5);
}

#[test]
fn prothero_and_robinson() {
    // y' = lambda (y - cos t) - sin t, solution cos t.
    for lambda in [-1e3, -1e6, -1e9] {
        let ode = Equation(move |t: f64, y: &[f64], dy: &mut [f64]| {
            dy[0] = lambda * (y[0] - t.cos()) - t.sin()
        });
        let mut y = [1.0];
        let mut radau = Radau::new(1, tolerances(1e-8));
        radau.integrate(&ode, 7.3, &mut y).unwrap();
        let error = (y[0] - 7.3f64.cos()).abs();
        println!(
            "lambda {lambda:e}: error {error:.2e} in {} steps",
            radau.steps()
        );
        assert!(error < 1e-7, "lambda {lambda:e}: {error:e}");
        assert!(
            radau.steps() < 500,
            "lambda {lambda:e}: {} steps",
            radau.steps()
        );
    }
}

#[test]
fn van_der_pol() {
    // mu = 1e3, time scaled by mu; reference: Mazzia & Magherini, Test Set for IVP Solvers, problem vdpol.
    let ode = Equation(|_, y: &[f64], dy: &mut [f64]| {
        dy[0] = y[1];
        dy[1] = 1e6 * ((1.0 - y[0] * y[0]) * y[1] - y[0]);
    });
    let reference = [1.706_167_732_170_483, -0.892_809_701_024_797_5];
    for tolerance in [1e-6, 1e-8, 1e-10] {
        let mut y = [2.0, 0.0];
        let mut radau = Radau::new(2, tolerances(tolerance));
        radau.integrate(&ode, 2.0, &mut y).unwrap();
        let error = largest_difference(&y, &reference);
        println!(
            "tol {tolerance:e}: error {error:.2e} in {} steps",
            radau.steps()
        );
        assert!(error < 10.0 * tolerance, "tol {tolerance:e}: {error:e}");
    }
}

/// A pendulum with drag under a torque; nonlinear, so that Jacobians and iterations differ from step to step.
fn pendulum(torque: f64) -> impl Ode {
    Equation(move |t: f64, y: &[f64], dy: &mut [f64]| {
        dy[0] = y[1];
        dy[1] = -37.0 * y[0].sin() - 0.2 * y[1] * y[1].abs() + torque * (1.0 + t);
    })
}

#[test]
fn replay_under_the_same_inputs_gives_the_same_bits() {
    let start = [1.9, -0.4];
    let mut radau = Radau::new(2, tolerances(1e-9));
    let mut y = start;
    radau.integrate(&pendulum(3.0), 2.0, &mut y).unwrap();
    assert!(radau.steps() > 20);
    assert!(
        radau.has_recorded(2.0, &start)
            && !radau.has_recorded(2.1, &start)
            && !radau.has_recorded(2.0, &y)
    );
    let mut repeated = start;
    radau.replay(&pendulum(3.0), &mut repeated).unwrap();
    assert_eq!(y.map(f64::to_bits), repeated.map(f64::to_bits));
}

#[test]
fn differences_of_replays_are_derivatives() {
    let start = [1.9, -0.4];
    let mut radau = Radau::new(2, tolerances(1e-7));
    let mut difference = |increment: f64| {
        let mut y = start;
        radau.integrate(&pendulum(3.0), 2.0, &mut y).unwrap();
        let mut raised = start;
        radau
            .replay(&pendulum(3.0 + increment), &mut raised)
            .unwrap();
        [0, 1].map(|i| (raised[i] - y[i]) / increment)
    };
    let (fine, coarse) = (difference(1e-6), difference(1e-4));
    // Smooth: what is left is the second derivative (coarse) and rounding (fine), not the tolerance over 1e-6.
    assert!(
        largest_difference(&fine, &coarse) < 1e-4,
        "{fine:?} {coarse:?}"
    );
    let precise = |torque: f64| {
        let mut y = start;
        Radau::new(2, tolerances(1e-13))
            .integrate(&pendulum(torque), 2.0, &mut y)
            .unwrap();
        y
    };
    let (high, low) = (precise(3.0 + 1e-4), precise(3.0 - 1e-4));
    let derivative = [0, 1].map(|i| (high[i] - low[i]) / 2e-4);
    assert!(
        largest_difference(&fine, &derivative) < 1e-5,
        "{fine:?} {derivative:?}"
    );
}

#[test]
fn a_singularity_is_reported_where_it_is() {
    let ode = Equation(|_, y: &[f64], dy: &mut [f64]| dy[0] = y[0] * y[0]);
    let mut y = [1.0];
    let error = Radau::new(1, tolerances(1e-8))
        .integrate(&ode, 2.0, &mut y)
        .unwrap_err();
    assert!((error.tau - 1.0).abs() < 1e-6, "{error:?}");
}

#[test]
fn an_equation_that_is_no_number_is_reported() {
    let ode = Equation(|t: f64, _: &[f64], dy: &mut [f64]| dy[0] = (0.37 - t).sqrt());
    let mut y = [1.0];
    let error = Radau::new(1, tolerances(1e-8))
        .integrate(&ode, 2.0, &mut y)
        .unwrap_err();
    assert!((error.tau - 0.37).abs() < 1e-6, "{error:?}");
    let nowhere = Equation(|_, _: &[f64], dy: &mut [f64]| dy[0] = f64::NAN);
    let error = Radau::new(1, tolerances(1e-8))
        .integrate(&nowhere, 2.0, &mut y)
        .unwrap_err();
    assert_eq!(
        error,
        IntegrationError {
            tau: 0.0,
            cause: Cause::NotFinite
        }
    );
}

#[test]
fn a_jump_inside_the_interval_is_found_by_the_control() {
    let ode =
        Equation(|t: f64, _: &[f64], dy: &mut [f64]| dy[0] = if t < 0.413 { 1.0 } else { -2.0 });
    let mut y = [0.0];
    let mut radau = Radau::new(1, tolerances(1e-8));
    radau.integrate(&ode, 1.0, &mut y).unwrap();
    assert!((y[0] - (0.413 - 2.0 * 0.587)).abs() < 1e-7, "{}", y[0]);
}
