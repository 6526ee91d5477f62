//! Minimal coordinates of a tree: those of its joints.
//!
//! With the speeds `u`, the twists of the bodies are `V = B u + b`, their rates `V' = B u' + c`, and the joints' reactions
//! do no work on `B`, so `(B^T M B) u' = B^T (f - M c)`. Nothing can drift: every state is on the joints.

use linchpin_proto::joint_load::Wrench;
use nalgebra::{Cholesky, DMatrix, DVector};

use super::edge::{Edge, Freedom, Moving};
use super::error::CompositionError;
use super::formulation::{Dynamics, Formulation, Unsettled};
use super::kinematics::{Kinematics, NO_LOAD, Twist, add_load, moved_load};
use super::system::System;
use super::tree;

/// A system in minimal coordinates.
#[derive(Debug)]
pub struct Minimal {
    system: System,
    edges: Vec<Edge>,
    /// Number of coordinates; the speeds follow them in the state.
    coordinates: usize,
    names: Vec<String>,
}

impl Minimal {
    /// Of a system whose start has been checked.
    ///
    /// # Errors
    /// [`CompositionError`] if it is no tree.
    pub fn new(system: System) -> Result<Self, CompositionError> {
        let edges = tree::edges(&system)?;
        let coordinates = edges.iter().map(Edge::number_of_coordinates).sum();
        let named = |edge: &Edge, what: &str, number: usize| -> Vec<String> {
            let name = match edge.joint {
                Some(joint) => &system.joints[joint].name,
                None => &system.bodies[edge.outer].name,
            };
            let names = (0..number).map(|place| format!("{name}.{what}[{place}]"));
            names.collect()
        };
        let of_coordinates = edges
            .iter()
            .flat_map(|edge| named(edge, "coordinate", edge.number_of_coordinates()));
        let of_speeds = edges
            .iter()
            .flat_map(|edge| named(edge, "speed", edge.number_of_speeds()));
        Ok(Self {
            names: of_coordinates.chain(of_speeds).collect(),
            coordinates,
            edges,
            system,
        })
    }

    /// The coordinates and speeds of an edge.
    fn of_edge<'s>(&self, edge: &Edge, state: &'s [f64]) -> (&'s [f64], &'s [f64]) {
        let (coordinates, speeds) = state.split_at(self.coordinates);
        (
            &coordinates[edge.coordinates..][..edge.number_of_coordinates()],
            &speeds[edge.speeds..][..edge.number_of_speeds()],
        )
    }

    fn moving(&self, t: f64, state: &[f64]) -> Vec<Moving> {
        let at_rest = Moving {
            motion: self.system.dimension.ground(),
            bias: Twist::ZERO,
            columns: Vec::new(),
        };
        let mut moving = vec![at_rest; self.system.bodies.len()];
        for edge in &self.edges {
            let (coordinates, speeds) = self.of_edge(edge, state);
            moving[edge.outer] = edge.carry(t, &moving[edge.inner], coordinates, speeds);
        }
        moving
    }

    fn kinematics_of(&self, t: f64, state: &[f64], moving: &[Moving]) -> Kinematics {
        let mut angles = vec![0.0; self.system.joints.len()];
        for edge in &self.edges {
            if let (Some(joint), Freedom::Turns(_)) = (edge.joint, &edge.freedom) {
                angles[joint] = edge.joint_coordinate(t, self.of_edge(edge, state).0);
            }
        }
        Kinematics {
            bodies: moving.iter().map(|body| body.motion).collect(),
            angles,
        }
    }

    /// Rates of the speeds; `None` if the mass matrix is not positive definite.
    fn speed_rates(&self, moving: &[Moving], loads: &[Wrench]) -> Option<DVector<f64>> {
        let n = self.names.len() - self.coordinates;
        let mut mass = DMatrix::zeros(n, n);
        let mut right = DVector::zeros(n);
        for ((body, moving), load) in self.system.bodies.iter().zip(moving).zip(loads) {
            let mut acting = *load;
            add_load(
                &mut acting,
                -1.0,
                &body.momentum(&moving.motion, &moving.bias),
            );
            for (i, twist) in &moving.columns {
                right[*i] += twist.power(&acting);
                let momentum = body.momentum(&moving.motion, twist);
                for (j, other) in &moving.columns {
                    mass[(*i, *j)] += other.power(&momentum);
                }
            }
        }
        Cholesky::new(mass).map(|factors| factors.solve(&right))
    }

    /// The joints' loads on their bodies b: what the bodies behind a joint need beyond the loads on them.
    fn reactions(
        &self,
        moving: &[Moving],
        loads: &[Wrench],
        accelerations: &[Twist],
    ) -> Vec<Wrench> {
        let needed = |((body, moving), (load, acceleration)): (_, (&Wrench, &Twist))| {
            let (body, moving): (&super::body::Body, &Moving) = (body, moving);
            let mut needed = body.momentum(&moving.motion, acceleration);
            add_load(&mut needed, -1.0, load);
            needed
        };
        let bodies = self.system.bodies.iter().zip(moving);
        let mut needed: Vec<Wrench> = bodies
            .zip(loads.iter().zip(accelerations))
            .map(needed)
            .collect();
        let mut reactions = vec![NO_LOAD; self.system.joints.len()];
        for edge in self.edges.iter().rev() {
            let position = |place: usize| moving[place].motion.pose.position;
            let on_outer = needed[edge.outer];
            let arm = position(edge.outer) - position(edge.inner);
            let on_inner = moved_load(&on_outer, &arm);
            add_load(&mut needed[edge.inner], 1.0, &on_inner);
            if let Some(joint) = edge.joint {
                let on_b = if edge.sign > 0.0 {
                    &on_outer
                } else {
                    &on_inner
                };
                add_load(&mut reactions[joint], edge.sign, on_b);
            }
        }
        reactions
    }
}

