//! What the coupling reads inside a step.

use serde::{Deserialize, Serialize};

/// What moments over a step are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MomentsFrom {
    /// Outputs at instants inside the step.
    Instants,
    /// Integrals of outputs over the step, with Legendre's polynomials as weights.
    Integrals,
}

/// What the workers tell of the inside of a step: integrals over it, weight by weight, then positions at instants, one by one. Each weight and
/// each instant is a *look* at the step.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Inside {
    /// Number of weights.
    pub weights: usize,
    /// The instants as shares of the step, ascending.
    pub shares: Vec<f64>,
    /// For each subsystem the places of its outputs that are integrated, among its coupling outputs.
    pub integrated: Vec<Vec<usize>>,
    /// The same of those that are told at instants.
    pub places: Vec<Vec<usize>>,
    /// For each coupling variable what the moments of its condition are made of.
    pub moments: Vec<MomentsFrom>,
}

impl Inside {
    /// Whether anything is told.
    pub fn is_told(&self) -> bool {
        self.looks() > 0
    }

    /// Number of weights and instants.
    pub fn looks(&self) -> usize {
        self.weights + self.shares.len()
    }

    /// What a look is at.
    pub fn kind(&self, look: usize) -> MomentsFrom {
        match look < self.weights {
            true => MomentsFrom::Integrals,
            false => MomentsFrom::Instants,
        }
    }

    /// The places of the outputs of a subsystem that a look shows, and how many values are told before them.
    fn shown(&self, subsystem: usize, look: usize) -> (&[usize], usize) {
        let integrated = &self.integrated[subsystem];
        match look.checked_sub(self.weights) {
            None => (integrated, look * integrated.len()),
            Some(instant) => {
                let places = &self.places[subsystem];
                (
                    places,
                    self.weights * integrated.len() + instant * places.len(),
                )
            }
        }
    }

    /// Where output `place` of a subsystem stands in what is told at a look, if it is told.
    pub fn find(&self, subsystem: usize, look: usize, place: usize) -> Option<usize> {
        let (places, before) = self.shown(subsystem, look);
        let found = places.iter().position(|known| *known == place)?;
        Some(before + found)
    }

    /// Number of values that a subsystem tells at all looks.
    pub fn values(&self, subsystem: usize) -> usize {
        let of = |all: &[Vec<usize>]| all.get(subsystem).map_or(0, Vec::len);
        of(&self.integrated) * self.weights + of(&self.places) * self.shares.len()
    }

    /// The places of the outputs whose values a subsystem tells, value by value.
    pub fn places_of(&self, subsystem: usize) -> impl Iterator<Item = usize> {
        let looks = 0..if self.values(subsystem) > 0 {
            self.looks()
        } else {
            0
        };
        looks.flat_map(move |look| self.shown(subsystem, look).0.iter().copied())
    }

    /// Writes what a subsystem with that many coupling `outputs` tells at a look to their places in `outputs`; `told` is what it tells at all
    /// of them. Other places stay as they are.
    pub fn spread(&self, subsystem: usize, look: usize, told: &[f64], outputs: &mut [f64]) {
        let (places, before) = self.shown(subsystem, look);
        for (&place, value) in places.iter().zip(&told[before..]) {
            outputs[place] = *value;
        }
    }

    /// Number of integrals that are wanted of each output of a subsystem that is integrated.
    pub fn integrals_of(&self, subsystem: usize) -> usize {
        let has_any = self
            .integrated
            .get(subsystem)
            .is_some_and(|places| !places.is_empty());
        if has_any { self.weights } else { 0 }
    }

    /// The instants at which a subsystem is looked at.
    pub fn instants_of(&self, subsystem: usize) -> &[f64] {
        match self.places.get(subsystem) {
            Some(places) if !places.is_empty() => &self.shares,
            _ => &[],
        }
    }
}
