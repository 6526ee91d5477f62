//! Processes that are ended during a run.

use std::fs;
use std::time::Duration;

use linchpin_tests::process::{Running, Workshop};
use rustix::process::{Pid, Signal, kill_process};

use crate::{rows, run, served_by, workshop};

const SOON: Duration = Duration::from_secs(5);

/// A run that would take minutes, with rows in its table already.
fn long_run(workshop: &Workshop, more: &[&str]) -> Running {
    let mut running = workshop.start(&run(more));
    running.wait_for_rows("out");
    running
}

fn long_scene() -> Workshop {
    workshop(&[("t_end = 1.0", "t_end = 10000.0")])
}

fn worker(running: &Running, name: &str) -> i32 {
    let workers = running.workers(&format!("{name}.sock"));
    assert_eq!(workers.len(), 1, "{workers:?}");
    workers[0]
}

fn send(pid: i32, signal: Signal) {
    kill_process(Pid::from_raw(pid).unwrap(), signal).unwrap();
}

#[test]
fn a_worker_that_is_killed() {
    let workshop = long_scene();
    let running = long_run(&workshop, &[]);
    send(worker(&running, "mass2"), Signal::KILL);
    let outcome = running.wait();
    outcome.fails(
        1,
        &[
            "\"mass2\"",
            "t = ",
            "was lost",
            "signal: 9",
            "out/results.csv",
        ],
    );
    assert!(!rows(&workshop).is_empty());
}

#[test]
fn a_worker_that_is_stopped() {
    let workshop = long_scene();
    let running = long_run(&workshop, &["--set", "run.deadline=0.5"]);
    send(worker(&running, "mass1"), Signal::STOP);
    let outcome = running.wait();
    outcome.fails(1, &["\"mass1\"", "t = ", "within 0.5 s", "run.deadline"]);
}

#[test]
fn a_worker_that_is_killed_between_its_unary_calls() {
    let workshop = long_scene();
    let running = long_run(&workshop, &["--set", "subsystem.mass2.calls=unary"]);
    send(worker(&running, "mass2"), Signal::KILL);
    running.wait().fails(1, &["\"mass2\"", "t = ", "signal: 9"]);
}

#[test]
fn a_master_that_is_killed_takes_its_workers_along() {
    let workshop = long_scene();
    let running = long_run(&workshop, &[]);
    assert_eq!(running.workers("worker").len(), 2);
    running.send(Signal::KILL);
    running.wait().leaves_no_process();
    let text = workshop.read("out/results.csv");
    let (whole, _) = text.rsplit_once('\n').unwrap();
    assert!(
        whole.lines().count() > 1,
        "what had been written can be read"
    );
}

#[test]
fn an_interrupt_ends_the_run_in_good_order() {
    let ctrl_c = |running: &Running| running.press_ctrl_c();
    let terminate = |running: &Running| running.send(Signal::TERM);
    for interrupt in [&ctrl_c as &dyn Fn(&Running), &terminate] {
        let workshop = long_scene();
        let running = long_run(&workshop, &[]);
        interrupt(&running);
        let outcome = running.wait();
        outcome.fails(130, &["interrupted at t = ", "out/results.csv"]);
        let last = rows(&workshop).last().unwrap()[0];
        assert!(
            outcome
                .stderr
                .contains(&format!("interrupted at t = {last} s")),
            "{outcome}"
        );
    }
}

#[test]
fn an_interrupt_of_a_run_in_one_process() {
    for more in [&["--in-process"][..], &["--in-process", "--threads"]] {
        let workshop = long_scene();
        let running = long_run(&workshop, more);
        running.press_ctrl_c();
        running
            .wait()
            .fails(130, &["interrupted at t = ", "out/results.csv"]);
    }
}

#[test]
fn an_interrupt_while_a_worker_starts() {
    let workshop = served_by(
        "command = [\"sh\", \"-c\", \"echo $$ > started; sleep 1000; true\", \"{address}\"]",
    );
    let mut running = workshop.start(&run(&[]));
    let started = workshop.path().join("started");
    running.wait_until("the worker", |_| {
        fs::read_to_string(&started).is_ok_and(|pid| !pid.is_empty())
    });
    running.press_ctrl_c();
    running
        .wait()
        .fails(130, &["interrupted at t = 0 s"])
        .takes_less_than(SOON);
}

#[test]
fn an_interrupt_while_a_worker_hangs() {
    let workshop = long_scene();
    let running = long_run(&workshop, &[]);
    send(worker(&running, "mass1"), Signal::STOP);
    running.press_ctrl_c();
    running
        .wait()
        .fails(130, &["interrupted at t = "])
        .takes_less_than(SOON);
}

#[test]
fn a_second_interrupt_ends_a_step_that_cannot_be_left() {
    let slow = "kind = \"rk4\", step = 1e-7 }  ";
    let workshop = workshop(&[
        ("kind = \"exact\" }  ", slow),
        ("macro_step = 1e-3", "macro_step = 0.9"),
    ]);
    let mut running = workshop.start(&run(&["--in-process"]));
    running.wait_until("signals are watched", |running| {
        watches_interrupts(running.id())
    });
    running.press_ctrl_c();
    running.wait_until("a word on the first", |running| {
        running.stderr().contains("interrupt again")
    });
    running.press_ctrl_c();
    let outcome = running.wait();
    outcome.fails(130, &[]);
    assert!(!outcome.stderr.contains("interrupted at t"), "{outcome}");
}

/// Whether a process has a handler for SIGINT.
fn watches_interrupts(pid: u32) -> bool {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).unwrap_or_default();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
    let caught = caught.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    caught.is_some_and(|mask| mask & (1 << (Signal::INT.as_raw() - 1)) != 0)
}
