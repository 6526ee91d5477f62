//! Kane's equations of a chain, and Newton's and Euler's laws of its bodies.

use nalgebra::{Cholesky, DMatrix, DVector, Vector3};

use super::frame::{Frame, Screw};
use super::{JointReaction, SpatialChain};
use crate::mechanics::spatial::{BodyMotion, to_body};

/// A chain at given coordinates and rates.
pub struct Configuration<'a> {
    chain: &'a SpatialChain,
    screws: Vec<Screw>,
    bodies: Vec<Place>,
}

/// One body of it.
struct Place {
    motion: BodyMotion,
    /// Angular velocity, in space.
    omega: Vector3<f64>,
    /// Angular acceleration and that of the centre at constant rates, in space.
    alpha: Vector3<f64>,
    acceleration: Vector3<f64>,
    /// Outer point of its joint, in space.
    joint: Vector3<f64>,
    /// Number of coordinates that move it.
    coordinates: usize,
}

/// What a body lacks besides its weight, about its centre.
struct Lack {
    force: Vector3<f64>,
    moment: Vector3<f64>,
}

impl<'a> Configuration<'a> {
    pub fn new(chain: &'a SpatialChain, coordinates: &[f64], rates: &[f64]) -> Self {
        let mut frame = Frame::ground();
        let mut screws = Vec::with_capacity(coordinates.len());
        let mut bodies = Vec::with_capacity(chain.bodies.len());
        for body in &chain.bodies {
            frame.carry(&body.joint.inner_point);
            for freedom in &body.joint.freedoms {
                let own = screws.len();
                screws.push(frame.free(freedom, coordinates[own], rates[own]));
            }
            frame.attitude *= body.joint.attitude;
            let joint = frame.origin;
            frame.carry(&-body.joint.outer_point);
            bodies.push(Place::new(&frame, joint, screws.len()));
        }
        Self {
            chain,
            screws,
            bodies,
        }
    }

    pub fn motions(&self) -> Vec<BodyMotion> {
        self.bodies.iter().map(|place| place.motion).collect()
    }

    /// `M_jk`, the sum over the bodies of `m v_j v_k + w_j J w_k` with the partial velocities `v`, `w`.
    pub fn mass_matrix(&self) -> DMatrix<f64> {
        let count = self.screws.len();
        let mut matrix = DMatrix::zeros(count, count);
        for (place, own) in self.bodies.iter().zip(&self.chain.bodies) {
            let screws = &self.screws[..place.coordinates];
            let partial = |screw: &Screw| screw.at(&place.motion.position);
            for (k, column) in screws.iter().enumerate() {
                let momentum = own.body.m * partial(column);
                let spin = own.body.inertia_times(&place.motion, &column.angular);
                for (j, row) in screws.iter().enumerate() {
                    matrix[(j, k)] += partial(row).dot(&momentum) + row.angular.dot(&spin);
                }
            }
        }
        matrix
    }

    /// Accelerations of the coordinates; not a number if the mass matrix is not positive definite.
    pub fn accelerations(&self) -> DVector<f64> {
        let count = self.screws.len();
        let mut forces = DVector::zeros(count);
        for (i, place) in self.bodies.iter().enumerate() {
            let lack = self.lack(i, &place.acceleration, &place.alpha);
            for (j, screw) in self.screws[..place.coordinates].iter().enumerate() {
                forces[j] -= screw.at(&place.motion.position).dot(&lack.force)
                    + screw.angular.dot(&lack.moment);
            }
        }
        match Cholesky::new(self.mass_matrix()) {
            Some(factors) => factors.solve(&forces),
            None => DVector::repeat(count, f64::NAN),
        }
    }

    /// Loads in the joints, summed from the tip of the chain to the ground.
    pub fn reactions(&self) -> Vec<JointReaction> {
        let rates = self.accelerations();
        let mut outer: Option<JointReaction> = None;
        let mut reactions = Vec::with_capacity(self.bodies.len());
        for (i, place) in self.bodies.iter().enumerate().rev() {
            let mut acceleration = place.acceleration;
            let mut alpha = place.alpha;
            for (screw, rate) in self.screws[..place.coordinates].iter().zip(&rates) {
                acceleration += screw.at(&place.motion.position) * *rate;
                alpha += screw.angular * *rate;
            }
            let Lack { force, moment } = self.lack(i, &acceleration, &alpha);
            let arm = place.motion.position - place.joint;
            let mut reaction = JointReaction {
                point: place.joint,
                force,
                moment: moment + arm.cross(&force),
            };
            if let Some(outer) = outer {
                reaction.force += outer.force;
                reaction.moment += outer.moment + (outer.point - place.joint).cross(&outer.force);
            }
            outer = Some(reaction);
            reactions.push(reaction);
        }
        reactions.reverse();
        reactions
    }

    /// `m (a - g)` and `J alpha + omega x J omega`.
    fn lack(&self, body: usize, acceleration: &Vector3<f64>, alpha: &Vector3<f64>) -> Lack {
        let place = &self.bodies[body];
        let own = &self.chain.bodies[body].body;
        let spin = own.inertia_times(&place.motion, &place.omega);
        Lack {
            force: own.m * (acceleration - self.chain.gravity),
            moment: own.inertia_times(&place.motion, alpha) + place.omega.cross(&spin),
        }
    }
}

impl Place {
    fn new(centre: &Frame, joint: Vector3<f64>, coordinates: usize) -> Self {
        let attitude = centre.attitude.into_inner();
        Self {
            motion: BodyMotion {
                position: centre.origin,
                attitude,
                velocity: centre.velocity,
                omega: to_body(&attitude, &centre.omega),
            },
            omega: centre.omega,
            alpha: centre.alpha,
            acceleration: centre.acceleration,
            joint,
            coordinates,
        }
    }
}
