//! The reference of the four-bar linkage against Newton's laws, its closed loop and a pendulum.

#![allow(clippy::unwrap_used)]

mod common;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use common::agm;
use common::motion::{assert_limit_of_rk4, rate, second_rate, times_around};
use linchpin_models::reference::{Bar, FourBar, FourBarMotion, ReferenceError, Shake, Side};
use nalgebra::{Rotation2, Vector2};

/// The crank turns round and the rocker swings.
const LINKAGE: FourBar = FourBar {
    bars: [
        Bar {
            m: 1.3,
            inertia: 0.017,
            length: 0.4,
            centre: [0.17, -0.03],
        },
        Bar {
            m: 2.1,
            inertia: 0.21,
            length: 1.1,
            centre: [0.62, 0.09],
        },
        Bar {
            m: 0.9,
            inertia: 0.08,
            length: 0.8,
            centre: [0.31, 0.05],
        },
    ],
    frame_hinges: [[-0.3, 0.2], [0.65, 0.45]],
    side: Side::Right,
    shake: Shake {
        amplitude: 0.0,
        frequency: 0.0,
    },
    gravity: 9.7,
    torque: 0.0,
    angle: 0.7,
    rate: -9.0,
};

const SHAKEN: FourBar = FourBar {
    shake: Shake {
        amplitude: 0.07,
        frequency: 2.3,
    },
    torque: 1.7,
    ..LINKAGE
};

/// The other place of the hinge between coupler and rocker.
const TURNED_OVER: FourBar = FourBar {
    side: Side::Left,
    ..SHAKEN
};

/// Both hinges of the frame inside of the circles of crank and rocker, so that both turn round (drag link).
const DRAG_LINK: FourBar = FourBar {
    bars: [
        Bar {
            length: 1.0,
            ..LINKAGE.bars[0]
        },
        LINKAGE.bars[1],
        Bar {
            length: 0.9,
            ..LINKAGE.bars[2]
        },
    ],
    frame_hinges: [[-0.3, 0.2], [0.1, 0.3]],
    ..LINKAGE
};

const ALL: [FourBar; 4] = [LINKAGE, SHAKEN, TURNED_OVER, DRAG_LINK];

fn over_two_seconds(own: &FourBar) -> Vec<FourBarMotion> {
    let times: Vec<_> = (0..=400).map(|i| 5e-3 * f64::from(i)).collect();
    own.motions(&times).unwrap()
}

fn along(motion: &FourBarMotion, bar: usize, point: [f64; 2]) -> Vector2<f64> {
    Rotation2::new(motion.angles[bar]) * Vector2::from(point)
}

/// First hinge of a bar, seen from outside of the frame.
fn first_hinge(own: &FourBar, motion: &FourBarMotion, bar: usize) -> Vector2<f64> {
    let frame = Vector2::new(motion.frame_position, 0.0);
    let [crank, rocker] = own.frame_hinges.map(Vector2::from);
    match bar {
        0 => frame + crank,
        1 => frame + crank + along(motion, 0, [own.bars[0].length, 0.0]),
        _ => frame + rocker,
    }
}

fn centre(own: &FourBar, motion: &FourBarMotion, bar: usize) -> Vector2<f64> {
    first_hinge(own, motion, bar) + along(motion, bar, own.bars[bar].centre)
}

#[test]
fn the_loop_stays_closed_on_its_side() {
    for own in ALL {
        for motion in over_two_seconds(&own) {
            let [coupler, rocker] = [1, 2].map(|bar| {
                let tip = along(&motion, bar, [own.bars[bar].length, 0.0]);
                first_hinge(&own, &motion, bar) + tip
            });
            let gap = (coupler - rocker).norm();
            assert!(gap < 1e-13, "{gap:e} at {}", motion.t);
            let hinge = first_hinge(&own, &motion, 2);
            let line = first_hinge(&own, &motion, 1) - hinge;
            let side = line.perp(&(rocker - hinge));
            assert_eq!(side > 0.0, own.side == Side::Left, "{side} at {}", motion.t);
        }
    }
}

