//! One edge of the tree: how a body moves relative to the one that it hangs on.
//!
//! With the motion of the inner body, the joint's arms `r` on the inner and `s` on the outer body, and the edge's own
//! speeds, the outer body has
//! `omega' = omega + sum e_k u_k`, `v' = v + omega x r + e u - omega' x s` (turns about axes `e_k`, or a translation along
//! `e`), and the derivative of that as acceleration. Each column of the outer body's Jacobian is the same with one speed
//! set to 1 and all others to 0; the bias is the acceleration with all rates of speeds set to 0.

use linchpin_proto::joint_load::Pose;
use nalgebra::{Quaternion, Vector3};

use super::body::{Body, GROUND};
use super::dimension::Dimension;
use super::error::CompositionError;
use super::joint::{Joint, JointKind};
use super::kinematics::{BodyMotion, Orientation, Twist};
use super::motion::{Coordinate, Course};
use crate::mechanics::spatial::real_first;

/// How the outer body moves on the inner one.
#[derive(Debug, Clone, PartialEq)]
pub enum Freedom {
    /// By all coordinates of a body; the inner one is the ground.
    Free(Dimension),
    /// By turns about axes, the first one held by the inner body, each other one by what the turn before it moves; unit
    /// vectors in the axes of the inner body at the start.
    Turns(Vec<Vector3<f64>>),
    /// Along an axis in the axes of the inner body.
    Slide(Vector3<f64>),
    /// By all turns, told by a quaternion from the outer body's axes to the inner one's.
    Ball,
}

/// One edge.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge {
    /// Place of its joint.
    pub joint: Option<usize>,
    /// Places of the bodies.
    pub inner: usize,
    /// The body farther from the ground.
    pub outer: usize,
    /// How it moves.
    pub freedom: Freedom,
    /// Place of the first coordinate among the states.
    pub coordinates: usize,
    /// Place of the first speed among the speeds.
    pub speeds: usize,
    /// The only coordinate, if its motion is prescribed.
    pub course: Option<Course>,
    /// 1 if the outer body is b of the joint, -1 if it is a: the joint counts its coordinate from a to b.
    pub sign: f64,
    /// The joint's point in the axes of the inner and of the outer body (m).
    points: [Vector3<f64>; 2],
    /// Turn from the inner to the outer body's axes at the start.
    start: Orientation,
    /// First coordinate at the start.
    start_coordinate: f64,
}

/// Motion of a body as a function of the speeds and their rates.
#[derive(Debug, Clone, PartialEq)]
pub struct Moving {
    /// Where it is and how it moves.
    pub motion: BodyMotion,
    /// Its acceleration when all rates of speeds are 0.
    pub bias: Twist,
    /// Places of the speeds that move it, and its twist when that speed is 1 and all others are 0.
    pub columns: Vec<(usize, Twist)>,
}

impl Edge {
    /// The edge of a joint; `outer_end` is the end of the joint at the outer body.
    ///
    /// # Errors
    /// [`CompositionError::NoTreeJoint`] for a joint whose coordinates no edge has.
    pub fn of_joint(
        place: usize,
        joint: &Joint,
        outer_end: usize,
        bodies: &[Body],
        course: Option<Course>,
    ) -> Result<Self, CompositionError> {
        let inner_end = 1 - outer_end;
        let [inner, outer] = [joint.bodies[inner_end], joint.bodies[outer_end]];
        let [inner_start, outer_start] = [&bodies[inner].start, &bodies[outer].start];
        let own = joint.axes[inner_end];
        let other = outer_start.arm(&joint.axes[outer_end]);
        let freedom = match joint.kind {
            JointKind::Revolute => Freedom::Turns(vec![own]),
            JointKind::Universal => Freedom::Turns(vec![own, inner_start.local_vector(&other)]),
            JointKind::Weld => Freedom::Turns(Vec::new()),
            JointKind::Prismatic => Freedom::Slide(own),
            JointKind::Spherical => Freedom::Ball,
            JointKind::Inline => {
                let field = joint.place.clone();
                return Err(CompositionError::NoTreeJoint { field });
            }
        };
        let sign = if outer_end == 1 { 1.0 } else { -1.0 };
        let has_coordinate = matches!(joint.kind, JointKind::Revolute | JointKind::Prismatic);
        Ok(Self {
            joint: Some(place),
            inner,
            outer,
            freedom,
            coordinates: 0,
            speeds: 0,
            course,
            sign,
            points: [joint.points[inner_end], joint.points[outer_end]],
            start: inner_start.orientation.to(&outer_start.orientation),
            start_coordinate: if has_coordinate {
                sign * joint.start_coordinate(bodies)
            } else {
                0.0
            },
        })
    }

