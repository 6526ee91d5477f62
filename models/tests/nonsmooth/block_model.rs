//! The block as a subsystem: its outputs against closed forms.

use super::ball_model::SOLVERS;
use super::common::body::Body;
use super::common::numbers;

const MASS: f64 = 1.37;
const GRAVITY: f64 = 9.79;
const HALF: [f64; 2] = [0.23, 0.11];
const WEIGHT: f64 = MASS * GRAVITY;
const STEP: f64 = 1e-4;

const BLOCK: [(&str, f64); 4] = [
    ("m", MASS),
    ("gravity", GRAVITY),
    ("half_width", HALF[0]),
    ("half_height", HALF[1]),
];

fn block(more: &[(&str, f64)], solver: super::common::Solver) -> Body {
    let all = [&BLOCK[..], more].concat();
    Body::with_values("block", numbers(&all), solver)
}

fn sum(block: &mut Body, word: &str) -> f64 {
    let names = [1, 2, 3, 4].map(|corner| format!("{word}_corner{corner}"));
    block.read(&names).iter().sum()
}

/// Up and down planes that rise and fall: it stops after `v / d` and `v^2 / (2 d)`, then friction holds the weight.
#[test]
fn it_slides_on_an_incline_stops_and_sticks() {
    let friction = 0.53;
    for solver in SOLVERS {
        for (slope, speed) in [(0.31_f64, -0.9_f64), (0.31, 0.9), (-0.31, 0.9), (0.0, -0.7)] {
            let case = format!("{solver:?} {slope} {speed}");
            let start = [("slope", slope), ("friction", friction), ("speed0", speed)];
            let mut block = block(&start, solver);
            let (along, across) = (slope.sin() * speed.signum(), slope.cos());
            let deceleration = GRAVITY * (friction * across + along);
            let end = speed.abs() / deceleration;
            block.advance(0.5 * end);
            let half = block.read_one("speed");
            assert!((half - 0.5 * speed).abs() < 1e-9, "{case}: {half}");
            let rubs = sum(&mut block, "friction") / (friction * WEIGHT * across);
            assert!((rubs + speed.signum()).abs() < 1e-9, "{case}: {rubs}");
            block.advance(0.6 * end);
            let place = block.read_one("way");
            let error = place - 0.5 * end * speed;
            assert!(
                error.abs() < deceleration * STEP * STEP,
                "{case}: {error:e}"
            );
            block.advance(1.0);
            let [way, rate, tilt] = block.read_all(["way", "speed", "tilt"]);
            assert!((way - place).abs() < 1e-10, "{case}: it creeps");
            assert!(
                rate.abs() < 1e-11 && tilt.abs() < 1e-10,
                "{case}: {rate:e} {tilt:e}"
            );
            let holds = sum(&mut block, "friction") - WEIGHT * slope.sin();
            let carries = sum(&mut block, "normal") - WEIGHT * across;
            assert!(
                holds.abs() < 1e-6 && carries.abs() < 1e-6,
                "{case}: {holds:e} {carries:e}"
            );
            assert_eq!(block.run.contacts().unwrap().impacts, 0, "{case}");
            let loss = block.read_one("friction_loss");
            let work = friction * WEIGHT * across * (way).abs();
            assert!((loss / work - 1.0).abs() < 1e-3, "{case}: {loss} {work}");
        }
    }
}

/// A force at the centre moves it when it is larger than the friction.
#[test]
fn a_force_pulls_it_loose() {
    let friction = 0.43;
    for solver in SOLVERS {
        let mut block = block(&[("friction", friction)], solver);
        block.drive("centre_fx", 0.98 * friction * WEIGHT);
        block.advance(0.3);
        let way = block.read_one("way");
        assert!(way.abs() < 1e-12, "{solver:?}: {way:e}");
        // Lifted a little it rubs less.
        block.drive("centre_fy", 0.1 * WEIGHT);
        block.advance(0.3);
        let acceleration = (0.98 - 0.9) * friction * GRAVITY;
        let [speed, a] = block.read_all(["centre_vx", "centre_ax"]);
        // The forces jump, and a scheme may take those before the jump into its first step.
        let error = speed - 0.3 * acceleration;
        assert!(error.abs() < acceleration * STEP, "{solver:?}: {error:e}");
        assert!((a - acceleration).abs() < 1e-9, "{solver:?}: {a}");
    }
}

/// What is at rest is, also where velocities are rounding: accelerations in the outputs are 0.
#[test]
fn at_rest_it_does_not_accelerate() {
    for solver in SOLVERS {
        for slope in [0.0, 0.3] {
            let start = [("slope", slope), ("gap0", 1e-3), ("tilt0", 0.01)];
            let mut block = block(&start, solver);
            block.advance(1.0);
            let names = ["centre_ax", "centre_ay", "centre_alpha", "speed"];
            let all = block.read_all(names);
            assert!(
                all.iter().all(|value| value.abs() < 1e-9),
                "{solver:?} {slope}: {all:?}"
            );
        }
    }
}

