//! A planar four-bar linkage in a loop of four workers against its solution in the crank's angle.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::{Connector, Place};
use linchpin_master::CoSimulation;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_models::reference::{Bar, FourBar, FourBarMotion, Shake, Side};
use linchpin_tests::convergence::assert_least_orders;
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::with_settings;

const SCENE: &str = include_str!("../../scenes/four-bar.toml");

/// Errors of the couplings stand far above this.
const SOLVER: &str = "subsystem.*.solver={ kind = \"radau5\", rtol = 1e-12, atol = 1e-12 }";

const STEPS: [f64; 3] = [2e-3, 1e-3, 5e-4];

const BARS: [&str; 3] = ["crank", "coupler", "rocker"];
const HINGES: [&str; 4] = [
    "frame-crank",
    "crank-coupler",
    "coupler-rocker",
    "rocker-frame",
];

/// The overrides that take the frame's velocity from all bodies.
const AT_REST: [&str; 5] = [
    "subsystem.frame.parameters.motion.shake.amplitude=0.0",
    "subsystem.frame.parameters.body.frame.velocity=[0.0, 0.0]",
    "subsystem.crank.parameters.vx0=0.0",
    "subsystem.coupler.parameters.vx0=2.319183674055688",
    "subsystem.rocker.parameters.vx0=0.0",
];

const fn bar(m: f64, inertia: f64, length: f64) -> Bar {
    let centre = [length / 2.0, 0.0];
    Bar {
        m,
        inertia,
        length,
        centre,
    }
}

const SHAKEN: FourBar = FourBar {
    bars: [
        bar(1.3, 0.017, 0.4),
        bar(2.1, 0.21, 1.1),
        bar(0.9, 0.08, 0.8),
    ],
    frame_hinges: [[-0.3, 0.2], [0.65, 0.45]],
    side: Side::Right,
    shake: Shake {
        amplitude: 0.07,
        frequency: 2.3,
    },
    gravity: 9.81,
    torque: 0.0,
    angle: 0.7,
    rate: -9.0,
};

const FIXED: FourBar = FourBar {
    shake: Shake {
        amplitude: 0.0,
        frequency: 2.3,
    },
    ..SHAKEN
};

fn scene(coupling: &str, others: &[&str]) -> Scene {
    let others = [&[SOLVER, "scene.t_end=0.4"], others].concat();
    with_settings(SCENE, coupling, &others)
}

/// Largest errors of the angles, the rates, the hinge forces after the first tenth of the time, and the energy of the bars.
fn errors(run: &Trajectory, linkage: &FourBar) -> [f64; 4] {
    let motions = linkage.motions(&run.column("t")).unwrap();
    let error = |column: &str, exact: &dyn Fn(&FourBarMotion) -> f64| {
        let late = if column.contains("lambda") {
            motions.len() / 10
        } else {
            0
        };
        let found = run.column(column);
        let pairs = found.iter().zip(&motions).skip(late);
        pairs
            .map(|(found, motion)| (found - exact(motion)).abs())
            .fold(0.0, f64::max)
    };
    let of_bars = |what: &str, exact: fn(&FourBarMotion) -> &[f64; 3]| {
        let errors = BARS.iter().enumerate();
        let errors = errors
            .map(|(bar, name)| error(&format!("{name}.{what}"), &|motion| exact(motion)[bar]));
        errors.fold(0.0, f64::max)
    };
    let forces = HINGES.iter().enumerate().flat_map(|(hinge, name)| {
        let error = &error;
        ["x", "y"].into_iter().enumerate().map(move |(axis, end)| {
            error(&format!("{name}.lambda.{end}"), &|motion| {
                motion.hinge_forces[hinge][axis]
            })
        })
    });
    let energies = BARS.map(|bar| run.column(&format!("{bar}.energy")));
    let energy = (0..motions.len()).map(|n| {
        let found: f64 = energies.iter().map(|energy| energy[n]).sum();
        (found - motions[n].energy).abs()
    });
    [
        of_bars("angle", |motion| &motion.angles),
        of_bars("rate", |motion| &motion.rates),
        forces.fold(0.0, f64::max),
        energy.fold(0.0, f64::max),
    ]
}

/// Couplings with the least orders of angles, rates, forces, energy. The shaken frame does work with the forces on it, so
/// their order shows in the energy.
const COUPLINGS: [(&str, [f64; 4]); 4] = [
    ("index=1 degree=1", [4.0, 3.0, 2.0, 3.0]),
    ("index=1 degree=2", [4.0, 3.0, 3.0, 3.0]),
    ("index=2 b=0 degree=0", [3.0, 2.0, 1.0, 3.0]),
    ("index=3 a=0 b=0 degree=0", [4.0, 2.0, 1.0, 2.0]),
];

/// Longer steps: Hermite coupling falls to rounding sooner.
const LONG_STEPS: [f64; 3] = [8e-3, 4e-3, 2e-3];

#[test]
fn orders_of_hermite_coupling() {
    let coupling = "method=hermite variant=apv jacobian=every-step";
    let errors = LONG_STEPS.map(|h| {
        let scene = scene(&format!("{coupling} macro_step={h}"), &[]);
        errors(&run(&scene, Place::InProcess), &SHAKEN)
    });
    assert_least_orders(coupling, &LONG_STEPS, &errors, [5.0, 4.6, 4.5, 4.9]);
}

fn assert_orders(linkage: &FourBar, others: &[&str]) {
    for (coupling, least) in COUPLINGS {
        let errors = STEPS.map(|h| {
            let coupling = format!("{coupling} macro_step={h}");
            errors(&run(&scene(&coupling, others), Place::InProcess), linkage)
        });
        assert_least_orders(coupling, &STEPS, &errors, least);
    }
}

#[test]
fn orders_on_a_frame_at_rest() {
    assert_orders(&FIXED, &AT_REST);
}

#[test]
fn orders_on_a_shaken_frame() {
    assert_orders(&SHAKEN, &[]);
}

#[test]
fn one_exchange_a_worker_and_macro_step() {
    let scene = scene("degree=1 jacobian=every-step", &[]);
    let connector = Connector::new(Place::InProcess);
    let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
    let mut simulation = CoSimulation::start(&scene, &mut connect, &Options::default()).unwrap();
    let before = simulation.statistics().exchanges;
    for step in 1..=4 {
        assert!(simulation.macro_step().unwrap());
        assert_eq!(simulation.statistics().exchanges - before, 4 * step);
    }
}
