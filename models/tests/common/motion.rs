//! Rates of change of a reference, and its comparison with another integrator.

use linchpin_models::integrators::{Ode, Rk4};

use super::body::difference;

/// Five times around `t`, `step` apart.
pub fn times_around(t: f64, step: f64) -> [f64; 5] {
    [-2.0, -1.0, 0.0, 1.0, 2.0].map(|i| t + step * i)
}

/// First derivative in the middle of five points, by differences of fourth order.
pub fn rate<T>(points: &[T], step: f64, value: impl Fn(&T) -> f64) -> f64 {
    let at = |i: usize| value(&points[i]);
    (at(0) - 8.0 * at(1) + 8.0 * at(3) - at(4)) / (12.0 * step)
}

/// Second derivative in the middle of five points, by differences of fourth order.
pub fn second_rate<T>(points: &[T], step: f64, value: impl Fn(&T) -> f64) -> f64 {
    let at = |i: usize| value(&points[i]);
    (-at(0) + 16.0 * at(1) - 30.0 * at(2) + 16.0 * at(3) - at(4)) / (12.0 * step * step)
}

/// The method of Runge and Kutta comes nearer to `end` by 12 and more with each halving of its step, down to 1e-10.
pub fn assert_limit_of_rk4(ode: &impl Ode, start: &[f64], length: f64, end: &[f64]) {
    let errors = [1000, 2000, 4000].map(|parts| {
        let mut state = start.to_vec();
        Rk4::new(start.len())
            .integrate(ode, length, parts, &mut state)
            .unwrap();
        difference(&state, end)
    });
    println!("errors of Runge-Kutta {errors:?}");
    for pair in errors.windows(2) {
        let falls = pair[1] < pair[0] / 12.0 || pair[1] < 1e-11;
        assert!(falls, "{errors:?}");
    }
    assert!(errors[2] < 1e-10, "{errors:?}");
}