    /// The edge of a body that no joint holds.
    pub fn free(dimension: Dimension, outer: usize) -> Self {
        Self {
            joint: None,
            inner: GROUND,
            outer,
            freedom: Freedom::Free(dimension),
            coordinates: 0,
            speeds: 0,
            course: None,
            sign: 1.0,
            points: [Vector3::zeros(); 2],
            start: dimension.unturned(),
            start_coordinate: 0.0,
        }
    }

    /// Number of its coordinates among the states.
    pub fn number_of_coordinates(&self) -> usize {
        match &self.freedom {
            _ if self.course.is_some() => 0,
            Freedom::Free(dimension) => dimension.coordinates(),
            Freedom::Turns(axes) => axes.len(),
            Freedom::Slide(_) => 1,
            Freedom::Ball => 4,
        }
    }

    /// Number of its speeds.
    pub fn number_of_speeds(&self) -> usize {
        match &self.freedom {
            _ if self.course.is_some() => 0,
            Freedom::Free(dimension) => dimension.speeds(),
            Freedom::Turns(axes) => axes.len(),
            Freedom::Slide(_) => 1,
            Freedom::Ball => 3,
        }
    }

    /// Writes coordinates and speeds at the start.
    pub fn put_start(&self, bodies: &[Body], coordinates: &mut [f64], speeds: &mut [f64]) {
        if self.course.is_some() {
            return;
        }
        let [inner, outer] = [&bodies[self.inner].start, &bodies[self.outer].start];
        let turning = outer.twist.angular - inner.twist.angular;
        match &self.freedom {
            Freedom::Free(dimension) => {
                dimension.put_position(outer, coordinates);
                dimension.put_twist(&outer.twist, speeds);
            }
            Freedom::Turns(axes) => {
                for (speed, axis) in speeds.iter_mut().zip(axes) {
                    *speed = turning.dot(&inner.arm(axis));
                }
                coordinates.fill(0.0);
                if let ([coordinate], [_]) = (coordinates, &axes[..]) {
                    *coordinate = self.start_coordinate;
                }
            }
            Freedom::Slide(axis) => {
                let arm = inner.arm(&self.points[0]) + self.start_coordinate * inner.arm(axis);
                let carried = inner.twist.shifted(&arm).linear;
                let moving = outer.velocity(&self.points[1]) - carried;
                coordinates[0] = self.start_coordinate;
                speeds[0] = moving.dot(&inner.arm(axis));
            }
            Freedom::Ball => {
                self.start.put(coordinates);
                speeds.copy_from_slice(inner.local_vector(&turning).as_slice());
            }
        }
    }

    /// Writes the rates of the coordinates.
    pub fn put_coordinate_rates(
        &self,
        motion: &BodyMotion,
        coordinates: &[f64],
        speeds: &[f64],
        rates: &mut [f64],
    ) {
        match &self.freedom {
            Freedom::Free(dimension) => dimension.put_position_rate(motion, rates),
            Freedom::Turns(_) | Freedom::Slide(_) => rates.copy_from_slice(speeds),
            Freedom::Ball => {
                let [w, x, y, z] = [0, 1, 2, 3].map(|part| coordinates[part]);
                let half = 0.5 * Vector3::from_column_slice(speeds);
                let rate = Quaternion::from_imag(half) * Quaternion::new(w, x, y, z);
                rates.copy_from_slice(real_first(&rate).as_slice());
            }
        }
    }

    /// Brings a quaternion among the coordinates back to unit length.
    pub fn settle(&self, coordinates: &mut [f64]) {
        let turn = match self.freedom {
            Freedom::Free(Dimension::Space) => &mut coordinates[3..],
            Freedom::Ball => coordinates,
            _ => return,
        };
        Orientation::from_parts(turn).settled().put(turn);
    }

    /// The joint's angle or displacement, from a to b.
    pub fn joint_coordinate(&self, t: f64, coordinates: &[f64]) -> f64 {
        let own = self.course.map(|course| course.at(t).value);
        own.or_else(|| coordinates.first().map(|own| self.sign * own))
            .unwrap_or_default()
    }

    /// The outer body, hanging on the inner one.
    pub fn carry(&self, t: f64, inner: &Moving, coordinates: &[f64], speeds: &[f64]) -> Moving {
        if let Freedom::Free(dimension) = self.freedom {
            return self.free_body(dimension, coordinates, speeds);
        }
        let mut joint = JointFrame::on(inner, &self.points[0]);
        match &self.freedom {
            Freedom::Turns(axes) => {
                let mut own = vec![Coordinate::default(); axes.len()];
                self.read_coordinates(t, coordinates, speeds, &mut own);
                for (number, (axis, own)) in axes.iter().zip(own).enumerate() {
                    let angle = own.value - self.start_coordinate;
                    joint.turn(axis, angle, &own, self.column(number));
                }
                joint.turn_by(&self.start);
            }
            Freedom::Slide(axis) => {
                let mut own = [Coordinate::default()];
                self.read_coordinates(t, coordinates, speeds, &mut own);
                joint.slide(inner, axis, &own[0], self.column(0));
                joint.turn_by(&self.start);
            }
            Freedom::Ball | Freedom::Free(_) => {
                let omega = Vector3::from_column_slice(speeds);
                joint.turn_freely(inner, &omega, self.speeds);
                joint.turn_by(&Orientation::from_parts(coordinates));
            }
        }
        joint.body(&self.points[1])
    }

