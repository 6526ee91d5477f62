//! Any model, with its variables by name.

use std::collections::BTreeMap;

use linchpin_proto::polynomial::Polynomial;
use linchpin_proto::v1;
use linchpin_worker::{Inputs, Model, Subsystem};

use super::mechanisms::{
    Composition, Given, PLANAR_TREE, SHAKEN_CRANK, SLIDER_CRANK, SPATIAL_LOOP, SPATIAL_TREE, values,
};
use super::{Solver, build_values, interval, numbers};

/// Far more accurate than what is checked.
pub const TIGHT: Solver = Solver("radau5", &[("rtol", 1e-12), ("atol", 1e-12)]);

/// A model with parameters that are no round numbers, and a size of its loads.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    pub model: &'static str,
    pub parameters: &'static [(&'static str, f64)],
    /// Parameters of multibody models.
    pub composition: Composition,
    /// Whether the multibody model has minimal coordinates.
    pub is_minimal: bool,
    pub load: f64,
}

impl Case {
    /// A multibody system.
    pub const fn composed(model: &'static str, composition: Composition, is_minimal: bool) -> Self {
        Self {
            model,
            parameters: &[],
            composition,
            is_minimal,
            load: 7.0,
        }
    }

    /// All parameters.
    pub fn values(&self) -> BTreeMap<String, v1::Value> {
        let mut all = numbers(self.parameters);
        all.extend(values(self.composition));
        if self.is_minimal {
            all.extend(values(&[("formulation", Given::Text("minimal"))]));
        }
        all
    }

    /// The model with these parameters.
    pub fn description(&self) -> v1::Model {
        model(self.model).describe_with(&self.values()).unwrap()
    }
}

