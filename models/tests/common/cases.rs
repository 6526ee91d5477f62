//! At least one case of every built-in model.

use std::collections::BTreeMap;

use linchpin_proto::v1;

use super::body::model;
use super::mechanisms::{
    Composition, Given, PLANAR_TREE, SHAKEN_CRANK, SLIDER_CRANK, SPATIAL_LOOP, SPATIAL_TREE, values,
};
use super::numbers;

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
