//! What a step starts from and what it leaves, as plain values.

use linchpin_worker::Inputs;

/// State of a mechanical system between two steps.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Seconds since the start of the present interval of inputs.
    pub tau: f64,
    /// Coordinates `q`.
    pub q: Vec<f64>,
    /// Velocities `v`; after an impact those behind it.
    pub v: Vec<f64>,
    /// Accelerations `a`.
    pub a: Vec<f64>,
    /// Acceleration-like variables `A` of the generalised-alpha method (S2 eq. 21).
    pub auxiliary: Vec<f64>,
    /// Contact forces (N, or N m), a number for each row of all contacts; 0 where open.
    pub forces: Vec<f64>,
    /// The same at the inner stage of schemes that have one: where the next step's iteration starts.
    pub inner_forces: Vec<f64>,
    /// Impulses (N s) of the last impact, a number for each row.
    pub impulses: Vec<f64>,
}

impl State {
    /// At rest in the origin.
    pub fn new(coordinates: usize, rows: usize) -> Self {
        Self {
            tau: 0.0,
            q: vec![0.0; coordinates],
            v: vec![0.0; coordinates],
            a: vec![0.0; coordinates],
            auxiliary: vec![0.0; coordinates],
            forces: vec![0.0; rows],
            inner_forces: vec![0.0; rows],
            impulses: vec![0.0; rows],
        }
    }

    /// Takes over all values of a state of the same sizes.
    pub fn copy_from(&mut self, other: &Self) {
        self.tau = other.tau;
        for (own, other) in self.parts_mut().into_iter().zip(other.parts()) {
            own.copy_from_slice(other);
        }
    }

    /// All numbers but the time, part by part.
    pub fn parts(&self) -> [&[f64]; 7] {
        [
            &self.q,
            &self.v,
            &self.a,
            &self.auxiliary,
            &self.forces,
            &self.inner_forces,
            &self.impulses,
        ]
    }

    /// The same to write to.
    pub fn parts_mut(&mut self) -> [&mut [f64]; 7] {
        [
            &mut self.q,
            &mut self.v,
            &mut self.a,
            &mut self.auxiliary,
            &mut self.forces,
            &mut self.inner_forces,
            &mut self.impulses,
        ]
    }

    /// Whether all numbers are finite.
    pub fn is_finite(&self) -> bool {
        let mut numbers = self.parts().into_iter().flatten();
        numbers.all(|number| number.is_finite())
    }
}

/// The inputs over an interval and where it starts.
#[derive(Debug, Clone, Copy)]
pub struct Drive<'a> {
    /// Time at which the interval starts (s).
    pub start: f64,
    /// Inputs as polynomials of the time since then.
    pub inputs: &'a Inputs,
}

/// One step of a scheme: from `tau` over `dt`.
#[derive(Debug, Clone, Copy)]
pub struct Step<'a> {
    /// Inputs.
    pub drive: Drive<'a>,
    /// Seconds since the start of the interval of inputs.
    pub tau: f64,
    /// Length (s).
    pub dt: f64,
    /// For every contact whether it takes part: closed at the start of the step (S2 eq. 41), or bilateral.
    pub active: &'a [bool],
}
