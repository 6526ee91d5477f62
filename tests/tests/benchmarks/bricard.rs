//! Bricard's linkage: five rods in a loop whose hinges repeat one condition.

use linchpin::connect::Place;
use linchpin_master::setup::Options;
use linchpin_tests::convergence::assert_least_orders;
use linchpin_tests::runs::{Trajectory, run, try_run};
use linchpin_tests::scenes::with_settings;

use super::{at_the_points_of, largest, relative};

const SPLIT: &str = include_str!("../../../scenes/benchmarks/bricard.toml");
const MONOLITH: &str = include_str!("../../../scenes/monolithic/bricard.toml");

/// Errors of the couplings stand above this.
const SOLVER: &str = "subsystem.*.solver={ kind = \"radau5\", rtol = 1e-12, atol = 1e-12 }";

/// The largest relative errors of place and velocity of the corners, and of the energy, which is constant.
fn errors(found: &Trajectory) -> [f64; 3] {
    let corners = ["rod0", "rod1", "rod2", "rod3"];
    let columns = |what: &str| {
        let of_corner = move |rod: &str| ["x", "y", "z"].map(|axis| format!("{rod}{what}{axis}"));
        corners
            .iter()
            .flat_map(move |rod| of_corner(rod))
            .collect::<Vec<_>>()
    };
    let outputs: Vec<String> = ["-r_", "-r_v"]
        .iter()
        .flat_map(|what| columns(what))
        .map(|column| format!("linkage.{column}"))
        .collect();
    let outputs = format!("output.variables={outputs:?}");
    let exact = at_the_points_of(found, &with_settings(MONOLITH, "", &[&outputs]));
    let of = |own: &str, other: &str| {
        let pairs = columns(own).into_iter().zip(columns(other));
        let pairs = pairs.map(|(own, other)| {
            (
                found.column(&own),
                exact.column(&format!("linkage.{other}")),
            )
        });
        // Coordinates that hardly change have no size of their own.
        let pairs = pairs.filter(|(_, exact)| exact.iter().any(|value| value.abs() > 1e-3));
        let pairs: Vec<_> = pairs.collect();
        largest(pairs.iter().map(|(found, exact)| relative(found, exact)))
    };
    let rods = ["rod0", "rod1", "rod2", "rod3", "rod4"];
    let rods = rods.map(|rod| found.column(&format!("{rod}.energy")));
    let energies = (0..found.rows.len()).map(|row| rods.iter().map(|rod| rod[row]).sum::<f64>());
    let energies: Vec<f64> = energies.collect();
    let lost = largest(energies.iter().map(|energy| (energy - energies[0]).abs()));
    // The joule is what the linkage is about: its height changes by 1 m.
    [of(".r_", "-r_"), of(".r_v", "-r_v"), lost]
}

const CONVERGED: &str = "iterations={most=6,tolerance=1e-10} jacobian=every-step";

fn split(degree: usize, h: f64) -> [f64; 3] {
    let coupling = format!("degree={degree} macro_step={h:e} {CONVERGED}");
    let scene = with_settings(SPLIT, &coupling, &[SOLVER, "scene.t_end=0.5"]);
    errors(&run(&scene, Place::InProcess))
}

#[test]
fn order_of_the_second_degree() {
    let steps = [5e-2, 3.125e-2, 2.5e-2];
    let errors = steps.map(|h| split(2, h));
    assert_least_orders("degree 2", &steps, &errors, [4.8, 5.0, 5.0]);
}

/// At steps at which the second degree has errors of 1e-9.
#[test]
fn the_third_degree_is_far_more_accurate() {
    let [place, velocity, energy] = split(3, 2.5e-2);
    println!("{place:.1e} {velocity:.1e} {energy:.1e}");
    assert!(place < 1e-11 && velocity < 1e-11 && energy < 1e-10);
}

/// With a hinge in j1 one condition repeats the others, and its multiplier is not determined: nothing refuses it at the
/// start, it grows, and the solvers give up.
#[test]
fn a_repeated_condition_ends_the_run() {
    let hinge = [
        "joint.j1.kind=revolute",
        "joint.j1.axis_b=[0.0, 0.0, 1.0]",
        "scene.t_end=0.1",
    ];
    let scene = with_settings(SPLIT, "degree=2", &hinge);
    let ended = try_run(&scene, Place::InProcess, &Options::default());
    println!("{}", ended.unwrap_err());
}
