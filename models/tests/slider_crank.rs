//! The reference of the slider-crank against the paper, Newton's laws and a coupled run.

#![allow(clippy::unwrap_used)]

mod common;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use common::body::difference;
use common::motion::{assert_limit_of_rk4, rate, second_rate, times_around};
use linchpin_models::reference::{Link, ReferenceError, SliderCrank, SliderCrankMotion};

const MOVING: SliderCrank = SliderCrank {
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
    torque: 3.1,
    angle: 0.7,
    rate: 2.9,
};

/// The second hinge outside of the circle of the crank's tip.
const SWINGING: SliderCrank = SliderCrank {
    hinges: [[-0.3, 0.2], [0.8, 1.1]],
    ..MOVING
};

/// Both, without the torque.
const FREE: [SliderCrank; 2] = [
    SliderCrank {
        torque: 0.0,
        ..MOVING
    },
    SliderCrank {
        torque: 0.0,
        ..SWINGING
    },
];

fn even_times(step: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|i| i as f64 * step).collect()
}

/// Centre of mass of a link.
fn centre(own: &SliderCrank, motion: &SliderCrankMotion, link: usize) -> [f64; 2] {
    let (sin, cos) = motion.angles[link].sin_cos();
    let half = 0.5 * own.links[link].length;
    let [x, y] = own.hinges[link];
    [x + half * cos, y + half * sin]
}

/// Tip of the crank.
fn tip(own: &SliderCrank, motion: &SliderCrankMotion) -> [f64; 2] {
    let (sin, cos) = motion.angles[0].sin_cos();
    let length = own.links[0].length;
    [
        own.hinges[0][0] + length * cos,
        own.hinges[0][1] + length * sin,
    ]
}

/// The figures of S1 Sect. 4.3 (seed notes, fact 7).
#[test]
fn the_paper_s_mechanism_starts_with_its_multiplier_and_energy() {
    let own = SliderCrank::schweizer_lu();
    let start = own.motions(&[0.0]).unwrap().remove(0);
    assert!(
        (start.multiplier - 5.124820).abs() < 5e-7,
        "{}",
        start.multiplier
    );
    assert!((start.energy - 26.556718).abs() < 5e-7, "{}", start.energy);
    assert!((start.angles[1] - FRAC_PI_2).abs() < 1e-15);
    assert!((start.slider - 1.0).abs() < 1e-15);
    assert_eq!(start.rates, [0.0, 0.0]);
}

/// Rows of another program's runs (golden runs S01 and S04: degree 0 and 1, H = 1e-3) at 0.06 s: multiplier, angles
/// and rates. The errors of degree 0 are of first, those of degree 1 of second order.
#[test]
fn coupled_runs_of_the_paper_s_mechanism_are_near() {
    let motion = SliderCrank::schweizer_lu().motions(&[0.06]).unwrap()[0];
    let own = [motion.angles, motion.rates].concat();
    let runs = [
        (
            5.142978318642,
            [
                0.781937287494,
                1.567329441057,
                -0.115417777495,
                -0.115819201290,
            ],
            [2e-3, 1e-5],
        ),
        (
            5.143431526686,
            [
                0.781937188263,
                1.567329341691,
                -0.115422612385,
                -0.115824169838,
            ],
            [2e-6, 5e-8],
        ),
    ];
    for (multiplier, state, allowed) in runs {
        let errors = [
            (motion.multiplier - multiplier).abs(),
            difference(&own, &state),
        ];
        println!("{errors:?}");
        assert!(
            errors[0] < allowed[0] && errors[1] < allowed[1],
            "{errors:?}"
        );
    }
}

/// Two turns of the crank in the driven case, all positions in the swinging one.
#[test]
fn the_tip_stays_on_the_axis_of_the_second_link() {
    for own in [MOVING, SWINGING] {
        let motions = own.motions(&even_times(0.05, 60)).unwrap();
        for motion in &motions {
            let (sin, cos) = motion.angles[1].sin_cos();
            let [x, y] = tip(&own, motion);
            let slider = own.hinges[1];
            let on_axis = [
                slider[0] + motion.slider * cos,
                slider[1] + motion.slider * sin,
            ];
            let gap = difference(&on_axis, &[x, y]);
            assert!(gap < 1e-14, "{gap:e} at {}", motion.t);
        }
    }
}

/// With its hinge inside the circle of the tip the second link turns as often as the crank, otherwise it swings.
#[test]
fn the_angle_of_the_second_link_is_continuous() {
    let driven = |own: SliderCrank| SliderCrank {
        rate: 25.0,
        gravity: 0.0,
        ..own
    };
    for (own, turns) in [(driven(MOVING), true), (driven(SWINGING), false)] {
        let motions = own.motions(&even_times(1e-3, 2000)).unwrap();
        for pair in motions.windows(2) {
            let mean = 0.5 * (pair[0].rates[1] + pair[1].rates[1]);
            let turned = pair[1].angles[1] - pair[0].angles[1];
            // Error of the trapezoidal rule.
            let error = (turned - 1e-3 * mean).abs();
            assert!(error < 1e-2, "{error:e} at {}", pair[0].t);
        }
        let last = motions.last().unwrap();
        assert!(last.angles[0] > 4.0 * TAU, "{}", last.angles[0]);
        let apart = (last.angles[0] - last.angles[1]).abs();
        assert_eq!(apart < FRAC_PI_2, turns, "{last:?}");
    }
}

