//! The signals of a request as the inputs of a subsystem.

use linchpin_proto::polynomial::Polynomial;
use linchpin_proto::v1::{self, Failure};

use crate::Inputs;

/// The driven inputs of an instance, and the defaults of the others.
pub(super) struct Signals {
    driven: Vec<usize>,
    defaults: Vec<f64>,
    inputs: Inputs,
    values: Vec<f64>,
}

/// An input that was replaced for one perturbed step.
pub(super) struct Replaced {
    input: usize,
    polynomial: Polynomial,
}

impl Signals {
    pub(super) fn new(known: &[v1::Variable], driven: &[String]) -> Result<Self, Failure> {
        let driven = find(known, driven, "inputs")?;
        for (place, variable) in known.iter().enumerate() {
            if variable.default.is_none() && !driven.contains(&place) {
                return Err(Failure::misuse(
                    "inputs",
                    format!(
                        "input \"{}\" has no default and must be driven",
                        variable.name
                    ),
                ));
            }
        }
        let defaults: Vec<f64> = known
            .iter()
            .map(|variable| variable.default.unwrap_or_default())
            .collect();
        let inputs = Inputs::constant(&defaults);
        Ok(Self {
            driven,
            values: defaults.clone(),
            defaults,
            inputs,
        })
    }

    pub(super) fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// Takes the signals of a request; inputs without one go back to their defaults.
    pub(super) fn set(&mut self, signals: &[v1::Signal]) -> Result<(), Failure> {
        for &input in &self.driven {
            self.inputs
                .replace(input, Polynomial::constant(self.defaults[input]));
        }
        for signal in signals {
            let input = self.place(signal)?;
            self.inputs.replace(input, polynomial(signal)?);
        }
        Ok(())
    }

    pub(super) fn replace(&mut self, signal: &v1::Signal) -> Result<Replaced, Failure> {
        let input = self.place(signal)?;
        let polynomial = self.inputs.replace(input, polynomial(signal)?);
        Ok(Replaced { input, polynomial })
    }

    pub(super) fn put_back(&mut self, replaced: Replaced) {
        self.inputs.replace(replaced.input, replaced.polynomial);
    }

    pub(super) fn values_at(&mut self, tau: f64) -> &[f64] {
        self.inputs.values_at(tau, &mut self.values);
        &self.values
    }

    fn place(&self, signal: &v1::Signal) -> Result<usize, Failure> {
        self.driven
            .get(signal.input as usize)
            .copied()
            .ok_or_else(|| {
                Failure::misuse(
                    "signals",
                    format!(
                        "a signal names input {}, but Initialize listed {} inputs (counted from 0)",
                        signal.input,
                        self.driven.len()
                    ),
                )
            })
    }
}

/// Places of `names` among the variables that a model has; `field` is where the names stand in the request.
pub(super) fn find(
    known: &[v1::Variable],
    names: &[String],
    field: &str,
) -> Result<Vec<usize>, Failure> {
    let place = |name: &String| {
        known
            .iter()
            .position(|variable| &variable.name == name)
            .ok_or_else(|| {
                let known: Vec<&str> = known
                    .iter()
                    .map(|variable| variable.name.as_str())
                    .collect();
                Failure::misuse(
                    field,
                    format!(
                        "no variable \"{name}\" among the model's: {}",
                        known.join(", ")
                    ),
                )
            })
    };
    names.iter().map(place).collect()
}

fn polynomial(signal: &v1::Signal) -> Result<Polynomial, Failure> {
    Polynomial::from_signal(signal).map_err(|error| {
        Failure::misuse(
            "signals",
            format!("the signal of input {}: {error}", signal.input),
        )
    })
}
