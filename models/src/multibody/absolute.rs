//! Absolute coordinates: an index-1 DAE.
//!
//! The states are coordinates and speeds of every body, and in space the angles of the revolute joints. Accelerations
//! and multipliers follow from the conditions on acceleration level,
//! `[M -J^T; J 0] (V', lambda) = (f, -c)`, which is solved by its Schur complement. The integrator lets positions and
//! velocities drift within its error; at the end of every macro step they are projected onto the conditions,
//! `dq = -M^-1 J^T S^-1 g` and `dV = -M^-1 J^T S^-1 g'`, the smallest change in the metric of the masses. It leaves
//! momentum and angular momentum as they are where no condition holds on the ground.

use linchpin_proto::joint_load::Wrench;
use nalgebra::DVector;

use super::condition::Condition;
use super::constraints::{Constraints, Factors};
use super::dimension::Dimension;
use super::formulation::{Dynamics, Formulation, Unsettled};
use super::joint::JointKind;
use super::kinematics::{Kinematics, NO_LOAD, Twist, add_load};
use super::system::System;

/// A residual (m or rad) whose square is below rounding: one more projection is the last one.
const NEARLY_CLOSED: f64 = 1e-9;

/// Projections after which the joints are taken for impossible to close.
const MOST_PROJECTIONS: usize = 20;

/// A system in absolute coordinates.
#[derive(Debug)]
pub struct Absolute {
    system: System,
    conditions: Vec<Condition>,
    /// Joint of every condition; that of a motion is the joint it drives.
    owners: Vec<Option<usize>>,
    /// Joints whose angle is a state.
    turning: Vec<usize>,
    names: Vec<String>,
}

impl Absolute {
    /// Of a system whose start has been checked.
    pub fn new(system: System) -> Self {
        let conditions = system.conditions();
        let owner = |condition: &Condition| {
            let mut joints = system.joints.iter();
            let place = match system
                .motions
                .iter()
                .find(|own| own.place == condition.place)
            {
                Some(motion) => return motion.joint(),
                None => &condition.place,
            };
            joints.position(|joint| joint.place == *place)
        };
        let owners = conditions.iter().map(owner).collect();
        let is_turning = |joint: &usize| {
            system.dimension == Dimension::Space
                && system.joints[*joint].kind == JointKind::Revolute
        };
        let turning: Vec<usize> = (0..system.joints.len()).filter(is_turning).collect();
        let names = names(&system, &turning);
        Self {
            conditions,
            owners,
            turning,
            names,
            system,
        }
    }

    fn moving_bodies(&self) -> usize {
        self.system.bodies.len() - 1
    }

    /// Places of the first speed and the first angle among the states.
    fn parts(&self) -> (usize, usize) {
        let bodies = self.moving_bodies();
        let speeds = bodies * self.system.dimension.coordinates();
        (speeds, speeds + bodies * self.system.dimension.speeds())
    }

    fn state(&self, kinematics: &Kinematics) -> Vec<f64> {
        let dimension = self.system.dimension;
        let mut state = vec![0.0; self.names.len()];
        let (speeds, angles) = self.parts();
        let (coordinates, rest) = state.split_at_mut(speeds);
        let (speeds, angles) = rest.split_at_mut(angles - speeds);
        let own = coordinates.chunks_mut(dimension.coordinates());
        let own = own.zip(speeds.chunks_mut(dimension.speeds()));
        for (body, (coordinates, speeds)) in kinematics.bodies[1..].iter().zip(own) {
            dimension.put_position(body, coordinates);
            dimension.put_twist(&body.twist, speeds);
        }
        for (angle, &joint) in angles.iter_mut().zip(&self.turning) {
            *angle = kinematics.angles[joint];
        }
        state
    }

    fn constraints(&self, t: f64, kinematics: &Kinematics) -> Constraints {
        let rows = self.conditions.iter();
        let rows = rows.map(|condition| condition.row(t, &kinematics.bodies));
        Constraints::new(&self.system.bodies, &kinematics.bodies, rows.collect())
    }

