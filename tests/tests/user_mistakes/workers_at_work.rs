//! Workers that fail in the middle of a run.

use std::time::Duration;

use linchpin_proto::v1::Failure;
use linchpin_tests::process::{Outcome, Peer, Workshop};
use linchpin_tests::scripted::{Act, Scripted};

use crate::{exists, rows, run, workshop};

/// Exchange number 0 looks ahead from the start, so exchange `STEP` ends macro step number `STEP`.
const STEP: u64 = 18;

/// Runs with a scripted peer as the second mass; the step under way starts at t = 0.017 s.
fn run_with_peer(script: impl FnOnce(Scripted) -> Scripted) -> (Workshop, Outcome) {
    let workshop = workshop(&[]);
    let peer = Peer::scripted(&workshop, script);
    let setting = format!("subsystem.mass2.address={}", peer.address());
    // One exchange for every macro step, whatever the columns are like.
    let once = "coupling.jacobian=every-step";
    let settings = [
        "--set",
        &setting,
        "--set",
        once,
        "--set",
        "run.deadline=0.4",
    ];
    let outcome = workshop.run(&run(&settings));
    (workshop, outcome)
}

/// The run stopped in step [`STEP`], with the rows before it.
#[track_caller]
fn stopped(script: impl FnOnce(Scripted) -> Scripted, words: &[&str]) -> Outcome {
    let (workshop, outcome) = run_with_peer(script);
    let words = [&["\"mass2\"", "t = 0.017", "out/results.csv"], words].concat();
    outcome.fails(1, &words);
    assert_eq!(rows(&workshop).len() as u64, STEP, "{outcome}");
    assert!(
        workshop
            .read("out/run.json")
            .contains("\"status\": \"failed\""),
        "{outcome}"
    );
    outcome
}

#[test]
fn a_true_peer_reaches_the_end() {
    let (workshop, outcome) = run_with_peer(|peer| peer);
    outcome.succeeds();
    assert_eq!(rows(&workshop).len(), 1001);
}

/// The scene has degree 0; a worker that takes nothing else is asked for degree 2.
#[test]
fn a_degree_that_the_worker_cannot_take() {
    let workshop = workshop(&[("degree = 0", "degree = 2")]);
    let peer = Peer::scripted(&workshop, |peer| peer.taking_degree(1));
    let setting = format!("subsystem.mass2.address={}", peer.address());
    let outcome = workshop.run(&run(&["--set", &setting]));
    outcome.fails(
        2,
        &[
            "coupling.degree",
            "\"mass2\"",
            "degree 1 at most, found 2",
            "coupling.degree = 1",
        ],
    );
    let (_workshop, outcome) = run_with_peer(|peer| peer.taking_degree(0));
    outcome.succeeds();
}

/// The degree that follows the estimates would be 3 nearly everywhere.
#[test]
fn an_automatic_degree_stays_below_that_of_the_worker() {
    let automatic = "method = \"weighted\"\ndegree = \"automatic\" # ";
    let workshop = workshop(&[
        ("method = ", "# method = "),
        ("index = 2", "# index = 2"),
        ("beta = 2e-3", "# beta = 2e-3"),
        ("degree = 0", automatic),
    ]);
    for highest in [0, 1, 2] {
        let peer = Peer::scripted(&workshop, |peer| peer.taking_degree(highest));
        let setting = format!("subsystem.mass2.address={}", peer.address());
        workshop.run(&run(&["--set", &setting])).succeeds();
        let rows = rows(&workshop);
        // The last column is the estimated error.
        let degrees = rows.iter().filter_map(|row| row.iter().rev().nth(1));
        assert_eq!(
            degrees.fold(0.0, |most: f64, degree| most.max(*degree)),
            f64::from(highest)
        );
        assert!(
            workshop
                .read("out/run.json")
                .contains("\"degree\": \"automatic\"")
        );
    }
}