/// At least one case of every model.
pub const CASES: [Case; 21] = [
    Case {
        model: "oscillator",
        parameters: &[
            ("m", 1.3),
            ("c", 1e3),
            ("d", 10.0),
            ("x0", 0.02),
            ("v0", 100.0),
        ],
        composition: &[],
        is_minimal: false,
        load: 333.0,
    },
    Case {
        model: "pendulum",
        parameters: &[
            ("m", 1.3),
            ("inertia", 0.17),
            ("length", 0.9),
            ("offset", 0.11),
            ("hinge_x", -0.4),
            ("hinge_y", 0.6),
            ("gravity", 9.7),
            ("spring", 21.0),
            ("rest_angle", 0.3),
            ("angle0", 1.1),
            ("rate0", -4.0),
        ],
        composition: &[],
        is_minimal: false,
        load: 7.0,
    },
    Case {
        model: "planar-body",
        parameters: &[
            ("m", 1.3),
            ("inertia", 0.17),
            ("length", 0.9),
            ("gravity", 9.7),
            ("x0", 0.3),
            ("y0", -0.7),
            ("angle0", 1.1),
            ("vx0", 2.0),
            ("vy0", 0.9),
            ("rate0", -4.0),
        ],
        composition: &[],
        is_minimal: false,
        load: 7.0,
    },
    Case {
        model: "spatial-body",
        parameters: &[
            ("m", 1.3),
            ("j1", 0.17),
            ("j2", 0.29),
            ("j3", 0.23),
            ("gravity", 9.7),
            ("start_x", -0.4),
            ("start_y", 0.1),
            ("start_z", 0.23),
            ("end_x", 0.5),
            ("end_y", -0.3),
            ("end_z", 0.07),
            ("x0", 0.3),
            ("y0", -0.7),
            ("z0", 0.2),
            ("rx0", 0.8),
            ("ry0", -1.9),
            ("rz0", 0.4),
            ("vx0", 2.0),
            ("vy0", 0.9),
            ("vz0", -1.2),
            ("omega1_0", 2.0),
            ("omega2_0", -3.0),
            ("omega3_0", 1.5),
        ],
        composition: &[],
        is_minimal: false,
        load: 7.0,
    },
    Case::composed("planar-multibody", SLIDER_CRANK, false),
    Case::composed("planar-multibody", PLANAR_TREE, false),
    Case::composed("planar-multibody", PLANAR_TREE, true),
    Case::composed("spatial-multibody", SPATIAL_LOOP, false),
    Case::composed("spatial-multibody", SPATIAL_TREE, false),
    Case::composed("spatial-multibody", SPATIAL_TREE, true),
    Case {
        model: "dc-motor",
        parameters: &[
            ("inertia", 0.083),
            ("resistance", 0.43),
            ("inductance", 0.031),
            ("back_emf", 0.72),
            ("torque_constant", 0.69),
            ("friction", 0.057),
            ("crank", 0.31),
            ("shaft_x", -0.4),
            ("shaft_y", 0.6),
            ("angle0", 1.1),
            ("rate0", -4.0),
            ("current0", 1.4),
        ],
        composition: &[],
        is_minimal: false,
        load: 7.0,
    },
    Case {
        model: "pi-controller",
        parameters: &[
            ("proportional", 5.3),
            ("integral", 8.1),
            ("integral0", -0.7),
        ],
        composition: &[],
        is_minimal: false,
        load: 7.0,
    },
    Case {
        model: "slider-crank",
        parameters: &[
            ("c", 3.1e-4),
            ("friction", 0.07),
            ("constant_torque", 0.13),
            ("theta1_0", 0.3),
            ("theta2_0", -0.149),
            ("omega1_0", 110.0),
            ("omega2_0", -53.0),
        ],
        composition: &[],
        is_minimal: false,
        load: 0.05,
    },
    Case {
        model: "slider-crank",
        parameters: &[
            ("c", 3.1e-4),
            ("friction", 0.07),
            ("elements", 3.0),
            ("youngs_modulus", 2e5),
            ("theta1_0", 0.3),
            ("theta2_0", -0.149),
            ("omega1_0", 11.0),
            ("omega2_0", -5.3),
        ],
        composition: &[],
        is_minimal: false,
        load: 0.01,
    },
    Case {
        model: "slider-crank",
        parameters: &[
            ("elements", 7.0),
            ("modes", 4.0),
            ("youngs_modulus", 2e5),
            ("material_damping", 1e-4),
            ("theta1_0", 0.3),
            ("theta2_0", -0.149),
            ("omega1_0", 11.0),
        ],
        composition: &[],
        is_minimal: false,
        load: 0.01,
    },
    Case {
        model: "rod-slider",
        parameters: &[
            ("c", 3.1e-4),
            ("friction", 0.07),
            ("x_0", 0.147),
            ("y_0", 0.045),
            ("theta2_0", -0.149),
            ("vx_0", -5.1),
            ("vy_0", 16.0),
            ("omega2_0", -53.0),
        ],
        composition: &[],
        is_minimal: false,
        load: 1.3,
    },
    Case {
        model: "mass-chain",
        parameters: &[
            ("m1", 1.3),
            ("m2", 0.7),
            ("k1", 21.0),
            ("k2", 13.0),
            ("k3", 7.0),
        ],
        composition: &[],
        is_minimal: false,
        load: 7.0,
    },
    Case {
        model: "bouncing-ball",
        parameters: &[
            ("m", 0.37),
            ("gravity", 9.79),
            ("height0", 1.3e-3),
            ("speed0", -0.11),
            ("restitution", 0.63),
        ],
        composition: &[],
        is_minimal: false,
        load: 0.7,
    },
    Case {
        model: "block",
        parameters: &[
            ("half_width", 0.23),
            ("half_height", 0.11),
            ("m", 1.37),
            ("inertia", 0.041),
            ("gravity", 9.79),
            ("slope", -0.31),
            ("friction", 0.27),
            ("restitution", 0.13),
            ("way0", 0.4),
            ("gap0", 7e-4),
            ("tilt0", 0.003),
            ("speed0", 0.9),
            ("lift0", -0.2),
            ("rate0", -0.4),
        ],
        composition: &[],
        is_minimal: false,
        load: 1.3,
    },
    Case {
        model: "block",
        parameters: &[
            ("half_width", 0.043),
            ("half_height", 0.31),
            ("m", 2.3),
            ("friction", 0.7),
            ("tilt0", 0.037),
        ],
        composition: &[],
        is_minimal: false,
        load: 0.3,
    },
    Case {
        model: "woodpecker",
        parameters: &[
            ("spring", 6.1e-3),
            ("beak_restitution", 0.43),
            ("friction", 0.31),
        ],
        composition: &[],
        is_minimal: false,
        load: 1e-4,
    },
];

/// Systems with prescribed motion, which changes their energy.
pub const SHAKEN: [Case; 2] = [
    Case::composed("planar-multibody", SHAKEN_CRANK, false),
    Case::composed("planar-multibody", SHAKEN_CRANK, true),
];

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
