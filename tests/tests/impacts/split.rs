//! The slider-crank of S2 Table 1, split at the crank pin, against the whole one.

use linchpin_tests::runs::Trajectory;

use crate::{DRIVEN, SPLIT, WHOLE, here, largest, last};

/// Clearance (m).
const CLEARANCE: f64 = 1e-3;

/// The first impact by extrapolation, and its closing speed in m/s: seed data of S2 Table 1.
const FIRST_IMPACT: f64 = 2.6925027520e-3;

const STEPS: [f64; 4] = [2e-4, 1e-4, 5e-5, 2.5e-5];

/// Allowed joint gaps over the clearance at [`STEPS`].
const BOUNDS: [f64; 4] = [0.033, 0.013, 0.007, 0.002];

/// With 20 internal steps in a macro step, and samples at its quarters.
fn split(h: f64, more: &[&str]) -> Trajectory {
    let own = [
        format!("coupling.macro_step={h:e}"),
        format!("subsystem.slider.solver.step={:e}", h / 20.0),
        format!("output.interval={:e}", h / 4.0),
    ];
    let own: Vec<&str> = own.iter().map(String::as_str).collect();
    here(SPLIT, &[&own[..], more].concat())
}

/// Largest distance of the two pins.
fn largest_gap(run: &Trajectory) -> f64 {
    let [x, y] = ["x", "y"].map(|axis| {
        let a = run.column(&format!("crank.tip_{axis}"));
        let b = run.column(&format!("slider.pin_{axis}"));
        a.into_iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>()
    });
    let gaps = x.iter().zip(&y).map(|(x, y)| x.hypot(*y));
    gaps.fold(0.0, f64::max)
}

/// How far the energy with all that impacts and friction took is from that of the start, at most (J).
fn imbalance(run: &Trajectory) -> f64 {
    let parts = [
        "crank.energy",
        "slider.energy",
        "slider.impact_loss",
        "slider.friction_loss",
    ];
    let parts = parts.map(|name| run.column(name));
    let sums: Vec<f64> = (0..parts[0].len())
        .map(|row| parts.iter().map(|part| part[row]).sum())
        .collect();
    sums.iter()
        .fold(0.0, |most: f64, sum| most.max((sum - sums[0]).abs()))
}

fn first_impact(run: &Trajectory) -> f64 {
    let statistics = &run.statistics.subsystems[1];
    statistics.contacts.unwrap().first_impact.unwrap()
}

fn whole() -> Trajectory {
    here(WHOLE, &["subsystem.mechanism.solver.step=1e-6"])
}

/// Joint gaps within the bounds at every fixed step, the joint closed to the order of the step, losses and angles as of the whole
/// mechanism, and loads that do not grow with 1/H.
#[test]
fn the_joint_holds_through_impacts() {
    let whole = whole();
    let (loss, angle) = (
        last(&whole, "mechanism.impact_loss"),
        last(&whole, "mechanism.theta1"),
    );
    let runs = STEPS.map(|h| split(h, &[]));
    let gaps = runs.each_ref().map(|run| largest_gap(run) / CLEARANCE);
    for (gap, bound) in gaps.iter().zip(BOUNDS) {
        assert!(*gap < 0.1 * bound, "{gaps:?}");
    }
    let imbalances = runs.each_ref().map(imbalance);
    for (run, h) in runs.iter().zip(STEPS) {
        // Impacts are found at the ends of internal steps.
        let late = first_impact(run) - FIRST_IMPACT;
        assert!((-1e-9..h / 20.0 + 1e-9).contains(&late), "{late:e}");
        assert!(
            (last(run, "slider.impact_loss") / loss - 1.0).abs() < 12.0 * h,
            "{h}"
        );
        assert!((last(run, "crank.angle") - angle).abs() < 0.4 * h, "{h}");
        let load = largest(run, &["pin.lambda.x", "pin.lambda.y"]);
        assert!((load / 556.0 - 1.0).abs() < 1e-2, "{load}");
    }
    assert!(
        imbalances[1] < 2.5e-4 && imbalances[3] < 2e-5,
        "{imbalances:?}"
    );
    assert!(imbalances[0] > 4.0 * imbalances[2], "{imbalances:?}");
}

