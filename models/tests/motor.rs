//! The reference of the motor-driven slider-crank against closed forms, balances and the mechanism alone.

#![allow(clippy::unwrap_used)]

mod common;

use common::body::difference;
use common::motion::{assert_limit_of_rk4, rate, times_around};
use linchpin_models::reference::{
    Link, Motor, MotorDrivenSliderCrank, SliderCrank, SpeedController,
};
use nalgebra::{Matrix4, Vector4};

const DRIVEN: MotorDrivenSliderCrank = MotorDrivenSliderCrank {
    slider_crank: SliderCrank {
        links: [
            Link {
                m: 1.3,
                inertia: 0.17,
                length: 0.9,
            },
            Link {
                m: 2.1,
                inertia: 0.41,
                length: 1.7,
            },
        ],
        hinges: [[-0.3, 0.2], [0.25, 0.45]],
        gravity: 9.7,
        torque: -0.6,
        angle: 0.7,
        rate: 1.9,
    },
    motor: Motor {
        resistance: 0.43,
        inductance: 0.031,
        back_emf: 0.72,
        torque_per_current: 0.69,
        rotor_inertia: 0.083,
        friction: 0.057,
    },
    controller: SpeedController {
        proportional: 5.3,
        integral: 8.1,
        speed: 7.0,
    },
    current: 1.4,
    error_integral: -0.2,
};

/// Both links on one hinge and no weight: the mechanism is one body, and the drive is linear.
const ONE_BODY: MotorDrivenSliderCrank = MotorDrivenSliderCrank {
    slider_crank: SliderCrank {
        hinges: [[0.4, -0.2]; 2],
        gravity: 0.0,
        ..DRIVEN.slider_crank
    },
    ..DRIVEN
};

/// Moment of inertia of [`ONE_BODY`] about its hinge, without and with the rotor.
fn inertia_of_one_body() -> [f64; 2] {
    let links = ONE_BODY.slider_crank.links;
    let about_hinge = |link: Link| link.inertia + 0.25 * link.m * link.length * link.length;
    let both = about_hinge(links[0]) + about_hinge(links[1]);
    [both, both + ONE_BODY.motor.rotor_inertia]
}

/// The linear system of rate, current and integral by the exponential of its matrix.
#[test]
fn a_drive_of_one_body_moves_as_its_matrix_exponential() {
    let [_, inertia] = inertia_of_one_body();
    let MotorDrivenSliderCrank {
        slider_crank,
        motor,
        controller,
        ..
    } = ONE_BODY;
    let l = motor.inductance;
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        -motor.friction / inertia, motor.torque_per_current / inertia, 0.0, slider_crank.torque / inertia,
        -(controller.proportional + motor.back_emf) / l, -motor.resistance / l, controller.integral / l,
        controller.proportional * controller.speed / l,
        -1.0, 0.0, 0.0, controller.speed,
        0.0, 0.0, 0.0, 0.0,
    );
    let start = Vector4::new(
        slider_crank.rate,
        ONE_BODY.current,
        ONE_BODY.error_integral,
        1.0,
    );
    let times = [0.02, 0.3, 1.1, 4.0];
    for (t, motion) in times.iter().zip(ONE_BODY.motions(&times).unwrap()) {
        let exact = (matrix * *t).exp() * start;
        let rates = motion.slider_crank.rates;
        let own = [rates[0], motion.current, motion.error_integral];
        let error = difference(&own, &exact.as_slice()[..3]);
        assert!(error < 1e-10, "{error:e} at {t}");
        let alpha = (matrix * exact)[0];
        let shaft = inertia_of_one_body()[0] * alpha - slider_crank.torque;
        assert!((motion.shaft_torque - shaft).abs() < 1e-10, "{motion:?}");
    }
}

/// The integral part leaves no error of the rate: in the end the current holds friction and the constant torque.
#[test]
fn the_controller_reaches_its_speed() {
    let end = ONE_BODY.motions(&[60.0]).unwrap()[0];
    let MotorDrivenSliderCrank {
        slider_crank,
        motor,
        controller,
        ..
    } = ONE_BODY;
    let torque = motor.friction * controller.speed - slider_crank.torque;
    let current = torque / motor.torque_per_current;
    let voltage = motor.resistance * current + motor.back_emf * controller.speed;
    let own = [
        end.slider_crank.rates[0],
        end.motor_torque,
        end.current,
        end.voltage,
        end.shaft_torque,
    ];
    let settled = [
        controller.speed,
        torque,
        current,
        voltage,
        -slider_crank.torque,
    ];
    assert!(difference(&own, &settled) < 1e-10, "{own:?} {settled:?}");
}

/// What the voltage and the constant torque bring is stored, or lost in the resistance, in the friction, and by the
/// difference of back-emf and torque constant.
#[test]
fn the_power_balance_holds() {
    let step = 1e-3;
    let motor = DRIVEN.motor;
    for t in [0.1, 0.9] {
        let motions = DRIVEN.motions(&times_around(t, step)).unwrap();
        let now = motions[2];
        let (w, i) = (now.slider_crank.rates[0], now.current);
        let torque = DRIVEN.slider_crank.torque;
        let power = now.voltage * i + torque * w
            - motor.resistance * i * i
            - motor.friction * w * w
            - (motor.back_emf - motor.torque_per_current) * i * w;
        let stored = rate(&motions, step, |motion| motion.energy);
        let error = (stored - power).abs();
        assert!(error < 1e-5 * power.abs(), "{stored} {power} at {t}");
    }
}

