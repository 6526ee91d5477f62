//! Loads against differences of the conditions.

use super::*;
use crate::v1;

fn laws() -> [JointLaw; 3] {
    let unit = |x: f64, y: f64, z: f64| Vector3::new(x, y, z).normalize();
    let points = [Vector3::new(0.3, -0.2, 0.5), Vector3::new(-0.1, 0.4, 0.7)];
    let laws = [
        Law::AtPoint {
            direction: unit(1.0, 2.0, -0.5),
        },
        Law::InPlane {
            normal: unit(0.3, -1.0, 0.8),
        },
        Law::Perpendicular {
            axes: [unit(1.0, 0.2, 0.1), unit(-0.4, 0.5, 1.0)],
        },
    ];
    laws.map(|law| JointLaw { law, points })
}

fn poses() -> [Pose; 2] {
    [
        Pose::spatial(Vector3::new(1.0, -2.0, 0.4), [0.3, 0.5, -0.2, 0.7]),
        Pose::spatial(Vector3::new(0.2, 0.6, -1.3), [-0.6, 0.1, 0.4, 0.2]),
    ]
}

/// The conditions once more, straight from S1.
fn condition(law: &JointLaw, [a, b]: &[Pose; 2]) -> f64 {
    let point = |pose: &Pose, point: Vector3<f64>| pose.position + pose.rotation * point;
    let distance = point(a, law.points[0]) - point(b, law.points[1]);
    match law.law {
        Law::AtPoint { direction } => distance.dot(&direction),
        Law::InPlane { normal } => distance.dot(&(b.rotation * normal)),
        Law::Perpendicular { axes } => (a.rotation * axes[0]).dot(&(b.rotation * axes[1])),
    }
}

#[test]
fn residuals_are_those_of_s1() {
    for law in laws() {
        assert_eq!(law.residual(&poses()), condition(&law, &poses()));
    }
}

fn moved(poses: &[Pose; 2], by: &[Displacement; 2], scale: f64) -> [Pose; 2] {
    std::array::from_fn(|end| Pose {
        position: poses[end].position + scale * by[end].position,
        rotation: poses[end].turned(&(scale * by[end].rotation)).rotation,
    })
}

fn displacement() -> [Displacement; 2] {
    let vector = Vector3::new;
    [
        Displacement {
            position: vector(0.7, -0.3, 0.2),
            rotation: vector(-0.5, 0.1, 0.9),
        },
        Displacement {
            position: vector(-0.2, 0.8, 0.4),
            rotation: vector(0.6, 0.3, -0.4),
        },
    ]
}

#[test]
fn loads_are_gradients_of_the_conditions() {
    for law in laws() {
        let step = 1e-6;
        let at = |scale| condition(&law, &moved(&poses(), &displacement(), scale));
        let difference = (at(step) - at(-step)) / (2.0 * step);
        let powers = End::BOTH.map(|end| {
            let wrench = law.unit_wrench(end, &poses());
            let moved = displacement()[end as usize];
            wrench.force.dot(&moved.position) + wrench.moment.dot(&moved.rotation)
        });
        let missing = difference - powers[0] - powers[1];
        assert!(missing.abs() < 1e-8, "{law:?}: {missing}");
    }
}

#[test]
fn forces_and_moments_of_the_ends_cancel() {
    for law in laws() {
        let [a, b] = End::BOTH.map(|end| law.unit_wrench(end, &poses()));
        assert!((a.force + b.force).norm() < 1e-14);
        let about_origin =
            |wrench: &Wrench, pose: &Pose| wrench.moment + pose.position.cross(&wrench.force);
        let [pose_a, pose_b] = poses();
        let sum = about_origin(&a, &pose_a) + about_origin(&b, &pose_b);
        let [p_a, p_b] = [(&pose_a, 0), (&pose_b, 1)]
            .map(|(pose, end)| pose.position + pose.rotation * law.points[end]);
        // Where the points are apart, the forces of the atpoint law form a couple.
        let couple = match law.law {
            Law::AtPoint { .. } => (p_a - p_b).cross(&a.force),
            _ => Vector3::zeros(),
        };
        assert!((sum - couple).norm() < 1e-14, "{law:?}: {sum}");
    }
}

#[test]
fn changes_of_loads_are_their_differences() {
    for law in laws() {
        for end in End::BOTH {
            let step = 1e-6;
            let at = |scale| law.unit_wrench(end, &moved(&poses(), &displacement(), scale));
            let (low, high) = (at(-step), at(step));
            let change = law.unit_wrench_change(end, &poses(), &displacement());
            let force = (high.force - low.force) / (2.0 * step) - change.force;
            let moment = (high.moment - low.moment) / (2.0 * step) - change.moment;
            assert!(
                force.norm() < 1e-8 && moment.norm() < 1e-8,
                "{law:?} {end:?}"
            );
        }
    }
}

#[test]
fn loads_depend_on_what_they_say() {
    for law in laws() {
        for end in End::BOTH {
            for of in End::BOTH {
                let only = |position: bool, rotation: bool| {
                    let mut by = [Displacement {
                        position: Vector3::zeros(),
                        rotation: Vector3::zeros(),
                    }; 2];
                    let own = displacement()[of as usize];
                    by[of as usize] = Displacement {
                        position: if position {
                            own.position
                        } else {
                            Vector3::zeros()
                        },
                        rotation: if rotation {
                            own.rotation
                        } else {
                            Vector3::zeros()
                        },
                    };
                    let change = law.unit_wrench_change(end, &poses(), &by);
                    change.force.norm() + change.moment.norm() > 1e-9
                };
                let reads = law.load_reads(end, of);
                assert_eq!(reads.position, only(true, false), "{law:?} {end:?} {of:?}");
                assert_eq!(reads.rotation, only(false, true), "{law:?} {end:?} {of:?}");
            }
            let wrench = law.unit_wrench(end, &poses());
            let acts = law.acts_by(end);
            assert_eq!(acts.force, wrench.force.norm() > 0.0);
            assert_eq!(acts.moment, wrench.moment.norm() > 0.0);
        }
    }
}

#[test]
fn messages_come_back_and_mistakes_are_named() {
    for law in laws() {
        let message = law.to_message("tip", End::B);
        assert_eq!(JointLaw::from_message(&message), Ok((law, End::B)));
    }
    let mistake = |change: fn(&mut v1::JointLoad)| {
        let mut message = laws()[2].to_message("tip", End::A);
        change(&mut message);
        JointLaw::from_message(&message).unwrap_err().to_string()
    };
    assert!(mistake(|load| load.law = 7).contains("law 7"));
    assert!(mistake(|load| load.end = 0).contains("end 0"));
    assert!(mistake(|load| load.point_b.clear()).contains("point_b"));
    assert!(mistake(|load| load.axis_a = vec![f64::NAN, 0.0, 0.0]).contains("axis_a"));
    assert!(mistake(|load| load.axis_b = vec![2.0, 0.0, 0.0]).contains("length 2"));
}
