//! The free damped oscillator.

use crate::oscillator::OscillatorParameters;

/// Position, velocity and acceleration at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Position (m).
    pub x: f64,
    /// Velocity (m/s).
    pub v: f64,
    /// Acceleration (m/s^2).
    pub a: f64,
}

/// The solution of `m x'' + d x' + c x = 0` from `x0`, `v0`, for every damping and for `c = 0`.
///
/// With `delta = d/2m`, `omega^2 = c/m`: below critical damping sine and cosine of `nu t`,
/// `nu^2 = omega^2 - delta^2`. From there on, with `kappa^2 = delta^2 - omega^2` and the slow root
/// `r = -omega^2 / (delta + kappa)` (free of cancellation),
/// `x = e^(r t) (x0 + (v0 - r x0) (1 - e^(-2 kappa t)) / 2 kappa)`, which overflows nowhere and goes over into the
/// critical case `kappa -> 0` without a loss of figures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeOscillation {
    omega_squared: f64,
    delta: f64,
    x0: f64,
    v0: f64,
}

impl FreeOscillation {
    /// Of these parameters, whose ranges are those of [`OscillatorParameters`].
    pub fn new(parameters: &OscillatorParameters) -> Self {
        let &OscillatorParameters { m, c, d, x0, v0 } = parameters;
        Self {
            omega_squared: c / m,
            delta: d / (2.0 * m),
            x0,
            v0,
        }
    }

    /// At `t` seconds after the start.
    pub fn motion(&self, t: f64) -> Motion {
        let omega = self.omega_squared.sqrt();
        // The difference of the squares is taken as a product: near critical damping it nearly vanishes.
        let discriminant = (self.delta - omega) * (self.delta + omega);
        let (x, v) = if discriminant < 0.0 {
            self.oscillating((-discriminant).sqrt(), t)
        } else {
            self.creeping(discriminant.sqrt(), t)
        };
        Motion {
            x,
            v,
            a: -2.0 * self.delta * v - self.omega_squared * x,
        }
    }

    fn oscillating(&self, nu: f64, t: f64) -> (f64, f64) {
        let Self {
            omega_squared,
            delta,
            x0,
            v0,
        } = *self;
        let decay = (-delta * t).exp();
        let (sin, cos) = (nu * t).sin_cos();
        (
            decay * (x0 * cos + (v0 + delta * x0) / nu * sin),
            decay * (v0 * cos - (delta * v0 + omega_squared * x0) / nu * sin),
        )
    }

    fn creeping(&self, kappa: f64, t: f64) -> (f64, f64) {
        let fast = self.delta + kappa;
        let slow = if fast > 0.0 {
            -self.omega_squared / fast
        } else {
            0.0
        };
        let fall = (-2.0 * kappa * t).exp_m1();
        let time = if kappa > 0.0 {
            -fall / (2.0 * kappa)
        } else {
            t
        };
        let decay = (slow * t).exp();
        let excess = self.v0 - slow * self.x0;
        let x = decay * (self.x0 + excess * time);
        (x, slow * x + decay * excess * (1.0 + fall))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn parameters(c: f64, d: f64) -> OscillatorParameters {
        OscillatorParameters {
            m: 1.3,
            c,
            d,
            x0: 0.7,
            v0: -2.9,
        }
    }

    /// `x` and `v` at `t` by the power series of the solution in short parts, without any case.
    fn by_series(parameters: &OscillatorParameters, t: f64, parts: usize) -> (f64, f64) {
        let &OscillatorParameters { m, c, d, x0, v0 } = parameters;
        let h = t / parts as f64;
        let (mut x, mut v) = (x0, v0);
        for _ in 0..parts {
            let mut terms = [x, v * h];
            let mut sums = (x + v * h, v * h);
            for k in 2..30 {
                let n = k as f64;
                let next = -(h * d / m * (n - 1.0) * terms[1] + h * h * c / m * terms[0])
                    / (n * (n - 1.0));
                sums.0 += next;
                sums.1 += n * next;
                terms = [terms[1], next];
            }
            (x, v) = (sums.0, sums.1 / h);
        }
        (x, v)
    }

    #[test]
    fn starts_at_its_initial_values() {
        for (c, d) in [
            (0.0, 0.0),
            (50.0, 0.0),
            (50.0, 3.0),
            (50.0, 400.0),
            (0.0, 3.0),
        ] {
            let parameters = parameters(c, d);
            let start = FreeOscillation::new(&parameters).motion(0.0);
            assert!((start.x - parameters.x0).abs() < 1e-15);
            assert!((start.v - parameters.v0).abs() < 1e-14, "{c} {d} {start:?}");
        }
    }

    #[test]
    fn without_spring_and_damper_it_goes_on_straight() {
        let motion = FreeOscillation::new(&parameters(0.0, 0.0)).motion(3.7);
        assert_eq!(
            motion,
            Motion {
                x: 0.7 - 2.9 * 3.7,
                v: -2.9,
                a: 0.0
            }
        );
    }

    #[test]
    fn nothing_is_lost_around_critical_damping() {
        let c = 37.0;
        let critical = 2.0 * (1.3f64 * c).sqrt();
        for near in [
            0.0, 1e-15, -1e-15, 1e-12, -1e-12, 1e-9, -1e-9, 1e-6, -1e-6, 1e-3, -1e-3,
        ] {
            let parameters = parameters(c, critical * (1.0 + near));
            let (x, v) = by_series(&parameters, 0.9, 400);
            let motion = FreeOscillation::new(&parameters).motion(0.9);
            assert!((motion.x - x).abs() < 1e-13, "{near:e}: {} {x}", motion.x);
            assert!((motion.v - v).abs() < 1e-12, "{near:e}: {} {v}", motion.v);
        }
    }

    #[test]
    fn strong_damping_creeps_without_overflow() {
        let parameters = parameters(2e3, 1e9);
        let t = 1e5;
        let motion = FreeOscillation::new(&parameters).motion(t);
        let expected = (parameters.x0 + parameters.v0 * 1.3e-9) * (-2e-6 * t).exp();
        assert!(
            (motion.x / expected - 1.0).abs() < 1e-12,
            "{motion:?} {expected}"
        );
        assert!(
            (motion.v / (-2e-6 * motion.x) - 1.0).abs() < 1e-12,
            "{motion:?}"
        );
    }

    proptest! {
        #[test]
        fn every_damping_agrees_with_the_power_series(
            log_c in -2f64..4.0,
            log_d in -3f64..2.5,
            t in 0.01f64..1.0,
        ) {
            let parameters = parameters(10f64.powf(log_c), 10f64.powf(log_d));
            let (x, v) = by_series(&parameters, t, 500);
            let motion = FreeOscillation::new(&parameters).motion(t);
            let scale = 1.0 + (parameters.c / parameters.m).sqrt();
            prop_assert!((motion.x - x).abs() < 3e-12, "{} {}", motion.x, x);
            prop_assert!((motion.v - v).abs() < 3e-12 * scale, "{} {}", motion.v, v);
        }
    }
}