/// Hermite coupling with a tolerance would take degrees up to 5; of a worker that takes none above 3 it asks no more, and of one that takes
/// 2 no look inside the step either.
#[test]
fn an_automatic_degree_of_hermite_coupling_stays_below_that_of_the_worker() {
    let automatic = "method = \"hermite\"\ntolerance = 1e-5\ndegree = \"automatic\" # ";
    let workshop = workshop(&[
        ("method = ", "# method = "),
        ("index = 2", "# index = 2"),
        ("beta = 2e-3", "# beta = 2e-3"),
        ("macro_step = 1e-3", "# macro_step = 1e-3"),
        ("degree = 0", automatic),
    ]);
    for highest in [2, 3, 4] {
        let peer = Peer::scripted(&workshop, |peer| peer.taking_degree(highest));
        let setting = format!("subsystem.mass2.address={}", peer.address());
        let outcome = workshop.run(&run(&["--set", &setting]));
        outcome.succeeds();
        let columns = workshop.read("out/results.csv");
        let mut columns = columns.lines().next().unwrap().split(',');
        let degree = columns.position(|name| name == "degree");
        let most = degree.map(|place| {
            let degrees = rows(&workshop).into_iter().map(|row| row[place]);
            degrees.fold(0.0, f64::max)
        });
        assert!(
            most.is_none_or(|most| most <= f64::from(highest)),
            "{highest}: {most:?}"
        );
        assert!(
            highest == 2 || most.is_some_and(|most| most > 2.0),
            "{highest}: {most:?}"
        );
    }
    let peer = Peer::scripted(&workshop, |peer| peer.taking_degree(1));
    let setting = format!("subsystem.mass2.address={}", peer.address());
    let outcome = workshop.run(&run(&["--set", &setting]));
    outcome.fails(2, &["coupling.degree", "\"mass2\"", "degree 1 at most"]);
}

#[test]
fn a_number_that_is_none() {
    for value in [f64::NAN, f64::INFINITY] {
        let put = Act::Put { output: 1, value };
        let words = ["output \"v\"", &value.to_string(), "coupling.macro_step"];
        stopped(|peer| peer.at_exchange(STEP, put), &words);
    }
}

#[test]
fn an_output_that_is_missing() {
    stopped(
        |peer| peer.at_exchange(STEP, Act::ForgetOutput),
        &["outputs instead of", "contract"],
    );
}

#[test]
fn a_failure_that_a_smaller_step_may_cure() {
    let failure = Failure::recoverable(0.0175, 1e-3, "Newton did not converge at t = 0.0175 s");
    let words = ["Newton did not converge", "smaller coupling.macro_step"];
    stopped(|peer| peer.at_exchange(STEP, Act::Fail(failure)), &words);
}

#[test]
fn a_failure_for_good() {
    let failure = Failure::fatal("the mesh is torn");
    let outcome = stopped(
        |peer| peer.at_exchange(STEP, Act::Fail(failure)),
        &["the mesh is torn"],
    );
    assert!(
        !outcome.stderr.contains("smaller coupling.macro_step"),
        "{outcome}"
    );
}

#[test]
fn a_worker_that_hangs_from_the_start() {
    let hang = Act::Wait(Duration::from_secs(6));
    let (workshop, outcome) = run_with_peer(|peer| peer.at_exchange(0, hang));
    outcome.fails(1, &["\"mass2\"", "t = 0 s", "within 0.4 s", "run.deadline"]);
    outcome.takes_less_than(Duration::from_secs(4));
    assert!(!exists(&workshop, "out/results.csv"), "{outcome}");
}

#[test]
fn a_worker_that_hangs() {
    let hang = Act::Wait(Duration::from_secs(6));
    let outcome = stopped(
        |peer| peer.at_exchange(STEP, hang),
        &["within 0.4 s", "run.deadline"],
    );
    outcome.takes_less_than(Duration::from_secs(4));
}
