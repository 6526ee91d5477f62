//! Integrals of outputs over a step.

use linchpin_proto::weights::{MAX_WEIGHTS, legendre};

use super::equation::{Driven, EquationOfMotion};
use crate::integrators::Quadrature;

/// Integrals of outputs over the step that was taken last, weight by weight: means over its share `s` of the output times Legendre's
/// polynomials. They begin at 0 with every step.
#[derive(Debug, Default)]
pub struct Integrals {
    outputs: Vec<usize>,
    weights: usize,
    values: Vec<f64>,
}

/// With weights of degree 3 and less, and as many internal steps as there are instants by default, integrals are as good as the motion.
const LEAST_PARTS: f64 = 4.0;

impl Integrals {
    /// Chooses the outputs and how many weights; without weights nothing is integrated.
    pub fn choose(&mut self, outputs: &[usize], weights: usize) {
        self.outputs.clear();
        self.outputs.extend_from_slice(outputs);
        self.weights = weights.min(MAX_WEIGHTS);
        self.begin();
    }

    /// Whether there is nothing to integrate.
    pub fn is_idle(&self) -> bool {
        self.weights == 0 || self.outputs.is_empty()
    }

    /// Numbers of the outputs.
    pub fn outputs(&self) -> &[usize] {
        &self.outputs
    }

    /// The longest internal step in a step of this length: weights vary over it.
    pub fn longest_step(&self, length: f64) -> f64 {
        if self.is_idle() {
            length
        } else {
            length / LEAST_PARTS
        }
    }

    /// Number of weights.
    pub fn weights(&self) -> usize {
        self.weights
    }

    /// Begins a step.
    pub fn begin(&mut self) {
        self.values.clear();
        self.values.resize(self.outputs.len() * self.weights, 0.0);
    }

    /// Writes the integrals, as many as there is room for.
    pub fn read(&self, values: &mut [f64]) {
        for (value, own) in values.iter_mut().zip(&self.values) {
            *value = *own;
        }
    }

    /// Adds the outputs at a share of the step, with the weight that the share has in a mean over the step.
    pub fn add(&mut self, share: f64, weight: f64, output: impl Fn(usize) -> f64) {
        if self.is_idle() {
            return;
        }
        let mut polynomials = [0.0; MAX_WEIGHTS];
        legendre(share, &mut polynomials[..self.weights]);
        for (place, &number) in self.outputs.iter().enumerate() {
            let value = weight * output(number);
            let sums = self.values[place..].iter_mut().step_by(self.outputs.len());
            for (sum, polynomial) in sums.zip(&polynomials) {
                *sum += polynomial * value;
            }
        }
    }

    /// Writes all integrals of each output.
    pub fn set(&mut self, integrals: impl Fn(usize) -> [f64; MAX_WEIGHTS]) {
        let number = self.outputs.len();
        for (place, &output) in self.outputs.iter().enumerate() {
            let sums = self.values[place..].iter_mut().step_by(number);
            for (sum, value) in sums.zip(integrals(output)) {
                *sum = value;
            }
        }
    }
}

/// The outputs of an equation of motion, integrated over a step of this length (s).
pub struct Integrating<'a, E> {
    pub driven: &'a Driven<'a, E>,
    pub length: f64,
    pub integrals: &'a mut Integrals,
}

impl<E: EquationOfMotion> Quadrature for Integrating<'_, E> {
    fn add(&mut self, tau: f64, y: &[f64], weight: f64) {
        if self.integrals.is_idle() {
            return;
        }
        let (state, inputs) = self.driven.at(tau, y);
        let equation = self.driven.equation;
        self.integrals
            .add(tau / self.length, weight / self.length, |output| {
                // Which outputs there are was looked up before.
                equation.output(&state, &inputs, output).unwrap_or(f64::NAN)
            });
    }

    fn longest_step(&self, length: f64) -> f64 {
        self.integrals.longest_step(length)
    }
}
