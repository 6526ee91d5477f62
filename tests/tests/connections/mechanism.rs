//! The motor scenes against monolithic solutions of the whole drive.

use std::f64::consts::{FRAC_PI_4, SQRT_2, TAU};

use linchpin::connect::Place;
use linchpin_models::reference::{
    Link, Motor, MotorDrivenMotion, MotorDrivenSliderCrank, SliderCrank, SpeedController,
};
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::with_settings;

use crate::{TIGHT, error_of};
use linchpin_tests::convergence::assert_all_orders;

const SPEED: f64 = 5.0;
const INTEGRAL: f64 = 200.0;
const BLOCK_MASS: f64 = 0.5;
const BLOCK_INERTIA: f64 = 0.01;

/// A scene with what is compared.
struct Drive {
    scene: &'static str,
    reference: fn() -> MotorDrivenSliderCrank,
    /// Result columns, and what they are in the reference.
    multipliers: &'static [(&'static str, Value)],
}

/// A value of the reference.
type Value = fn(&MotorDrivenMotion) -> f64;

/// The rotor is the crank, and carries the block on its pin.
const CRANK: Drive = Drive {
    scene: include_str!("../../../scenes/motor/slider-crank.toml"),
    reference: with_block,
    multipliers: &[
        ("slider.lambda.inplane", |motion| {
            motion.slider_crank.multiplier
        }),
        ("pin.lambda.x", |motion| force_on_pin(motion)[0]),
        ("pin.lambda.y", |motion| force_on_pin(motion)[1]),
    ],
};

/// The shaft turns link 1.
const SHAFT: Drive = Drive {
    scene: include_str!("../../../scenes/motor/driven-link.toml"),
    reference: with_link,
    multipliers: &[
        ("slider.lambda", |motion| motion.slider_crank.multiplier),
        // The moment on the rotor.
        ("shaft.lambda", |motion| -motion.shaft_torque),
    ],
};

/// S1's slider-crank on the motor of both scenes.
fn with_link() -> MotorDrivenSliderCrank {
    MotorDrivenSliderCrank {
        slider_crank: SliderCrank::schweizer_lu(),
        motor: Motor {
            resistance: 0.5,
            inductance: 0.02,
            back_emf: 5.0,
            torque_per_current: 5.0,
            rotor_inertia: 10.0,
            friction: 0.2,
        },
        controller: SpeedController {
            proportional: 60.0,
            integral: INTEGRAL,
            speed: SPEED,
        },
        current: 0.0,
        error_integral: 0.0,
    }
}

/// The mass of the block is on the pin, and it turns with link 2. A link of twice the mass and length `l` has the moment
/// `-m g l cos p` of its weight, and with `m l^2 / 2` about its middle the moment of inertia `m l^2` about its hinge.
fn with_block() -> MotorDrivenSliderCrank {
    let drive = with_link();
    let mut links = drive.slider_crank.links;
    links[0] = Link {
        m: 2.0 * BLOCK_MASS,
        inertia: 0.5 * BLOCK_MASS * SQRT_2 * SQRT_2,
        length: SQRT_2,
    };
    links[1].inertia += BLOCK_INERTIA;
    MotorDrivenSliderCrank {
        slider_crank: SliderCrank {
            links,
            ..drive.slider_crank
        },
        ..drive
    }
}

/// Force on the rotor: what accelerates the block is the opposite, its weight and the force of link 2.
fn force_on_pin(motion: &MotorDrivenMotion) -> [f64; 2] {
    let own = &motion.slider_crank;
    let across = [-own.angles[1].sin(), own.angles[1].cos()];
    let [radial, tangential] = [-own.rates[0].powi(2), alpha(motion)].map(|a| a * SQRT_2);
    let (sin, cos) = own.angles[0].sin_cos();
    let acceleration = [
        radial * cos - tangential * sin,
        radial * sin + tangential * cos,
    ];
    let weight = [0.0, -BLOCK_MASS * 9.81];
    [0, 1]
        .map(|axis| weight[axis] + own.multiplier * across[axis] - BLOCK_MASS * acceleration[axis])
}

/// Angular acceleration of the crank, from the torque that turns it.
fn alpha(motion: &MotorDrivenMotion) -> f64 {
    let motor = with_block().motor;
    let on_rotor = motion.motor_torque - motor.friction * motion.slider_crank.rates[0];
    (on_rotor - motion.shaft_torque) / motor.rotor_inertia
}

impl Drive {
    fn run(&self, coupling: &str, others: &[&str]) -> Trajectory {
        let others = [&[TIGHT], others].concat();
        run(
            &with_settings(self.scene, coupling, &others),
            Place::InProcess,
        )
    }

    fn exact(&self, trajectory: &Trajectory) -> Vec<MotorDrivenMotion> {
        (self.reference)().motions(&trajectory.column("t")).unwrap()
    }

