//! The tree of bodies that joints hold on the ground.

use super::body::{Body, GROUND};
use super::edge::{Edge, Freedom};
use super::error::CompositionError;
use super::motion::Target;
use super::system::System;

/// The edges of the tree of a system, every body behind the one that it hangs on. A body that no joint holds hangs on the
/// ground by an edge that leaves it free.
///
/// # Errors
/// [`CompositionError`]: a joint that closes a loop, one that no edge can express, or a prescribed motion of a point.
pub fn edges(system: &System) -> Result<Vec<Edge>, CompositionError> {
    for motion in &system.motions {
        if let Target::Point { .. } = motion.target {
            let field = motion.place.clone();
            return Err(CompositionError::PointMotion { field });
        }
    }
    let mut growth = Growth {
        system,
        is_reached: vec![false; system.bodies.len()],
        is_used: vec![false; system.joints.len()],
        edges: Vec::new(),
        counts: Counts::default(),
    };
    growth.grow(GROUND)?;
    for body in 1..system.bodies.len() {
        if !growth.is_reached[body] {
            growth.push(Edge::free(system.dimension, body));
            growth.grow(body)?;
        }
    }
    Ok(growth.edges)
}

#[derive(Default)]
struct Counts {
    coordinates: usize,
    speeds: usize,
}

struct Growth<'a> {
    system: &'a System,
    is_reached: Vec<bool>,
    is_used: Vec<bool>,
    edges: Vec<Edge>,
    counts: Counts,
}

impl Growth<'_> {
    /// Adds all bodies that hang on `root`, level by level.
    fn grow(&mut self, root: usize) -> Result<(), CompositionError> {
        self.is_reached[root] = true;
        let mut level = vec![root];
        while !level.is_empty() {
            let mut next = Vec::new();
            for inner in level {
                self.grow_from(inner, &mut next)?;
            }
            level = next;
        }
        Ok(())
    }

    fn grow_from(&mut self, inner: usize, next: &mut Vec<usize>) -> Result<(), CompositionError> {
        for (place, joint) in self.system.joints.iter().enumerate() {
            if self.is_used[place] || !joint.bodies.contains(&inner) {
                continue;
            }
            self.is_used[place] = true;
            let outer_end = usize::from(joint.bodies[0] == inner);
            let outer = joint.bodies[outer_end];
            if self.is_reached[outer] {
                let field = joint.place.clone();
                return Err(CompositionError::Loop { field });
            }
            self.is_reached[outer] = true;
            let mut motions = self.system.motions.iter();
            let motion = motions.find(|motion| motion.joint() == Some(place));
            let course = motion.map(|motion| motion.course);
            let bodies: &[Body] = &self.system.bodies;
            self.push(Edge::of_joint(place, joint, outer_end, bodies, course)?);
            next.push(outer);
        }
        Ok(())
    }

    fn push(&mut self, mut edge: Edge) {
        edge.coordinates = self.counts.coordinates;
        edge.speeds = self.counts.speeds;
        if let Freedom::Free(_) = edge.freedom {
            self.is_reached[edge.outer] = true;
        }
        self.counts.coordinates += edge.number_of_coordinates();
        self.counts.speeds += edge.number_of_speeds();
        self.edges.push(edge);
    }
}
