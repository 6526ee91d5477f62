//! A joint load does the same as the force and moment that a virtual displacement of the marker tells.

use linchpin_proto::v1;
use nalgebra::{Vector3, Vector6};

use crate::bodies::{BODIES, Body, SOLVERS};
use crate::common::Solver;
use crate::common::body::difference;
use crate::joint::{Joint, Partner, Space, all_joints, pose, pose_outputs};
use crate::run::{Run, Signal, nodes};

const LENGTH: f64 = 0.03;

fn multiplier(t: f64) -> f64 {
    5.3 + 2.0 * t - 70.0 * t * t
}

fn partner(space: Space) -> Partner {
    match space {
        Space::Planar => Partner {
            space,
            position: |t| Vector3::new(0.4 + 0.7 * t - 11.0 * t * t, -0.2 + 5.0 * t, 0.0),
            turn: |t| Vector3::new(0.0, 0.0, 0.3 + 1.7 * t - 8.0 * t * t),
            reference: [1.0, 0.0, 0.0, 0.0],
        },
        Space::Spatial => Partner {
            space,
            position: |t| Vector3::new(0.4 + 0.7 * t, -0.2 - 5.0 * t * t, 0.9 * t - 0.3),
            turn: |t| Vector3::new(1.7 * t, 0.2 - 8.0 * t * t, -0.9 * t),
            reference: [0.3, 0.5, -0.2, 0.7],
        },
    }
}

/// A body under a joint load, and the same body under force and moment.
struct Pair {
    joint: Joint,
    partner: Partner,
    joined: Run,
    loaded: Run,
    outputs: Vec<String>,
}

impl Pair {
    fn new(body: Body, joint: Joint, solver: Solver) -> Self {
        let partner = partner(body.space);
        let markers = body.description().markers.into_iter();
        let marker = { markers }.find(|own| own.name == joint.marker);
        let load_inputs = v1::InitializeRequest {
            inputs: marker.unwrap().load,
            ..v1::InitializeRequest::default()
        };
        Self {
            joint,
            partner,
            joined: Run::new(body.case, &[], solver, partner.request(&[joint])),
            loaded: Run::new(body.case, &[], solver, load_inputs),
            outputs: body.outputs(),
        }
    }

    /// The expected load with the marker at these outputs, at `t`.
    fn load(&self, own: &[f64], t: f64) -> Vector6<f64> {
        multiplier(t) * self.joint.derivative(&pose(own), &self.partner.pose(t))
    }

    /// The expected load at the times of [`nodes`], on the way of the marker.
    fn loads(&mut self) -> [Vector6<f64>; 8] {
        let outputs = pose_outputs(self.partner.space, self.joint.marker);
        nodes(LENGTH).map(|tau| {
            let joined = &mut self.joined;
            let look_ahead = |signals: &[Signal]| joined.look_ahead(tau, signals, &outputs);
            let own = self.partner.signals(multiplier, look_ahead);
            self.load(&own, self.joined.t + tau)
        })
    }

    /// Both over one step.
    fn step(&mut self) {
        let loads = self.loads();
        let start = self.loaded.t;
        let at = |t: f64| {
            let distance = |node: &f64| (node - (t - start)).abs();
            let places = nodes(LENGTH).map(|node| distance(&node));
            let nearest = (0..loads.len()).min_by(|&i, &j| places[i].total_cmp(&places[j]));
            loads[nearest.unwrap()]
        };
        let loaded = &mut self.loaded;
        under(self.partner.space, &at, |signals| {
            loaded.step(LENGTH, signals)
        });
        let joined = &mut self.joined;
        let signals = |signals: &[Signal]| joined.step(LENGTH, signals);
        self.partner.signals(multiplier, signals);
    }

    /// Largest difference of all outputs, accelerations included.
    fn difference(&self) -> f64 {
        let read = |outputs: &[String]| {
            let read = |signals: &[Signal]| self.joined.read(signals, outputs);
            self.partner.signals(multiplier, read)
        };
        let own = read(&pose_outputs(self.partner.space, self.joint.marker));
        let load = self.load(&own, self.joined.t);
        let expected = under(self.partner.space, &|_| load, |signals| {
            self.loaded.read(signals, &self.outputs)
        });
        difference(&read(&self.outputs), &expected)
    }
}

/// Calls `with` with the components of a load that a marker takes.
fn under<T>(
    space: Space,
    load: &dyn Fn(f64) -> Vector6<f64>,
    with: impl FnOnce(&[Signal]) -> T,
) -> T {
    let components: &[usize] = match space {
        Space::Planar => &[0, 1, 5],
        Space::Spatial => &[0, 1, 2, 3, 4, 5],
    };
    let components = components.iter().map(|&c| move |t: f64| load(t)[c]);
    let components: Vec<_> = components.collect();
    let signals: Vec<Signal> = components.iter().map(|own| own as Signal).collect();
    with(&signals)
}

#[test]
fn a_joint_load_is_the_multiplier_times_the_derivative_of_its_condition() {
    for body in BODIES {
        let markers = body.markers.iter();
        for joint in markers.flat_map(|marker| all_joints(body.space, marker)) {
            for solver in SOLVERS {
                let mut pair = Pair::new(body, joint, solver);
                for _ in 0..3 {
                    pair.step();
                    let difference = pair.difference();
                    let model = body.case.model;
                    assert!(
                        difference < 2e-11,
                        "{model} {joint:?} {solver:?}: {difference:e}"
                    );
                }
            }
        }
    }
}
