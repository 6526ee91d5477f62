//! What a composition consists of: bodies, what acts on them, what is seen of them.

use std::collections::BTreeMap;

use linchpin_proto::joint_load::Wrench;
use linchpin_proto::v1;
use linchpin_worker::JointLoad;
use linchpin_worker::setup::SetupError;
use nalgebra::Vector3;

use super::body::{self, Body};
use super::condition::Condition;
use super::dimension::Dimension;
use super::entries::{Entries, Entry};
use super::joint::{self, Joint};
use super::kinematics::{Kinematics, NO_LOAD, add_load};
use super::marker::{self, Marker};
use super::motion::{self, Motion};
use super::spring::{self, Spring};
use super::torsion::{self, TorsionSpring};

/// Acceleration of gravity (m/s^2) unless the scene gives another.
const STANDARD_GRAVITY: f64 = 9.81;

/// In which coordinates the equations of motion are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coordinates {
    /// Those of every body.
    Absolute,
    /// Those of the joints.
    Minimal,
}

/// A composition as a scene writes it.
#[derive(Debug, Clone, PartialEq)]
pub struct System {
    /// In the plane or in space.
    pub dimension: Dimension,
    /// As the scene chooses.
    pub coordinates: Coordinates,
    /// The ground, then the bodies.
    pub bodies: Vec<Body>,
    /// Joints between them.
    pub joints: Vec<Joint>,
    /// Prescribed motions.
    pub motions: Vec<Motion>,
    /// Places where other subsystems can be joined.
    pub markers: Vec<Marker>,
    /// Joint loads with the places of their markers.
    joint_loads: Vec<(usize, JointLoad)>,
    springs: Vec<Spring>,
    torsion_springs: Vec<TorsionSpring>,
    /// Acceleration of gravity (m/s^2).
    gravity: Vector3<f64>,
    t_start: f64,
}

impl System {
    /// Reads the parameters of a scene; the start is at the time `t_start` (s).
    ///
    /// # Errors
    /// [`SetupError`] with the place of the mistake.
    pub fn read(
        dimension: Dimension,
        parameters: &BTreeMap<String, v1::Value>,
        t_start: f64,
    ) -> Result<Self, SetupError> {
        let entries = Entries::new(dimension, parameters)?;
        let bodies = body::read(&entries, dimension)?;
        let joints = joint::read(&entries, &bodies, dimension)?;
        let plain = entries.plain();
        Ok(Self {
            dimension,
            coordinates: coordinates(&plain)?,
            motions: motion::read(&entries, &bodies, &joints, t_start)?,
            markers: marker::read(&entries, &bodies)?,
            joint_loads: Vec::new(),
            springs: spring::read(&entries, &bodies)?,
            torsion_springs: torsion::read(&entries, &bodies, &joints, dimension)?,
            gravity: gravity(&plain, dimension)?,
            bodies,
            joints,
            t_start,
        })
    }

    /// With these joint loads; those of markers that are not there are left out.
    pub fn with_joint_loads(mut self, joint_loads: &[JointLoad]) -> Self {
        let place = |load: &JointLoad| {
            let mut markers = self.markers.iter();
            markers.position(|marker| marker.name == load.marker.name)
        };
        let placed = joint_loads
            .iter()
            .filter_map(|load| Some((place(load)?, load.clone())));
        self.joint_loads = placed.collect();
        self
    }

    /// Time of the start (s).
    pub fn t_start(&self) -> f64 {
        self.t_start
    }

    /// The start as the scene gives it.
    pub fn start(&self) -> Kinematics {
        Kinematics {
            bodies: self.bodies.iter().map(|body| body.start).collect(),
            angles: vec![0.0; self.joints.len()],
        }
    }

    /// All conditions of joints and motions.
    pub fn conditions(&self) -> Vec<Condition> {
        let joints = self.joints.iter();
        let of_joints = joints.flat_map(|joint| joint.conditions(&self.bodies));
        let motions = self.motions.iter();
        let of_motions = motions.map(|motion| motion.condition(&self.bodies, &self.joints));
        of_joints.chain(of_motions).collect()
    }

    /// What acts on the bodies at their centres of mass: weight, springs, loads of markers and the gyroscopic moment. It
    /// would be the momentum's rate if there were no joints.
    pub fn loads(&self, kinematics: &Kinematics, inputs: &[f64]) -> Vec<Wrench> {
        let bodies = self.bodies.iter().zip(&kinematics.bodies);
        let own = bodies.map(|(body, motion)| Wrench {
            force: body.mass * self.gravity,
            moment: body.gyroscopic(motion),
        });
        let mut loads: Vec<Wrench> = own.collect();
        for spring in &self.springs {
            spring.add_loads(&kinematics.bodies, &mut loads);
        }
        for spring in &self.torsion_springs {
            spring.add_loads(kinematics, &mut loads);
        }
        self.add_marker_loads(kinematics, inputs, &mut loads);
        loads
    }

    fn add_marker_loads(&self, kinematics: &Kinematics, inputs: &[f64], loads: &mut [Wrench]) {
        let components = self.dimension.load_components();
        for (marker, inputs) in self.markers.iter().zip(inputs.chunks_exact(components)) {
            let load = self.dimension.load(inputs);
            if load != NO_LOAD {
                let at_centre = marker.at_centre(&kinematics.bodies[marker.body], &load);
                add_load(&mut loads[marker.body], 1.0, &at_centre);
            }
        }
        for (place, load) in &self.joint_loads {
            let marker = &self.markers[*place];
            let body = &kinematics.bodies[marker.body];
            let load = load.wrench(&marker.pose(body), inputs);
            add_load(&mut loads[marker.body], 1.0, &marker.at_centre(body, &load));
        }
    }

    /// Kinetic energy, potential energy above the origin and energy of the springs (J).
    pub fn energy(&self, kinematics: &Kinematics) -> f64 {
        let bodies = self.bodies.iter().zip(&kinematics.bodies);
        let own = bodies.map(|(body, motion)| {
            let height = motion.pose.position.dot(&self.gravity);
            body.kinetic_energy(motion) - body.mass * height
        });
        let springs = self.springs.iter();
        let springs = springs.map(|spring| spring.energy(&kinematics.bodies));
        let turned = self.torsion_springs.iter();
        let turned = turned.map(|spring| spring.energy(kinematics));
        own.chain(springs).chain(turned).sum()
    }
}

fn coordinates(plain: &Entry<'_>) -> Result<Coordinates, SetupError> {
    if !plain.has("formulation") {
        return Ok(Coordinates::Absolute);
    }
    let choices = [
        ("absolute", Coordinates::Absolute),
        ("minimal", Coordinates::Minimal),
    ];
    plain.choice("formulation", &choices)
}

fn gravity(plain: &Entry<'_>, dimension: Dimension) -> Result<Vector3<f64>, SetupError> {
    if plain.is_list("gravity") {
        return plain.vector("gravity");
    }
    let down = -dimension.directions()[dimension.components() - 1];
    Ok(plain.number_or("gravity", STANDARD_GRAVITY)? * down)
}
