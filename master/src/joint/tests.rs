//! One suite for all joints.

use super::*;

fn all() -> Vec<Box<dyn Joint>> {
    vec![
        Box::new(RigidLink),
        Box::new(AtPoint::InPlane),
        Box::new(AtPoint::InSpace),
    ]
}

/// Motion with no two numbers alike.
fn awkward() -> Motion {
    let mut motion = Motion::default();
    for (number, value) in motion.iter_mut().flatten().flatten().enumerate() {
        *value = (1.7 * number as f64).sin() * (1.0 + number as f64);
    }
    motion
}

#[test]
fn gradients_are_the_differences_of_the_conditions() {
    let motion = awkward();
    let raise = 1e-3;
    for joint in all() {
        for row in 0..joint.rows().len() {
            for level in Level::ALL {
                for (end, of) in End::BOTH
                    .into_iter()
                    .flat_map(|end| Level::ALL.map(|of| (end, of)))
                {
                    for component in 0..joint.reads().len() {
                        let [mut low, mut high] = [motion; 2];
                        low[end as usize][of as usize][component] -= raise;
                        high[end as usize][of as usize][component] += raise;
                        let difference =
                            joint.condition(row, level, &high) - joint.condition(row, level, &low);
                        let gradient = joint.gradient(row, level, &motion, end, of, component);
                        assert!((difference / (2.0 * raise) - gradient).abs() < 1e-9);
                    }
                }
            }
        }
    }
}

#[test]
fn action_equals_reaction() {
    for joint in all() {
        for row in 0..joint.rows().len() {
            for component in 0..joint.loads().len() {
                let sum: f64 = End::BOTH
                    .iter()
                    .map(|&end| joint.load(row, end, component))
                    .sum();
                assert_eq!(sum, 0.0);
            }
        }
    }
}

/// The load of a multiplier does the work `sum load . velocity = +- g'`: none while the condition holds.
#[test]
fn an_ideal_joint_does_no_work() {
    let motion = awkward();
    for joint in all() {
        for row in 0..joint.rows().len() {
            let power: f64 = End::BOTH
                .iter()
                .flat_map(|&end| (0..joint.loads().len()).map(move |component| (end, component)))
                .map(|(end, component)| {
                    joint.load(row, end, component) * motion[end as usize][1][component]
                })
                .sum();
            let rate = joint.condition(row, Level::Velocity, &motion);
            assert!((power.abs() - rate.abs()).abs() < 1e-12, "{power} {rate}");
        }
    }
}
