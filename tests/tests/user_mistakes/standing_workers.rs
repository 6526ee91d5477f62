//! Workers that stand while masters come and go.

use std::time::{Duration, Instant};

use linchpin_tests::process::{Running, Workshop};
use rustix::process::Signal;

use crate::{oscillator, run};

/// A worker for so many instances, and the address at which it listens.
fn standing(workshop: &Workshop, more: &[&str]) -> (Running, String) {
    let address = format!("unix:{}", workshop.path().join("standing.sock").display());
    let listen = ["worker", "--listen", &address];
    let mut worker = workshop.command(&[&listen[..], more].concat());
    // A folder of its own for the outputs, which those of the masters would overwrite.
    let own = Workshop::new();
    worker.current_dir(own.path());
    let mut running = own.start_command(worker);
    running.wait_until("the worker", |running| {
        running.stdout().contains("listening on")
    });
    std::mem::forget(own);
    (running, address)
}

/// The oscillator scene with both masses on one worker, for a long time.
fn scene(address: &str, calls: &str) -> String {
    let served = format!("address = \"{address}\"\ncalls = \"{calls}\"\nmodel = \"oscillator\"  ");
    let text = oscillator(&[("t_end = 1.0", "t_end = 10000.0")]);
    let text = text.replacen("model = \"oscillator\"  ", &served, 1);
    let (first, second) = text
        .split_once("name = \"mass2\"\nmodel = \"oscillator\"")
        .unwrap();
    format!("{first}name = \"mass2\"\n{}{second}", served.trim_end())
}

/// Masters that are killed leave a worker that is free again within seconds.
#[test]
fn a_worker_is_free_again_after_masters_were_killed() {
    for calls in ["automatic", "unary"] {
        let workshop = Workshop::new();
        let (worker, address) = standing(&workshop, &["--max-instances", "4"]);
        workshop.write("scene.toml", scene(&address, calls));
        // As many as fill it.
        for _ in 0..2 {
            let mut master = workshop.start(&run(&[]));
            master.wait_for_rows("out");
            master.send(Signal::KILL);
            master.wait();
            std::fs::remove_file(workshop.path().join("out/results.csv")).unwrap();
        }
        let started = Instant::now();
        while !list(&workshop, &address).contains("instances: 0") {
            assert!(
                started.elapsed() < Duration::from_secs(20),
                "{}",
                list(&workshop, &address)
            );
            std::thread::sleep(Duration::from_millis(50));
        }
        workshop
            .run(&run(&["--set", "scene.t_end=0.05"]))
            .exits_with(0);
        worker.send(Signal::TERM);
        worker.wait().exits_with(0);
    }
}

fn list(workshop: &Workshop, address: &str) -> String {
    workshop
        .run(&["instances", address])
        .exits_with(0)
        .stdout
        .clone()
}

/// However a run ends, its instances end with it.
#[test]
fn runs_that_end_in_order_leave_no_instance() {
    let workshop = Workshop::new();
    let (worker, address) = standing(&workshop, &["--lease", "1000"]);
    workshop.write("scene.toml", scene(&address, "automatic"));
    let sound = ["--set", "scene.t_end=0.05"];
    let wrong = ["--set", "subsystem.mass2.parameters.m=-1"];
    let diverging = [
        "--set",
        "coupling.method=penalty",
        "--set",
        "coupling.stiffness=1e9",
    ];
    for (more, code) in [(&sound[..], 0), (&wrong, 2), (&diverging, 1)] {
        for calls in ["automatic", "unary"] {
            let calls = format!("subsystem.*.calls={calls}");
            let more = [more, &["--set", &calls]].concat();
            workshop.run(&run(&more)).exits_with(code);
            assert!(list(&workshop, &address).starts_with("instances: 0"));
        }
    }
    for signal in [Signal::INT, Signal::HUP] {
        std::fs::remove_file(workshop.path().join("out/results.csv")).unwrap();
        let mut master = workshop.start(&run(&[]));
        master.wait_for_rows("out");
        master.send(signal);
        master.wait().exits_with(128 + signal.as_raw());
        assert!(list(&workshop, &address).starts_with("instances: 0"));
    }
    worker.send(Signal::TERM);
    worker.wait().exits_with(0);
}

/// A master that is stopped answers nothing, and keeps its instances.
#[test]
fn a_master_that_is_stopped_keeps_its_instances() {
    for calls in ["automatic", "unary"] {
        let workshop = Workshop::new();
        let (worker, address) = standing(&workshop, &["--lease", "0.1"]);
        workshop.write("scene.toml", scene(&address, calls));
        let mut master = workshop.start(&run(&[]));
        master.wait_for_rows("out");
        master.send(Signal::STOP);
        std::thread::sleep(Duration::from_secs(2));
        let listed = workshop.command(&["instances", &address]).output().unwrap();
        let listed = String::from_utf8_lossy(&listed.stdout).into_owned();
        assert!(
            listed.contains("instances: 2") && listed.contains("held by its master"),
            "{listed}"
        );
        master.send(Signal::CONT);
        std::thread::sleep(Duration::from_millis(200));
        master.send(Signal::TERM);
        master.wait().exits_with(143);
        worker.send(Signal::TERM);
        worker.wait().exits_with(0);
    }
}

#[test]
fn an_instance_is_ended_by_hand() {
    let workshop = Workshop::new();
    let (worker, address) = standing(&workshop, &["--lease", "1000"]);
    workshop.write("scene.toml", scene(&address, "automatic"));
    let mut master = workshop.start(&run(&[]));
    master.wait_for_rows("out");
    master.send(Signal::KILL);
    master.wait();
    let listed = list(&workshop, &address);
    assert!(
        listed.contains("instances: 2") && listed.contains("left by its master, ends in"),
        "{listed}"
    );
    let number = listed
        .lines()
        .nth(1)
        .unwrap()
        .split_whitespace()
        .next()
        .unwrap();
    workshop
        .run(&["instances", &address, "--end", number])
        .exits_with(0)
        .prints(&["instances: 1"]);
    workshop
        .run(&["instances", &address, "--end", number])
        .exits_with(1)
        .says(&[
            "has no instance",
            number.trim_start_matches("0x").trim_start_matches('0'),
        ]);
    workshop
        .run(&["instances", &address, "--end", "seven"])
        .exits_with(2);
    worker.send(Signal::TERM);
    worker.wait().exits_with(0);
    workshop
        .run(&["instances", "unix:/nowhere.sock", "--timeout", "0.2"])
        .exits_with(1)
        .says(&["unix:/nowhere.sock", "is the worker running"]);
}
