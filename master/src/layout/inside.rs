//! What the coupling reads inside a step.

/// Instants inside a step at which the workers tell positions.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Inside {
    /// The instants as shares of the step, ascending.
    pub shares: Vec<f64>,
    /// For each subsystem the places of its outputs that are told there, among its coupling outputs; none if there are no instants.
    pub places: Vec<Vec<usize>>,
}

impl Inside {
    /// Where output `place` of a subsystem stands in what is told at instant number `instant`, if it is told.
    pub fn find(&self, subsystem: usize, instant: usize, place: usize) -> Option<usize> {
        let places = &self.places[subsystem];
        let found = places.iter().position(|known| *known == place)?;
        Some(instant * places.len() + found)
    }

    /// Number of values that a subsystem tells at all instants.
    pub fn values(&self, subsystem: usize) -> usize {
        let places = self.places.get(subsystem).map_or(0, Vec::len);
        places * self.shares.len()
    }

    /// Writes what a subsystem with that many coupling `outputs` tells at instant number `instant` to their places in `outputs`; `told`
    /// is what it tells at all instants. Other places stay as they are.
    pub fn spread(&self, subsystem: usize, instant: usize, told: &[f64], outputs: &mut [f64]) {
        let places = &self.places[subsystem];
        let told = &told[instant * places.len()..];
        for (&place, value) in places.iter().zip(told) {
            outputs[place] = *value;
        }
    }
}
