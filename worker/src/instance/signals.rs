//! The signals of a request as the inputs of a subsystem.

use std::collections::{HashMap, HashSet};

use linchpin_proto::polynomial::Polynomial;
use linchpin_proto::v1::{self, Failure};

use crate::{Inputs, setup};

/// The driven inputs of an instance, the defaults of the others, and the inputs of joint loads.
pub(crate) struct Signals {
    /// In the order in which a signal names them: driven inputs of the model, then joint inputs.
    driven: Vec<Driven>,
    is_given: Vec<bool>,
    inputs: Inputs,
    /// Zero, except for the input that a direction names.
    direction: Inputs,
    /// The inputs with the time counted from an instant inside the step on.
    shifted: Inputs,
    directed: Option<usize>,
    values: Vec<f64>,
}

/// An input that the master drives.
struct Driven {
    input: usize,
    name: String,
    default: Option<f64>,
}

/// An input that was replaced for one perturbed step.
pub(super) struct Replaced {
    input: usize,
    polynomial: Polynomial,
}

impl Signals {
    /// The inputs that a subsystem sees: those of the model, in their order, then the joint inputs of the request.
    ///
    /// # Errors
    /// [`Failure`] of severity misuse: names that are unknown or listed twice, inputs without a value.
    pub(crate) fn new(
        known: &[v1::Variable],
        request: &v1::InitializeRequest,
    ) -> Result<Self, Failure> {
        let driven = &request.inputs;
        let places = find(known, driven, "inputs")?;
        let mut is_driven = vec![false; known.len()];
        places.iter().for_each(|&place| is_driven[place] = true);
        let undriven = |place: &usize| known[*place].default.is_none() && !is_driven[*place];
        if let Some(place) = (0..known.len()).find(undriven) {
            return Err(Failure::misuse(
                "inputs",
                format!(
                    "input \"{}\" has no default and must be driven",
                    known[place].name
                ),
            ));
        }
        refuse_twice("inputs", driven)?;
        refuse_twice("joint_inputs", &request.joint_inputs)?;
        let own = places.into_iter().map(|input| Driven {
            input,
            name: known[input].name.clone(),
            default: known[input].default,
        });
        let joint_inputs = request.joint_inputs.iter().zip(known.len()..);
        let joint_inputs = joint_inputs.map(|(name, input)| Driven {
            input,
            name: name.clone(),
            default: None,
        });
        let driven: Vec<Driven> = own.chain(joint_inputs).collect();
        let start = known.iter().map(|variable| variable.default);
        let start = start.chain(request.joint_inputs.iter().map(|_| None));
        let start: Vec<f64> = start.map(Option::unwrap_or_default).collect();
        Ok(Self {
            is_given: vec![false; driven.len()],
            driven,
            inputs: Inputs::constant(&start),
            shifted: Inputs::constant(&[]),
            direction: Inputs::constant(&vec![0.0; start.len()]),
            directed: None,
            values: start,
        })
    }

    /// Number of inputs that have signals.
    pub(crate) fn len(&self) -> usize {
        self.driven.len()
    }

    /// Place of signal number `signal` among the inputs that the subsystem sees.
    pub(crate) fn input(&self, signal: usize) -> Option<usize> {
        self.driven.get(signal).map(|driven| driven.input)
    }

    pub(super) fn direction(&self) -> &Inputs {
        &self.direction
    }

    pub(super) fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// The inputs as polynomials of the time since `start`, s after the start of the step.
    pub(super) fn inputs_from(&mut self, start: f64) -> &Inputs {
        self.shifted.shift(&self.inputs, start);
        &self.shifted
    }

    /// Takes the signals of a request; inputs without one go back to their defaults.
    pub(super) fn set(&mut self, signals: &[v1::Signal]) -> Result<(), Failure> {
        self.is_given.fill(false);
        for signal in signals {
            let place = self.place(signal, "signals")?;
            let driven = &self.driven[place];
            if std::mem::replace(&mut self.is_given[place], true) {
                return Err(Failure::misuse(
                    "signals",
                    format!("input \"{}\" has two signals", driven.name),
                ));
            }
            self.inputs
                .replace(driven.input, polynomial(signal, "signals")?);
        }
        for (driven, _) in self
            .driven
            .iter()
            .zip(&self.is_given)
            .filter(|(_, given)| !**given)
        {
            let default = driven.default.ok_or_else(|| {
                Failure::misuse(
                    "signals",
                    format!(
                        "input \"{}\" has neither a signal nor a default",
                        driven.name
                    ),
                )
            })?;
            self.inputs
                .replace(driven.input, Polynomial::constant(default));
        }
        Ok(())
    }

    pub(super) fn replace(&mut self, signal: &v1::Signal) -> Result<Replaced, Failure> {
        let input = self.driven[self.place(signal, "signals")?].input;
        let polynomial = self.inputs.replace(input, polynomial(signal, "signals")?);
        Ok(Replaced { input, polynomial })
    }

    pub(super) fn put_back(&mut self, replaced: Replaced) {
        self.inputs.replace(replaced.input, replaced.polynomial);
    }

    /// Takes the direction in which one input changes; all others stay.
    pub(super) fn set_direction(&mut self, direction: &v1::Signal) -> Result<(), Failure> {
        let place = self.place(direction, "directions")?;
        let polynomial = polynomial(direction, "directions")?;
        if let Some(before) = self.directed {
            self.direction.replace(before, Polynomial::constant(0.0));
        }
        let input = self.driven[place].input;
        self.direction.replace(input, polynomial);
        self.directed = Some(input);
        Ok(())
    }

    pub(super) fn values_at(&mut self, tau: f64) -> &[f64] {
        self.inputs.values_at(tau, &mut self.values);
        &self.values
    }

    /// Place of the signal's input among the driven ones; `field` is where the signal stands in the request.
    fn place(&self, signal: &v1::Signal, field: &str) -> Result<usize, Failure> {
        let place = signal.input as usize;
        if place < self.driven.len() {
            return Ok(place);
        }
        Err(Failure::misuse(
            field,
            format!(
                "a signal names input {place}, but Initialize listed {} inputs (counted from 0)",
                self.driven.len()
            ),
        ))
    }
}

/// Places of `names` among the variables that a model has; `field` is where the names stand in the request.
pub(crate) fn find(
    known: &[v1::Variable],
    names: &[String],
    field: &str,
) -> Result<Vec<usize>, Failure> {
    // The first of a name counts.
    let places = known.iter().enumerate().rev();
    let places: HashMap<&str, usize> = places.map(|(i, own)| (own.name.as_str(), i)).collect();
    let place = |name: &String| {
        places.get(name.as_str()).copied().ok_or_else(|| {
            let known = setup::names(known.iter().map(|own| &own.name));
            let message = format!("no variable \"{name}\" among the model's: {known}");
            Failure::misuse(field, message)
        })
    };
    names.iter().map(place).collect()
}

fn refuse_twice(field: &str, names: &[String]) -> Result<(), Failure> {
    let mut listed = HashSet::with_capacity(names.len());
    let twice = names.iter().find(|name| !listed.insert(*name));
    twice.map_or(Ok(()), |name| {
        let message = format!("input \"{name}\" is listed twice");
        Err(Failure::misuse(field, message))
    })
}

fn polynomial(signal: &v1::Signal, field: &str) -> Result<Polynomial, Failure> {
    Polynomial::from_signal(signal).map_err(|error| {
        Failure::misuse(
            field,
            format!("the signal of input {}: {error}", signal.input),
        )
    })
}