/// A moment above `m g b` turns it about a corner that sticks: `(J + m (b^2 + h^2)) alpha = M - m g b` at the start.
#[test]
fn a_moment_topples_it() {
    let [b, h] = HALF;
    for (given, inertia) in [(None, MASS * (b * b + h * h) / 3.0), (Some(0.041), 0.041)] {
        for solver in SOLVERS {
            let mut start = vec![("friction", 0.9)];
            start.extend(given.map(|inertia| ("inertia", inertia)));
            let mut block = block(&start, solver);
            block.drive("centre_moment", 0.99 * WEIGHT * b);
            block.advance(0.1);
            assert!(block.read_one("tilt").abs() < 1e-12, "{solver:?}");
            block.drive("centre_moment", 1.2 * WEIGHT * b);
            block.advance(10.0 * STEP);
            let alpha = 0.2 * WEIGHT * b / (inertia + MASS * (b * b + h * h));
            let [rate, left, right] = block.read_all(["centre_rate", "gap_corner1", "gap_corner2"]);
            let mean = rate / (10.0 * STEP);
            assert!(
                (mean / alpha - 1.0).abs() < 0.06,
                "{solver:?}: {mean} {alpha}"
            );
            assert!(
                left.abs() < 1e-6 && right > 1e-7,
                "{solver:?}: {left:e} {right:e}"
            );
            // Moreau's rule holds velocities at the middle of a step: at its end the corner seems to leave.
            if solver.0 != "moreau" {
                let own = block.read_one("centre_alpha");
                assert!(
                    (own / alpha - 1.0).abs() < 1e-3,
                    "{solver:?}: {own} {alpha}"
                );
            }
        }
    }
}

/// Parameters of the start are of the lowest corner, whichever that is.
#[test]
fn it_starts_on_its_lowest_corner() {
    let slope = 0.2;
    let given = |tilt: f64, rate: f64| {
        let start = [
            ("slope", slope),
            ("gap0", 0.013),
            ("way0", 0.4),
            ("tilt0", tilt),
            ("speed0", 0.7),
            ("lift0", 0.3),
            ("rate0", rate),
        ];
        block(&start, SOLVERS[0])
    };
    for (tilt, rate, lowest) in [
        (0.1, 0.5, 1),
        (-0.1, 0.5, 2),
        (0.0, 0.5, 1),
        (0.0, -0.5, 2),
        (1.7, 0.5, 4),
        (3.0, 0.5, 4),
        (3.3, 0.5, 3),
    ] {
        let mut block = given(tilt, rate);
        let gap = format!("gap_corner{lowest}");
        let corner = ["x", "y"].map(|axis| format!("corner{lowest}_{axis}"));
        assert!((block.read_one(&gap) - 0.013).abs() < 1e-14, "{lowest}");
        let gaps = [1, 2, 3, 4].map(|corner| format!("gap_corner{corner}"));
        assert!(block.read(&gaps).iter().all(|gap| *gap > 0.013 - 1e-14));
        let [way, own] = block.read_all(["way", "tilt"]);
        assert!((way - 0.4).abs() < 1e-14 && (own - tilt).abs() < 1e-14);
        let before = block.read(&corner);
        let dt = 1e-6;
        block.advance(dt);
        let after = block.read(&corner);
        let (sin, cos) = f64::sin_cos(slope);
        let [vx, vy] = [0, 1].map(|axis| (after[axis] - before[axis]) / dt);
        assert!(
            (cos * vx + sin * vy - 0.7).abs() < 1e-4,
            "{lowest}: {vx} {vy}"
        );
        assert!(
            (cos * vy - sin * vx - 0.3).abs() < 1e-4,
            "{lowest}: {vx} {vy}"
        );
    }
}

/// Gaps are those of the corners that are drawn; the outline is closed; a block that falls hits with all of its side.
#[test]
fn corners_are_where_they_are_drawn() {
    let mut block = block(&[("gap0", 0.1), ("restitution", 0.5)], SOLVERS[0]);
    let fall = (2.0 * 0.1 / GRAVITY).sqrt();
    block.advance(fall + 2.0 * STEP);
    assert_eq!(block.read_one("impacts"), 1.0);
    let names = ["impulse_corner1", "impulse_corner2", "impulse"];
    let [left, right, all] = block.read_all(names);
    let expected = 1.5 * MASS * GRAVITY * fall;
    assert!((all / expected - 1.0).abs() < 1e-3, "{all} {expected}");
    assert!((left - right).abs() < 1e-9 * all && (left + right - all).abs() < 1e-12);
    block.drive("centre_moment", 3.0);
    block.advance(0.05);
    assert!(block.read_one("tilt") > 0.05);
    for corner in 1..=4 {
        let names = [
            format!("corner{corner}_y"),
            format!("gap_corner{corner}"),
            format!("block{corner}_y"),
        ];
        let [y, gap, outline] = block.read(&names)[..] else {
            panic!("three values")
        };
        assert!((y - gap).abs() < 1e-15 && y == outline, "{corner}");
    }
    let [first, last] = block.read_all(["block1_x", "block5_x"]);
    assert_eq!(first, last);
}
