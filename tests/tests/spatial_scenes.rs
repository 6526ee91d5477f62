//! The scenes of mechanisms in space against their references in joint coordinates: two double pendulums, a top in a gimbal.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::{Connector, Place};
use linchpin_master::CoSimulation;
use linchpin_master::joint::composite::in_space;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_models::reference::{
    CompositeJoint, Gimbal, RigidBody, SpatialChain, SpatialChainMotion,
};
use linchpin_tests::convergence::assert_least_orders;
use linchpin_tests::in_space::compare::{Loaded, motions, pose_errors};
use linchpin_tests::in_space::joints::{self, unit};
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::with_settings;
use nalgebra::Vector3;

/// Errors of the couplings stand far above this.
const SOLVER: &str = "subsystem.*.solver={ kind = \"radau5\", rtol = 1e-12, atol = 1e-12 }";

/// A scene of two workers: the first has all bodies but the last of a chain.
struct Mechanism {
    scene: &'static str,
    chain: SpatialChain,
    t_end: f64,
    /// Its macro steps relative to those of the others: it may turn faster.
    pace: f64,
    /// The joint between the workers, its name, and its kind in the reference.
    joint: (&'static str, CompositeJoint),
    /// Subsystem with the last body.
    last: &'static str,
    /// Outputs that tell the first coordinates from their values at the start.
    angles: &'static [&'static str],
    energies: [&'static str; 2],
}

fn universal_pendulum() -> Mechanism {
    let axes = [unit(2.0, 1.0, 0.0), unit(-1.0, 2.0, 3.0)];
    Mechanism {
        scene: include_str!("../../scenes/spatial/universal-pendulum.toml"),
        chain: SpatialChain::universal_double_pendulum(),
        joint: ("elbow", CompositeJoint::Universal(axes)),
        t_end: 0.4,
        pace: 1.0,
        last: "lower",
        angles: &["upper.hinge_angle"],
        energies: ["upper.energy", "lower.energy"],
    }
}

fn revolute_pendulum() -> Mechanism {
    Mechanism {
        scene: include_str!("../../scenes/spatial/revolute-pendulum.toml"),
        chain: SpatialChain::revolute_double_pendulum(),
        joint: ("elbow", CompositeJoint::Revolute(unit(3.0, -1.0, 2.0))),
        ..universal_pendulum()
    }
}

fn gimbal() -> Mechanism {
    let body = |m, moments: [f64; 3]| RigidBody {
        m,
        moments: Vector3::from(moments),
    };
    let gimbal = Gimbal {
        outer: body(0.7, [0.013, 0.017, 0.029]),
        inner: body(0.4, [0.011, 0.008, 0.016]),
        top: body(1.3, [0.021, 0.027, 0.034]),
        distance: 0.17,
        gravity: 9.81,
        angles: [0.3, 0.8, -0.4],
        rates: [1.9, -0.6, 45.0],
    };
    Mechanism {
        scene: include_str!("../../scenes/spatial/gimbal.toml"),
        chain: gimbal.chain(),
        t_end: 0.2,
        pace: 0.5,
        joint: ("bearing", CompositeJoint::Revolute(Vector3::z_axis())),
        last: "top",
        angles: &["gimbal.stand_angle", "gimbal.ring_angle"],
        energies: ["gimbal.energy", "top.energy"],
    }
}

impl Mechanism {
    fn scene(&self, coupling: &str, h: f64) -> Scene {
        let coupling = format!("{coupling} macro_step={h}");
        let t_end = format!("scene.t_end={}", self.t_end);
        with_settings(self.scene, &coupling, &[SOLVER, &t_end])
    }

    /// Largest errors of the angles in the first worker, of the last body's pose, of the joint's load, of the energy.
    fn errors(&self, run: &Trajectory) -> [f64; 4] {
        let exact = self.chain.motions(&run.column("t")).unwrap();
        let last = self.chain.bodies.len() - 1;
        let poses = exact.iter().map(|motion| &motion.bodies[last]);
        let [position, attitude] = pose_errors(&motions(run, self.last), poses);
        let energy = |motion: &SpatialChainMotion| motion.energy;
        let parts = self.energies.map(|name| run.column(name));
        let found: Vec<f64> = parts[0].iter().zip(&parts[1]).map(|(a, b)| a + b).collect();
        [
            self.angle_error(run, &exact),
            position.max(attitude),
            self.load_error(run, &exact),
            largest_difference(&found, exact.iter().map(energy)),
        ]
    }

