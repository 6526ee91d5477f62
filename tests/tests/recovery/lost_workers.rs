//! A worker that is lost is replaced, and the run goes on.

use std::path::PathBuf;

use linchpin_tests::process::{Peer, Workshop};
use linchpin_tests::python::{Python, in_repository, python};
use rustix::process::Signal;

use crate::seen::{send, wait_for_bytes};
use crate::{
    DOUBLE_PENDULUM, OSCILLATOR, SPLIT, recoveries, report, run, undisturbed, with_python_worker,
    workshop,
};

/// Runs the scene, sends `signal` to the worker of `subsystem` when the table has some bytes, and again when it has more; the bits must be
/// those of the undisturbed run. Gives the steps that were repeated.
#[track_caller]
fn assert_recovers(workshop: &Workshop, settings: &[&str], subsystem: &str, signal: Signal) -> u64 {
    let expected = undisturbed(workshop, settings);
    let mut running = workshop.start(&run("out", settings));
    for share in [4, 2] {
        wait_for_bytes(&mut running, workshop, "out", expected.len() as u64 / share);
        send(&mut running, subsystem, signal);
    }
    let outcome = running.wait();
    outcome
        .succeeds()
        .says(&["takes the place of a lost one", subsystem]);
    assert!(
        workshop.read("out/results.csv") == expected,
        "other results\n{outcome}"
    );
    let (workers, repeated) = recoveries(&report(workshop, "out"));
    assert!((1..=2).contains(&workers), "{workers}\n{outcome}");
    repeated
}

const LONG: &str = "scene.t_end=20";

#[test]
fn a_worker_that_is_killed_is_replaced() {
    let workshop = workshop(OSCILLATOR);
    let settings = [LONG, "run.export_every=50"];
    let repeated = assert_recovers(&workshop, &settings, "mass2", Signal::KILL);
    assert!(repeated <= 2 * 50, "{repeated}");
}

#[test]
fn a_worker_that_hangs_is_replaced_after_the_deadline() {
    let workshop = workshop(OSCILLATOR);
    assert_recovers(
        &workshop,
        &[LONG, "run.deadline=0.5"],
        "mass1",
        Signal::STOP,
    );
}

/// Columns, instants, integrals, varying steps and degrees: requests with everything in them.
#[test]
fn whatever_the_method_asks_for() {
    for settings in [
        &[
            "coupling.method=hermite",
            "coupling.degree=4",
            "coupling.moments=integrals",
            "coupling.macro_step=2e-4",
        ][..],
        &[
            "coupling.method=hermite",
            "coupling.tolerance=1e-9",
            "coupling.macro_step=2e-4",
            "coupling.greatest_step=4e-4",
            "coupling.degree=automatic",
        ],
        &["output.interval=3e-4", "coupling.macro_step=1e-4"],
        &[
            "coupling.method=penalty",
            "coupling.stiffness=1e6",
            "coupling.damping=1e2",
            "coupling.macro_step=5e-5",
        ],
    ] {
        let workshop = workshop(DOUBLE_PENDULUM);
        let settings = [settings, &["run.export_every=20"]].concat();
        assert_recovers(&workshop, &settings, "link2", Signal::KILL);
    }
}

#[test]
fn unary_calls_have_it_as_well() {
    let workshop = workshop(OSCILLATOR);
    let settings = [
        "scene.t_end=4",
        "subsystem.*.calls=unary",
        "run.export_every=30",
    ];
    let repeated = assert_recovers(&workshop, &settings, "mass2", Signal::KILL);
    assert!(repeated <= 2 * 30, "{repeated}");
}

/// The Python worker of these tests exports no states: another one repeats the run from its start.
#[test]
fn a_worker_that_exports_nothing_repeats_all_steps() {
    let workshop = workshop(&with_python_worker());
    let settings = ["scene.t_end=3", "run.recoveries=2"];
    let repeated = assert_recovers(&workshop, &settings, "mass2", Signal::KILL);
    assert!(repeated > 100, "{repeated}");
}

/// Impacts that partners take part in: what a master has said of them is a part of the state.
#[test]
fn impacts_across_joints_have_it_as_well() {
    for every in ["run.export_every=1", "run.export_every=1000"] {
        let workshop = workshop(SPLIT);
        let settings = [
            "coupling.macro_step=5e-6",
            "subsystem.slider.solver.step=1e-6",
            "scene.t_end=0.012",
            every,
        ];
        assert_recovers(&workshop, &settings, "slider", Signal::KILL);
    }
}

