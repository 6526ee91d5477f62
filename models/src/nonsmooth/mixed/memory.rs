//! The state of an integrator as plain numbers.

use super::Integrator;
use crate::nonsmooth::contact_log::ContactLog;

impl Integrator {
    /// Hands out all numbers that later steps depend on, in an order that [`Integrator::recall`] takes them back.
    pub fn memory(&self, mut put: impl FnMut(&[f64])) {
        for part in self.state.parts() {
            put(part);
        }
        put(&self.log.numbers());
        put(&[self.friction_power]);
        for pending in &self.pending {
            put(&[f64::from(u8::from(*pending))]);
        }
    }

    /// Takes back the numbers of [`Integrator::memory`]; returns what is behind them.
    pub fn recall<'a>(&mut self, mut numbers: &'a [f64]) -> &'a [f64] {
        let mut take = |count: usize| {
            let (taken, rest) = numbers.split_at(count.min(numbers.len()));
            numbers = rest;
            taken
        };
        for part in self.state.parts_mut() {
            let taken = take(part.len());
            part[..taken.len()].copy_from_slice(taken);
        }
        self.log.take(take(ContactLog::NUMBERS));
        if let [power] = take(1) {
            self.friction_power = *power;
        }
        for pending in &mut self.pending {
            *pending = take(1) == [1.0];
        }
        self.state.tau = 0.0;
        numbers
    }

    /// How many numbers [`Integrator::memory`] hands out.
    pub fn memory_len(&self) -> usize {
        let state: usize = self.state.parts().iter().map(|part| part.len()).sum();
        state + ContactLog::NUMBERS + 1 + self.pending.len()
    }
}