#[test]
fn without_a_torque_the_energy_stays() {
    for own in FREE {
        let motions = own.motions(&even_times(0.1, 30)).unwrap();
        let start = motions[0].energy;
        let drift = motions
            .iter()
            .map(|motion| (motion.energy - start).abs())
            .fold(0.0, f64::max);
        println!("drift {drift:e} of {start}");
        assert!(drift < 1e-10, "{drift:e}");
    }
}

#[test]
fn the_torque_does_its_work() {
    for own in [MOVING, SWINGING] {
        let motions = own.motions(&even_times(0.1, 30)).unwrap();
        for motion in &motions {
            let work = own.torque * (motion.angles[0] - own.angle);
            let error = (motion.energy - motions[0].energy - work).abs();
            assert!(error < 1e-9, "{error:e} at {}", motion.t);
        }
    }
}

/// Newton's and Euler's laws of the single links under their weights, the forces in their hinges and the multiplier.
#[test]
fn the_forces_accelerate_the_links() {
    for (own, t) in [(MOVING, 0.3), (MOVING, 1.1), (SWINGING, 0.4)] {
        let step = 1e-3;
        let motions = own.motions(&times_around(t, step)).unwrap();
        let now = motions[2];
        let (sin, cos) = now.angles[1].sin_cos();
        for (link, sign) in [(0, 1.0), (1, -1.0)] {
            let body = own.links[link];
            let contact = [-sin, cos].map(|n| sign * now.multiplier * n);
            let hinge = now.hinge_forces[link];
            let points: Vec<_> = motions.iter().map(|at| centre(&own, at, link)).collect();
            let weight = [0.0, -body.m * own.gravity];
            for axis in [0, 1] {
                let acceleration = second_rate(&points, step, |point| point[axis]);
                let force = weight[axis] + hinge[axis] + contact[axis];
                let error = (body.m * acceleration - force).abs();
                assert!(
                    error < 1e-6,
                    "link {link}, axis {axis}: {error:e} of {force}"
                );
            }
            let moment = |at: [f64; 2], force: [f64; 2]| {
                let arm = [at[0] - points[2][0], at[1] - points[2][1]];
                arm[0] * force[1] - arm[1] * force[0]
            };
            let moments = moment(own.hinges[link], hinge)
                + moment(tip(&own, &now), contact)
                + if link == 0 { own.torque } else { 0.0 };
            let alpha = rate(&motions, step, |motion| motion.rates[link]);
            let error = (body.inertia * alpha - moments).abs();
            assert!(error < 1e-6, "link {link}: {error:e} of {moments}");
        }
    }
}

/// The trajectory is the limit of another integrator.
#[test]
fn another_integrator_tends_to_it() {
    let own = SWINGING;
    let end = own.motions(&[1.0]).unwrap()[0];
    assert_limit_of_rk4(
        &own,
        &[own.angle, own.rate],
        1.0,
        &[end.angles[0], end.rates[0]],
    );
}

/// On one common hinge both links turn as one body; without gravity its rate grows evenly.
#[test]
fn links_on_one_hinge_turn_together() {
    let own = SliderCrank {
        hinges: [[0.4, -0.2]; 2],
        gravity: 0.0,
        angle: -3.0 * PI,
        ..MOVING
    };
    let [a, b] = own.links;
    let inertia = a.inertia + b.inertia + 0.25 * (a.m * 0.81 + b.m * 2.89);
    let end = own.motions(&[1.7]).unwrap()[0];
    let rate = own.rate + own.torque / inertia * 1.7;
    let angle = own.angle + 0.5 * (own.rate + rate) * 1.7;
    assert!(difference(&end.rates, &[rate; 2]) < 1e-11, "{end:?}");
    assert!(difference(&end.angles, &[angle; 2]) < 1e-11, "{end:?}");
    let multiplier = -(b.inertia + 0.25 * b.m * 2.89) * own.torque / inertia / 0.9;
    assert!((end.multiplier - multiplier).abs() < 1e-11, "{end:?}");
}

#[test]
fn mistakes_are_named() {
    let refused = |own: SliderCrank| own.motions(&[0.0]).unwrap_err().to_string();
    let [first, second] = MOVING.links;
    let with_second = |link: Link| SliderCrank {
        links: [first, link],
        ..MOVING
    };
    for (own, field) in [
        (with_second(Link { m: -2.0, ..second }), "m = -2"),
        (
            with_second(Link {
                length: 0.0,
                ..second
            }),
            "length = 0",
        ),
        (
            SliderCrank {
                hinges: [[0.0, f64::NAN], [1.0, 0.0]],
                ..MOVING
            },
            "hinges = NaN",
        ),
        (
            SliderCrank {
                gravity: f64::INFINITY,
                ..MOVING
            },
            "gravity = inf",
        ),
        (
            SliderCrank {
                torque: f64::NAN,
                ..MOVING
            },
            "torque = NaN",
        ),
        (
            SliderCrank {
                angle: f64::NAN,
                ..MOVING
            },
            "angle = NaN",
        ),
        (
            SliderCrank {
                rate: f64::INFINITY,
                ..MOVING
            },
            "rate = inf",
        ),
    ] {
        let message = refused(own);
        assert!(
            message.contains(field) && message.contains("must be"),
            "{message}"
        );
    }
}

/// Where the tip lies on the second hinge the second link has no direction.
#[test]
fn a_tip_on_the_second_hinge_is_refused() {
    let own = SliderCrank {
        hinges: [[0.0, 0.0], [0.9, 0.0]],
        angle: 0.0,
        ..MOVING
    };
    let error = own.motions(&[0.1]).unwrap_err();
    assert!(
        matches!(error, ReferenceError::Integration { t: 0.0, .. }),
        "{error}"
    );
}
