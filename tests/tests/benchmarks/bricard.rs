//! Bricard's linkage: five rods in a loop whose hinges repeat one condition.

use linchpin::connect::Place;
use linchpin_tests::convergence::assert_least_orders;
use linchpin_tests::runs::{Trajectory, run};
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

/// With a hinge in j1, too, one condition repeats the others: it moves as without, with the order of the method, and says so.
#[test]
fn a_repeated_condition_changes_nothing_but_multipliers() {
    let hinge = [
        SOLVER,
        "joint.j1.kind=revolute",
        "joint.j1.axis_b=[0.0, 0.0, 1.0]",
        "scene.t_end=0.5",
    ];
    for coupling in [
        "degree=2 macro_step=2.5e-2",
        "degree=3 macro_step=2.5e-2",
        "method=weighted degree=2 macro_step=1e-2",
    ] {
        let coupling = format!("{coupling} {CONVERGED}");
        let scene = |joints: &[&str]| with_settings(SPLIT, &coupling, joints);
        let once = run(&scene(&[SOLVER, "scene.t_end=0.5"]), Place::InProcess);
        let found = run(&scene(&hinge), Place::InProcess);
        for (error, own) in errors(&found).into_iter().zip(errors(&once)) {
            println!("{coupling}: {error:.1e}, without {own:.1e}");
            assert!(
                error < 20.0 * own + 1e-11,
                "{coupling}: {error:e}, without {own:e}"
            );
        }
        let told = &found.statistics.redundancy;
        assert_eq!(told.conditions, 1, "{told:?}");
        assert_eq!(told.joints, ["j1", "j2", "j3", "j4"]);
        let warnings = found.statistics.warnings();
        let warnings: Vec<String> = warnings.iter().map(ToString::to_string).collect();
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        for word in ["j1, j2, j3, j4", "1 redundant condition", "least norm"] {
            assert!(warnings[0].contains(word), "{}", warnings[0]);
        }
    }
}
