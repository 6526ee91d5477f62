//! Processes that are ended during a run.

use std::fs;
use std::os::unix::process::CommandExt;
use std::process::{Command, Stdio};
use std::time::Duration;

use linchpin_proto::readable::time;
use linchpin_tests::process::{Running, Workshop};
use rustix::process::{Pid, Signal, kill_process};

use crate::{rows, run, served_by, workshop};

/// Far less than the time limits that would end a wait.
const SOON: Duration = Duration::from_secs(20);

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
    let running = long_run(&workshop, &["--set", "run.recoveries=0"]);
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
    let running = long_run(
        &workshop,
        &["--set=run.deadline=0.5", "--set=run.recoveries=0"],
    );
    send(worker(&running, "mass1"), Signal::STOP);
    let outcome = running.wait();
    outcome.fails(1, &["\"mass1\"", "t = ", "within 0.5 s", "run.deadline"]);
}

#[test]
fn a_worker_that_is_killed_between_its_unary_calls() {
    let workshop = long_scene();
    let running = long_run(
        &workshop,
        &[
            "--set=subsystem.mass2.calls=unary",
            "--set=run.recoveries=0",
        ],
    );
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

/// A shell that runs a script with these arguments, as [`Workshop::command`] runs the program.
fn shell(workshop: &Workshop, script: &str, first: &[&str], more: &[&str]) -> Command {
    let mut command = Command::new("sh");
    command
        .args(["-c", script])
        .args(first)
        .args(more)
        .current_dir(workshop.path())
        .env("TMPDIR", workshop.path())
        .stdin(Stdio::null())
        .process_group(0);
    command
}

/// What `out/run.json` says.
fn report(workshop: &Workshop) -> serde_json::Value {
    serde_json::from_str(&workshop.read("out/run.json")).unwrap()
}

/// Every signal that ends a process unless it is watched.
const SIGNALS: [Signal; 6] = [
    Signal::INT,
    Signal::TERM,
    Signal::HUP,
    Signal::QUIT,
    Signal::XCPU,
    Signal::USR1,
];

#[test]
fn a_signal_ends_the_run_in_good_order() {
    for signal in SIGNALS {
        for more in [&[][..], &["--in-process"]] {
            let workshop = long_scene();
            let running = long_run(&workshop, more);
            assert_eq!(report(&workshop)["status"], "running");
            running.send(signal);
            let outcome = running.wait();
            let code = 128 + signal.as_raw();
            outcome.fails(code, &["interrupted at t = ", "out/results.csv"]);
            let last = rows(&workshop).last().unwrap()[0];
            let at = format!("interrupted at t = {} s", time(last));
            assert!(outcome.stderr.contains(&at), "{outcome}");
            let report = report(&workshop);
            assert_eq!(report["status"], "interrupted", "{report}");
            let reason = report["reason"].as_str().unwrap();
            assert!(reason.contains(&at) && reason.contains("(SIG"), "{reason}");
            // The first row is that of the start.
            let steps = report["statistics"]["macro_steps"].as_u64().unwrap();
            assert_eq!(steps + 1, rows(&workshop).len() as u64);
        }
    }
}

#[test]
fn ctrl_c_at_the_terminal_ends_the_run_in_good_order() {
    let workshop = long_scene();
    let running = long_run(&workshop, &[]);
    running.press_ctrl_c();
    running.wait().fails(130, &["interrupted at t = "]);
}

/// As `nohup` starts a command.
#[test]
fn a_hangup_that_is_ignored_stays_ignored() {
    let workshop = long_scene();
    let program = workshop.command(&run(&[])).get_program().to_owned();
    let mut running = workshop.start_command(shell(
        &workshop,
        "trap '' HUP; exec \"$0\" \"$@\"",
        &[program.to_str().unwrap()],
        &run(&[]),
    ));
    running.wait_for_rows("out");
    running.send(Signal::HUP);
    let before = fs::metadata(workshop.path().join("out/results.csv"))
        .unwrap()
        .len();
    running.wait_until("more rows behind the hangup", |_| {
        fs::metadata(workshop.path().join("out/results.csv")).is_ok_and(|own| own.len() > before)
    });
    running.send(Signal::TERM);
    running.wait().fails(143, &["interrupted at t = "]);
}

/// The system sends it again every second, and a terminal that closes sends its signal more than once.
#[test]
fn signals_that_come_again_by_themselves_do_not_end_the_run_at_once() {
    for signal in [Signal::HUP, Signal::XCPU, Signal::USR1] {
        let workshop = long_scene();
        let running = long_run(&workshop, &[]);
        for _ in 0..20 {
            // It may have ended by now.
            let _ = kill_process(Pid::from_raw(running.id() as i32).unwrap(), signal);
        }
        running
            .wait()
            .fails(128 + signal.as_raw(), &["out/results.csv"]);
        assert_eq!(report(&workshop)["status"], "interrupted");
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

/// The limit is in blocks of 512 or 1024 bytes.
#[test]
fn a_limit_on_the_size_of_files() {
    let workshop = long_scene();
    let program = workshop.command(&run(&[])).get_program().to_owned();
    let running = workshop.start_command(shell(
        &workshop,
        "ulimit -f 100; exec \"$0\" \"$@\"",
        &[program.to_str().unwrap()],
        &run(&[]),
    ));
    let outcome = running.wait();
    outcome.fails(1, &["out/results.csv", "File too large", "ulimit -f"]);
    let rows = rows(&workshop);
    assert!(rows.len() > 10, "{outcome}");
    let text = workshop.read("out/results.csv");
    assert!(
        text.ends_with('\n') && text.len() > 30_000,
        "{}",
        text.len()
    );
    let report = report(&workshop);
    assert_eq!(report["status"], "failed", "{report}");
    assert!(
        report["reason"]
            .as_str()
            .unwrap()
            .contains("File too large")
    );
}

/// Whether a process has a handler for SIGINT.
fn watches_interrupts(pid: u32) -> bool {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).unwrap_or_default();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
    let caught = caught.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    caught.is_some_and(|mask| mask & (1 << (Signal::INT.as_raw() - 1)) != 0)
}