/// The crank turns round; the angles of coupler and rocker follow their rates without a jump.
#[test]
fn all_angles_are_continuous() {
    for (own, turns_round) in [(LINKAGE, false), (DRAG_LINK, true)] {
        let motions = over_two_seconds(&FourBar {
            gravity: 0.0,
            rate: 15.0,
            ..own
        });
        for pair in motions.windows(2) {
            for bar in 0..3 {
                let turned = pair[1].angles[bar] - pair[0].angles[bar];
                assert!(turned.abs() < 0.5, "bar {bar} jumps at {}", pair[0].t);
            }
        }
        let [first, last] = [motions[0], motions[400]];
        assert!(first.angles[1..].iter().all(|angle| angle.abs() <= PI));
        assert!(last.angles[0] > 2.0 * TAU, "{last:?}");
        assert_eq!(last.angles[2] > TAU, turns_round, "{last:?}");
    }
}

#[test]
fn on_a_frame_at_rest_the_energy_stays() {
    for own in [LINKAGE, DRAG_LINK] {
        let motions = over_two_seconds(&own);
        let start = motions[0].energy;
        let change = |motion: &FourBarMotion| (motion.energy - start).abs();
        let drift = motions.iter().map(change).fold(0.0, f64::max);
        println!("drift {drift:e} of {start}");
        assert!(drift < 1e-10, "{drift:e}");
    }
}

/// The forces of the frame move with it, and so does the torque with the crank.
#[test]
fn the_frame_does_its_work() {
    let step = 4e-4;
    for own in [SHAKEN, TURNED_OVER] {
        let motions = own.motions(&times_around(0.57, step)).unwrap();
        let now = motions[2];
        let velocity = rate(&motions, step, |motion| motion.frame_position);
        assert!((velocity - now.frame_velocity).abs() < 1e-8);
        let [on_crank, _, _, on_frame] = now.hinge_forces;
        let power = (on_crank[0] - on_frame[0]) * velocity + own.torque * now.rates[0];
        let change = rate(&motions, step, |motion| motion.energy);
        assert!(power.abs() > 1.0);
        assert!((change - power).abs() < 1e-5, "{change} {power}");
    }
}

/// Newton's and Euler's laws of every bar under its weight and the forces in its hinges. The crank's moments
/// enter no hinge force, so that they check its equation.
#[test]
fn the_hinge_forces_accelerate_the_bars() {
    let step = 4e-4;
    for own in ALL {
        for t in [0.1, 0.57] {
            let motions = own.motions(&times_around(t, step)).unwrap();
            let now = motions[2];
            let forces = now.hinge_forces.map(Vector2::from);
            // Of the neighbours, on crank, coupler and rocker; the rocker's first hinge is its last one in the loop.
            let loads = [
                [forces[0], -forces[1]],
                [forces[1], -forces[2]],
                [-forces[3], forces[2]],
            ];
            for (i, bar) in own.bars.iter().enumerate() {
                let [first, second] = loads[i];
                let acceleration = Vector2::from([0, 1].map(|axis| {
                    second_rate(&motions, step, |motion| centre(&own, motion, i)[axis])
                }));
                let weight = Vector2::new(0.0, -bar.m * own.gravity);
                let error = (bar.m * acceleration - weight - first - second).norm();
                assert!(
                    error < 2e-5,
                    "bar {i} at {t}: {error:e} of {first} {second}"
                );
                let arm =
                    |along_bar: f64| along(&now, i, [along_bar - bar.centre[0], -bar.centre[1]]);
                let moment = arm(0.0).perp(&first)
                    + arm(bar.length).perp(&second)
                    + if i == 0 { own.torque } else { 0.0 };
                let alpha = rate(&motions, step, |motion| motion.rates[i]);
                let error = (bar.inertia * alpha - moment).abs();
                assert!(error < 2e-6, "bar {i} at {t}: {error:e} of {moment}");
                let turning = rate(&motions, step, |motion| motion.angles[i]);
                assert!((turning - now.rates[i]).abs() < 1e-7, "bar {i} at {t}");
            }
        }
    }
}