/// In place of the built-in worker comes one in Python, which integrates as exactly but rounds otherwise.
#[test]
fn a_worker_with_other_bits_ends_the_run() {
    let workshop = Workshop::new();
    let program = workshop.command::<&str>(&[]).get_program().to_owned();
    let Python { interpreter, stubs } = python();
    let script = "if test -e begun; then PYTHONPATH=$2 exec $3 $4 --listen $1; fi; touch begun; exec $0 worker --exit-with-stdin --listen $1";
    let words = [
        "sh".into(),
        "-c".into(),
        script.into(),
        PathBuf::from(program),
        "{address}".into(),
        stubs.clone(),
        interpreter.clone(),
        in_repository("tests/python/oscillator_worker.py"),
    ];
    let served = format!("command = {words:?}\nmodel = \"oscillator\"  ");
    let text = OSCILLATOR.replacen("model = \"oscillator\"  ", &served, 1);
    workshop.write(
        "scene.toml",
        text.replacen("solver = { kind = \"exact\" } ", "", 1),
    );
    let settings = ["scene.t_end=1000", "run.export_every=1000000"];
    let mut running = workshop.start(&run("out", &settings));
    running.wait_for_rows("out");
    send(&mut running, "mass1", Signal::KILL);
    running.wait().fails(
        1,
        &[
            "\"mass1\"",
            "was lost",
            "in 1 attempt: repeating its macro steps it came to ",
            "must give the same bits",
            "out/results.csv",
        ],
    );
}

/// A worker that was started by somebody else, and is started again by somebody else.
#[test]
fn a_worker_at_an_address_may_come_back_there() {
    let address = |text: &str, address: &str| {
        let served = format!("address = \"{address}\"\nmodel = \"oscillator\"  ");
        text.replacen("model = \"oscillator\"  ", &served, 1)
    };
    let workshop = workshop(OSCILLATOR);
    let expected = undisturbed(&workshop, &[LONG]);
    let socket = format!("unix:{}/standing.sock", workshop.path().display());
    workshop.write("scene.toml", address(OSCILLATOR, &socket));
    let listen = ["worker", "--listen", &socket];
    let begin = || {
        let mut command = workshop.command(&listen);
        command.stdout(std::process::Stdio::null());
        command.spawn().unwrap()
    };
    let mut worker = begin();
    let mut running = workshop.start(&run("out", &[LONG]));
    wait_for_bytes(&mut running, &workshop, "out", expected.len() as u64 / 3);
    worker.kill().unwrap();
    worker.wait().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(700));
    let mut worker = begin();
    running.wait().exits_with(0).says(&["mass1", "lost"]);
    assert!(workshop.read("out/results.csv") == expected);
    worker.kill().unwrap();
    worker.wait().unwrap();
}

/// The instance is gone, the worker and the connection are not.
#[test]
fn an_instance_that_somebody_ends_is_made_anew() {
    for (calls, end) in [("automatic", LONG), ("unary", "scene.t_end=3")] {
        let workshop = workshop(OSCILLATOR);
        let expected = undisturbed(&workshop, &[end]);
        let peer = Peer::scripted(&workshop, |script| script);
        let served = format!(
            "address = \"{}\"\ncalls = \"{calls}\"\nmodel = \"oscillator\"  ",
            peer.address()
        );
        workshop.write(
            "scene.toml",
            OSCILLATOR.replacen("model = \"oscillator\"  ", &served, 1),
        );
        let mut running = workshop.start(&run("out", &[end]));
        wait_for_bytes(&mut running, &workshop, "out", expected.len() as u64 / 4);
        let instances = |more: &[&str]| {
            let words = [&["instances", peer.address()], more].concat();
            let listed = workshop.command(&words).output().unwrap();
            assert!(listed.status.success(), "{listed:?}");
            String::from_utf8(listed.stdout).unwrap()
        };
        let listed = instances(&[]);
        let number = listed
            .split_whitespace()
            .find(|word| word.starts_with("0x"));
        instances(&["--end", number.unwrap()]);
        running.wait().exits_with(0).says(&["mass1", "no instance"]);
        assert!(workshop.read("out/results.csv") == expected, "{calls}");
    }
}

#[test]
fn a_loss_ends_the_run_if_the_scene_says_so() {
    let workshop = workshop(OSCILLATOR);
    let mut running = workshop.start(&run("out", &["scene.t_end=1000", "run.recoveries=0"]));
    running.wait_for_rows("out");
    send(&mut running, "mass2", Signal::KILL);
    let outcome = running.wait();
    outcome.fails(
        1,
        &["\"mass2\"", "was lost", "signal: 9", "out/results.csv"],
    );
    assert!(!outcome.stderr.contains("attempt"), "{outcome}");
}

/// A shell that starts the worker the first time only.
#[test]
fn a_worker_that_cannot_be_replaced_ends_the_run_with_both_reasons() {
    let once = "command = [\"sh\", \"-c\", \"test -e begun && exit 7; touch begun; exec $0 worker --exit-with-stdin --listen $1\", \
                \"PROGRAM\", \"{address}\"]\nmodel = \"oscillator\"  ";
    let workshop = Workshop::new();
    let program = workshop.command::<&str>(&[]).get_program().to_owned();
    let once = once.replace("PROGRAM", program.to_str().unwrap());
    workshop.write(
        "scene.toml",
        OSCILLATOR.replacen("model = \"oscillator\"  ", &once, 1),
    );
    let mut running = workshop.start(&run("out", &["scene.t_end=1000", "run.recoveries=2"]));
    running.wait_for_rows("out");
    let workers = running.workers("/mass1");
    assert_eq!(workers.len(), 1, "{workers:?}");
    send(&mut running, "mass1", Signal::KILL);
    running.wait().fails(
        1,
        &[
            "\"mass1\"",
            "was lost",
            "signal: 9",
            "no other worker could take its place in 2 attempts",
            "exit status: 7",
            "out/results.csv",
        ],
    );
}
