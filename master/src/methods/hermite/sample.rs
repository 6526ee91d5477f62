//! The coupling variables at the shares of a step at which loads are raised.

use nalgebra::UnitQuaternion;

use super::curves::HermiteCurves;
use crate::system::Point;
use crate::system::unknowns::Unknowns;

/// Values of the curves, in memory that is kept from step to step.
pub struct Sample {
    shares: Vec<f64>,
    inner: Vec<Vec<f64>>,
    /// Instants inside the step as shares of it, and the values there.
    instants: Vec<f64>,
    inside: Vec<Vec<f64>>,
    ends: Vec<f64>,
    rates: Vec<f64>,
}

impl Sample {
    /// For `size` variables with these unknowns; the last share is the end of the step.
    /// `instants` are shares of the step at which conditions are looked at.
    pub fn new(unknowns: &Unknowns, instants: &[f64], size: usize) -> Self {
        let shares = unknowns.shares().to_vec();
        Self {
            inner: vec![vec![0.0; size]; shares.len() - 1],
            shares,
            inside: vec![vec![0.0; size]; instants.len()],
            instants: instants.to_vec(),
            ends: vec![0.0; size],
            rates: vec![0.0; size],
        }
    }

    /// Takes the values of `curves`.
    pub fn take(&mut self, curves: &HermiteCurves) {
        let inner = self.inner.iter_mut().zip(&self.shares);
        let inside = self.inside.iter_mut().zip(&self.instants);
        for (values, &share) in inner.chain(inside) {
            curves.sample(share, values);
        }
        curves.sample(1.0, &mut self.ends);
        curves.sample_rates(&mut self.rates);
    }

    /// Values at the end of the step.
    pub fn ends(&self) -> &[f64] {
        &self.ends
    }

    /// The point to linearise about, for a step of length `step`.
    pub fn point<'a>(&'a self, step: f64, attitudes: &'a [UnitQuaternion<f64>]) -> Point<'a> {
        Point {
            w: &self.ends,
            inner: &self.inner,
            inside: &self.inside,
            rates: &self.rates,
            step,
            attitudes,
        }
    }
}
