//! The inputs of one step.

use linchpin_proto::polynomial::Polynomial;

/// All inputs of a subsystem over one step, in the order of its description.
#[derive(Debug, Clone, PartialEq)]
pub struct Inputs {
    polynomials: Vec<Polynomial>,
}

impl Inputs {
    /// Constant inputs.
    pub fn constant(values: &[f64]) -> Self {
        Self {
            polynomials: values
                .iter()
                .map(|&value| Polynomial::constant(value))
                .collect(),
        }
    }

    /// Number of inputs.
    pub fn len(&self) -> usize {
        self.polynomials.len()
    }

    /// Whether the subsystem has no input.
    pub fn is_empty(&self) -> bool {
        self.polynomials.is_empty()
    }

    /// Input number `input` as a polynomial of the time since the start of the step.
    ///
    /// # Panics
    /// If there is no such input.
    pub fn polynomial(&self, input: usize) -> &Polynomial {
        &self.polynomials[input]
    }

    /// Value of input number `input` at `tau` seconds after the start of the step.
    ///
    /// # Panics
    /// If there is no such input.
    pub fn value(&self, input: usize, tau: f64) -> f64 {
        self.polynomials[input].value(tau)
    }

    /// Values of all inputs at `tau`.
    pub fn values_at(&self, tau: f64, values: &mut [f64]) {
        for (value, polynomial) in values.iter_mut().zip(&self.polynomials) {
            *value = polynomial.value(tau);
        }
    }

    /// Takes over `whole`, with the time counted from `start` on (s), in memory that is already there.
    pub(crate) fn shift(&mut self, whole: &Self, start: f64) {
        let shifted = whole.polynomials.iter().map(|own| own.shifted(start));
        self.polynomials.clear();
        self.polynomials.extend(shifted);
    }

    /// Replaces input number `input` and returns what it was.
    ///
    /// # Panics
    /// If there is no such input.
    pub fn replace(&mut self, input: usize, polynomial: Polynomial) -> Polynomial {
        std::mem::replace(&mut self.polynomials[input], polynomial)
    }
}
