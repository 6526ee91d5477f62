//! The coupling variables at the shares of a step at which loads are raised.

use nalgebra::UnitQuaternion;

use super::curves::HermiteCurves;
use super::moments::Look;
use crate::system::Point;
use crate::system::unknowns::Unknowns;

/// Values of the curves, in memory that is kept from step to step.
pub struct Sample {
    shares: Vec<f64>,
    inner: Vec<Vec<f64>>,
    /// How the inside of the step is looked at, and what is seen.
    looks: Vec<Look>,
    inside: Vec<Vec<f64>>,
    at_node: Vec<f64>,
    ends: Vec<f64>,
    rates: Vec<f64>,
}

impl Sample {
    /// For `size` variables with these unknowns; the last share is the end of the step.
    /// `looks` tell how conditions inside the step are looked at.
    pub fn new(unknowns: &Unknowns, looks: &[Look], size: usize) -> Self {
        let shares = unknowns.shares().to_vec();
        Self {
            inner: vec![vec![0.0; size]; shares.len() - 1],
            shares,
            inside: vec![vec![0.0; size]; looks.len()],
            looks: looks.to_vec(),
            at_node: vec![0.0; size],
            ends: vec![0.0; size],
            rates: vec![0.0; size],
        }
    }

    /// Takes the values of `curves`.
    pub fn take(&mut self, curves: &HermiteCurves) {
        for (values, &share) in self.inner.iter_mut().zip(&self.shares) {
            curves.sample(share, values);
        }
        for (values, look) in self.inside.iter_mut().zip(&self.looks) {
            match look {
                Look::At(share) => curves.sample(*share, values),
                Look::Integral(nodes) => {
                    values.fill(0.0);
                    for &[share, factor] in nodes {
                        curves.sample(share, &mut self.at_node);
                        for (value, at_node) in values.iter_mut().zip(&self.at_node) {
                            *value += factor * at_node;
                        }
                    }
                }
            }
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
