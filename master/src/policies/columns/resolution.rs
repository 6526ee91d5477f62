//! Whether a macro step resolves how a subsystem responds to loads.

use super::settings::SETTINGS;
use crate::joint::Level;
use crate::layout::Layout;
use crate::signal::SharePolynomial;
use serde::{Deserialize, Serialize};

const NOTHING: [[f64; 2]; SharePolynomial::TERMS] = [[0.0; 2]; SharePolynomial::TERMS];

/// Compares the responses of every subsystem on position and acceleration level, at the ends of the joints.
///
/// Under a load of shape `p(s)` over a step of length `H` a free body with the acceleration `a p(1)` at the end of the step has moved by `a H^2 m_p`, with
/// `m_p = integral of (1 - s) p(s)`, whatever its inertia. Where springs and dampers act within the step the two no longer fit: near the zeros of either the
/// coupling Jacobian says nothing (aliasing), and S1's methods become unstable.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Resolution {
    /// For each subsystem the places of coordinates and of their accelerations.
    places: Vec<[Vec<usize>; 2]>,
    /// For each subsystem and curve the largest responses of the present step, as accelerations of a free body.
    largest: Vec<[[f64; 2]; SharePolynomial::TERMS]>,
    /// For each subsystem by what factor they differed most so far; 1 where nothing is known.
    worst: Vec<f64>,
}

impl Resolution {
    /// For the joints of `layout`.
    pub fn new(layout: &Layout) -> Self {
        let mut places = vec![[Vec::new(), Vec::new()]; layout.outputs.len()];
        for end in layout.joints.iter().flat_map(|joint| &joint.ends) {
            for (level, places) in [Level::Position, Level::Acceleration]
                .into_iter()
                .zip(&mut places[end.subsystem])
            {
                places.extend_from_slice(end.translation(level));
            }
        }
        Self {
            largest: vec![NOTHING; places.len()],
            worst: vec![1.0; places.len()],
            places,
        }
    }

    /// New responses follow.
    pub fn begin(&mut self) {
        self.largest.fill(NOTHING);
    }

    /// Takes the response of a subsystem to a load over `length` whose shape is curve number `curve`. Loads along which nothing moves tell nothing, so the
    /// largest response to any load of this shape counts.
    pub fn take(
        &mut self,
        subsystem: usize,
        (curve, shape): (usize, &SharePolynomial),
        length: f64,
        response: &[f64],
    ) {
        let (lever, end) = (shape.lever(), shape.value(1.0));
        if lever.abs() < SETTINGS.least_lever || end.abs() < SETTINGS.least_lever {
            return;
        }
        let units = [length * length * lever.abs(), end.abs()];
        for ((places, unit), largest) in self.places[subsystem]
            .iter()
            .zip(units)
            .zip(&mut self.largest[subsystem][curve])
        {
            let squares = places
                .iter()
                .map(|&place| response[place] * response[place]);
            *largest = largest.max(squares.sum::<f64>().sqrt() / unit);
        }
    }

    /// All responses of the step are known.
    pub fn judge(&mut self) {
        for (curves, worst) in self.largest.iter().zip(&mut self.worst) {
            for [by_position, acceleration] in curves {
                if *by_position > 0.0 && *acceleration > 0.0 {
                    let ratio = by_position / acceleration;
                    *worst = worst.max(ratio).max(1.0 / ratio);
                }
            }
        }
    }

    /// By what factor the responses of a subsystem differed most from those of inertia, if that is too much to be resolved.
    pub fn unresolved(&self, subsystem: usize) -> Option<f64> {
        Some(self.worst[subsystem]).filter(|worst| *worst > SETTINGS.unresolved)
    }
}
