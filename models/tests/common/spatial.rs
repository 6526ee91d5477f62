//! Newton's and Euler's laws of the bodies of a chain in space.

use linchpin_models::reference::{BodyMotion, JointReaction, SpatialChain, SpatialChainMotion};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::motion::{assert_limit_of_rk4, rate, times_around};

/// From the axes of a body to those of space.
pub fn attitude(body: &BodyMotion) -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(body.attitude)
}

/// Place in space of a point of a body.
pub fn place(body: &BodyMotion, point: &Vector3<f64>) -> Vector3<f64> {
    body.position + attitude(body) * point
}

/// Rate of a vector in the middle of five points.
pub fn vector_rate<T>(points: &[T], step: f64, value: impl Fn(&T) -> Vector3<f64>) -> Vector3<f64> {
    Vector3::from_fn(|axis, _| rate(points, step, |point| value(point)[axis]))
}

/// Each body of the chain around `t`: its velocities are the rates of its pose, and its momenta change by its weight
/// and the loads in its joints.
pub fn assert_newton_euler(chain: &SpatialChain, t: f64) {
    let step = 4e-4;
    let motions = chain.motions(&times_around(t, step)).unwrap();
    for i in 0..chain.bodies.len() {
        assert_velocities(&motions, i, step);
        let own = chain.bodies[i].body;
        let now = motions[2].bodies[i];
        let (force, moment) = load(&motions[2], i);
        let momentum_rate = vector_rate(&motions, step, |at| own.m * at.bodies[i].velocity);
        let error = (momentum_rate - own.m * chain.gravity - force).norm();
        assert!(error < 1e-6, "body {i}: {error:e} of {force}");
        let spin_rate = vector_rate(&motions, step, |at| {
            let body = &at.bodies[i];
            attitude(body) * own.moments.component_mul(&body.omega)
        });
        let error = (spin_rate - moment).norm();
        assert!(error < 1e-6, "body {i} at {now:?}: {error:e} of {moment}");
    }
}

fn assert_velocities(motions: &[SpatialChainMotion], i: usize, step: f64) {
    let now = motions[2].bodies[i];
    let velocity = vector_rate(motions, step, |at| at.bodies[i].position);
    let error = (velocity - now.velocity).norm();
    assert!(error < 1e-7, "body {i}: {error:e}");
    let parts =
        [0, 1, 2, 3].map(|part| rate(motions, step, |at| at.bodies[i].attitude.coords[part]));
    let [x, y, z, w] = parts;
    let error = Quaternion::new(w, x, y, z) - now.attitude * Quaternion::from_imag(now.omega) * 0.5;
    assert!(error.norm() < 1e-7, "body {i}: {error}");
}

/// Force and moment about the centre of mass of body `i` in its joints.
fn load(now: &SpatialChainMotion, i: usize) -> (Vector3<f64>, Vector3<f64>) {
    let centre = now.bodies[i].position;
    let about_centre = |at: &JointReaction| at.moment + (at.point - centre).cross(&at.force);
    let inner = &now.reactions[i];
    let (mut force, mut moment) = (inner.force, about_centre(inner));
    if let Some(outer) = now.reactions.get(i + 1) {
        force -= outer.force;
        moment -= about_centre(outer);
    }
    (force, moment)
}

/// The trajectory is the limit of another integrator.
pub fn assert_chain_is_limit_of_rk4(chain: &SpatialChain, length: f64) {
    let end = chain.motions(&[length]).unwrap().remove(0);
    let start = [chain.coordinates.as_slice(), &chain.rates].concat();
    let end = [end.coordinates, end.rates].concat();
    assert_limit_of_rk4(chain, &start, length, &end);
}

/// Largest change of the energy over a motion (J).
pub fn drift_of_energy(motions: &[SpatialChainMotion]) -> f64 {
    let change = |motion: &SpatialChainMotion| (motion.energy - motions[0].energy).abs();
    motions.iter().map(change).fold(0.0, f64::max)
}