/// S1's method with multipliers that are constant over a step, which the bounds were measured with.
#[test]
fn constant_multipliers_keep_the_bounds() {
    for (h, bound) in STEPS.into_iter().zip(BOUNDS) {
        let weighted = [
            "coupling.method=weighted",
            "coupling.index=1",
            "coupling.degree=0",
        ];
        let run = split(h, &weighted);
        let gap = largest_gap(&run) / CLEARANCE;
        assert!(gap < bound, "{h}: {gap}");
    }
}

/// Where forces alone cross the joint they grow as the step falls, and what the impacts take is off by a percent and more; with impulses
/// they stay.
#[test]
fn forces_alone_grow_without_bound() {
    let loss = last(&whole(), "mechanism.impact_loss");
    let with = |impacts: &str| {
        let impacts = format!("coupling.impacts={impacts}");
        [1e-4, 2.5e-5].map(|h| {
            let mut run = split(h, &[&impacts]);
            let off = last(&run, "slider.impact_loss") / loss - 1.0;
            run.rows.retain(|row| row[0] > 2.6e-3);
            (largest(&run, &["pin.lambda.x", "pin.lambda.y"]), off.abs())
        })
    };
    let [coarse, fine] = with("forces");
    assert!(
        fine.0 > 2.0 * coarse.0 && fine.1 > 1e-2,
        "{coarse:?} {fine:?}"
    );
    let [coarse, fine] = with("impulses");
    assert!(
        fine.0 < 1.01 * coarse.0 && fine.1 < 3e-4,
        "{coarse:?} {fine:?}"
    );
}

/// Also polynomials of higher degree, whose conditions are looked at inside the step as well.
#[test]
fn other_couplings_lose_the_same() {
    let loss = last(&whole(), "mechanism.impact_loss");
    for (more, allowed) in [
        (&["coupling.degree=3"][..], 1e-3),
        (
            &[
                "coupling.method=baumgarte",
                "coupling.index=1",
                "coupling.degree=1",
            ],
            1e-3,
        ),
        (
            &[
                "coupling.method=weighted",
                "coupling.index=2",
                "coupling.degree=0",
            ],
            1e-3,
        ),
        (&["coupling.jacobian=every-step"], 1e-3),
        (&["coupling.iterations={ most = 4 }"], 1e-3),
    ] {
        let run = split(1e-4, more);
        let off = last(&run, "slider.impact_loss") / loss - 1.0;
        assert!(off.abs() < allowed, "{more:?}: {off:e}");
        assert!(largest_gap(&run) < 0.013 * CLEARANCE, "{more:?}");
    }
}

/// Where steps follow their error an impact is no reason to shorten them.
#[test]
fn steps_that_vary_pass_impacts() {
    let run = here(SPLIT, &["coupling.tolerance=1e-6"]);
    let whole = whole();
    assert!(
        run.statistics.macro_steps < 250,
        "{}",
        run.statistics.macro_steps
    );
    let loss = last(&whole, "mechanism.impact_loss");
    assert!((last(&run, "slider.impact_loss") / loss - 1.0).abs() < 3e-3);
    let angle = last(&whole, "mechanism.theta1");
    assert!((last(&run, "crank.angle") - angle).abs() < 5e-5);
    assert!(imbalance(&run) < 4e-4, "{:e}", imbalance(&run));
}

/// S2 Table 2: a torque on the crank, half the clearance.
#[test]
fn a_driven_crank_meets_the_second_table() {
    let run = here(DRIVEN, &["subsystem.slider.solver.step=2.5e-6"]);
    let parameters = "subsystem.mechanism.parameters={ c = 5e-4, constant_torque = 1.0 }";
    let whole = here(WHOLE, &[parameters, "subsystem.mechanism.solver.step=1e-6"]);
    let first = run.statistics.subsystems[2]
        .contacts
        .unwrap()
        .first_impact
        .unwrap();
    assert!(
        (-1e-9..2.6e-6).contains(&(first - 7.5201144e-3)),
        "{first:e}"
    );
    let angle = last(&run, "crank.angle") - last(&whole, "mechanism.theta1");
    assert!(angle.abs() < 2e-5, "{angle:e}");
    let loss = last(&run, "slider.impact_loss") / last(&whole, "mechanism.impact_loss");
    assert!((loss - 1.0).abs() < 5e-3, "{loss}");
}
