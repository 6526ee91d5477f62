//! The slider-crank of S1 Sect. 4.3 against a monolithic solution: the inplane joint in the plane, and the degree of the
//! motion that the bodies exchange.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin::error_norm::ColumnError;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_models::reference::SliderCrank;
use linchpin_tests::convergence::{assert_all_orders, assert_least_orders, slope_of};
use linchpin_tests::evidence;
use linchpin_tests::runs::{Trajectory, run, try_run};
use linchpin_tests::scenes::with_settings;
use linchpin_tests::tuning::{SLIDER_CRANK, TABLE_HEAD, tune};

const SCENE: &str = include_str!("../../scenes/slider-crank.toml");

/// Errors of the couplings stand far above this.
const SOLVER: &str = "subsystem.*.solver={ kind = \"radau5\", rtol = 1e-12, atol = 1e-12 }";

const STEPS: [f64; 4] = [8e-3, 4e-3, 2e-3, 1e-3];

/// The crank has passed its fastest turn.
const T_END: f64 = 1.4;

fn scene(coupling: &str, h: f64) -> Scene {
    let coupling = format!("method={coupling} macro_step={h}");
    let t_end = format!("scene.t_end={T_END}");
    with_settings(SCENE, &coupling, &[SOLVER, &t_end])
}

fn trajectory(coupling: &str, h: f64) -> Trajectory {
    run(&scene(coupling, h), Place::InProcess)
}

/// Relative errors (rms) of the angles, the energy, and the multiplier.
fn errors(trajectory: &Trajectory) -> [f64; 3] {
    let motions = SliderCrank::schweizer_lu()
        .motions(&trajectory.column("t"))
        .unwrap();
    let error = |column: &str, exact: &dyn Fn(usize) -> f64| {
        let mut error = ColumnError::default();
        for (n, value) in trajectory.column(column).into_iter().enumerate() {
            error.add(value, exact(n));
        }
        error
    };
    let angles = [0, 1].map(|link| {
        error(&format!("link{}.angle", link + 1), &|n| {
            motions[n].angles[link]
        })
    });
    let mut energy = ColumnError::default();
    for (found, motion) in total_energy(trajectory).into_iter().zip(&motions) {
        energy.add(found, motion.energy);
    }
    let multiplier = error("slider.lambda", &|n| motions[n].multiplier);
    [ColumnError::together(angles), energy, multiplier].map(|error| error.normalised())
}

fn total_energy(trajectory: &Trajectory) -> Vec<f64> {
    let [one, two] = ["link1.energy", "link2.energy"].map(|column| trajectory.column(column));
    one.iter().zip(two).map(|(one, two)| one + two).collect()
}

#[test]
fn the_start_is_that_of_the_paper() {
    let start = trajectory("weighted a=1 b=0 degree=0", 1e-2);
    assert!((start.column("slider.lambda")[0] - 5.124820).abs() < 5e-7);
    assert!((total_energy(&start)[0] - 26.556718).abs() < 5e-7);
}

/// The exchanged motion limits the order to 5. The crank turns fast: at these steps the highest derivatives still matter.
#[test]
fn orders_of_hermite_coupling() {
    let steps = [2e-2, 1.4e-2, 1e-2];
    for (variant, least) in [("apv", [5.0, 5.0, 4.5]), ("c0pv", [4.0, 4.0, 2.0])] {
        let coupling = format!("hermite variant={variant} jacobian=every-step");
        let errors = steps.map(|h| errors(&trajectory(&coupling, h)));
        assert_least_orders(&coupling, &steps, &errors, least);
    }
}

#[test]
fn orders_of_convergence() {
    let cases = [
        // All coupling variables of degree 0, as in Figs. 19 and 20: the exchanged motion limits the
        // order to 1.
        (
            "baumgarte beta=2e-3 gamma=0 degree=0 exchanged_degree=0 jacobian=every-step",
            [1.0, 1.0, 1.0],
        ),
        (
            "weighted a=1 b=0 degree=0 exchanged_degree=0",
            [1.0, 1.0, 1.0],
        ),
        (
            "weighted a=1 b=1 degree=1 exchanged_degree=1",
            [2.0, 2.0, 2.0],
        ),
        (
            "weighted a=2 b=2.6 degree=2 exchanged_degree=2",
            [3.0, 3.0, 3.0],
        ),
        // Mixed degrees: the multiplier constant, the exchanged motion a parabola.
        (
            "weighted a=1 b=0 degree=0 exchanged_degree=2",
            [3.0, 3.0, 1.0],
        ),
        (
            "weighted a=2 b=2.6 degree=1 exchanged_degree=3",
            [3.0, 4.0, 2.0],
        ),
        (
            "baumgarte beta=0 gamma=0 degree=0 exchanged_degree=2",
            [3.0, 3.0, 1.0],
        ),
    ];
    assert_all_orders(&cases, &STEPS, |coupling, h| {
        errors(&trajectory(coupling, h))
    });
}

