//! Every joint in space in a running co-simulation: two floating bodies against their motion in the joint's coordinates.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_models::reference::CompositeJoint;
use linchpin_tests::convergence::slope_of;
use linchpin_tests::in_space::joints;
use linchpin_tests::in_space::pair::{Pair, PairErrors};
use linchpin_tests::runs::run;

/// Weighted multipliers of index 1, a = 2, b = 2.6, with k = 1, and quadratic exchanged variables.
const MEASURED: &str = "degree=1 exchanged_degree=2 jacobian=every-step";

/// Other couplings, with the least orders of positions, attitudes, loads, energy.
const OTHERS: [(&str, [f64; 4]); 4] = [
    (
        "method=baumgarte index=1 degree=1 exchanged_degree=2",
        [3.0, 3.0, 2.0, 3.0],
    ),
    (
        "index=2 b=0 degree=0 exchanged_degree=2 jacobian=every-step",
        [3.0, 3.0, 1.0, 3.0],
    ),
    (
        "index=3 a=0 b=0 degree=0 exchanged_degree=2 jacobian=every-step",
        [3.0, 3.0, 1.0, 3.0],
    ),
    ("index=1 degree=0 exchanged_degree=0", [1.0, 1.0, 1.0, 1.0]),
];

fn errors_at<const N: usize>(
    pair: &Pair,
    coupling: &str,
    steps: [f64; N],
    t_end: f64,
) -> [PairErrors; N] {
    steps.map(|h| {
        let scene = pair.scene(&format!("{coupling} macro_step={h}"), t_end);
        pair.errors(&run(&scene, Place::InProcess))
    })
}

/// No force acts in it, so the centres of mass go straight ahead, up to the solvers' errors.
fn turns_only(joint: &CompositeJoint) -> bool {
    matches!(
        joint,
        CompositeJoint::Orientation | CompositeJoint::Perpendicular(_)
    )
}

/// Asserts the least orders for every joint, over 0.24 s.
fn assert_orders(coupling: &str, least: [f64; 4], steps: [f64; 3]) {
    let mut report = format!("{coupling}, least {least:?}\n");
    let mut wrong = 0;
    for joint in joints::all() {
        let errors = errors_at(&Pair::floating(joint), coupling, steps, 0.24);
        let orders = PairErrors::orders(&steps, &errors);
        let too_low = |of: usize| match of {
            0 if turns_only(&joint) => errors[2].position > 1e-11,
            _ => orders[of] < least[of] - 0.15,
        };
        let is_wrong = (0..4).any(too_low);
        wrong += usize::from(is_wrong);
        let mark = if is_wrong { " <-- too low" } else { "" };
        report += &format!("{}: {orders:.2?}{mark}\n", joints::name(&joint));
        report += &errors.map(|error| format!("    {error:?}\n")).concat();
    }
    println!("{report}");
    assert!(wrong == 0, "{wrong} joints have too low orders\n{report}");
}

#[test]
fn orders_of_convergence() {
    assert_orders(MEASURED, [3.0, 3.0, 2.0, 3.0], [2e-3, 1e-3, 5e-4]);
}

#[test]
fn orders_of_other_couplings() {
    for (coupling, least) in OTHERS {
        assert_orders(coupling, least, [8e-3, 4e-3, 2e-3]);
    }
}

/// The forces of an atpoint joint have fixed directions and are opposite in every instant. A force whose direction turns
/// follows the partner's motion as each worker has it, which differ by the exchanged polynomial's error.
#[test]
fn momentum_and_angular_momentum_stay() {
    let steps = [8e-3, 4e-3, 2e-3];
    for joint in joints::all() {
        let name = joints::name(&joint);
        let errors = errors_at(&Pair::floating(joint), MEASURED, steps, 0.24);
        let momentum = errors.map(|error| error.momentum);
        let is_fixed = matches!(
            joint,
            CompositeJoint::AtPoint
                | CompositeJoint::Universal(_)
                | CompositeJoint::Revolute(_)
                | CompositeJoint::Weld
        );
        if is_fixed || turns_only(&joint) {
            assert!(momentum[0] < 1e-13, "{name}: {momentum:?}");
        } else {
            let order = slope_of(steps.into_iter().zip(momentum));
            assert!(order > 2.85, "{name}: order {order} of {momentum:?}");
        }
        let angular = errors.map(|error| error.angular_momentum);
        let order = slope_of(steps.into_iter().zip(angular));
        assert!(order > 2.85, "{name}: order {order} of {angular:?}");
        assert!(angular[2] < 1e-7, "{name}: {angular:?}");
    }
}

/// Where the master evaluates the loads, the two bodies get opposite forces in every instant in any joint.
#[test]
fn momentum_stays_to_rounding_in_wrench_form() {
    for joint in joints::all() {
        let coupling = format!("{MEASURED} loads=master");
        let [errors] = errors_at(&Pair::floating(joint), &coupling, [8e-3], 0.24);
        let momentum = errors.momentum;
        assert!(momentum < 1e-12, "{}: {momentum:e}", joints::name(&joint));
    }
}

#[test]
fn the_joints_stay_closed() {
    let steps = [8e-3, 4e-3, 2e-3];
    for joint in joints::all() {
        let errors = errors_at(&Pair::floating(joint), MEASURED, steps, 0.24);
        let gaps = errors.map(|error| error.gap);
        let order = slope_of(steps.into_iter().zip(gaps));
        let name = joints::name(&joint);
        assert!(order > 3.85, "{name}: order {order} of {gaps:?}");
        assert!(gaps[2] < 1e-8, "{name}: {gaps:?}");
    }
}

/// Both bodies turn over several times.
#[test]
fn tumbling_bodies_pass_through_any_attitude() {
    let steps = [2e-3, 1e-3];
    for joint in &joints::all()[..3] {
        let name = joints::name(joint);
        let pair = Pair::turning(*joint, 4.0);
        let turns = pair.turns(1.5);
        assert!(turns.iter().all(|turns| *turns > 3.0), "{name}: {turns:?}");
        let errors = errors_at(&pair, MEASURED, steps, 1.5);
        let [.., finest] = errors;
        for (of, what) in [(1, "attitude"), (3, "energy")] {
            let errors = errors.map(|errors| errors.measured()[of]);
            let order = slope_of(steps.into_iter().zip(errors));
            println!("{name}, {what}: order {order:.2} of {errors:?}");
            assert!(order > 2.85, "{name}, {what}: order {order} of {errors:?}");
        }
        assert!(finest.position < 2e-6, "{name}: {finest:?}");
    }
}