/// The rotor alone under the current, its friction and the reaction of the shaft; current and integral by their laws.
#[test]
fn rotor_current_and_integral_follow_their_laws() {
    let step = 1e-3;
    let motions = DRIVEN.motions(&times_around(0.4, step)).unwrap();
    let now = motions[2];
    let w = now.slider_crank.rates[0];
    let Motor {
        resistance,
        inductance,
        back_emf,
        rotor_inertia,
        friction,
        ..
    } = DRIVEN.motor;
    let SpeedController {
        proportional,
        integral,
        speed,
    } = DRIVEN.controller;
    let alpha = rate(&motions, step, |motion| motion.slider_crank.rates[0]);
    let on_rotor = now.motor_torque - friction * w - now.shaft_torque;
    assert!((rotor_inertia * alpha - on_rotor).abs() < 1e-7);
    assert!((now.motor_torque - 0.69 * now.current).abs() < 1e-14);
    let di = rate(&motions, step, |motion| motion.current);
    let lack = now.voltage - resistance * now.current - back_emf * w;
    assert!((inductance * di - lack).abs() < 1e-6, "{di} {lack}");
    let dz = rate(&motions, step, |motion| motion.error_integral);
    assert!((dz - (speed - w)).abs() < 1e-7);
    let voltage = proportional * dz + integral * now.error_integral;
    assert!((now.voltage - voltage).abs() < 1e-6);
}

/// Without a torque of the motor, friction and rotor it is the mechanism alone.
#[test]
fn an_idle_drive_leaves_the_mechanism_alone() {
    let idle = MotorDrivenSliderCrank {
        motor: Motor {
            torque_per_current: 0.0,
            friction: 0.0,
            rotor_inertia: 0.0,
            ..DRIVEN.motor
        },
        ..DRIVEN
    };
    let times = [0.3, 0.8];
    let alone = DRIVEN.slider_crank.motions(&times).unwrap();
    for (driven, alone) in idle.motions(&times).unwrap().iter().zip(alone) {
        let own = driven.slider_crank;
        assert!(difference(&own.angles, &alone.angles) < 1e-10);
        assert!((own.multiplier - alone.multiplier).abs() < 1e-9);
        assert_eq!(driven.shaft_torque, 0.0);
    }
}

/// Euler's equation of the crank alone about its hinge: weight, shaft, constant torque and contact.
#[test]
fn the_shaft_turns_the_crank() {
    let step = 1e-3;
    let motions = DRIVEN.motions(&times_around(0.6, step)).unwrap();
    let now = motions[2];
    let at = now.slider_crank;
    let mechanism = DRIVEN.slider_crank;
    let crank = mechanism.links[0];
    let alpha = rate(&motions, step, |motion| motion.slider_crank.rates[0]);
    let inertia = crank.inertia + 0.25 * crank.m * crank.length * crank.length;
    let weight = -0.5 * crank.m * mechanism.gravity * crank.length * at.angles[0].cos();
    let contact = crank.length * at.multiplier * (at.angles[0] - at.angles[1]).cos();
    let moment = weight + contact + now.shaft_torque + mechanism.torque;
    let error = (inertia * alpha - moment).abs();
    assert!(error < 1e-6, "{error:e} of {moment}");
}

#[test]
fn another_integrator_tends_to_it() {
    let end = DRIVEN.motions(&[1.0]).unwrap()[0];
    let SliderCrank { angle, rate, .. } = DRIVEN.slider_crank;
    let start = [angle, rate, DRIVEN.current, DRIVEN.error_integral];
    let at = end.slider_crank;
    let end = [at.angles[0], at.rates[0], end.current, end.error_integral];
    assert_limit_of_rk4(&DRIVEN, &start, 1.0, &end);
}

#[test]
fn mistakes_are_named() {
    let motor = |motor: Motor| MotorDrivenSliderCrank { motor, ..DRIVEN };
    let controller = |controller: SpeedController| MotorDrivenSliderCrank {
        controller,
        ..DRIVEN
    };
    let own = DRIVEN.motor;
    let speed = DRIVEN.controller;
    #[rustfmt::skip]
    let mistakes = [
        (motor(Motor { resistance: -1.0, ..own }), "resistance = -1"),
        (motor(Motor { inductance: 0.0, ..own }), "inductance = 0"),
        (motor(Motor { back_emf: f64::NAN, ..own }), "back_emf = NaN"),
        (motor(Motor { torque_per_current: f64::NAN, ..own }), "torque_per_current = NaN"),
        (motor(Motor { rotor_inertia: -0.1, ..own }), "rotor_inertia = -0.1"),
        (motor(Motor { friction: -0.1, ..own }), "friction = -0.1"),
        (controller(SpeedController { proportional: f64::NAN, ..speed }), "proportional = NaN"),
        (controller(SpeedController { integral: f64::INFINITY, ..speed }), "integral = inf"),
        (controller(SpeedController { speed: f64::NAN, ..speed }), "speed = NaN"),
        (MotorDrivenSliderCrank { current: f64::NAN, ..DRIVEN }, "current = NaN"),
        (MotorDrivenSliderCrank { error_integral: f64::NAN, ..DRIVEN }, "error_integral = NaN"),
        (
            MotorDrivenSliderCrank { slider_crank: SliderCrank { gravity: f64::NAN, ..DRIVEN.slider_crank }, ..DRIVEN },
            "gravity = NaN",
        ),
    ];
    for (own, field) in mistakes {
        let message = own.motions(&[0.0]).unwrap_err().to_string();
        assert!(
            message.contains(field) && message.contains("must be"),
            "{message}"
        );
    }
}
