//! The polynomial of a coupling variable over one macro step.
//!
//! A [`Signal`] gives nodes and values; the polynomial through them is
//! `p(tau) = c_0 + c_1 (tau - n_0) + c_2 (tau - n_0)(tau - n_1) + ...` with the divided differences `c_i`
//! (Newton's form of the Lagrange polynomial, S1 eqs. 56, 59 and 69). `tau` is the time since the start of the step.

use crate::v1::Signal;

/// Most nodes that a polynomial may have; its degree is one less.
pub const MAX_NODES: usize = 8;

/// Why nodes and values give no polynomial.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PolynomialError {
    /// No node.
    #[error("a signal needs at least one node")]
    Empty,
    /// More than [`MAX_NODES`] nodes.
    #[error("{nodes} nodes, at most {MAX_NODES} are allowed")]
    TooMany {
        /// How many were given.
        nodes: usize,
    },
    /// Nodes and values differ in number.
    #[error("{nodes} nodes but {values} values")]
    Unequal {
        /// Number of nodes.
        nodes: usize,
        /// Number of values.
        values: usize,
    },
    /// Infinite or not a number.
    #[error("node or value {place} is not a finite number")]
    NotFinite {
        /// Place in the list, from 0.
        place: usize,
    },
    /// Two nodes coincide.
    #[error("nodes {first} and {second} coincide")]
    Coincident {
        /// Place of the one.
        first: usize,
        /// Place of the other.
        second: usize,
    },
}

/// A polynomial of degree at most `MAX_NODES - 1`, without heap memory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polynomial {
    nodes: [f64; MAX_NODES],
    differences: [f64; MAX_NODES],
    len: usize,
}

impl Polynomial {
    /// The constant `value`.
    pub fn constant(value: f64) -> Self {
        let mut differences = [0.0; MAX_NODES];
        differences[0] = value;
        Self {
            nodes: [0.0; MAX_NODES],
            differences,
            len: 1,
        }
    }

    /// The polynomial of degree `nodes.len() - 1` through the points `(nodes[i], values[i])`.
    ///
    /// # Errors
    /// [`PolynomialError`] if the points do not define one.
    pub fn through(nodes: &[f64], values: &[f64]) -> Result<Self, PolynomialError> {
        let len = nodes.len();
        if len == 0 {
            return Err(PolynomialError::Empty);
        }
        if len > MAX_NODES {
            return Err(PolynomialError::TooMany { nodes: len });
        }
        if values.len() != len {
            return Err(PolynomialError::Unequal {
                nodes: len,
                values: values.len(),
            });
        }
        let mut own = Self {
            nodes: [0.0; MAX_NODES],
            differences: [0.0; MAX_NODES],
            len,
        };
        own.nodes[..len].copy_from_slice(nodes);
        own.differences[..len].copy_from_slice(values);
        if let Some(place) = (0..len).find(|&i| !(nodes[i].is_finite() && values[i].is_finite())) {
            return Err(PolynomialError::NotFinite { place });
        }
        for second in 1..len {
            if let Some(first) = (0..second).find(|&first| nodes[first] == nodes[second]) {
                return Err(PolynomialError::Coincident { first, second });
            }
        }
        for order in 1..len {
            for i in (order..len).rev() {
                own.differences[i] = (own.differences[i] - own.differences[i - 1])
                    / (own.nodes[i] - own.nodes[i - order]);
            }
        }
        Ok(own)
    }

    /// The polynomial that a message stands for.
    pub fn from_signal(signal: &Signal) -> Result<Self, PolynomialError> {
        Self::through(&signal.nodes, &signal.values)
    }

    /// Highest power that may occur.
    pub fn degree(&self) -> usize {
        self.len - 1
    }

    /// `p(tau)`.
    pub fn value(&self, tau: f64) -> f64 {
        let mut sum = self.differences[self.len - 1];
        for i in (0..self.len - 1).rev() {
            sum = self.differences[i] + (tau - self.nodes[i]) * sum;
        }
        sum
    }

    /// The polynomial `q(tau) = p(start + tau)`: the same, with the time counted from `start` on.
    pub fn shifted(mut self, start: f64) -> Self {
        for node in &mut self.nodes[..self.len] {
            *node -= start;
        }
        self
    }