impl Formulation for Minimal {
    fn system(&self) -> &System {
        &self.system
    }

    fn state_names(&self) -> &[String] {
        &self.names
    }

    fn start(&self) -> Vec<f64> {
        let mut state = vec![0.0; self.names.len()];
        let (coordinates, speeds) = state.split_at_mut(self.coordinates);
        for edge in &self.edges {
            edge.put_start(
                &self.system.bodies,
                &mut coordinates[edge.coordinates..][..edge.number_of_coordinates()],
                &mut speeds[edge.speeds..][..edge.number_of_speeds()],
            );
        }
        state
    }

    fn kinematics(&self, t: f64, state: &[f64]) -> Kinematics {
        self.kinematics_of(t, state, &self.moving(t, state))
    }

    fn dynamics(&self, t: f64, state: &[f64], inputs: &[f64]) -> Option<Dynamics> {
        let moving = self.moving(t, state);
        let kinematics = self.kinematics_of(t, state, &moving);
        let loads = self.system.loads(&kinematics, inputs);
        let rates = self.speed_rates(&moving, &loads)?;
        let acceleration = |body: &Moving| {
            let columns = body.columns.iter();
            columns.fold(body.bias, |sum, (place, column)| {
                sum.plus(rates[*place], column)
            })
        };
        let accelerations: Vec<Twist> = moving.iter().map(acceleration).collect();
        Some(Dynamics {
            reactions: self.reactions(&moving, &loads, &accelerations),
            accelerations,
        })
    }

    fn rate(&self, t: f64, state: &[f64], inputs: &[f64], rate: &mut [f64]) {
        let moving = self.moving(t, state);
        let kinematics = self.kinematics_of(t, state, &moving);
        let loads = self.system.loads(&kinematics, inputs);
        let Some(rates) = self.speed_rates(&moving, &loads) else {
            rate.fill(f64::NAN);
            return;
        };
        let (of_coordinates, of_speeds) = rate.split_at_mut(self.coordinates);
        of_speeds.copy_from_slice(rates.as_slice());
        for edge in &self.edges {
            let (coordinates, speeds) = self.of_edge(edge, state);
            edge.put_coordinate_rates(
                &moving[edge.outer].motion,
                coordinates,
                speeds,
                &mut of_coordinates[edge.coordinates..][..edge.number_of_coordinates()],
            );
        }
    }

    fn settle(&self, _: f64, state: &mut [f64]) -> Result<(), Unsettled> {
        for edge in &self.edges {
            let coordinates = edge.number_of_coordinates();
            edge.settle(&mut state[edge.coordinates..][..coordinates]);
        }
        Ok(())
    }
}