/// S1 Sect. 4.3: "the numerical dissipation is significantly reduced if higher order approximation is used (k > 0)".
#[test]
fn higher_degrees_dissipate_less() {
    let loss = |coupling: &str| {
        let energy = total_energy(&trajectory(coupling, 1e-3));
        energy[0] - energy[energy.len() - 1]
    };
    let of_degree = [
        loss("weighted a=1 b=0 degree=0 exchanged_degree=0 jacobian=every-step"),
        loss("weighted a=1 b=1 degree=1 exchanged_degree=1 jacobian=every-step"),
        loss("weighted a=2 b=2.6 degree=2 exchanged_degree=2 jacobian=every-step"),
    ];
    println!("energy lost with k = 0, 1, 2: {of_degree:?} J");
    let [constant, linear, parabola] = of_degree;
    assert!(constant > 0.05, "{of_degree:?}");
    assert!(linear.abs() < 2e-4 * constant, "{of_degree:?}");
    assert!(parabola.abs() < 0.05 * linear.abs(), "{of_degree:?}");
}

/// The exchanged motion alone causes the large error of k = 0; indices 2 and 3 stay stable when its degree is raised.
#[test]
fn mixed_degrees_are_stable_and_far_more_accurate() {
    let angle_error = |coupling: &str| errors(&trajectory(coupling, 1e-2))[0];
    for (coupling, gain) in [
        ("weighted a=1 b=0", 500.0),
        ("baumgarte beta=0 gamma=0", 500.0),
    ] {
        let plain = angle_error(&format!("{coupling} degree=0 exchanged_degree=0"));
        let mixed = angle_error(&format!("{coupling} degree=0 exchanged_degree=2"));
        println!("{coupling}: {plain:.2e} {mixed:.2e}");
        assert!(plain > gain * mixed, "{coupling}: {plain:e} {mixed:e}");
    }
}

/// The worker evaluates the load at the pose that its body has at every instant, or gets it as force and moment.
#[test]
fn both_forms_of_the_load_agree_to_the_order_of_the_method() {
    let cases = [
        ("weighted a=1 b=0 degree=0 exchanged_degree=0", 1.0),
        ("weighted a=1 b=1 degree=1 exchanged_degree=1", 2.0),
        ("weighted a=2 b=2.6 degree=1 exchanged_degree=2", 3.0),
    ];
    for (coupling, order) in cases {
        let differences = STEPS.map(|h| {
            let [worker, master] = ["worker", "master"].map(|form| {
                trajectory(&format!("{coupling} loads={form}"), h).column("link1.angle")
            });
            let pairs = worker.iter().zip(master);
            pairs
                .map(|(one, two)| (one - two).abs())
                .fold(0.0, f64::max)
        });
        let slope = slope_of(STEPS.into_iter().zip(differences));
        println!("{coupling}: {slope:.2} {differences:?}");
        assert!(slope > order - 0.15, "{coupling}: {slope} {differences:?}");
    }
}

#[test]
fn tuned_springs_reach_their_errors() {
    for tuned in SLIDER_CRANK {
        let [angles, ..] = errors(&trajectory(&tuned.coupling(), tuned.macro_step));
        assert!(
            (angles / tuned.error - 1.0).abs() < 0.05,
            "{angles:e} {tuned:?}"
        );
    }
}

const COMMAND: &str =
    "cargo test --release -p linchpin-tests --test slider_crank -- --ignored --nocapture";

/// What penalty coupling can reach if stiffness and damping are tuned with the solution known.
#[test]
#[ignore = "prints a table of docs/evidence/methods.md, and writes it with LINCHPIN_WRITE=1"]
fn best_springs() {
    let mut table = TABLE_HEAD.to_owned();
    for h in [1e-2_f64, 1e-3] {
        for degree in 0..=1 {
            let best = tune([-2.0 * h.log10(), -h.log10()], 2, |values| {
                penalty_error("jacobi", degree, values, h)
            });
            table += &best.row(h, "jacobi", degree);
        }
    }
    evidence::show("methods.md", "springs of the slider-crank", COMMAND, &table);
}

/// Error of the angles; infinite if the run diverges.
fn penalty_error(order: &str, degree: usize, [stiffness, damping]: [f64; 2], h: f64) -> f64 {
    let springs =
        format!("order={order} degree={degree} stiffness={stiffness:e} damping={damping:e}");
    let scene = scene(&format!("penalty {springs}"), h);
    match try_run(&scene, Place::InProcess, &Options::default()) {
        Ok(trajectory) => errors(&trajectory)[0],
        Err(_) => f64::INFINITY,
    }
}
