//! Any model, with its variables by name.

use std::collections::BTreeMap;

use linchpin_proto::polynomial::Polynomial;
use linchpin_proto::v1;
use linchpin_worker::{Inputs, Model, Subsystem};

use super::cases::Case;
use super::{Solver, build_values, interval, numbers};

/// Far more accurate than what is checked.
pub const TIGHT: Solver = Solver("radau5", &[("rtol", 1e-12), ("atol", 1e-12)]);

/// All built-in models by name.
pub fn model(name: &str) -> Box<dyn Model> {
    let mut models = linchpin_models::models().into_iter();
    models.find(|model| model.describe().name == name).unwrap()
}

/// One solver of a model with its options.
pub fn solver(kind: &v1::SolverKind) -> Solver {
    match kind.name.as_str() {
        "exact" => Solver("exact", &[]),
        "radau5" => Solver("radau5", &[]),
        "rk4" => Solver("rk4", &[("step", 7e-4)]),
        "generalized-alpha" => Solver("generalized-alpha", &[("step", 7e-4)]),
        "newmark-alpha" => Solver("newmark-alpha", &[("step", 7e-4), ("alpha_f", 0.1)]),
        "bathe" => Solver("bathe", &[("step", 7e-4)]),
        "ed-alpha" => Solver("ed-alpha", &[("step", 7e-4)]),
        "moreau" => Solver("moreau", &[("step", 7e-4)]),
        "hets" => Solver("hets", &[("step", 7e-4)]),
        other => panic!("the tests have no options for the solver {other}"),
    }
}

/// A subsystem in motion.
pub struct Body {
    pub model: v1::Model,
    pub run: Box<dyn Subsystem>,
    pub t: f64,
    inputs: Inputs,
}

impl Body {
    pub fn new(name: &str, parameters: &[(&str, f64)], solver: Solver) -> Self {
        Self::with_values(name, numbers(parameters), solver)
    }

    pub fn with_values(
        name: &str,
        parameters: BTreeMap<String, v1::Value>,
        solver: Solver,
    ) -> Self {
        let model = model(name);
        let description = model.describe_with(&parameters).unwrap();
        let run = build_values(&*model, parameters, solver).unwrap();
        let inputs = Inputs::constant(&vec![0.0; description.inputs.len()]);
        Self {
            model: description,
            run,
            t: 0.0,
            inputs,
        }
    }

    pub fn of(case: Case, solver: Solver) -> Self {
        Self::with_values(case.model, case.values(), solver)
    }

    /// The case with other values of some parameters.
    pub fn altered(case: Case, parameters: &[(&str, f64)], solver: Solver) -> Self {
        let mut all = case.values();
        all.extend(numbers(parameters));
        Self::with_values(case.model, all, solver)
    }

    /// A constant input.
    pub fn drive(&mut self, input: &str, value: f64) {
        let place = self.model.inputs.iter().position(|own| own.name == input);
        self.inputs
            .replace(place.unwrap(), Polynomial::constant(value));
    }

    /// Constant inputs of different sizes, all of them.
    pub fn drive_all(&mut self, size: f64) {
        for input in 0..self.model.inputs.len() {
            let value = size * (1.0 + 2.3 * input as f64).sin();
            self.inputs.replace(input, Polynomial::constant(value));
        }
    }

    pub fn input(&self, name: &str) -> f64 {
        let place = self.model.inputs.iter().position(|own| own.name == name);
        self.inputs.value(place.unwrap(), 0.0)
    }

    /// All of them.
    pub fn input_values(&self) -> Vec<f64> {
        let mut values = vec![0.0; self.inputs.len()];
        self.inputs.values_at(0.0, &mut values);
        values
    }

    pub fn advance(&mut self, length: f64) {
        self.run
            .step(interval(self.t, length), &self.inputs)
            .unwrap();
        self.t += length;
    }

    pub fn read(&mut self, names: &[impl AsRef<str>]) -> Vec<f64> {
        let place = |name: &str| self.model.outputs.iter().position(|own| own.name == name);
        let wanted: Vec<_> = names
            .iter()
            .map(|name| place(name.as_ref()).unwrap())
            .collect();
        let mut inputs = vec![0.0; self.model.inputs.len()];
        self.inputs.values_at(0.0, &mut inputs);
        let mut values = vec![0.0; wanted.len()];
        self.run
            .outputs(self.t, &inputs, &wanted, &mut values)
            .unwrap();
        values
    }

    pub fn read_all<const N: usize>(&mut self, names: [&str; N]) -> [f64; N] {
        self.read(&names).try_into().unwrap()
    }

    pub fn read_one(&mut self, name: &str) -> f64 {
        self.read(&[name])[0]
    }

    /// Values and their rates of change at `t + 2 step`, by differences of fourth order along the motion, which is
    /// then at `t + 4 step`. The values come last.
    pub fn rates(&mut self, step: f64, read: impl Fn(&mut Self) -> Vec<f64>) -> Rates {
        let mut points = vec![read(self)];
        for _ in 0..4 {
            self.advance(step);
            points.push(read(self));
        }
        let rate = |i: usize| {
            let [a, b, _, d, e] = [0, 1, 2, 3, 4].map(|point: usize| points[point][i]);
            (a - 8.0 * b + 8.0 * d - e) / (12.0 * step)
        };
        Rates {
            rates: (0..points[2].len()).map(rate).collect(),
            values: points.swap_remove(2),
        }
    }
}

/// Values at one time and how fast they change.
pub struct Rates {
    pub values: Vec<f64>,
    pub rates: Vec<f64>,
}

/// Largest difference of two lists.
pub fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}
