//! Models as a master drives them, for all tests.

#![allow(dead_code, reason = "every test program uses a part of this")]

use std::collections::BTreeMap;

use linchpin_models::oscillator::Oscillator;
use linchpin_proto::polynomial::Polynomial;
use linchpin_proto::v1;
use linchpin_worker::{Inputs, Interval, Model, Setup, Snapshot, Subsystem, setup::SetupError};

pub mod body;
pub mod cases;
pub mod mechanisms;
pub mod motion;
pub mod spatial;

pub const X: usize = 0;
pub const V: usize = 1;
pub const A: usize = 2;

/// A solver with its options.
#[derive(Debug, Clone, Copy)]
pub struct Solver(pub &'static str, pub &'static [(&'static str, f64)]);

pub const EXACT: Solver = Solver("exact", &[]);
pub const RADAU5: Solver = Solver("radau5", &[]);
pub const RK4: Solver = Solver("rk4", &[("step", 7e-4)]);
pub const ALL: [Solver; 3] = [EXACT, RADAU5, RK4];

pub fn number(value: f64) -> v1::Value {
    v1::Value {
        kind: Some(v1::value::Kind::Number(value)),
    }
}

pub fn build(parameters: &[(&str, f64)], solver: Solver) -> Result<Box<dyn Subsystem>, SetupError> {
    build_model(&Oscillator, parameters, solver)
}

pub fn build_model(
    model: &dyn Model,
    parameters: &[(&str, f64)],
    solver: Solver,
) -> Result<Box<dyn Subsystem>, SetupError> {
    build_values(model, numbers(parameters), solver)
}

/// Values of any type.
pub fn build_values(
    model: &dyn Model,
    parameters: BTreeMap<String, v1::Value>,
    solver: Solver,
) -> Result<Box<dyn Subsystem>, SetupError> {
    let description = model.describe_with(&parameters)?;
    let solver = v1::Solver {
        kind: solver.0.to_owned(),
        options: numbers(solver.1),
    };
    let setup = Setup::from_request(&description, parameters, Some(solver), 0.0)?;
    model.initialize(&setup)
}

/// Numbers as a request has them.
pub fn numbers(pairs: &[(&str, f64)]) -> BTreeMap<String, v1::Value> {
    let pairs = pairs.iter();
    pairs
        .map(|&(name, value)| (name.to_owned(), number(value)))
        .collect()
}

pub fn oscillator(parameters: &[(&str, f64)], solver: Solver) -> Box<dyn Subsystem> {
    build(parameters, solver).unwrap()
}

/// Position and velocity.
pub fn state(subsystem: &mut Box<dyn Subsystem>) -> [f64; 2] {
    let mut values = [0.0; 2];
    subsystem
        .outputs(0.0, &[0.0; 3], &[X, V], &mut values)
        .unwrap();
    values
}

pub fn snapshot(subsystem: &dyn Subsystem) -> Snapshot {
    let mut snapshot = Snapshot::default();
    subsystem.snapshot(&mut snapshot);
    snapshot
}

/// The polynomial `a_0 + a_1 tau + ...` as a master sends it over a step of length `length`.
pub fn polynomial(coefficients: &[f64], length: f64) -> Polynomial {
    let nodes: Vec<f64> = (0..coefficients.len())
        .map(|i| length * (1.0 - i as f64))
        .collect();
    let value = |tau: &f64| coefficients.iter().rev().fold(0.0, |sum, a| sum * tau + a);
    Polynomial::through(&nodes, &nodes.iter().map(value).collect::<Vec<_>>()).unwrap()
}

/// A polynomial force, partner at rest.
pub fn force(coefficients: &[f64], length: f64) -> Inputs {
    let mut inputs = Inputs::constant(&[0.0; 3]);
    inputs.replace(0, polynomial(coefficients, length));
    inputs
}

pub fn interval(start: f64, length: f64) -> Interval {
    Interval { start, length }
}

/// Arithmetic-geometric mean.
pub fn agm(mut a: f64, mut b: f64) -> f64 {
    for _ in 0..60 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}