    /// Coefficients `a_j` of `p(scale * s) = a_0 + a_1 s + a_2 s^2 + ...`; entries above the degree are 0.
    ///
    /// With `scale` = the step size the argument `s` runs from 0 to 1, whatever the unit of time.
    pub fn powers(&self, scale: f64) -> [f64; MAX_NODES] {
        let mut powers = [0.0; MAX_NODES];
        powers[0] = self.differences[self.len - 1];
        for i in (0..self.len - 1).rev() {
            // powers <- differences[i] + (scale s - nodes[i]) powers
            for j in (0..self.len).rev() {
                let lower = if j > 0 { powers[j - 1] } else { 0.0 };
                powers[j] = scale * lower - self.nodes[i] * powers[j];
            }
            powers[0] += self.differences[i];
        }
        powers
    }
}

impl Signal {
    /// Makes the signal the constant `value`; its memory is kept.
    pub fn set_constant(&mut self, value: f64) {
        self.nodes.clear();
        self.nodes.push(0.0);
        self.values.clear();
        self.values.push(value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_cubic_is_reproduced_by_four_nodes() {
        let cubic = |t: f64| 2.0 - 3.0 * t + 0.5 * t * t + 4.0 * t * t * t;
        let nodes = [0.3, 0.0, -0.3, -0.7];
        let polynomial = Polynomial::through(&nodes, &nodes.map(cubic)).unwrap();
        for tau in [-1.0, 0.1, 0.9, 2.5] {
            assert!((polynomial.value(tau) - cubic(tau)).abs() < 1e-12);
        }
        let expected = [2.0, -3.0 * 0.2, 0.5 * 0.04, 4.0 * 0.008];
        for (power, expected) in polynomial.powers(0.2).iter().zip(expected) {
            assert!((power - expected).abs() < 1e-13, "{power} {expected}");
        }
    }

    #[test]
    fn every_wrong_set_of_points_has_its_error() {
        let through = Polynomial::through;
        assert_eq!(through(&[], &[]), Err(PolynomialError::Empty));
        assert_eq!(
            through(&[0.0], &[]),
            Err(PolynomialError::Unequal {
                nodes: 1,
                values: 0
            })
        );
        assert_eq!(
            through(&[0.0; 9], &[0.0; 9]),
            Err(PolynomialError::TooMany { nodes: 9 })
        );
        assert_eq!(
            through(&[0.0, 1.0], &[0.0, f64::NAN]),
            Err(PolynomialError::NotFinite { place: 1 })
        );
        assert_eq!(
            through(&[0.0, 1.0, 0.0], &[0.0; 3]),
            Err(PolynomialError::Coincident {
                first: 0,
                second: 2
            })
        );
    }

    proptest! {
        #[test]
        fn passes_through_its_points(
            steps in proptest::collection::vec(0.1f64..2.0, 1..=4),
            values in proptest::collection::vec(-1e3f64..1e3, 4),
        ) {
            let mut t = 0.0;
            let nodes: Vec<f64> = steps.iter().map(|step| { t -= step; t }).collect();
            let polynomial = Polynomial::through(&nodes, &values[..nodes.len()]).unwrap();
            for (node, value) in nodes.iter().zip(&values) {
                prop_assert!((polynomial.value(*node) - value).abs() < 1e-8);
            }
        }

        #[test]
        fn powers_and_newton_form_agree(
            values in proptest::collection::vec(-10f64..10.0, 4),
            s in 0.0f64..1.0,
            scale in 1e-4f64..1.0,
        ) {
            let nodes = [scale, 0.0, -scale, -2.0 * scale];
            let polynomial = Polynomial::through(&nodes, &values).unwrap();
            let powers = polynomial.powers(scale);
            let sum = powers.iter().rev().fold(0.0, |sum, power| sum * s + power);
            prop_assert!((sum - polynomial.value(s * scale)).abs() < 1e-10);
        }

        #[test]
        fn any_message_is_answered(
            nodes in proptest::collection::vec(any::<f64>(), 0..12),
            values in proptest::collection::vec(any::<f64>(), 0..12),
        ) {
            let signal = Signal { input: 0, nodes, values };
            if let Ok(polynomial) = Polynomial::from_signal(&signal) {
                prop_assert_eq!(polynomial.degree() + 1, signal.nodes.len());
            }
        }
    }
}