/// Crank and rocker of one length, coupler as long as the frame: the coupler does not turn, and the linkage is a
/// pendulum with the period `2 pi / (w agm(1, cos(A/2)))` at the amplitude `A`.
#[test]
fn a_parallelogram_swings_as_a_pendulum() {
    let [mut crank, mut coupler, mut rocker] = LINKAGE.bars;
    crank.length = 0.7;
    rocker.length = 0.7;
    coupler.length = 0.9;
    let inertia = crank.inertia
        + rocker.inertia
        + crank.m * Vector2::from(crank.centre).norm_squared()
        + rocker.m * Vector2::from(rocker.centre).norm_squared()
        + coupler.m * 0.49;
    let moment = crank.m * Vector2::from(crank.centre)
        + rocker.m * Vector2::from(rocker.centre)
        + coupler.m * Vector2::new(0.7, 0.0);
    let rest = -FRAC_PI_2 - moment.y.atan2(moment.x);
    let amplitude = 0.9;
    let own = FourBar {
        bars: [crank, coupler, rocker],
        frame_hinges: [[-0.3, 0.2], [0.6, 0.2]],
        side: Side::Left,
        angle: rest + amplitude,
        rate: 0.0,
        ..LINKAGE
    };
    let omega = (moment.norm() * own.gravity / inertia).sqrt();
    let period = TAU / (omega * agm(1.0, (0.5 * amplitude).cos()));
    let motions = own.motions(&[0.5 * period, period]).unwrap();
    for (motion, expected) in motions.iter().zip([rest - amplitude, rest + amplitude]) {
        assert!((motion.angles[0] - expected).abs() < 1e-10, "{motion:?}");
        assert!((motion.angles[2] - expected).abs() < 1e-10, "{motion:?}");
        assert!(motion.angles[1].abs() < 1e-10, "{motion:?}");
        assert!(motion.rates[0].abs() < 1e-10, "{motion:?}");
    }
}

/// The time of the shaken frame counts from the start, whatever times are asked for before.
#[test]
fn stops_on_the_way_change_nothing() {
    let alone = SHAKEN.motions(&[0.9]).unwrap()[0];
    let with_stops = SHAKEN.motions(&[0.0, 0.23, 0.4, 0.9]).unwrap()[3];
    assert!((alone.angles[0] - with_stops.angles[0]).abs() < 1e-9);
    assert!((alone.rates[0] - with_stops.rates[0]).abs() < 1e-8);
}

#[test]
fn another_integrator_tends_to_it() {
    for own in [SHAKEN, TURNED_OVER] {
        let end = own.motions(&[0.5]).unwrap()[0];
        assert_limit_of_rk4(
            &own,
            &[own.angle, own.rate],
            0.5,
            &[end.angles[0], end.rates[0]],
        );
    }
}

#[test]
fn mistakes_are_named() {
    let second = |alter: fn(&mut Bar)| {
        let mut own = LINKAGE;
        alter(&mut own.bars[1]);
        own
    };
    let shaken = |amplitude: f64, frequency: f64| FourBar {
        shake: Shake {
            amplitude,
            frequency,
        },
        ..LINKAGE
    };
    #[rustfmt::skip]
    let mistakes = [
        (second(|bar| bar.m = 0.0), "body 1 (from 0) has m = 0"),
        (second(|bar| bar.inertia = -1.0), "body 1 (from 0) has inertia = -1"),
        (second(|bar| bar.length = f64::NAN), "body 1 (from 0) has length = NaN"),
        (second(|bar| bar.centre[1] = f64::NAN), "body 1 (from 0) has centre = NaN"),
        (FourBar { frame_hinges: [[0.0; 2], [f64::NAN; 2]], ..LINKAGE }, "frame_hinges = NaN"),
        (shaken(f64::NAN, 1.0), "amplitude = NaN"),
        (shaken(1.0, f64::INFINITY), "frequency = inf"),
        (FourBar { gravity: f64::NAN, ..LINKAGE }, "gravity = NaN"),
        (FourBar { torque: f64::NAN, ..LINKAGE }, "torque = NaN"),
        (FourBar { angle: f64::NAN, ..LINKAGE }, "angle = NaN"),
        (FourBar { rate: f64::NAN, ..LINKAGE }, "rate = NaN"),
        (second(|bar| bar.length = 9.0), "reach distances between 8.2 m and 9.8 m"),
    ];
    for (own, expected) in mistakes {
        let message = own.motions(&[0.0]).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    }
}

/// A crank that drives coupler and rocker into one line cannot go on.
#[test]
fn a_dead_position_of_coupler_and_rocker_is_refused() {
    let mut own = LINKAGE;
    own.bars[1].length = 0.6;
    own.torque = 9.0;
    own.rate = 0.0;
    own.angle = 0.9;
    let error = own.motions(&[9.0]).unwrap_err();
    assert!(
        matches!(error, ReferenceError::Integration { .. }),
        "{error}"
    );
}