    /// Accelerations, and what determines them.
    fn solve(&self, t: f64, kinematics: &Kinematics, inputs: &[f64]) -> Option<Solution> {
        let loads = self.system.loads(kinematics, inputs);
        let bodies = self.system.bodies.iter().zip(&kinematics.bodies);
        let mut accelerations: Vec<Twist> = bodies
            .zip(&loads)
            .map(|((body, motion), load)| body.response(motion, load))
            .collect();
        let constraints = self.constraints(t, kinematics);
        let factors = constraints.factors()?;
        let rows = constraints.rows().iter();
        let right = rows.map(|row| -row.along(|place| accelerations[place]) - row.bias);
        let multipliers = factors.solve(DVector::from_iterator(constraints.rows().len(), right));
        constraints.add_responses(1.0, &multipliers, &mut accelerations);
        Some(Solution {
            accelerations,
            constraints,
            multipliers,
        })
    }

    /// Moves the bodies onto the conditions.
    fn close(&self, t: f64, kinematics: &mut Kinematics) -> Result<(), Unsettled> {
        let mut residual = f64::INFINITY;
        for _ in 0..MOST_PROJECTIONS {
            let constraints = self.constraints(t, kinematics);
            let residuals = constraints.rows().iter().map(|row| row.residual);
            let residuals = DVector::from_iterator(constraints.rows().len(), residuals);
            residual = residuals.amax();
            self.displace(&constraints, &factors(&constraints)?, residuals, kinematics);
            if residual < NEARLY_CLOSED {
                return Ok(());
            }
        }
        Err(Unsettled::Open { residual })
    }

    fn displace(
        &self,
        constraints: &Constraints,
        factors: &Factors,
        residuals: DVector<f64>,
        kinematics: &mut Kinematics,
    ) {
        let multipliers = factors.solve(residuals);
        let mut by = vec![Twist::ZERO; kinematics.bodies.len()];
        constraints.add_responses(-1.0, &multipliers, &mut by);
        for (body, by) in kinematics.bodies.iter_mut().zip(&by) {
            *body = body.displaced(by);
        }
    }

    /// Changes the velocities to what the conditions allow.
    fn slow(&self, t: f64, kinematics: &mut Kinematics) -> Result<(), Unsettled> {
        let constraints = self.constraints(t, kinematics);
        let mut twists: Vec<Twist> = kinematics.bodies.iter().map(|body| body.twist).collect();
        let rows = constraints.rows().iter();
        let rates = rows.map(|row| row.along(|place| twists[place]) + row.drift);
        let rates = DVector::from_iterator(constraints.rows().len(), rates);
        let multipliers = factors(&constraints)?.solve(rates);
        constraints.add_responses(-1.0, &multipliers, &mut twists);
        for (body, twist) in kinematics.bodies.iter_mut().zip(twists) {
            body.twist = twist;
        }
        Ok(())
    }
}

struct Solution {
    accelerations: Vec<Twist>,
    constraints: Constraints,
    multipliers: DVector<f64>,
}

impl Formulation for Absolute {
    fn system(&self) -> &System {
        &self.system
    }

    fn state_names(&self) -> &[String] {
        &self.names
    }

    fn start(&self) -> Vec<f64> {
        self.state(&self.system.start())
    }

    fn kinematics(&self, _: f64, state: &[f64]) -> Kinematics {
        let dimension = self.system.dimension;
        let (speeds, angles) = self.parts();
        let coordinates = state[..speeds].chunks(dimension.coordinates());
        let own = coordinates.zip(state[speeds..angles].chunks(dimension.speeds()));
        let mut kinematics = Kinematics {
            bodies: vec![dimension.ground()],
            angles: vec![0.0; self.system.joints.len()],
        };
        let motions = own.map(|(coordinates, speeds)| dimension.motion(coordinates, speeds));
        kinematics.bodies.extend(motions);
        for (&joint, &angle) in self.turning.iter().zip(&state[angles..]) {
            kinematics.angles[joint] = angle;
        }
        kinematics
    }

