//! The slider-crank on the shaft of a direct-current motor with a speed controller.

use super::ranges::{finite, not_negative, positive};
use super::slider_crank::{Drive, SliderCrank, SliderCrankMotion};
use super::{ReferenceError, trajectory};
use crate::integrators::Ode;

/// A direct-current motor with a constant field: `L i' = u - R i - k_e w` under the voltage `u` at the rate `w`, torque
/// `k_t i - b w` on the rotor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motor {
    /// `R` (ohm), not negative.
    pub resistance: f64,
    /// `L` (H), positive.
    pub inductance: f64,
    /// `k_e`, voltage per rate (V s/rad).
    pub back_emf: f64,
    /// `k_t`, torque per current (N m/A).
    pub torque_per_current: f64,
    /// Moment of inertia of the rotor (kg m^2), not negative.
    pub rotor_inertia: f64,
    /// `b`, viscous friction of the rotor (N m s/rad), not negative.
    pub friction: f64,
}

/// A proportional-integral controller of a rate `w`: `u = K_p e + K_i z`, `z' = e`, `e = speed - w`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedController {
    /// `K_p` (V s/rad).
    pub proportional: f64,
    /// `K_i` (V/rad).
    pub integral: f64,
    /// The rate that is wanted (rad/s).
    pub speed: f64,
}

/// A slider-crank whose crank turns with the rotor of a motor.
///
/// The state is `(p1, p1', i, z)`. The crank's equation is that of [`SliderCrank`] with the rotor's inertia added to
/// the crank's and the motor's torque to [`SliderCrank::torque`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotorDrivenSliderCrank {
    /// The mechanism.
    pub slider_crank: SliderCrank,
    /// The motor, whose shaft is the hinge of the crank.
    pub motor: Motor,
    /// What sets its voltage.
    pub controller: SpeedController,
    /// Current at the start (A).
    pub current: f64,
    /// Integral `z` of the rate's error at the start (rad).
    pub error_integral: f64,
}

/// Motion of a motor-driven slider-crank at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotorDrivenMotion {
    /// The mechanism; its energy is that of the two links.
    pub slider_crank: SliderCrankMotion,
    /// Current (A).
    pub current: f64,
    /// Integral `z` of the rate's error (rad).
    pub error_integral: f64,
    /// Voltage at the motor (V).
    pub voltage: f64,
    /// Torque of the current on the rotor, `k_t i` (N m).
    pub motor_torque: f64,
    /// Torque of the rotor on the crank (N m): what motor and friction leave after turning the rotor.
    pub shaft_torque: f64,
    /// Energy of the links, of the turning rotor and of the current in the inductance (J).
    pub energy: f64,
}

impl MotorDrivenSliderCrank {
    /// The motion at `times` (s since the start), which must ascend from 0; Radau IIA with the tolerance 1e-12.
    ///
    /// # Errors
    /// [`ReferenceError`] if a parameter is out of its range, the times do not ascend, or the integration fails, as it
    /// does where the tip of the crank comes to hinge 2.
    pub fn motions(&self, times: &[f64]) -> Result<Vec<MotorDrivenMotion>, ReferenceError> {
        self.slider_crank.check()?;
        self.motor.check()?;
        self.controller.check()?;
        finite("current", self.current)?;
        finite("error_integral", self.error_integral)?;
        let SliderCrank { angle, rate, .. } = self.slider_crank;
        let start = [angle, rate, self.current, self.error_integral];
        let states = trajectory::states(self, &start, times)?;
        let motions = times.iter().zip(states);
        Ok(motions
            .map(|(&t, state)| self.motion(t, [state[0], state[1], state[2], state[3]]))
            .collect())
    }

    fn drive(&self, rate: f64, current: f64) -> Drive {
        Drive {
            torque: self.slider_crank.torque + self.motor.torque(rate, current),
            inertia: self.motor.rotor_inertia,
        }
    }

    fn motion(&self, t: f64, [angle, rate, current, integral]: [f64; 4]) -> MotorDrivenMotion {
        let drive = self.drive(rate, current);
        let slider_crank = self.slider_crank.motion(t, angle, rate, drive);
        let alpha = self.slider_crank.crank_acceleration(angle, rate, drive);
        let Motor {
            inductance,
            torque_per_current,
            rotor_inertia,
            ..
        } = self.motor;
        let stored = 0.5 * (rotor_inertia * rate * rate + inductance * current * current);
        MotorDrivenMotion {
            slider_crank,
            current,
            error_integral: integral,
            voltage: self.controller.voltage(rate, integral),
            motor_torque: torque_per_current * current,
            shaft_torque: self.motor.torque(rate, current) - rotor_inertia * alpha,
            energy: slider_crank.energy + stored,
        }
    }
}

impl Motor {
    fn check(&self) -> Result<(), ReferenceError> {
        not_negative("resistance", self.resistance)?;
        positive("inductance", self.inductance)?;
        finite("back_emf", self.back_emf)?;
        finite("torque_per_current", self.torque_per_current)?;
        not_negative("rotor_inertia", self.rotor_inertia)?;
        not_negative("friction", self.friction)
    }

    /// Of current and friction on the rotor (N m).
    fn torque(&self, rate: f64, current: f64) -> f64 {
        self.torque_per_current * current - self.friction * rate
    }

    fn current_rate(&self, voltage: f64, rate: f64, current: f64) -> f64 {
        (voltage - self.resistance * current - self.back_emf * rate) / self.inductance
    }
}

impl SpeedController {
    fn check(&self) -> Result<(), ReferenceError> {
        finite("proportional", self.proportional)?;
        finite("integral", self.integral)?;
        finite("speed", self.speed)
    }

    fn voltage(&self, rate: f64, integral: f64) -> f64 {
        self.proportional * (self.speed - rate) + self.integral * integral
    }
}

impl Ode for MotorDrivenSliderCrank {
    fn derivative(&self, _: f64, y: &[f64], dy: &mut [f64]) {
        let (angle, rate, current, integral) = (y[0], y[1], y[2], y[3]);
        let drive = self.drive(rate, current);
        let voltage = self.controller.voltage(rate, integral);
        dy[0] = rate;
        dy[1] = self.slider_crank.crank_acceleration(angle, rate, drive);
        dy[2] = self.motor.current_rate(voltage, rate, current);
        dy[3] = self.controller.speed - rate;
    }
}
