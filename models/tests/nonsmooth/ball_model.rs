//! The bouncing ball as a subsystem: its outputs against closed forms.

use super::common::Solver;
use super::common::body::Body;

const MASS: f64 = 0.37;
const GRAVITY: f64 = 9.79;
const HEIGHT: f64 = 0.737;
const SPEED: f64 = 0.31;
const RESTITUTION: f64 = 0.63;

const STEP: f64 = 1e-4;
/// Those that damp what contacts leave behind.
pub const SOLVERS: [Solver; 5] = [
    Solver("generalized-alpha", &[("step", STEP)]),
    Solver("bathe", &[("step", STEP)]),
    Solver("ed-alpha", &[("step", STEP)]),
    Solver("moreau", &[("step", STEP)]),
    Solver("hets", &[("step", STEP)]),
];

fn ball(solver: Solver, restitution: f64) -> Body {
    let parameters = [
        ("m", MASS),
        ("gravity", GRAVITY),
        ("height0", HEIGHT),
        ("speed0", SPEED),
        ("restitution", restitution),
    ];
    Body::new("bouncing-ball", &parameters, solver)
}

/// Time and speed of the first impact.
fn first_impact() -> (f64, f64) {
    let speed = (SPEED * SPEED + 2.0 * GRAVITY * HEIGHT).sqrt();
    ((SPEED + speed) / GRAVITY, speed)
}

/// All flights together last until `t_1 + 2 e v_1 / (g (1 - e))`; all impulses together are `m v_1 (1 + e) / (1 - e)`.
#[test]
fn after_the_time_of_zeno_the_floor_carries_the_ball() {
    let (time, speed) = first_impact();
    let zeno = time + 2.0 * RESTITUTION * speed / (GRAVITY * (1.0 - RESTITUTION));
    let all_impulses = MASS * speed * (1.0 + RESTITUTION) / (1.0 - RESTITUTION);
    for solver in SOLVERS {
        let mut ball = ball(solver, RESTITUTION);
        let (mut impacts, mut impulses, mut first) = (0.0, 0.0, None);
        let mut last = 0.0;
        while ball.t < 1.1 * zeno {
            ball.advance(1e-2);
            let names = ["impacts", "impact_time", "impulse", "impulse_ball"];
            let [number, at, impulse, of_ball] = ball.read_all(names);
            if number > 0.0 {
                first.get_or_insert(at);
                last = at;
            } else {
                assert_eq!(at, ball.t, "{solver:?}");
            }
            assert!((impulse - of_ball).abs() < 1e-15, "{solver:?}");
            impacts += number;
            impulses += impulse;
        }
        let late = first.unwrap() - time;
        assert!(late.abs() <= 1.51 * STEP, "{solver:?}: {late:e}");
        assert!((last - zeno).abs() < 0.02, "{solver:?}: {last} {zeno}");
        let counted = ball.run.contacts().unwrap();
        assert_eq!(impacts, counted.impacts as f64, "{solver:?}");
        // Each one leaves up to g dt too much or too little.
        assert!((12.0..=40.0).contains(&impacts), "{solver:?}: {impacts}");
        let error = impulses / all_impulses - 1.0;
        assert!(error.abs() < 2e-3, "{solver:?}: {error:e}");

        let [height, speed, force] = ball.read_all(["height", "speed", "normal_ball"]);
        assert!(height.abs() < 2.0 * STEP, "{solver:?}: {height:e}");
        assert!(speed.abs() < 1e-12, "{solver:?}: {speed:e}");
        assert!(
            (force / (MASS * GRAVITY) - 1.0).abs() < 1e-9,
            "{solver:?}: {force}"
        );
        let [gap, y] = ball.read_all(["gap_ball", "ball_y"]);
        assert_eq!((gap, y), (height, height));
        let [energy, loss] = ball.read_all(["energy", "impact_loss"]);
        let start = MASS * (GRAVITY * HEIGHT + 0.5 * SPEED * SPEED);
        assert!(((energy + loss) / start - 1.0).abs() < 2e-3, "{solver:?}");
    }
}

#[test]
fn perfect_balls_never_rest_and_balls_of_clay_at_once() {
    for solver in SOLVERS {
        let mut perfect = ball(solver, 1.0);
        let start = perfect.read_one("energy");
        perfect.advance(5.0);
        assert!((perfect.read_one("energy") / start - 1.0).abs() < 1e-10);

        let (time, _) = first_impact();
        let mut clay = ball(solver, 0.0);
        clay.advance(time + 2.0 * STEP);
        assert_eq!(clay.read_one("impacts"), 1.0, "{solver:?}");
        clay.advance(1.0);
        let [impacts, speed] = clay.read_all(["impacts", "speed"]);
        assert_eq!(impacts, 0.0, "{solver:?}");
        assert!(speed.abs() < 1e-15, "{solver:?}: {speed:e}");
    }
}

/// Its acceleration under a constant force is exact for all schemes.
#[test]
fn a_force_lifts_it_from_the_floor() {
    for solver in SOLVERS {
        let parameters = [("m", MASS), ("gravity", GRAVITY), ("height0", 0.0)];
        let mut ball = Body::new("bouncing-ball", &parameters, solver);
        ball.drive("force", 0.5 * MASS * GRAVITY);
        ball.advance(0.1);
        let [height, force] = ball.read_all(["height", "normal_ball"]);
        assert!(height.abs() < 1e-14, "{solver:?}: {height:e}");
        assert!(
            (force / (0.5 * MASS * GRAVITY) - 1.0).abs() < 1e-9,
            "{solver:?}"
        );
        ball.drive("force", 3.0 * MASS * GRAVITY);
        ball.advance(0.1);
        let [height, acceleration] = ball.read_all(["height", "ball_ay"]);
        let expected = 0.5 * 2.0 * GRAVITY * 0.01;
        // The scheme may notice within its step that the contact opens.
        assert!(
            (height - expected).abs() < 2.0 * GRAVITY * 0.1 * STEP,
            "{solver:?}: {height}"
        );
        assert!(
            (acceleration - 2.0 * GRAVITY).abs() < 1e-9,
            "{solver:?}: {acceleration}"
        );
    }
}
