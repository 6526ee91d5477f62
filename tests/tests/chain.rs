//! The hanging chain, one worker a link, against its monolithic solution.

#![allow(clippy::unwrap_used, missing_docs)]

use std::fmt::Write;

use linchpin::connect::{Connector, Place};
use linchpin_master::CoSimulation;
use linchpin_master::cosimulation::Options;
use linchpin_master::scene::{Scene, parse};
use linchpin_models::reference::{Chain, GroundHinge, Link};
use linchpin_tests::runs::run;

const LENGTH: f64 = 0.7;
const MASS: f64 = 1.3;
const INERTIA: f64 = 0.06;

/// Links at awkward angles from the x axis, hanging down.
fn angles(n: usize) -> Vec<f64> {
    (0..n)
        .map(|link| -1.2 + 0.3 * (1.7 * link as f64).sin())
        .collect()
}

fn scene(n: usize, h: f64, t_end: f64) -> Scene {
    let angles = angles(n);
    let mut text = format!(
        "[scene]\nname = \"chain\"\nt_end = {t_end}\n[coupling]\nmethod = \"weighted\"\ndegree = 1\nmacro_step = {h}\n"
    );
    let (mut x, mut y) = (0.0, 0.0);
    let common = format!("m = {MASS}, inertia = {INERTIA}, length = {LENGTH}");
    let solver = "solver = { kind = \"radau5\", rtol = 1e-11, atol = 1e-11 }";
    for (link, angle) in angles.iter().enumerate() {
        let (model, place) = match link {
            0 => ("pendulum", String::new()),
            _ => ("planar-body", format!(", x0 = {x:?}, y0 = {y:?}")),
        };
        writeln!(
            text,
            "[[subsystem]]\nname = \"link{link}\"\nmodel = \"{model}\"\nparameters = {{ {common}{place}, angle0 = {angle:?} }}\n{solver}"
        )
        .unwrap();
        x += LENGTH * angle.cos();
        y += LENGTH * angle.sin();
    }
    for hinge in 1..n {
        let a = if hinge == 1 { "tip" } else { "end" };
        writeln!(
            text,
            "[[joint]]\nname = \"hinge{hinge}\"\nkind = \"atpoint\"\na = \"link{}.{a}\"\nb = \"link{hinge}.start\"",
            hinge - 1
        )
        .unwrap();
    }
    let variables: Vec<String> = (0..n).map(|link| format!("\"link{link}.angle\"")).collect();
    writeln!(text, "[output]\nvariables = [{}]", variables.join(", ")).unwrap();
    parse(&text, "chain", &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

fn reference(n: usize) -> Chain {
    Chain {
        link: Link {
            m: MASS,
            inertia: INERTIA,
            length: LENGTH,
        },
        hinge: GroundHinge::default(),
        gravity: 9.81,
        angles: angles(n),
        rates: vec![0.0; n],
    }
}

#[test]
fn angles_and_forces_are_those_of_the_monolithic_chain() {
    for n in [2, 3, 5, 8] {
        let trajectory = run(&scene(n, 1e-3, 0.3), Place::InProcess);
        let motions = reference(n).motions(&trajectory.column("t")).unwrap();
        for link in 0..n {
            let found = trajectory.column(&format!("link{link}.angle"));
            let off = |(found, motion): (&f64, &linchpin_models::reference::LinkMotion)| {
                (found - motion.angles[link]).abs()
            };
            let worst = found.iter().zip(&motions).map(off).fold(0.0, f64::max);
            assert!(worst < 1e-7, "n = {n}, link {link}: {worst:e}");
        }
        for hinge in 1..n {
            let found = trajectory.column(&format!("hinge{hinge}.lambda.y"));
            let last = motions.last().unwrap().hinge_forces[hinge - 1][1];
            let off = (found.last().unwrap() - last).abs() / last.abs().max(1.0);
            assert!(off < 1e-3, "n = {n}, hinge {hinge}: {off:e}");
        }
    }
}

#[test]
fn one_exchange_a_worker_and_macro_step_for_any_length() {
    for n in [2, 16, 64] {
        let scene = scene(n, 1e-3, 5e-3);
        let connector = Connector::new(Place::InProcess);
        let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
        let mut simulation =
            CoSimulation::start(&scene, &mut connect, &Options::default()).unwrap();
        let before = simulation.statistics().exchanges;
        for step in 1..=4 {
            assert!(simulation.macro_step().unwrap());
            assert_eq!(simulation.statistics().exchanges - before, step * n as u64);
        }
    }
}
