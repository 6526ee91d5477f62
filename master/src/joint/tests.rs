//! One suite for all joints.

use linchpin_proto::joint_load::Pose;
use nalgebra::{DMatrix, UnitQuaternion, Vector3};

use super::composite::{Frame, PlanarFrame, in_plane, in_space, link};
use super::*;

const IN_SPACE: [(Kind, usize); 11] = [
    (Kind::AtPoint, 3),
    (Kind::InPlane, 1),
    (Kind::Perpendicular, 1),
    (Kind::Universal, 4),
    (Kind::Revolute, 5),
    (Kind::Cylindrical, 4),
    (Kind::Planar, 3),
    (Kind::Inline, 2),
    (Kind::Orientation, 3),
    (Kind::Translational, 5),
    (Kind::Weld, 6),
];

const IN_PLANE: [(Kind, usize); 8] = [
    (Kind::AtPoint, 2),
    (Kind::Revolute, 2),
    (Kind::InPlane, 1),
    (Kind::Inline, 1),
    (Kind::Perpendicular, 1),
    (Kind::Orientation, 1),
    (Kind::Translational, 2),
    (Kind::Weld, 3),
];

/// A small change of the motion of a marker.
#[derive(Default)]
struct MarkerChange {
    position: Vector3<f64>,
    rotation: Vector3<f64>,
    velocity: Vector3<f64>,
    omega: Vector3<f64>,
    acceleration: Vector3<f64>,
    alpha: Vector3<f64>,
}

impl MarkerChange {
    /// What it changes of the number with these derivatives.
    fn of(&self, gradient: &MarkerGradient) -> f64 {
        self.position.dot(&gradient.position)
            + self.rotation.dot(&gradient.rotation)
            + self.velocity.dot(&gradient.velocity)
            + self.omega.dot(&gradient.omega)
            + self.acceleration.dot(&gradient.acceleration)
            + self.alpha.dot(&gradient.alpha)
    }
}

fn frame() -> Frame {
    Frame {
        points: [Vector3::new(0.3, -0.2, 0.5), Vector3::new(-0.1, 0.4, 0.7)],
        axes: [
            Vector3::new(1.0, 0.2, -0.4).normalize(),
            Vector3::new(-0.3, 0.9, 0.5).normalize(),
        ],
        attitude: UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -0.3, 0.8)),
    }
}

fn planar_frame() -> PlanarFrame {
    PlanarFrame {
        points: [Vector3::new(0.3, -0.2, 0.0), Vector3::new(-0.1, 0.4, 0.0)],
        axes: [Vector3::new(0.8, 0.6, 0.0), Vector3::new(-0.28, 0.96, 0.0)],
        angle: 0.4,
    }
}

/// Every joint with the number of freedoms that it takes.
fn all() -> Vec<(String, Joint, usize)> {
    let spatial = IN_SPACE.map(|(kind, rows)| {
        let joint = in_space(kind, &frame()).unwrap();
        (format!("{kind:?} in space"), joint, rows)
    });
    let planar = IN_PLANE.map(|(kind, rows)| {
        let joint = in_plane(kind, &planar_frame()).unwrap();
        (format!("{kind:?} in the plane"), joint, rows)
    });
    let link = [("RigidLink".to_owned(), link(), 1)];
    spatial.into_iter().chain(planar).chain(link).collect()
}

