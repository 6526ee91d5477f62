//! Markers of nonsmooth models: velocities and accelerations are rates of change, and a load acts along its velocity.
//!
//! Without contacts the motion is smooth, and a step of order 2 makes differences as accurate as is asserted.

use std::collections::BTreeMap;

use linchpin_models::nonsmooth::SLIDER_CRANK;
use linchpin_proto::polynomial::Polynomial;
use linchpin_proto::v1::{self, value::Kind};
use linchpin_worker::{Inputs, Interval, Model, Setup, Subsystem};

/// Distance of the points of a difference (s).
const DISTANCE: f64 = 2e-6;

struct Moving {
    description: v1::Model,
    run: Box<dyn Subsystem>,
    inputs: Inputs,
    t: f64,
}

impl Moving {
    /// A free mechanism under a torque, some time after its start.
    fn new(elements: f64) -> Self {
        let number = |value| v1::Value {
            kind: Some(Kind::Number(value)),
        };
        let text = |text: &str| v1::Value {
            kind: Some(Kind::Text(text.to_owned())),
        };
        let mut parameters = BTreeMap::from([
            ("guide".to_owned(), text("free")),
            ("elements".to_owned(), number(elements)),
            ("youngs_modulus".to_owned(), number(2e8)),
            ("omega1_0".to_owned(), number(31.0)),
            ("omega2_0".to_owned(), number(-17.0)),
            ("omega3_0".to_owned(), number(3.0)),
        ]);
        if elements == 0.0 {
            parameters.remove("youngs_modulus");
        }
        let solver = v1::Solver {
            kind: "generalized-alpha".to_owned(),
            options: BTreeMap::from([
                ("rho_inf".to_owned(), number(1.0)),
                ("step".to_owned(), number(2e-7)),
            ]),
        };
        let description = SLIDER_CRANK.describe_with(&parameters).unwrap();
        let setup = Setup::from_request(&description, parameters, Some(solver), 0.0).unwrap();
        let mut inputs = Inputs::constant(&vec![0.0; description.inputs.len()]);
        inputs.replace(0, Polynomial::constant(0.7));
        let mut moving = Self {
            run: SLIDER_CRANK.initialize(&setup).unwrap(),
            description,
            inputs,
            t: 0.0,
        };
        moving.advance(3e-3);
        moving
    }

    fn advance(&mut self, length: f64) {
        let interval = Interval {
            start: self.t,
            length,
        };
        self.run.step(interval, &self.inputs).unwrap();
        self.t += length;
    }

    fn read(&mut self, names: &[String]) -> Vec<f64> {
        let outputs = &self.description.outputs;
        let place = |name: &String| outputs.iter().position(|output| output.name == *name);
        let wanted: Vec<usize> = names.iter().map(|name| place(name).unwrap()).collect();
        let mut inputs = vec![0.0; self.description.inputs.len()];
        self.inputs.values_at(0.0, &mut inputs);
        let mut values = vec![0.0; wanted.len()];
        self.run
            .outputs(self.t, &inputs, &wanted, &mut values)
            .unwrap();
        values
    }
}

#[test]
fn velocities_and_accelerations_are_rates_of_change() {
    for elements in [0.0, 3.0] {
        let mut moving = Moving::new(elements);
        let markers = moving.description.markers.clone();
        for marker in markers.iter().filter(|marker| !marker.velocity.is_empty()) {
            let mut points = Vec::new();
            for _ in 0..3 {
                points.push(
                    [&marker.position, &marker.velocity, &marker.acceleration]
                        .map(|names| moving.read(names)),
                );
                moving.advance(DISTANCE);
            }
            let [before, here, after] = &points[..] else {
                panic!("three points")
            };
            for level in [0, 1] {
                let rates = before[level].iter().zip(&after[level]);
                let rates = rates.map(|(before, after)| (after - before) / (2.0 * DISTANCE));
                for (rate, own) in rates.zip(&here[level + 1]) {
                    // Vibrations of the rod have periods of some 1e-4 s.
                    let allowed = 5e-4 * (1.0 + own.abs());
                    assert!(
                        (rate - own).abs() < allowed,
                        "{elements} {} {level}: {rate} {own}",
                        marker.name
                    );
                }
            }
        }
    }
}