    fn dynamics(&self, t: f64, state: &[f64], inputs: &[f64]) -> Option<Dynamics> {
        let kinematics = self.kinematics(t, state);
        let solution = self.solve(t, &kinematics, inputs)?;
        let mut reactions: Vec<Wrench> = vec![NO_LOAD; self.system.joints.len()];
        let rows = solution.constraints.rows().iter().zip(&self.owners);
        for ((row, owner), &multiplier) in rows.zip(&solution.multipliers) {
            if let Some(joint) = owner {
                add_load(&mut reactions[*joint], multiplier, &row.loads[1]);
            }
        }
        Some(Dynamics {
            accelerations: solution.accelerations,
            reactions,
        })
    }

    fn rate(&self, t: f64, state: &[f64], inputs: &[f64], rate: &mut [f64]) {
        let dimension = self.system.dimension;
        let kinematics = self.kinematics(t, state);
        let Some(solution) = self.solve(t, &kinematics, inputs) else {
            rate.fill(f64::NAN);
            return;
        };
        let (speeds, angles) = self.parts();
        let (coordinates, rest) = rate.split_at_mut(speeds);
        let (speeds, angles) = rest.split_at_mut(angles - speeds);
        let own = coordinates.chunks_mut(dimension.coordinates());
        let own = own.zip(speeds.chunks_mut(dimension.speeds()));
        let moving = kinematics.bodies[1..]
            .iter()
            .zip(&solution.accelerations[1..]);
        for ((body, acceleration), (coordinates, speeds)) in moving.zip(own) {
            dimension.put_position_rate(body, coordinates);
            dimension.put_twist(acceleration, speeds);
        }
        for (rate, &joint) in angles.iter_mut().zip(&self.turning) {
            let joint = &self.system.joints[joint];
            let pair = joint.bodies.map(|place| &kinematics.bodies[place]);
            *rate = joint.coordinate(pair, 0.0).rate;
        }
    }

    fn settle(&self, t: f64, state: &mut [f64]) -> Result<(), Unsettled> {
        let mut kinematics = self.kinematics(t, state);
        if !self.conditions.is_empty() {
            self.close(t, &mut kinematics)?;
            self.slow(t, &mut kinematics)?;
        }
        for body in &mut kinematics.bodies {
            body.orientation = body.orientation.settled();
        }
        for &place in &self.turning {
            let joint = &self.system.joints[place];
            let pair = joint.bodies.map(|place| &kinematics.bodies[place]);
            kinematics.angles[place] = joint.angle_near(pair, kinematics.angles[place]);
        }
        state.copy_from_slice(&self.state(&kinematics));
        Ok(())
    }
}

fn factors(constraints: &Constraints) -> Result<Factors, Unsettled> {
    constraints.factors().ok_or(Unsettled::Singular)
}

fn names(system: &System, turning: &[usize]) -> Vec<String> {
    let (coordinates, speeds): (&[&str], &[&str]) = match system.dimension {
        Dimension::Plane => (&["x", "y", "angle"], &["vx", "vy", "rate"]),
        Dimension::Space => (
            &["x", "y", "z", "qw", "qx", "qy", "qz"],
            &["vx", "vy", "vz", "omega_x", "omega_y", "omega_z"],
        ),
    };
    let of_bodies = |parts: &[&str]| -> Vec<String> {
        let bodies = system.bodies[1..].iter();
        let names =
            bodies.flat_map(|body| parts.iter().map(|part| format!("{}.{part}", body.name)));
        names.collect()
    };
    let joints = turning.iter().map(|&joint| &system.joints[joint].name);
    let angles = joints.map(|name| format!("{name}.angle")).collect();
    [of_bodies(coordinates), of_bodies(speeds), angles].concat()
}