/// Two bodies on smooth paths, out of the joint; `t` in s. Rates are those of the path, by its own formula.
fn motion_at(t: f64, in_plane: bool) -> Motion {
    let body = |number: f64| {
        let wave = |phase: f64, frequency: f64| {
            let angle = frequency * t + phase * number;
            [
                angle.sin(),
                frequency * angle.cos(),
                -frequency * frequency * angle.sin(),
            ]
        };
        let coordinates = [wave(1.0, 1.3), wave(2.0, 0.7), wave(0.3, 2.1)];
        let level = |level: usize| {
            let z = if in_plane { 0.0 } else { coordinates[2][level] };
            Vector3::new(coordinates[0][level], coordinates[1][level], z)
        };
        // Turning about the third axis, then about a tilted one fixed in space.
        let (spin, tilt) = (wave(0.9, 1.7), wave(1.4, 0.9));
        let tilt = if in_plane { [0.0; 3] } else { tilt };
        let axis = Vector3::new(0.6, 0.48, 0.64).normalize();
        let turned = UnitQuaternion::from_scaled_axis(axis * tilt[0]);
        let spun = UnitQuaternion::from_scaled_axis(Vector3::z() * spin[0]);
        let spin_axis = turned * Vector3::z();
        let omega = axis * tilt[1] + spin_axis * spin[1];
        let alpha =
            axis * tilt[2] + spin_axis * spin[2] + (axis * tilt[1]).cross(&spin_axis) * spin[1];
        MarkerMotion {
            pose: Pose {
                position: level(0),
                rotation: (turned * spun).to_rotation_matrix().into_inner(),
            },
            velocity: level(1),
            omega,
            acceleration: level(2),
            alpha,
        }
    };
    [body(1.0), body(1.7)]
}

fn is_planar(name: &str) -> bool {
    !name.ends_with("space")
}

#[test]
fn rates_of_the_conditions_are_their_differences_in_time() {
    let step = 1e-4;
    for (name, joint, _) in all() {
        for condition in joint.conditions() {
            for levels in Level::ALL.windows(2) {
                let at = |t| condition.value(levels[0], &motion_at(t, is_planar(&name)));
                let difference = (at(0.4 + step) - at(0.4 - step)) / (2.0 * step);
                let rate = condition.value(levels[1], &motion_at(0.4, is_planar(&name)));
                assert!(
                    (difference - rate).abs() < 1e-6,
                    "{name}: {difference} {rate}"
                );
            }
        }
    }
}

#[test]
fn changes_of_the_conditions_are_their_differences() {
    let raise = 1e-6;
    for (name, joint, _) in all() {
        let motion = motion_at(0.4, is_planar(&name));
        for (row, condition) in joint.conditions().enumerate() {
            for end in End::BOTH {
                let vector = |seed: f64| Vector3::new(seed.sin(), (2.0 * seed).cos(), 0.3 - seed);
                let change = MarkerChange {
                    position: vector(1.0),
                    rotation: vector(2.0),
                    velocity: vector(3.0),
                    omega: vector(4.0),
                    acceleration: vector(5.0),
                    alpha: vector(6.0),
                };
                let moved = |scale: f64| {
                    let mut moved = motion;
                    let own = &mut moved[end as usize];
                    own.pose = own.pose.turned(&(scale * change.rotation));
                    own.pose.position += scale * change.position;
                    own.velocity += scale * change.velocity;
                    own.omega += scale * change.omega;
                    own.acceleration += scale * change.acceleration;
                    own.alpha += scale * change.alpha;
                    moved
                };
                for level in Level::ALL {
                    let [low, high] =
                        [-raise, raise].map(|scale| condition.value(level, &moved(scale)));
                    let difference = (high - low) / (2.0 * raise);
                    let factors = condition.factors(&motion);
                    let own = change.of(&condition.gradient(level, (&motion, &factors), end));
                    assert!(
                        (difference - own).abs() < 1e-7 * (1.0 + own.abs()),
                        "{name}, row {row}, {end:?}, {level:?}: {difference} {own}"
                    );
                }
            }
        }
    }
}