    /// Errors of the angles, of current and voltage, and of the multipliers.
    fn errors(&self, trajectory: &Trajectory) -> [f64; 3] {
        let motions = self.exact(trajectory);
        let pair = |column: &str, exact: Value| {
            (
                trajectory.column(column),
                motions.iter().map(exact).collect(),
            )
        };
        let multipliers = self.multipliers.iter();
        let multipliers: Vec<_> = multipliers
            .map(|(name, exact)| pair(name, *exact))
            .collect();
        [
            error_of(&[
                pair("motor.angle", |motion| motion.slider_crank.angles[0]),
                pair("link2.angle", |motion| motion.slider_crank.angles[1]),
            ]),
            error_of(&[
                pair("motor.current", |motion| motion.current),
                pair("controller.control", |motion| motion.voltage),
            ]),
            error_of(&multipliers),
        ]
    }
}

/// Multipliers of degree k have the order k + 1 and add the order k + 2 to the motion; signals and exchanged motion of degree
/// k' add k' + 1. With k = 0 the error of the motion that the start leaves falls faster, so that 2 is reached from above.
#[test]
fn orders_of_convergence() {
    const STEPS: [f64; 4] = [2e-3, 1e-3, 5e-4, 2.5e-4];
    let cases = [
        ("degree=0 exchanged_degree=0", [1.0, 1.0, 1.0]),
        ("degree=0 exchanged_degree=2", [2.15, 2.15, 1.0]),
        ("degree=1 exchanged_degree=1", [2.0, 2.0, 2.0]),
        ("degree=1 exchanged_degree=2", [3.0, 3.0, 2.0]),
        ("degree=1 exchanged_degree=3", [3.0, 3.0, 2.0]),
        // The start limits the multipliers, as for the oscillator.
        ("degree=2 exchanged_degree=2", [3.0, 3.0, 2.5]),
        ("index=2 a=1 degree=0 exchanged_degree=2", [2.05, 2.0, 1.0]),
        (
            "method=baumgarte index=3 degree=0 exchanged_degree=2",
            [2.05, 2.0, 1.0],
        ),
        (
            "method=baumgarte degree=1 exchanged_degree=2",
            [3.0, 3.0, 2.0],
        ),
    ];
    for drive in [&CRANK, &SHAFT] {
        assert_all_orders(&cases, &STEPS, |coupling, h| {
            let coupling = format!("{coupling} macro_step={h}");
            drive.errors(&drive.run(&coupling, &["scene.t_end=0.4"]))
        });
    }
}

#[test]
fn the_mechanism_turns_at_the_set_speed() {
    for drive in [&CRANK, &SHAFT] {
        let whole = drive.run("macro_step=1e-3", &[]);
        let [angles, electric, multipliers] = drive.errors(&whole);
        println!("{angles:e} {electric:e} {multipliers:e}");
        let turned =
            |column: &str, start: f64| (whole.column(column).last().unwrap() - start) / TAU;
        let [crank, link] = [
            turned("motor.angle", FRAC_PI_4),
            turned("link2.angle", 2.0 * FRAC_PI_4),
        ];
        assert!(crank > 3.0 && link > 3.0 - 0.25, "{crank} {link} turns");
        let rates = whole.column("motor.rate");
        let angle = whole.column("motor.angle");
        let last_turn = angle
            .iter()
            .position(|own| own + TAU > angle[angle.len() - 1])
            .unwrap();
        let mean = rates[last_turn..].iter().sum::<f64>() / (rates.len() - last_turn) as f64;
        assert!((mean / SPEED - 1.0).abs() < 0.02, "mean rate {mean}");
        assert!(angles < 1e-6 && electric < 1e-5 && multipliers < 1e-4);
    }
}

#[test]
fn every_method_runs() {
    for drive in [&CRANK, &SHAFT] {
        for (coupling, worst) in [
            ("method=weighted degree=1 loads=master", 1e-5),
            ("method=weighted index=2 a=1 degree=0", 1e-4),
            ("method=weighted index=3 degree=0", 1e-4),
            ("method=baumgarte degree=1", 1e-5),
            ("method=baumgarte index=2 beta=2e-3 degree=0", 1e-3),
            ("method=explicit mu=2e-3 degree=0 exchanged_degree=0", 3e-2),
        ] {
            let [angles, ..] = drive.errors(&drive.run(coupling, &["scene.t_end=0.4"]));
            println!("{coupling}: {angles:e}");
            assert!(angles < worst, "{coupling}: {angles:e}");
        }
    }
}

/// Nothing moves at the start: the force in the slider is that of the weights and of the voltage that is not yet a current.
#[test]
fn the_first_row_is_consistent() {
    for drive in [&CRANK, &SHAFT] {
        let first = drive.run("macro_step=1e-3", &["scene.t_end=1e-3"]);
        let exact = &drive.exact(&first)[0];
        for (column, of) in drive.multipliers {
            let (found, expected) = (first.column(column)[0], of(exact));
            assert!(
                (found - expected).abs() < 1e-9,
                "{column}: {found} {expected}"
            );
        }
        let voltage = first.column("controller.control")[0];
        assert!((voltage - 60.0 * SPEED).abs() < 1e-12, "{voltage}");
    }
}
