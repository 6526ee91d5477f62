//! Motions of a floating pair through any attitude.
//!
//! Three successive turns are singular at some attitude. So the reference is started again from time to time, in
//! coordinates that count from the attitudes it has then.

use linchpin_models::reference::{Freedom, SpatialChain, SpatialChainMotion, SpatialJoint};
use nalgebra::{UnitQuaternion, Vector3};

/// A body turns by less than this (rad) before the coordinates are counted anew.
const TURN: f64 = 0.7;

/// Motions of a chain whose first body is on a free joint at `times` (s), which ascend from 0.
pub fn motions(chain: &SpatialChain, times: &[f64]) -> Vec<SpatialChainMotion> {
    let (mut chain, mut since) = (chain.clone(), 0.0);
    let mut motions: Vec<SpatialChainMotion> = Vec::with_capacity(times.len());
    let mut left = times;
    while !left.is_empty() {
        let reach = since + TURN / fastest(&chain);
        let count = left.partition_point(|t| *t < reach).max(1);
        let (now, later) = left.split_at(count);
        let own: Vec<f64> = now.iter().map(|t| t - since).collect();
        motions.extend(chain.motions(&own).unwrap());
        let last = &motions[motions.len() - 1];
        chain = from_here(&chain, last);
        since = now[count - 1];
        left = later;
    }
    motions
}

/// Largest rate of a turn (rad/s).
fn fastest(chain: &SpatialChain) -> f64 {
    let freedoms = chain.bodies.iter().flat_map(|body| &body.joint.freedoms);
    let rates = freedoms
        .zip(&chain.rates)
        .map(|(freedom, rate)| match freedom {
            Freedom::Turn(_) => rate.abs(),
            Freedom::Slide(_) => 0.0,
        });
    rates.sum()
}

/// The chain with `motion` as its start; joints with three turns count from their present attitude.
fn from_here(chain: &SpatialChain, motion: &SpatialChainMotion) -> SpatialChain {
    let mut chain = SpatialChain {
        coordinates: motion.coordinates.clone(),
        rates: motion.rates.clone(),
        ..chain.clone()
    };
    let mut inner = (UnitQuaternion::identity(), Vector3::zeros());
    let mut first = 0;
    for (jointed, body) in chain.bodies.iter_mut().zip(&motion.bodies) {
        let attitude = UnitQuaternion::new_unchecked(body.attitude);
        let outer = (attitude, attitude * body.omega);
        let count = jointed.joint.freedoms.len();
        if turns_anywhere(&jointed.joint) {
            let turns = first + count - 3..first + count;
            jointed.joint.attitude = inner.0.inverse() * outer.0;
            chain.coordinates[turns.clone()].fill(0.0);
            let relative = inner.0.inverse() * (outer.1 - inner.1);
            chain.rates[turns].copy_from_slice(relative.as_slice());
        }
        (inner, first) = (outer, first + count);
    }
    chain
}

/// Whether the last three freedoms are turns: about x, y and z, as all joints with free attitudes have them.
fn turns_anywhere(joint: &SpatialJoint) -> bool {
    let turns = joint.freedoms.iter().rev();
    let turns = turns.take_while(|freedom| matches!(freedom, Freedom::Turn(_)));
    turns.count() == 3
}