/// The power of the loads of a unit multiplier is the rate of its condition: an ideal joint does no work while it is closed.
#[test]
fn power_of_the_loads_is_the_rate_of_the_condition() {
    for (name, joint, _) in all() {
        let motion = motion_at(0.4, is_planar(&name));
        let poses = motion.map(|marker| marker.pose);
        for condition in joint.conditions() {
            let Some(law) = condition.law() else {
                continue;
            };
            let powers = End::BOTH.map(|end| {
                let load = law.unit_wrench(end, &poses);
                let marker = motion[end as usize];
                load.force.dot(&marker.velocity) + load.moment.dot(&marker.omega)
            });
            let rate = condition.value(Level::Velocity, &motion);
            assert!((powers[0] + powers[1] - rate).abs() < 1e-13, "{name}");
        }
    }
}

/// Poses of a and b that close the joint of [`frame`].
fn closed() -> [Pose; 2] {
    let Frame {
        points,
        axes,
        attitude,
    } = frame();
    let b = UnitQuaternion::from_scaled_axis(Vector3::new(-0.7, 1.1, 0.2));
    let position_b = Vector3::new(0.2, -0.6, 0.9);
    let pose = |position, rotation: UnitQuaternion<f64>| Pose {
        position,
        rotation: rotation.to_rotation_matrix().into_inner(),
    };
    let align = UnitQuaternion::rotation_between(&axes[0], &axes[1]).unwrap();
    let turn = if attitude.angle() > 0.0 {
        attitude
    } else {
        align
    };
    let a = b * turn;
    let position_a = position_b + b * points[1] - a * points[0];
    [pose(position_a, a), pose(position_b, b)]
}

/// At a closed position the conditions of a joint are independent: as many freedoms of the relative motion are gone.
#[test]
fn joints_take_as_many_freedoms_as_they_have_rows() {
    for (name, joint, rows) in all() {
        assert_eq!(joint.len(), rows, "{name}");
        let motion = if is_planar(&name) {
            let mut motion = motion_at(0.4, true);
            motion[0].pose.position = Vector3::zeros();
            motion[1].pose.position = Vector3::new(0.4, 0.1, 0.0);
            motion
        } else {
            closed().map(|pose| MarkerMotion {
                pose,
                ..MarkerMotion::default()
            })
        };
        let freedoms: &[usize] = match &*name {
            "RigidLink" => &[0],
            _ if is_planar(&name) => &[0, 1, 5],
            _ => &[0, 1, 2, 3, 4, 5],
        };
        let entry = |row: usize, column: usize| {
            let unit = |first: usize| {
                let component = freedoms[column].checked_sub(first).filter(|c| *c < 3);
                component.map_or(Vector3::zeros(), |c| Vector3::ith(c, 1.0))
            };
            let change = MarkerChange {
                position: unit(0),
                rotation: unit(3),
                ..MarkerChange::default()
            };
            let condition = joint.condition(row);
            let factors = condition.factors(&motion);
            change.of(&condition.gradient(Level::Position, (&motion, &factors), End::A))
        };
        let matrix = DMatrix::from_fn(rows, freedoms.len(), entry);
        assert_eq!(matrix.rank(0.05), rows, "{name}: {matrix}");
    }
}

/// The joints that keep an attitude are closed where they say, and tell when they are turned over.
#[test]
fn attitudes_are_kept_and_turned_over_ones_are_known() {
    for kind in [Kind::Orientation, Kind::Weld, Kind::Translational] {
        let joint = in_space(kind, &frame()).unwrap();
        let motion = closed().map(|pose| MarkerMotion {
            pose,
            ..MarkerMotion::default()
        });
        for condition in joint.conditions() {
            assert!(condition.value(Level::Position, &motion).abs() < 1e-14);
        }
        let [a, b] = motion.map(|marker| marker.pose.rotation);
        let agreement = |axes: &[Vector3<f64>; 2]| (a * axes[0]).dot(&(b * axes[1]));
        assert!(joint.aligned().iter().all(|axes| agreement(axes) > 0.999));
        assert_eq!(joint.aligned().len(), 3);
    }
    let revolute = in_space(Kind::Revolute, &frame()).unwrap();
    assert_eq!(revolute.aligned(), [frame().axes]);
}