    fn angle_error(&self, run: &Trajectory, exact: &[SpatialChainMotion]) -> f64 {
        let errors = self.angles.iter().enumerate().map(|(place, name)| {
            let start = self.chain.coordinates[place];
            let exact = exact.iter().map(|motion| motion.coordinates[place] - start);
            largest_difference(&run.column(name), exact)
        });
        errors.fold(0.0, f64::max)
    }

    fn load_error(&self, run: &Trajectory, exact: &[SpatialChainMotion]) -> f64 {
        let last = self.chain.bodies.len() - 1;
        let place = &self.chain.bodies[last].joint;
        let points = [place.outer_point, place.inner_point];
        let (name, kind) = &self.joint;
        let frame = joints::frame(kind, place, points);
        let loaded = Loaded {
            name,
            joint: &in_space(joints::kind(kind), &frame).unwrap(),
            markers: [(last, points[0]), (last - 1, points[1])],
        };
        loaded.load_error(run, exact)
    }
}

fn largest_difference(found: &[f64], exact: impl ExactSizeIterator<Item = f64>) -> f64 {
    assert_eq!(found.len(), exact.len());
    let differences = found.iter().zip(exact).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

/// A coupling, the least orders of angles, pose, load, energy, and the smallest macro step of three. With k = 2 the
/// multipliers fall to the noise of the solvers, divided by H^2, at once; with Hermite coupling that of the tilted hinge does.
const COUPLINGS: [(&str, [f64; 4], f64); 6] = [
    (
        "method=hermite degree=3 iterations={most=8,tolerance=1e-12}",
        // The multipliers at the macro points are solved for once, with columns that may be older: of the fast top that limits them.
        [6.8, 6.8, 4.5, 6.8],
        2e-2,
    ),
    (
        "method=hermite variant=apv jacobian=every-step",
        [5.0, 5.0, 3.9, 4.9],
        5e-3,
    ),
    (
        "method=hermite variant=apv jacobian=every-step loads=master",
        [5.0, 5.0, 3.9, 4.7],
        5e-3,
    ),
    ("degree=1 exchanged_degree=2", [3.0, 3.0, 2.0, 3.0], 5e-4),
    (
        "degree=2 exchanged_degree=3 jacobian=every-step",
        [3.0, 3.0, 3.0, 3.0],
        1e-3,
    ),
    (
        "index=2 b=0 degree=0 exchanged_degree=2",
        [3.0, 3.0, 1.0, 3.0],
        5e-4,
    ),
];

fn assert_orders(mechanism: &Mechanism) {
    for (coupling, least, smallest) in COUPLINGS {
        let steps = [4.0, 2.0, 1.0].map(|share| share * smallest * mechanism.pace);
        let errors = steps.map(|h| {
            let scene = mechanism.scene(coupling, h);
            mechanism.errors(&run(&scene, Place::InProcess))
        });
        assert_least_orders(coupling, &steps, &errors, least);
    }
}

#[test]
fn orders_of_a_double_pendulum_with_a_universal_joint() {
    assert_orders(&universal_pendulum());
}

#[test]
fn orders_of_a_double_pendulum_with_a_tilted_hinge() {
    assert_orders(&revolute_pendulum());
}

#[test]
fn orders_of_a_top_in_a_gimbal() {
    assert_orders(&gimbal());
}

#[test]
fn one_exchange_a_worker_and_macro_step() {
    for mechanism in [universal_pendulum(), revolute_pendulum(), gimbal()] {
        let scene = mechanism.scene("degree=1 jacobian=every-step", 1e-3);
        let connector = Connector::new(Place::InProcess);
        let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
        let mut simulation =
            CoSimulation::start(&scene, &mut connect, &Options::default()).unwrap();
        let before = simulation.statistics().exchanges;
        for step in 1..=4 {
            assert!(simulation.macro_step().unwrap());
            assert_eq!(simulation.statistics().exchanges - before, 2 * step);
        }
    }
}