    /// Place of a speed among the speeds, unless the motion is prescribed.
    fn column(&self, number: usize) -> Option<usize> {
        self.course.is_none().then_some(self.speeds + number)
    }

    fn read_coordinates(
        &self,
        t: f64,
        coordinates: &[f64],
        speeds: &[f64],
        own: &mut [Coordinate],
    ) {
        if let (Some(course), [own]) = (self.course, &mut *own) {
            *own = course.at(t).times(self.sign);
            return;
        }
        for (own, (&value, &rate)) in own.iter_mut().zip(coordinates.iter().zip(speeds)) {
            *own = Coordinate {
                value,
                rate,
                acceleration: 0.0,
            };
        }
    }

    fn free_body(&self, dimension: Dimension, coordinates: &[f64], speeds: &[f64]) -> Moving {
        let columns = (0..dimension.speeds()).map(|number| {
            let mut unit = vec![0.0; dimension.speeds()];
            unit[number] = 1.0;
            (self.speeds + number, dimension.twist(&unit))
        });
        Moving {
            motion: dimension.motion(coordinates, speeds),
            bias: Twist::ZERO,
            columns: columns.collect(),
        }
    }
}

/// A frame at the joint's point, on its way from the inner to the outer body.
struct JointFrame {
    position: Vector3<f64>,
    orientation: Orientation,
    twist: Twist,
    bias: Twist,
    columns: Vec<(usize, Twist)>,
}

impl JointFrame {
    fn on(inner: &Moving, point: &Vector3<f64>) -> Self {
        let mut frame = Self {
            position: inner.motion.pose.position,
            orientation: inner.motion.orientation,
            twist: inner.motion.twist,
            bias: inner.bias,
            columns: inner.columns.clone(),
        };
        frame.shift(&inner.motion.arm(point));
        frame
    }

    /// Moves the reference point by an arm that turns with the frame.
    fn shift(&mut self, arm: &Vector3<f64>) {
        self.position += arm;
        self.bias = self.bias.accelerated(arm, &self.twist.angular);
        self.twist = self.twist.shifted(arm);
        for (_, column) in &mut self.columns {
            *column = column.shifted(arm);
        }
    }

    fn turn(&mut self, axis: &Vector3<f64>, angle: f64, own: &Coordinate, column: Option<usize>) {
        let axis_in_space = self.orientation.rotation() * axis;
        let omega = own.rate * axis_in_space;
        self.bias.angular += own.acceleration * axis_in_space + self.twist.angular.cross(&omega);
        self.twist.angular += omega;
        self.turn_by(&self.orientation.about(axis, angle));
        self.columns.extend(column.map(|place| {
            let unit = Twist {
                linear: Vector3::zeros(),
                angular: axis_in_space,
            };
            (place, unit)
        }));
    }

    fn slide(
        &mut self,
        inner: &Moving,
        axis: &Vector3<f64>,
        own: &Coordinate,
        column: Option<usize>,
    ) {
        let axis = inner.motion.arm(axis);
        let omega = inner.motion.twist.angular;
        self.shift(&(own.value * axis));
        self.twist.linear += own.rate * axis;
        self.bias.linear += own.acceleration * axis + 2.0 * own.rate * omega.cross(&axis);
        self.columns.extend(column.map(|place| {
            let unit = Twist {
                linear: axis,
                angular: Vector3::zeros(),
            };
            (place, unit)
        }));
    }

    fn turn_freely(&mut self, inner: &Moving, omega: &Vector3<f64>, first: usize) {
        let omega = inner.motion.arm(omega);
        self.bias.angular += self.twist.angular.cross(&omega);
        self.twist.angular += omega;
        let units = [Vector3::x(), Vector3::y(), Vector3::z()];
        for (number, unit) in units.into_iter().enumerate() {
            let unit = Twist {
                linear: Vector3::zeros(),
                angular: inner.motion.arm(&unit),
            };
            self.columns.push((first + number, unit));
        }
    }

    fn turn_by(&mut self, inner: &Orientation) {
        self.orientation = self.orientation.then(inner);
    }

    /// The body whose joint point this is.
    fn body(mut self, point: &Vector3<f64>) -> Moving {
        let rotation = self.orientation.rotation();
        self.shift(&-(rotation * point));
        Moving {
            motion: BodyMotion {
                orientation: self.orientation,
                pose: Pose {
                    position: self.position,
                    rotation,
                },
                twist: self.twist,
            },
            bias: self.bias,
            columns: self.columns,
        }
    }
}
