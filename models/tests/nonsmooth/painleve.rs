//! Painleve's rod: a slender rod slides on a rough floor, its lower end ahead. Its contact problem has no solution or
//! several, which must be told.
//!
//! Rod of length `2 l` at the angle `theta`: `G_NN = (1 + 3 cos^2) / m`, `G_NT = +-3 sin cos / m`. A sliding end jams
//! for `mu >= (1 + 3 cos^2) / (3 sin cos)`: 5/3 at 45 degrees, and 4/3 at `tan(theta) = 2`, where it is least.

use linchpin_models::nonsmooth::contact::Unsolved;
use linchpin_models::nonsmooth::mechanics::{Settings, StepError};
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::systems::body_on_planes::{Body, BodyOnPlanes, Plane};
use linchpin_models::nonsmooth::systems::notch::CornerLaw;
use linchpin_worker::Inputs;

use super::stand::{Case, SCHEMES, Stand};

const LENGTH: f64 = 0.37;
const MASS: f64 = 0.83;
const GRAVITY: f64 = 9.79;

/// The rod on its lower end, which slides with -1.3 m/s; it turns with `rate`.
fn rod(
    case: Case,
    [angle, friction, rate]: [f64; 3],
    settings: Settings,
) -> Result<Stand, StepError> {
    let body = Body::rectangle(MASS, [LENGTH, 0.0], GRAVITY);
    let law = CornerLaw {
        normal_restitution: 0.0,
        tangential_restitution: 0.0,
        friction,
    };
    let plane = Plane::rising(0.0);
    let system = BodyOnPlanes::on_plane(body, &[[-LENGTH, 0.0]], plane, law);
    let (sin, cos) = angle.sin_cos();
    let q = [LENGTH * cos, LENGTH * sin - 1e-14, angle];
    // The end has no velocity along y.
    let v = [-1.3 - LENGTH * sin * rate, LENGTH * cos * rate, rate];
    let none = Inputs::constant(&[]);
    Stand::try_driven(system, case.kind, settings, [&q, &v], none)
}

/// Least friction that jams.
fn limit(angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    (1.0 + 3.0 * cos * cos) / (3.0 * sin * cos)
}

#[test]
fn limits() {
    assert!((limit(0.25 * std::f64::consts::PI) - 5.0 / 3.0).abs() < 1e-14);
    assert!((limit(2.0_f64.atan()) - 4.0 / 3.0).abs() < 1e-14);
}

#[test]
fn below_the_limit_there_is_one_solution() {
    for case in SCHEMES {
        let start = [1.1, 0.97 * limit(1.1), 0.0];
        let mut stand = rod(case, start, Settings::default()).unwrap();
        stand.steps(20, 1e-4);
        let counters = stand.integrator.mechanics.counters;
        assert_eq!((counters.ambiguous, counters.jams), (0, 0));
        assert!(stand.v()[0] > -1.3, "friction slows it down");
    }
}

#[test]
fn without_a_solution_the_start_is_refused() {
    // At rest but for sliding: gravity closes the contact, friction closes it further.
    for case in SCHEMES {
        let start = [1.1, 1.1 * limit(1.1), 0.0];
        let refused = rod(case, start, Settings::default()).err();
        assert_eq!(refused, Some(StepError::Contact(Unsolved::NoSolution)));
    }
}

#[test]
fn an_impact_without_collision_is_counted() {
    // On velocity level there is a solution, a force of the size 1/dt that stops the sliding at once.
    let settings = Settings {
        has_consistent_start: false,
        ..Settings::default()
    };
    for case in SCHEMES {
        let mut stand = rod(case, [1.1, 1.1 * limit(1.1), 0.0], settings).unwrap();
        stand.step(1e-5);
        let kind = case.kind;
        assert!(stand.integrator.mechanics.counters.jams > 0, "{kind:?}");
        let slip = stand.v()[0] + LENGTH * 1.1_f64.sin() * stand.v()[2];
        // Schemes of one stage stop it; the stages of the others do not agree on what happened.
        let has_stages = matches!(kind, SchemeKind::Bathe | SchemeKind::EdAlpha { .. });
        assert!(
            has_stages || slip.abs() < 1e-3,
            "{kind:?}: it slides with {slip}"
        );
    }
}

#[test]
fn several_solutions_are_counted() {
    // It turns so fast that its end would lift off; but pressed, it would stay: l sin(theta) rate^2 > g.
    for case in SCHEMES {
        let rate = (1.7 * GRAVITY / (LENGTH * 1.1_f64.sin())).sqrt();
        let start = [1.1, 1.1 * limit(1.1), rate];
        let stand = rod(case, start, Settings::default()).unwrap();
        assert!(stand.integrator.mechanics.counters.ambiguous > 0);
        // The solution that is taken lets it lift off.
        assert_eq!(stand.integrator.state.forces, [0.0, 0.0]);
    }
}
